// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/feature.hpp"

namespace vsa::reader {

/// Whether this build reads SDF and URDF files: with libsdformat.
[[nodiscard]] Feature sdf_feature();

}  // namespace vsa::reader
