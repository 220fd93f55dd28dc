# Flags, as interface targets. Only albedo_arithmetic is part of the installed package.

# albedo_arithmetic: everything that decides a number's last digits or a block's layout.
#
# The models are templates in public headers, and blocks of the machine's vectors pass between a user's code and the library. So these
# flags are a public property of the target, when installed too: the linker may keep a user's copy of a formula in place of the
# library's, and how a block is passed follows the instruction set: code for another one doesn't link (core/instruction_set.hpp).
# A native build serves the machine it was built on; packages turn ALBEDO_NATIVE off.
#   -ffp-contract=off   a formula rounds the same wherever the compiler inlines it (a block's own exp and log ask for fused operations
#                       by name and keep them)
#   -fno-math-errno     sqrt becomes one instruction; no value changes
# Never -ffast-math: it makes NaN and infinity unobservable, and they are findings here.
add_library(albedo_arithmetic INTERFACE)
add_library(albedo::arithmetic ALIAS albedo_arithmetic)
set_target_properties(albedo_arithmetic PROPERTIES EXPORT_NAME arithmetic)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(albedo_arithmetic INTERFACE -ffp-contract=off $<BUILD_INTERFACE:-fno-math-errno>)
  if(ALBEDO_NATIVE)
    target_compile_options(albedo_arithmetic INTERFACE -march=native)
  endif()
endif()

# albedo_warnings: private to this project's own targets.
add_library(albedo_warnings INTERFACE)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(
    albedo_warnings
    INTERFACE -Wall
              -Wextra
              -Wpedantic
              -Wshadow
              -Wconversion
              -Wsign-conversion
              -Wdouble-promotion
              -Wold-style-cast
              -Wcast-align
              -Wcast-qual
              -Wnon-virtual-dtor
              -Woverloaded-virtual
              -Wextra-semi
              -Wformat=2
              $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond>
              $<$<CXX_COMPILER_ID:GNU>:-Wlogical-op>
              $<$<BOOL:${ALBEDO_WERROR}>:-Werror>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 falsely accuses its own headers: AVX-512 intrinsics as Eigen uses them, and strings. clang still looks.
    target_compile_options(albedo_warnings INTERFACE -Wno-uninitialized -Wno-maybe-uninitialized -Wno-restrict
                                                     -Wno-array-bounds -Wno-stringop-overflow)
  endif()
endif()

# albedo_sanitizers: private, and empty unless ALBEDO_SANITIZE names some or ALBEDO_FUZZ asks for all that fuzzing needs.
add_library(albedo_sanitizers INTERFACE)
if(ALBEDO_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "ALBEDO_FUZZ needs clang, whose libFuzzer the targets are linked with, and the compiler is "
                        "${CMAKE_CXX_COMPILER_ID}: use the preset fuzz, or CMAKE_CXX_COMPILER=clang++")
  endif()
  if(NOT ALBEDO_PROGRAMS)
    message(FATAL_ERROR "ALBEDO_FUZZ needs ALBEDO_PROGRAMS=ON: most of the readers are the program's")
  endif()
  if(NOT ALBEDO_SANITIZE)
    set(ALBEDO_SANITIZE address,undefined)
  endif()
  target_compile_options(albedo_sanitizers INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(ALBEDO_SANITIZE)
  target_compile_options(albedo_sanitizers INTERFACE -fsanitize=${ALBEDO_SANITIZE} -fno-sanitize-recover=all
                                                     -fno-omit-frame-pointer)
  target_link_options(albedo_sanitizers INTERFACE -fsanitize=${ALBEDO_SANITIZE})
endif()

# What every target of this project is built with.
function(albedo_target target)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:albedo_warnings> $<BUILD_INTERFACE:albedo_sanitizers>)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()
