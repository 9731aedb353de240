// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "vsa/experiment/bench.hpp"

namespace vsa::experiment {

inline Specimen specimen(const std::string& type = "qbmove_maker_pro", std::vector<config::Override> overrides = {}) {
  Specimen s;
  s.type = type;
  s.overrides = std::move(overrides);
  s.library = config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  return s;
}

inline StiffnessOptions short_sweep(double preset) {
  StiffnessOptions o;
  o.preset = preset;
  o.period_s = 10;
  o.cycles = 1;
  return o;
}

inline SpeedOptions short_square() {
  SpeedOptions o;
  o.preset = 0.3;
  o.hold_s = 0.6;
  o.steps = 2;
  return o;
}

}  // namespace vsa::experiment
