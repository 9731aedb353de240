// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Plays a gait file of models/gaits through a robot's commands, the paper's eq. (10) as include/vsa/motion/gait.hpp writes it:
// files without a base and without steering only.
#pragma once

#include <toml++/toml.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::test {

class GaitPlayer {
 public:
  GaitPlayer(const std::string& file, host::Robot& robot) : robot_(robot) {
    const toml::table root = toml::parse_file(file);
    if (root.contains("base") || root.contains("steering")) throw std::runtime_error(file + " isn't a plain gait");
    frequency_rad_per_s_ = root.at_path("frequency_rad_per_s").value<double>().value();
    ramp_s_ = root.at_path("ramp_s").value<double>().value();
    period_ns_ = std::llround(root.at_path("period_s").value<double>().value() * 1e9);
    for (const auto& entry : *root.at_path("group").as_table()) read_group(*entry.second.as_table());
    if (axes_.size() != robot.size()) throw std::runtime_error(file + " doesn't move every actuator");
  }

  /// Before every step.
  void play(std::int64_t time_ns) {
    const std::int64_t slot = time_ns / period_ns_;
    if (slot == last_slot_) return;
    last_slot_ = slot;
    const double t_s = static_cast<double>(time_ns) * 1e-9;
    for (const Axis& axis : axes_) {
      const double ramp = t_s < ramp_s_ ? t_s / ramp_s_ : 1.0;
      const double wave = ramp * std::sin(frequency_rad_per_s_ * t_s + axis.phase_rad);
      if (!robot_.command(axis.actuator, axis.offset_rad + axis.amplitude_rad * wave, axis.preset_rad)) {
        throw std::runtime_error("a command of the gait is refused");
      }
    }
  }

 private:
  struct Axis {
    std::size_t actuator = 0;
    double amplitude_rad = 0, offset_rad = 0, phase_rad = 0, preset_rad = 0;
  };

  void read_group(const toml::table& group) {
    constexpr double kPi = 3.14159265358979323846;
    const auto number = [&group](const char* key, double otherwise) { return group.at_path(key).value_or(otherwise); };
    const toml::array& names = *group.at_path("actuators").as_array();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto actuator = robot_.find(names.get(k)->value<std::string>().value());
      if (!actuator) throw std::runtime_error("the robot lacks an actuator of the gait");
      const double n = group.at_path("n").as_array()->get(k)->value<double>().value();
      axes_.push_back({*actuator, number("amplitude_deg", 0) * kPi / 180, number("offset_deg", 0) * kPi / 180,
                       n * kPi / number("lambda", 1) + number("delta_deg", 0) * kPi / 180, number("preset_deg", 0) * kPi / 180});
    }
  }

  host::Robot& robot_;
  double frequency_rad_per_s_ = 0, ramp_s_ = 0;
  std::int64_t period_ns_ = 0, last_slot_ = -1;
  std::vector<Axis> axes_;
};

}  // namespace vsa::test
