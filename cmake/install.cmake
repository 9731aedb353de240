# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# What is installed. Components are packages (cmake/packages.cmake); `cmake --install` without --component installs all of them.
include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY VSA_ROOMS)
install(TARGETS ${rooms} EXPORT vsasimTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
if(TARGET vsa_shared)
  install(TARGETS vsa_shared EXPORT vsasimTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
endif()
install(DIRECTORY include/vsa DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(DIRECTORY actuators models data DESTINATION ${CMAKE_INSTALL_DATADIR}/vsa COMPONENT data)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/vsa COMPONENT data)
install(EXPORT vsasimTargets NAMESPACE vsa:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vsasim COMPONENT development)
set(VSA_COMPONENTS "")
foreach(target IN LISTS rooms)
  get_target_property(name ${target} EXPORT_NAME)
  list(APPEND VSA_COMPONENTS ${name})
endforeach()
if(TARGET vsa_shared)
  list(APPEND VSA_COMPONENTS shared)
endif()
list(SORT VSA_COMPONENTS)
list(JOIN VSA_COMPONENTS ", " VSA_COMPONENTS)
configure_package_config_file(cmake/vsasimConfig.cmake.in ${PROJECT_BINARY_DIR}/vsasimConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vsasim PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vsasimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vsasimConfig.cmake ${PROJECT_BINARY_DIR}/vsasimConfigVersion.cmake cmake/installed_data.cpp
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vsasim COMPONENT development)

# What makes a shell, a Gazebo and a colcon workspace (colcon.pkg) find all that. The script has the prefix in it, so it is made when
# installing: cmake --install --prefix may name another.
install(CODE "set(CMAKE_INSTALL_DATADIR \"${CMAKE_INSTALL_DATADIR}\")\nset(CMAKE_INSTALL_LIBDIR \"${CMAKE_INSTALL_LIBDIR}\")
  set(CMAKE_INSTALL_BINDIR \"${CMAKE_INSTALL_BINDIR}\")
  get_filename_component(CMAKE_INSTALL_PREFIX \"\${CMAKE_INSTALL_PREFIX}\" ABSOLUTE)
  configure_file(\"${PROJECT_SOURCE_DIR}/plugins/setup.sh.in\" \"${PROJECT_BINARY_DIR}/setup.sh\" @ONLY)" COMPONENT doctor)
install(FILES ${PROJECT_BINARY_DIR}/setup.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/vsa COMPONENT doctor)
configure_file(${PROJECT_SOURCE_DIR}/plugins/hook.dsv.in ${PROJECT_BINARY_DIR}/vsa.dsv @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/vsa.dsv DESTINATION ${CMAKE_INSTALL_DATADIR}/vsa/environment COMPONENT doctor)
install(FILES plugins/hook.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/vsa/environment RENAME vsa.sh COMPONENT doctor)
