# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# vsa_room(NAME [ONLY file…] [EXCEPT file…] [PUBLIC target…] [PRIVATE target…]): the library of src/NAME with its headers in include/vsa/NAME.
# ONLY, EXCEPT: of its sources, where a feature is left out or in (cmake/features.cmake).
# A room links only the rooms that it may know; a wrong include still compiles, a wrong call doesn't link.
function(vsa_room name)
  cmake_parse_arguments(ROOM "" "" "ONLY;EXCEPT;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(TRANSFORM ROOM_ONLY PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${name}/)
  list(TRANSFORM ROOM_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${name}/)
  if(ROOM_ONLY)
    set(sources ${ROOM_ONLY})
  elseif(ROOM_EXCEPT)
    list(REMOVE_ITEM sources ${ROOM_EXCEPT})
  endif()
  add_library(vsa_${name} STATIC ${sources})
  add_library(vsa::${name} ALIAS vsa_${name})
  set_target_properties(vsa_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(vsa_${name} PUBLIC cxx_std_20)
  target_include_directories(vsa_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(vsa_${name} PUBLIC ${ROOM_PUBLIC} PRIVATE ${ROOM_PRIVATE})
  vsa_compile_together(vsa_${name})
  set_property(GLOBAL APPEND PROPERTY VSA_ROOMS vsa_${name})
endfunction()

# vsa_compile_together(TARGET): with VSA_UNITY its sources are compiled twelve in one, since most of the time goes into headers. So no
# two of a target name a helper alike; SKIP_UNITY_BUILD_INCLUSION is for those that have to.
function(vsa_compile_together target)
  if(NOT VSA_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # what a source has for itself is in an included file then
  endif()
endfunction()

# vsa_write_room_links(FILE): what every room links, a line "ROOM: TARGET TARGET" each, for tests/scripts/rooms.py.
function(vsa_write_room_links file)
  get_property(rooms GLOBAL PROPERTY VSA_ROOMS)
  set(lines "")
  foreach(target IN LISTS rooms)
    get_target_property(links ${target} LINK_LIBRARIES)
    string(REGEX REPLACE "^vsa_" "" room ${target})
    if(NOT links)
      set(links "")
    endif()
    string(REPLACE ";" " " links "${links}")
    string(APPEND lines "${room}: ${links}\n")
  endforeach()
  file(WRITE ${file} "${lines}")
endfunction()
