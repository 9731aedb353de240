# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# Debian packages by CPack: one per component of what is installed. `make packages` (scripts/packages.sh) makes them; packages are of
# what this build has, so a plug-in's is there where its Gazebo is. docs/howto/packages.md says what is in which.
if(NOT VSA_PACKAGES)
  return()
endif()
set(VSA_PACKAGE_RELEASE 1 CACHE STRING "The packages' revision: 0.1.0-1 is the first of 0.1.0")
set(VSA_PACKAGE_MAINTAINER "The vsasim authors <vsasim@localhost>" CACHE STRING "Who answers for the packages: name and mail address")
set(VSA_PACKAGE_HOMEPAGE "" CACHE STRING "An address of the project's page; empty: none is told")
find_program(VSA_DPKG_QUERY dpkg-query REQUIRED)
find_program(VSA_PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(package_version ${PROJECT_VERSION}-${VSA_PACKAGE_RELEASE})

# vsa_owners(OUT FILE…): the packages that these files belong to; files of no package are left out.
function(vsa_owners out)
  set(owners "")
  foreach(file IN LISTS ARGN)
    get_filename_component(real ${file} REALPATH)
    execute_process(COMMAND ${VSA_DPKG_QUERY} --search ${real} OUTPUT_VARIABLE line ERROR_QUIET RESULT_VARIABLE failed)
    if(failed)
      message(WARNING "packages: ${file} is of no Debian package: nothing depends on it")
    elseif(line MATCHES "^([^:,]+)[:,]")
      list(APPEND owners ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES owners)
  set(${out} ${owners} PARENT_SCOPE)
endfunction()

# What a program that links the library needs for compiling: who owns what CMake found here.
set(found "")
set(owners_of_links "")
foreach(package fmt nlohmann_json Boost tomlplusplus tinyxml2 mujoco assimp Ceres Eigen3 Pagmo ${VSA_SDF_PACKAGES} ${VSA_URDF_PACKAGES} ${VSA_TOPICS_PACKAGES})
  if(${package}_DIR)
    file(GLOB files ${${package}_DIR}/*[cC]onfig.cmake)
    list(GET files 0 file)
    list(APPEND found ${file})
  endif()
endforeach()
foreach(module nlopt_cxx libzip hdf5-serial)
  execute_process(COMMAND pkg-config --variable=pcfiledir ${module} OUTPUT_VARIABLE directory OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(directory)
    list(APPEND found ${directory}/${module}.pc)
  endif()
endforeach()
# OpenGL and Qhull: what MuJoCo's CMake package asks for and Debian's package of it doesn't bring.
foreach(file ${VSA_LODEPNG_INCLUDE_DIR}/lodepng.h ${VSA_HACD_INCLUDE_DIR}/hacdHACD.h ${OPENGL_INCLUDE_DIR}/GL/gl.h
    ${OPENGL_opengl_LIBRARY} ${OPENGL_glx_LIBRARY} ${Qhull_DIR}/QhullConfig.cmake)
  if(EXISTS ${file})
    if(file MATCHES "\\.so$")  # of the development package's, which is a link; what it leads to is another's
      execute_process(COMMAND ${VSA_DPKG_QUERY} --search ${file} OUTPUT_VARIABLE line ERROR_QUIET)
      string(REGEX REPLACE "^([^:,]+)[:,].*" "\\1" owner "${line}")
      list(APPEND owners_of_links ${owner})
    else()
      list(APPEND found ${file})
    endif()
  endif()
endforeach()
vsa_owners(development_needs ${found})
list(APPEND development_needs ${owners_of_links} "pkgconf | pkg-config")
list(REMOVE_DUPLICATES development_needs)

# vsa_package(COMPONENT NAME SUMMARY TEXT… [SECTION s] [ALL] [DEPENDS d…] [SUGGESTS s…]): one package. TEXT: lines of its description.
# ALL: the same on every machine.
set(components "")
function(vsa_package component name summary)
  cmake_parse_arguments(P "ALL" "SECTION" "TEXT;DEPENDS;SUGGESTS" ${ARGN})
  string(TOUPPER ${component} C)
  list(JOIN P_TEXT "\n" text)
  list(JOIN P_DEPENDS ", " depends)
  list(JOIN P_SUGGESTS ", " suggests)
  set(CPACK_DEBIAN_${C}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_PACKAGE_SECTION ${P_SECTION} PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${C}_PACKAGE_SUGGESTS "${suggests}" PARENT_SCOPE)
  if(P_ALL)
    set(CPACK_DEBIAN_${C}_PACKAGE_ARCHITECTURE all PARENT_SCOPE)
    set(CPACK_DEBIAN_${C}_PACKAGE_SHLIBDEPS OFF PARENT_SCOPE)
  endif()
  # What every package has to have: who wrote it, under which licence, and what changed.
  set(doc ${PROJECT_BINARY_DIR}/packaging)
  install(FILES ${doc}/copyright ${doc}/changelog.gz ${doc}/changelog.Debian.gz DESTINATION share/doc/${name}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  # What the checker of packages would say of every package or of this one, each with its reason.
  set(overrides "")
  foreach(file all ${name})
    if(EXISTS ${PROJECT_SOURCE_DIR}/packaging/lintian/${file})
      file(READ ${PROJECT_SOURCE_DIR}/packaging/lintian/${file} text_of_file)
      string(APPEND overrides "${text_of_file}")
    endif()
  endforeach()
  file(WRITE ${doc}/lintian/${name} "${overrides}")
  install(FILES ${doc}/lintian/${name} DESTINATION share/lintian/overrides COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(components ${components} ${component} PARENT_SCOPE)
endfunction()

set(same "(= ${package_version})")
set(what "vsasim simulates robots built of variable stiffness actuators: bus,"
         "firmware, electronics, motors, friction, nonlinear springs, sensors.")
if(VSA_SIMULATOR)
  vsa_package(data vsasim-data "actuator types, robots, worlds and pages of vsasim" ALL SECTION science
    TEXT ${what} "." "This package has what its programs and Gazebo plug-ins read: actuator types," "models, recordings of hardware and the templates of HTML pages.")
  vsa_package(tools vsasim "simulator of variable stiffness actuator robots" SECTION science
    DEPENDS "vsasim-data ${same}" "vsasim-doctor ${same}" SUGGESTS "vsasim-doc"
    TEXT ${what} "." "This package has the command vsa with its embedded simulator. It runs worlds," "shows them in a browser, measures actuators, identifies their parameters," "and stands in for the hardware on a serial port.")
  set(library_needs "")
  if(TARGET vsa_shared)
    set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
    set(library_needs "libvsasim${abi} ${same}")
    vsa_package(library libvsasim${abi} "simulator of variable stiffness actuators: shared library" SECTION libs
      DEPENDS "vsasim-data ${same}"
      TEXT ${what} "." "This package has the shared library, for programs that were linked to it.")
    # Who links it depends on this minor version of it, from its first release on.
    file(WRITE ${PROJECT_BINARY_DIR}/packaging/shlibs "libvsasim ${abi} libvsasim${abi} (>= ${abi}.0)\n")
    file(WRITE ${PROJECT_BINARY_DIR}/packaging/triggers "activate-noawait ldconfig\n")
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/packaging/shlibs ${PROJECT_BINARY_DIR}/packaging/triggers)
  endif()
  vsa_package(development libvsasim-dev "simulator of variable stiffness actuators: C++ library" SECTION libdevel
    DEPENDS "vsasim-data ${same}" ${library_needs} ${development_needs} SUGGESTS "vsasim-doc"
    TEXT ${what} "." "This package has headers, static libraries and a CMake package of the library," "from one actuator that needs the C++ standard library alone to whole worlds.")
  vsa_package(documentation vsasim-doc "simulator of variable stiffness actuators: manual and examples" ALL SECTION doc
    SUGGESTS "vsasim-data" "libvsasim-dev"
    TEXT ${what} "." "This package has the manual, as Markdown, and examples in C++ and Python.")
endif()
vsa_package(doctor vsasim-doctor "checks what Gazebo needs to run vsasim's robots" SECTION science
  TEXT ${what} "." "This package has vsa-doctor, which tells what is missing or wrong for Gazebo," "topics and serial ports, and the script that makes a shell's Gazebo find" "vsasim's plug-ins and models.")
if(TARGET vsa-mpi)
  vsa_package(mpi vsasim-mpi "simulator of variable stiffness actuators: sweeps by MPI" SECTION science
    DEPENDS "vsasim-data ${same}" SUGGESTS "vsasim (>= ${PROJECT_VERSION})"
    TEXT ${what} "." "This package has vsa-mpi: parameter sweeps, searches and fits on all ranks of" "an MPI job.")
endif()
if(VSA_WITH_PYTHON)
  math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
  vsa_package(python python3-vsasim "simulator of variable stiffness actuators: Python module" SECTION python
    DEPENDS "vsasim-data ${same}" "python3 (>= 3.${Python3_VERSION_MINOR})" "python3 (<< 3.${next_python})" "python3-numpy" SUGGESTS "vsasim-doc"
    TEXT ${what} "." "This package has the Python module vsasim, with NumPy: worlds, actuators," "batches of many copies, and tasks for learning in Gymnasium's shape.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/python/postinst ${PROJECT_SOURCE_DIR}/packaging/python/prerm)
  configure_file(packaging/python/METADATA.in ${PROJECT_BINARY_DIR}/packaging/METADATA @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/METADATA packaging/python/INSTALLER
    DESTINATION ${VSA_PYTHON_DIR}/vsasim-${PROJECT_VERSION}.dist-info COMPONENT python EXCLUDE_FROM_ALL)
endif()
if(VSA_GAZEBO_CLASSIC)
  vsa_package(gazebo_classic gazebo11-plugin-vsasim "variable stiffness actuators in Gazebo Classic 11" SECTION science
    DEPENDS "vsasim-data ${same}" "vsasim-doctor ${same}"
    TEXT ${what} "." "This package has the plug-in for Gazebo Classic 11.")
endif()
if(VSA_GZ_SIM)
  vsa_package(gz_sim gz-sim-plugin-vsasim "variable stiffness actuators in gz-sim" SECTION science
    DEPENDS "vsasim-data ${same}" "vsasim-doctor ${same}"
    TEXT ${what} "." "This package has the system plug-in for gz-sim ${VSA_GZ_SIM_FOUND}.")
endif()

# Pages whose links lead to what packages have, made anew whenever they are packed.
install(CODE "execute_process(COMMAND \"${VSA_PYTHON3}\" \"${PROJECT_SOURCE_DIR}/packaging/manual.py\"
    --out \"${PROJECT_BINARY_DIR}/packaging/manual\" RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR \"packaging/manual.py failed\")
  endif()" COMPONENT documentation EXCLUDE_FROM_ALL)
install(DIRECTORY ${PROJECT_BINARY_DIR}/packaging/manual/ DESTINATION share/doc/vsasim-doc COMPONENT documentation EXCLUDE_FROM_ALL)
install(DIRECTORY examples DESTINATION share/doc/vsasim-doc COMPONENT documentation EXCLUDE_FROM_ALL PATTERN "__pycache__" EXCLUDE)

# Copyright file and change logs, from the repository's own.
execute_process(COMMAND ${VSA_PYTHON3} ${PROJECT_SOURCE_DIR}/packaging/prepare.py --version ${PROJECT_VERSION} --release ${VSA_PACKAGE_RELEASE}
  --maintainer ${VSA_PACKAGE_MAINTAINER} --out ${PROJECT_BINARY_DIR}/packaging RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "packaging/prepare.py failed")
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/packaging/prepare.py
  ${PROJECT_SOURCE_DIR}/packaging/copyright ${PROJECT_SOURCE_DIR}/CHANGELOG.md)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vsasim)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "vsasim")
# CPack's own word for none: another would stand before each package's.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")
set(CPACK_DEBIAN_PACKAGE_SOURCE vsasim)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${VSA_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${VSA_PACKAGE_MAINTAINER}")
if(VSA_PACKAGE_HOMEPAGE)
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${VSA_PACKAGE_HOMEPAGE}")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_STRIP_FILES ON)
# By DESTDIR, so that what is written when installing (setup.sh) has the prefix that it will be used from.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
# Whatever the umask of who makes them.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
include(CPack)
