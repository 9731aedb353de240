// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The reader of a build without libsdformat, where urdfdom is.
#include "sdf/urdf_plainly.hpp"

namespace vsa::reader {

description::World read_sdf(const SdfSource& source, const ReadOptions& options, const Finder& finder, SeenFiles& seen,
                            std::vector<std::string>& warnings, Problems& problems) {
  return read_urdf_plainly(source, options, finder, seen, warnings, problems);
}

}  // namespace vsa::reader
