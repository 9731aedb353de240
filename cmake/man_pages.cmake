# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# vsa_install_man_page(FILE COMPONENT): a page of section 1. In a Debian package it is compressed, as they have to be, without time or
# name in it.
function(vsa_install_man_page file component)
  if(VSA_PACKAGES)
    get_filename_component(name ${file} NAME)
    set(compressed ${PROJECT_BINARY_DIR}/packaging/man/${name}.gz)
    add_custom_command(OUTPUT ${compressed}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/packaging/man
      COMMAND gzip -9nc ${file} > ${compressed}
      DEPENDS ${file} VERBATIM)
    add_custom_target(vsa_man_page_${component} ALL DEPENDS ${compressed})
    set(file ${compressed})
  endif()
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endfunction()
