// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The JSON texts that pages get; live_view.hpp lists them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recordings.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/view/request.hpp"

namespace vsa::view {

struct State {
  std::optional<double> speed;
  const motion::Gait* gait = nullptr;
  std::vector<motion::ByHand> by_hand;  ///< one per actuator
  const Recordings* recordings = nullptr;
};

[[nodiscard]] std::string state_text(const State& state);
/// `run` tells this run from others, `state` is the last state_text().
[[nodiscard]] std::string hello_text(const Rules& rules, const std::string& run, const std::string& state);
/// {"type":TYPE,"text":TEXT}
[[nodiscard]] std::string plain_text(const char* type, const std::string& text);

}  // namespace vsa::view
