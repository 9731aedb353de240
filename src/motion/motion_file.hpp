// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "motion/toml_reader.hpp"
#include "vsa/motion/motion.hpp"

namespace vsa::motion {

/// All but a gait's own keys; problems go to the reader.
[[nodiscard]] MotionParams read_motion(Reader& reader, const toml::table& root);

}  // namespace vsa::motion
