// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "vsa/motion/gait.hpp"
#include "vsa/units.hpp"

namespace vsa::motion {

/// Two actuators that keep what they are told; a body that goes where it is put.
class TwoActuators : public Stage {
 public:
  std::int64_t time_ns() const override { return now_ns; }
  std::size_t find_actuator(std::string_view name) const override {
    if (name == "left" || name == "right") return name == "left" ? 0 : 1;
    throw InputError(Problem{"", "actuator", std::string(name), "no such actuator", "left, right"});
  }
  const std::string& model_of(std::size_t) const override { return model; }
  void send(std::size_t actuator, std::optional<double> equilibrium_rad, std::optional<double> preset) override {
    if (equilibrium_rad) told[actuator].equilibrium_rad = *equilibrium_rad;
    if (preset) told[actuator].preset = *preset;
    ++sent;
  }
  Commanded commanded(std::size_t actuator) const override { return told[actuator]; }
  std::array<double, 3> center_of_mass(std::string_view of) const override {
    asked = std::string(of);
    return {std::cos(heading_rad) * 1e-9 * static_cast<double>(now_ns), std::sin(heading_rad) * 1e-9 * static_cast<double>(now_ns),
            0};
  }

  void play(Gait& gait, double until_s) {
    for (; now_ns < std::llround(until_s * 1e9); now_ns += 10'000'000) gait.apply(*this);
  }

  std::string model = "walker";
  mutable std::string asked;
  double heading_rad = 0;
  std::int64_t now_ns = 0;
  int sent = 0;
  std::array<Commanded, 2> told{};
};

inline GaitParams walk() {
  GaitParams p;
  p.frequency_rad_per_s = 2 * kPi;
  p.groups.push_back({"legs", {"left", "right"}, {0, 1}, 0.5, 0.1, 1.0, 0.0, 0.3});
  return p;
}

}  // namespace vsa::motion
