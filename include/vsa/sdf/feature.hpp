// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/feature.hpp"

namespace vsa::reader {

/// Whether this build reads SDF files: with libsdformat.
[[nodiscard]] Feature sdf_feature();

/// Whether it reads URDF files: with libsdformat or, where that isn't, urdfdom.
[[nodiscard]] Feature urdf_feature();

}  // namespace vsa::reader
