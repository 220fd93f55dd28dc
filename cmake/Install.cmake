include(CMakePackageConfigHelpers)

install(TARGETS albedo albedo_arithmetic EXPORT albedoTargets)
install(
  DIRECTORY "${PROJECT_SOURCE_DIR}/include/" "${PROJECT_BINARY_DIR}/include/"
  TYPE INCLUDE
  FILES_MATCHING
  PATTERN "*.hpp"
  PATTERN "command_line.hpp" EXCLUDE)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/albedo")
install(EXPORT albedoTargets NAMESPACE albedo:: DESTINATION "${package_dir}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/albedoConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/albedoConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/albedoConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/albedoConfig.cmake" "${PROJECT_BINARY_DIR}/albedoConfigVersion.cmake"
        DESTINATION "${package_dir}")

if(ALBEDO_PROGRAMS)
  # The component command_line, with a file of its own: whoever doesn't ask for it needs none of its packages.
  install(TARGETS albedo_analysis EXPORT albedoCommandLineTargets)
  install(EXPORT albedoCommandLineTargets NAMESPACE albedo:: DESTINATION "${package_dir}")
  install(FILES "${PROJECT_SOURCE_DIR}/include/albedo/command_line.hpp" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/albedo")

  # A program of a shared build finds its library beside it, wherever the whole is moved.
  file(RELATIVE_PATH bin_to_lib "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  set_target_properties(albedo_program albedo_figures PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
  install(TARGETS albedo_program albedo_figures)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/analysis/data" DESTINATION "${CMAKE_INSTALL_DATADIR}/albedo")
endif()
