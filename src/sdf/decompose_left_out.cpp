// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/mesh_file.hpp"

namespace vsa::reader {

std::vector<Mesh> decompose(const Mesh&) {
  throw InputError(Problem{"", "", "",
                           "can't be decomposed by a build without HACD: install libbullet-extras-dev and build again, or ask for "
                           "the convex hull",
                           ""});
}

}  // namespace vsa::reader
