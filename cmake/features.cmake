# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Features that a system may lack the libraries for: SDF files (libsdformat), URDF files (libsdformat, else urdfdom), topics (a Gazebo
# transport with its messages). AUTO takes the newest version that is found and leaves the feature out where there is none; ON fails
# then, OFF doesn't look.
#   VSA_WITH_SDF, VSA_WITH_URDF, VSA_WITH_TOPICS   whether they are in
#   VSA_WITH_URDFDOM   whether urdfdom was found: what reads URDF without libsdformat, and in tests beside it
#   VSA_SDF_TARGET, VSA_URDFDOM_TARGETS, VSA_TOPICS_TARGETS   what to link
#   VSA_SDF_FOUND_AS, VSA_URDF_FOUND_AS, VSA_TOPICS_FOUND_AS   what was found, for people
#   VSA_SDF_PACKAGES, VSA_URDF_PACKAGES, VSA_TOPICS_PACKAGES   for an installed vsasim, which looks for the same
foreach(feature SDF URDF TOPICS)
  set(VSA_${feature} AUTO CACHE STRING "AUTO: where found; ON: needed; OFF: left out")
  set_property(CACHE VSA_${feature} PROPERTY STRINGS AUTO ON OFF)
endforeach()

# vsa_first_found(OUT NAME…): the first package that is there.
function(vsa_first_found out)
  foreach(name IN LISTS ARGN)
    find_package(${name} QUIET)
    if(${name}_FOUND)
      set(${out} ${name} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${out} "" PARENT_SCOPE)
endfunction()

set(VSA_WITH_SDF FALSE)
if(VSA_SIMULATOR AND NOT VSA_SDF STREQUAL "OFF")
  vsa_first_found(name sdformat16 sdformat15 sdformat14 sdformat13 sdformat12)
  if(name)
    find_package(${name} REQUIRED)
    set(VSA_WITH_SDF TRUE)
    set(VSA_SDF_PACKAGES ${name})
    set(VSA_SDF_TARGET ${name}::${name})
    set(VSA_SDF_FOUND_AS "${name} ${${name}_VERSION}")
  endif()
endif()

set(VSA_WITH_URDF ${VSA_WITH_SDF})
set(VSA_WITH_URDFDOM FALSE)
set(VSA_URDF_FOUND_AS "${VSA_SDF_FOUND_AS}")
if(VSA_SIMULATOR AND NOT VSA_URDF STREQUAL "OFF" AND (NOT VSA_WITH_SDF OR VSA_TESTS))
  find_package(urdfdom QUIET)
  find_package(console_bridge QUIET)
  if(TARGET urdfdom::urdfdom_model AND TARGET console_bridge::console_bridge)
    set(VSA_WITH_URDFDOM TRUE)
    set(VSA_URDFDOM_TARGETS urdfdom::urdfdom_model console_bridge::console_bridge)
    if(NOT VSA_WITH_SDF)
      set(VSA_WITH_URDF TRUE)
      set(VSA_URDF_PACKAGES urdfdom console_bridge)
      pkg_check_modules(VSA_URDFDOM QUIET urdfdom)  # its CMake package tells no version
      set(VSA_URDF_FOUND_AS "urdfdom ${VSA_URDFDOM_VERSION}")
    endif()
  endif()
endif()

# Their meshes: COLLADA, and the convex parts of what isn't convex. libsdformat's reader needs both.
set(VSA_WITH_ASSIMP FALSE)
set(VSA_WITH_HACD FALSE)
if(VSA_WITH_URDF)
  find_package(assimp QUIET)
  find_path(VSA_HACD_INCLUDE_DIR hacdHACD.h PATH_SUFFIXES bullet/HACD HACD)   # Bullet's extras; no CMake package
  set(VSA_WITH_ASSIMP ${assimp_FOUND})
  if(VSA_HACD_INCLUDE_DIR)
    set(VSA_WITH_HACD TRUE)
  endif()
  if(NOT VSA_WITH_SDF AND NOT VSA_WITH_ASSIMP)
    string(APPEND VSA_URDF_FOUND_AS ", without COLLADA meshes (libassimp-dev brings them)")
  endif()
  if(NOT VSA_WITH_SDF AND NOT VSA_WITH_HACD)
    string(APPEND VSA_URDF_FOUND_AS ", without convex parts of meshes (libbullet-extras-dev brings them)")
  endif()
endif()

set(VSA_WITH_TOPICS FALSE)
if(VSA_SIMULATOR AND NOT VSA_TOPICS STREQUAL "OFF")
  foreach(pair "gz-transport15;gz-msgs12" "gz-transport14;gz-msgs11" "gz-transport13;gz-msgs10" "gz-transport12;gz-msgs9"
      "ignition-transport11;ignition-msgs8")
    list(GET pair 0 transport)
    list(GET pair 1 messages)
    vsa_first_found(found ${transport})
    if(found)
      find_package(${messages} REQUIRED)
      find_package(${transport} REQUIRED)
      set(VSA_WITH_TOPICS TRUE)
      set(VSA_TOPICS_PACKAGES ${messages} ${transport})
      set(VSA_TOPICS_TARGETS ${transport}::core ${messages}::core)
      set(VSA_TOPICS_FOUND_AS "${transport} ${${transport}_VERSION}, ${messages} ${${messages}_VERSION}")
      break()
    endif()
  endforeach()
endif()

# What the configure step and `vsa doctor` say where one is missing.
set(VSA_SDF_REMEDY "install libsdformat-dev of Debian 12, or libsdformat14-dev of Gazebo's archive for Ubuntu 24.04, and build again (Debian 13 and Ubuntu 24.04 themselves have none)")
set(VSA_TOPICS_REMEDY "install libignition-transport-dev and libignition-msgs-dev of Debian 12, or libgz-transport13-dev of Gazebo's archive for Ubuntu 24.04, and build again (Debian 13 and Ubuntu 24.04 themselves have none)")
set(VSA_URDF_REMEDY "install liburdfdom-dev and build again")
set(VSA_SDF_NAME "reader of SDF")
set(VSA_URDF_NAME "reader of URDF")
set(VSA_TOPICS_NAME "topics")
foreach(feature SDF URDF TOPICS)
  if(NOT VSA_SIMULATOR)
    continue()
  elseif(VSA_WITH_${feature})
    message(STATUS "${VSA_${feature}_NAME}: ${VSA_${feature}_FOUND_AS}")
  elseif(VSA_${feature} STREQUAL "ON")
    message(FATAL_ERROR "VSA_${feature} is ON and its library wasn't found (${VSA_${feature}_REMEDY})")
  elseif(VSA_${feature} STREQUAL "OFF")
    message(STATUS "${VSA_${feature}_NAME}: left out: VSA_${feature} is OFF")
  else()
    message(STATUS "${VSA_${feature}_NAME}: left out: no library found (${VSA_${feature}_REMEDY})")
  endif()
endforeach()
