# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# toml++ and tinyxml2 where the distribution (Debian 11, Ubuntu 20.04) has no CMake package of them.
find_package(tomlplusplus QUIET)
if(NOT TARGET tomlplusplus::tomlplusplus)
  find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h)
  vsa_need(toml++ libtomlplusplus-dev TOMLPLUSPLUS_INCLUDE_DIR)
  add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
  set_target_properties(tomlplusplus::tomlplusplus PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${TOMLPLUSPLUS_INCLUDE_DIR})
endif()
find_package(tinyxml2 QUIET)
if(NOT TARGET tinyxml2::tinyxml2)
  find_path(TINYXML2_INCLUDE_DIR tinyxml2.h)
  find_library(TINYXML2_LIBRARY tinyxml2)
  vsa_need(tinyxml2.h libtinyxml2-dev TINYXML2_INCLUDE_DIR)
  vsa_need(tinyxml2 libtinyxml2-dev TINYXML2_LIBRARY)
  add_library(tinyxml2::tinyxml2 INTERFACE IMPORTED)
  set_target_properties(tinyxml2::tinyxml2 PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${TINYXML2_INCLUDE_DIR} INTERFACE_LINK_LIBRARIES ${TINYXML2_LIBRARY})
endif()
