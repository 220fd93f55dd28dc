# `cmake --build build/release --target docs` writes doc/html under the build directory and fails on any warning.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND AND PROJECT_IS_TOP_LEVEL)
  configure_file("${PROJECT_SOURCE_DIR}/doc/Doxyfile.in" "${PROJECT_BINARY_DIR}/doc/Doxyfile" @ONLY)
  add_custom_target(
    docs
    COMMAND Doxygen::doxygen "${PROJECT_BINARY_DIR}/doc/Doxyfile"
    WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/doc"
    COMMENT "Documentation in ${PROJECT_BINARY_DIR}/doc/html"
    VERBATIM)
endif()
