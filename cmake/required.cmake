# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Libraries that a build can't be without. What is missing is collected and told at once, a line each, with the Debian package that
# brings it: CMake's own message would be of the first one, and of files that it looked for. Macros, since what find_package sets
# belongs to who asks.
set(VSA_MISSING "")

# A package that is installed, to dpkg's knowledge, `setup.sh` doesn't install again.
set(VSA_MISSING_INSTALLED "")
function(vsa_note_installed package)
  find_program(VSA_DPKG_QUERY dpkg-query)
  mark_as_advanced(VSA_DPKG_QUERY)
  string(REGEX MATCH "^[a-z0-9.+-]+" name "${package}")
  if(VSA_DPKG_QUERY)
    execute_process(COMMAND ${VSA_DPKG_QUERY} -W "-f=\${Status}" ${name} OUTPUT_VARIABLE status ERROR_QUIET)
    if(status MATCHES "ok installed" AND NOT VSA_MISSING_INSTALLED MATCHES " ${name}( |$)")
      set(VSA_MISSING_INSTALLED "${VSA_MISSING_INSTALLED} ${name}" PARENT_SCOPE)
    endif()
  endif()
endfunction()

# vsa_need(NAME DEBIAN-PACKAGE FOUND [WHY]): NAME is missing unless the variable FOUND is true.
macro(vsa_need name package found)
  if(NOT ${found})
    string(APPEND VSA_MISSING "\n  ${name}: ${package}")
    if(NOT "${ARGN}" STREQUAL "")
      string(APPEND VSA_MISSING " (${ARGN})")
    else()
      vsa_note_installed("${package}")
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
    set(broken "")
    if(VSA_MISSING_INSTALLED)
      set(broken "\nOf packages that dpkg has as installed files are gone, which setup.sh doesn't see:\n  apt-get install --reinstall${VSA_MISSING_INSTALLED}\n")
    endif()
    message(FATAL_ERROR "Missing; `sh scripts/setup.sh` installs these packages:${VSA_MISSING}\n${broken}")
  endif()
endmacro()
