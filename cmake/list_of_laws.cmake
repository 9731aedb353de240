# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#
# cmake -DDIRECTORY=src/elastic/laws -DOUT=FILE -P list_of_laws.cmake
# Writes elastic::laws(): each "extern const Law kName{" that starts a line of a source there, by name. So a new law is its own file
# and nothing else.
file(GLOB sources ${DIRECTORY}/*.cpp)
set(names "")
foreach(source IN LISTS sources)
  file(STRINGS ${source} lines ENCODING UTF-8 REGEX "^(extern )?const Law k[A-Za-z0-9_]+ *[{=]")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^extern const Law (k[A-Za-z0-9_]+)")
      message(FATAL_ERROR "${source}: \"${line}\": the list can't see it; write extern const Law")
    endif()
    list(APPEND names ${CMAKE_MATCH_1})
  endforeach()
endforeach()
list(LENGTH names count)
if(count EQUAL 0)
  message(FATAL_ERROR "${DIRECTORY}: no law starts a line with extern const Law")
endif()
list(SORT names)
list(JOIN names ", " declared)
list(TRANSFORM names PREPEND "&")
list(JOIN names ", " addresses)
file(WRITE ${OUT} "// Written by cmake/list_of_laws.cmake from the sources in src/elastic/laws.
#include <array>

#include \"vsa/elastic/law.hpp\"

namespace vsa::elastic {

extern const Law ${declared};

std::span<const Law* const> laws() noexcept {
  static constexpr std::array kAll{${addresses}};
  return kAll;
}

}  // namespace vsa::elastic
")
