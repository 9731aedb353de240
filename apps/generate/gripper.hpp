// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The gripper: one module, a finger on its housing and one on its flange. Frame: the gripper axis along x, fingers along −z; `side`
// is the fixed finger's along y (−1: right hand). A positive angle closes, pads are parallel at 0.
#pragma once

#include "parts.hpp"

namespace vsa::generate {

inline constexpr double kFaceThickness = 0.008;  // of the soft object, between the fingers

/// Housing and fixed finger as parts of a link, `z` above its origin.
void palm_shapes(Xml& xml, const Description& d, double side, double z);
[[nodiscard]] Inertial palm(const Description& d, double side, double z);

/// The link with the flange and the moving finger.
void write_finger_link(Xml& xml, const Description& d, const std::string& name, double side, const Vec& at, double yaw_rad);
[[nodiscard]] Vec closing_axis(double side);

}  // namespace vsa::generate
