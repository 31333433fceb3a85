# cmake --install: the libraries with their headers and package files (find_package(frep), target frep::frep)
# and the program. Tested by the ctest entry "consumer" (tests/consumer).
include(CMakePackageConfigHelpers)
get_property(frep_targets GLOBAL PROPERTY FREP_INSTALL_TARGETS)
set(frep_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/frep)

install(TARGETS ${frep_targets} frep_settings EXPORT frepTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT frepTargets NAMESPACE frep:: DESTINATION ${frep_package_dir})
install(DIRECTORY src/frep DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.def")

configure_package_config_file(cmake/frepConfig.cmake.in ${PROJECT_BINARY_DIR}/frepConfig.cmake
                              INSTALL_DESTINATION ${frep_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/frepConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/frepConfig.cmake ${PROJECT_BINARY_DIR}/frepConfigVersion.cmake
        DESTINATION ${frep_package_dir})
