// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/sdf/read.hpp"

namespace vsa::reader {

/// read_sdf without libsdformat: a URDF, by urdfdom. Of an SDF it says what would bring its reader.
[[nodiscard]] description::World read_urdf_plainly(const SdfSource& source, const ReadOptions& options, const Finder& finder,
                                                   SeenFiles& seen, std::vector<std::string>& warnings, Problems& problems);

}  // namespace vsa::reader
