# Installs BUILD_DIR under WORK_DIR, moves the result, and builds and runs the project beside this file against it and, where the
# programs were built, the example of a model of one's own.
# cmake -DBUILD_DIR= -DWORK_DIR= -DCXX= -DGENERATOR= -DBUILD_TYPE= -DVERSION= [-DPROGRAM= -DEXAMPLE=] -P run.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "exit ${code}: ${command}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/installed")
file(RENAME "${WORK_DIR}/installed" "${WORK_DIR}/moved") # no absolute path may be left in the package

function(build_against_installed source binary)
  run("${CMAKE_COMMAND}"
      -S "${source}"
      -B "${binary}"
      -G "${GENERATOR}"
      "-DCMAKE_PREFIX_PATH=${WORK_DIR}/moved"
      "-DCMAKE_CXX_COMPILER=${CXX}"
      "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
      ${ARGN})
  run("${CMAKE_COMMAND}" --build "${binary}")
endfunction()

# The library alone needs none of the programs' packages.
build_against_installed(
  "${CMAKE_CURRENT_LIST_DIR}" "${WORK_DIR}/build" "-DALBEDO_VERSION=${VERSION}" -DCMAKE_DISABLE_FIND_PACKAGE_OpenEXR=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)
run("${WORK_DIR}/build/consumer")

# Without the library's flags the linker must say for which instruction set the program was compiled.
if(CMAKE_HOST_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  execute_process(
    COMMAND "${CMAKE_COMMAND}" --build "${WORK_DIR}/build" --target mismatched
    RESULT_VARIABLE code
    OUTPUT_VARIABLE message
    ERROR_VARIABLE message)
  if(code EQUAL 0 OR NOT message MATCHES "albedo::(avx|sse2)::Model")
    message(FATAL_ERROR "a program for another instruction set than the library's: exit ${code}: ${message}")
  endif()
endif()
if(NOT PROGRAM)
  return()
endif()
run("${WORK_DIR}/moved/${PROGRAM}" --version)

# The example's model in the hands of every subcommand; its albedo is rho cos(theta)^(k-1).
build_against_installed("${EXAMPLE}" "${WORK_DIR}/example")
set(my_model "${WORK_DIR}/example/my_model")
run("${my_model}" direct)
run("${my_model}" models minnaert)
run("${my_model}" at minnaert k=2.5 --theta 60 --assert "at(60)==0.353553390593274+-1e-8")
run("${my_model}" at minnaert k=0.5 rho=0.3 --theta 80,89.99 --assert "at(80)==0.719923151095259+-1e-8")
run("${my_model}" at sum minnaert:k=2,weight=0.5 lambert:weight=0.5 --theta 60 --assert "at(60)==0.75+-1e-8")
run("${my_model}" curve minnaert k=1.5 -o "${WORK_DIR}/curve.csv" --assert "max<=1.0000001")
run("${my_model}" table minnaert k=1:3:5 cos_theta=0.1:1:10 -o "${WORK_DIR}/table.csv" --assert "min==0.01+-1e-8")
run("${my_model}" audit minnaert k=2.5)
execute_process(
  COMMAND "${my_model}" at minaert --theta 0
  RESULT_VARIABLE code
  ERROR_VARIABLE message)
if(NOT code EQUAL 2 OR NOT message MATCHES "did you mean 'minnaert'")
  message(FATAL_ERROR "a misspelt name: exit ${code}: ${message}")
endif()
