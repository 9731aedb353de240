# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY VSA_ROOMS)
install(TARGETS ${rooms} EXPORT vsasimTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/vsa DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY presets models data DESTINATION ${CMAKE_INSTALL_DATADIR}/vsa)
install(EXPORT vsasimTargets NAMESPACE vsa:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vsasim)
configure_package_config_file(cmake/vsasimConfig.cmake.in ${PROJECT_BINARY_DIR}/vsasimConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vsasim)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vsasimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vsasimConfig.cmake ${PROJECT_BINARY_DIR}/vsasimConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vsasim)
