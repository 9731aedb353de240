# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Libraries that a build can't be without. What is missing is collected and told at once, a line each, with the Debian package that
# brings it: CMake's own message would be of the first one, and of files that it looked for. Macros, since what find_package sets
# belongs to who asks.
set(VSA_MISSING "")

# vsa_need(NAME DEBIAN-PACKAGE FOUND [WHY]): NAME is missing unless the variable FOUND is true.
macro(vsa_need name package found)
  if(NOT ${found})
    string(APPEND VSA_MISSING "\n  ${name}: ${package}")
    if(NOT "${ARGN}" STREQUAL "")
      string(APPEND VSA_MISSING " (${ARGN})")
    endif()
  endif()
endmacro()

# vsa_need_package(NAME DEBIAN-PACKAGE [what find_package takes…])
macro(vsa_need_package name package)
  find_package(${name} ${ARGN} QUIET)
  set(why "${${name}_NOT_FOUND_MESSAGE}")
  if(NOT why AND ${name}_CONSIDERED_VERSIONS)
    set(versions ${${name}_CONSIDERED_VERSIONS})
    list(REMOVE_DUPLICATES versions)
    list(JOIN versions ", " versions)
    set(why "found ${versions}, needed ${ARGN}")
  endif()
  string(REGEX REPLACE "[ \n]+" " " why "${why}")
  vsa_need(${name} ${package} ${name}_FOUND ${why})
endmacro()

# vsa_need_module(VARIABLE NAME DEBIAN-PACKAGE): of pkg-config, as the target PkgConfig::VARIABLE.
macro(vsa_need_module variable module package)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(${variable} QUIET IMPORTED_TARGET ${module})
  endif()
  vsa_need(${module} ${package} ${variable}_FOUND)
endmacro()

# vsa_end_of_needs(): ends configuring where something is missing.
macro(vsa_end_of_needs)
  if(VSA_MISSING)
    message(FATAL_ERROR "Missing; `sh scripts/setup.sh` installs these packages:${VSA_MISSING}\n")
  endif()
endmacro()
