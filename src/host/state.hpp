// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "host/bus_line.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/state_fields.hpp"

namespace vsa::host {

inline constexpr std::int64_t kLatestNs = 4'000'000'000'000'000'000;  ///< of Robot::advance

/// Whether a channel can follow these: finite, times that grow from 0 on.
[[nodiscard]] inline bool in_order(std::span<const Robot::Knot> knots) noexcept {
  constexpr double kLongestPath_s = 1e9;
  double last = -1.0;
  for (const Robot::Knot& k : knots) {
    if (!std::isfinite(k.value) || !(k.time_s >= 0 && k.time_s > last && k.time_s <= kLongestPath_s)) return false;
    last = k.time_s;
  }
  return true;
}

/// The knots of a trajectory. Up to Robot::kMostKnots are its own; more are shared, never changed: a copy allocates nothing.
class Knots {
 public:
  using Knot = Robot::Knot;
  Knots() = default;
  Knots(const Knots& other) noexcept { *this = other; }
  Knots& operator=(const Knots& other) noexcept {
    if (this == &other) return *this;
    std::copy_n(other.own_.begin(), other.count_, own_.begin());
    count_ = other.count_;
    shared_ = other.shared_;
    return *this;
  }
  void take(std::shared_ptr<const std::vector<Knot>> knots) noexcept {
    count_ = knots->size() <= own_.size() ? knots->size() : 0;
    std::copy_n(knots->begin(), count_, own_.begin());
    shared_ = count_ > 0 ? nullptr : std::move(knots);
  }
  void clear() noexcept {
    count_ = 0;
    shared_ = nullptr;
  }
  [[nodiscard]] std::span<const Knot> all() const noexcept {
    return shared_ ? std::span<const Knot>(*shared_) : std::span<const Knot>(own_.data(), count_);
  }

  // As state::Capped has it.
  [[nodiscard]] std::size_t size() const noexcept { return all().size(); }
  void resize(std::size_t count) noexcept {
    count_ = std::min(count, own_.size());
    shared_ = nullptr;
  }
  Knot& operator[](std::size_t i) noexcept { return own_[i]; }
  const Knot& operator[](std::size_t i) const noexcept { return all()[i]; }

 private:
  std::array<Knot, Robot::kMostKnots> own_;
  std::size_t count_ = 0;
  std::shared_ptr<const std::vector<Knot>> shared_;
};

/// One commanded quantity: a constant, or knots in simulated time.
struct Track {
  double value = 0;  ///< where it was when the knots began, or the constant
  std::int64_t start_ns = 0;
  Knots knots{};

  void begin(std::shared_ptr<const std::vector<Robot::Knot>> next, std::int64_t now_ns) noexcept {
    value = at(now_ns);
    start_ns = now_ns;
    if (next->size() == 1 && next->front().time_s == 0.0) return hold(next->front().value);
    knots.take(std::move(next));
  }

  void hold(double constant) noexcept {
    value = constant;
    knots.clear();
  }

  /// A long trajectory that has ended is a constant.
  void settle(std::int64_t now_ns) noexcept {
    if (knots.size() > Robot::kMostKnots && static_cast<double>(now_ns - start_ns) * 1e-9 >= knots.all().back().time_s)
      hold(last());
  }

  [[nodiscard]] double last() const noexcept { return knots.size() > 0 ? knots.all().back().value : value; }

  [[nodiscard]] double at(std::int64_t now_ns) const noexcept {
    const std::span<const Robot::Knot> all = knots.all();
    if (all.empty()) return value;
    const double t = static_cast<double>(now_ns - start_ns) * 1e-9;
    if (t >= all.back().time_s) return all.back().value;
    double t0 = 0.0, v0 = value;
    for (const Robot::Knot& k : all) {
      if (t < k.time_s) return k.time_s > t0 && t > t0 ? v0 + (k.value - v0) * (t - t0) / (k.time_s - t0) : v0;
      t0 = k.time_s;
      v0 = k.value;
    }
    return v0;
  }

  static auto fields(auto& s, auto&& visit) {
    return visit("value", "rad, or the preset's", s.value, "start", "ns", s.start_ns, "knot", "",
                 state::Capped{s.knots, Robot::kMostKnots});
  }
  [[nodiscard]] const char* impossible() const noexcept {
    return std::isfinite(value) && in_order(knots.all()) ? nullptr : "finite commands, knots whose times grow";
  }
};

struct ActuatorSlot {
  device::UnitState unit;
  Track equilibrium, preset;
  std::array<Ticks, 3> measured{};
  bool noted_preset = false, noted_limits = false, noted_port = false, noted_unresolved = false, noted_rate = false;

  static auto fields(auto& s, auto&& visit) {
    return visit("unit", "", s.unit, "equilibrium", "", s.equilibrium, "preset", "", s.preset, "measured", "ticks", s.measured,
                 "noted_preset", "", s.noted_preset, "noted_limits", "", s.noted_limits, "noted_port", "", s.noted_port,
                 "noted_unresolved", "", s.noted_unresolved, "noted_rate", "", s.noted_rate);
  }
};

struct RobotState {
  std::int64_t time_ns = 0;  ///< where the next step is expected
  std::int64_t steps = 0;
  std::int64_t stepped_ns = 0;  ///< the time of all of them
  std::size_t unsettled = 0;    ///< steps of joints whose solution didn't settle
  bool noted_unsettled = false, noted_energy = false;
  bool stiff = false;  ///< some spring was found hardly resolved
  std::vector<ActuatorSlot> actuators;

  static auto fields(auto& s, auto&& visit) {
    return visit("time", "ns", s.time_ns, "steps", "", s.steps, "stepped", "ns", s.stepped_ns, "unsettled", "", s.unsettled,
                 "noted_unsettled", "", s.noted_unsettled, "noted_energy", "", s.noted_energy, "stiff", "", s.stiff, "actuator", "",
                 s.actuators);
  }
  [[nodiscard]] const char* impossible() const noexcept {
    const auto possible = [](std::int64_t n) { return n >= 0 && n <= kLatestNs; };
    return possible(time_ns) && possible(steps) && possible(stepped_ns) ? nullptr : "a time of 0 … 4e18 ns";
  }
};

struct Robot::Snapshot {
  std::shared_ptr<const RobotConfig> made_of;  ///< the robot's, with the parameters of that time
  RobotState state;
  std::vector<BusState> buses;
};

}  // namespace vsa::host
