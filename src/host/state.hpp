// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "host/bus_line.hpp"
#include "vsa/host/robot.hpp"

namespace vsa::host {

/// One commanded quantity: a constant, or knots in simulated time. Knots are shared, never changed: a copy allocates nothing.
struct Track {
  double value = 0;  ///< where it was when the knots began, or the constant
  std::int64_t start_ns = 0;
  std::shared_ptr<const std::vector<Robot::Knot>> knots;

  void begin(std::shared_ptr<const std::vector<Robot::Knot>> next, std::int64_t now_ns) noexcept {
    value = at(now_ns);
    start_ns = now_ns;
    knots = std::move(next);
    if (knots->size() == 1 && knots->front().time_s == 0.0) {
      value = knots->front().value;
      knots = nullptr;
    }
  }

  void hold(double constant) noexcept {
    value = constant;
    knots = nullptr;
  }

  [[nodiscard]] double last() const noexcept { return knots ? knots->back().value : value; }

  [[nodiscard]] double at(std::int64_t now_ns) const noexcept {
    if (!knots) return value;
    const double t = static_cast<double>(now_ns - start_ns) * 1e-9;
    if (t >= knots->back().time_s) return knots->back().value;
    double t0 = 0.0, v0 = value;
    for (const Robot::Knot& k : *knots) {
      if (t < k.time_s) return k.time_s > t0 && t > t0 ? v0 + (k.value - v0) * (t - t0) / (k.time_s - t0) : v0;
      t0 = k.time_s;
      v0 = k.value;
    }
    return v0;
  }
};

struct ActuatorSlot {
  device::UnitState unit;
  Track equilibrium, preset;
  std::array<Ticks, 3> measured{};
  bool noted_preset = false, noted_limits = false, noted_port = false, noted_unresolved = false, noted_rate = false;
};

struct RobotState {
  std::int64_t time_ns = 0;  ///< where the next step is expected
  std::int64_t steps = 0;
  std::size_t unsettled = 0;  ///< steps of joints whose solution didn't settle
  bool noted_unsettled = false, noted_energy = false;
  std::vector<ActuatorSlot> actuators;
};

struct Robot::Snapshot {
  std::shared_ptr<const RobotConfig> made_of;  ///< the robot's, with the parameters of that time
  RobotState state;
  std::vector<BusState> buses;
};

}  // namespace vsa::host
