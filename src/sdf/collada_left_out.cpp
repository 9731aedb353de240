// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/mesh_file.hpp"

namespace vsa::reader {

Mesh read_collada(const std::filesystem::path& file) {
  throw InputError(Problem{file.string(), "", "", "COLLADA isn't read by a build without assimp",
                           "STL or OBJ; or install libassimp-dev and build again"});
}

}  // namespace vsa::reader
