// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "toml_reader.hpp"
#include "vsa/engine/motion.hpp"

namespace vsa::engine {

/// All but a gait's own keys; problems go to the reader.
[[nodiscard]] MotionParams read_motion(Reader& reader, const toml::table& root);

}  // namespace vsa::engine
