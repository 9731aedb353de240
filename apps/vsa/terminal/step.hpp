// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "vsa/config/text.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {

/// Throws InputError naming --step-s where no world takes it.
inline void check_step(std::optional<double> step_s) {
  if (!step_s || (*step_s >= engine::kShortestStep_s && *step_s <= engine::kLongestStep_s)) return;
  throw InputError({"", "--step-s", config::number_text(*step_s), "out of range",
                    config::range_text(engine::kShortestStep_s, engine::kLongestStep_s) + " s"});
}

}  // namespace vsa::app
