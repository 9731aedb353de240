// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units on a line without a robot: each shaft turns freely with the unit's own inertia, or is held. As after switching on: motors
// off, references 0.
//
//     Emulation units({{config, 1}, {config, 2}});
//     // one thread, in real time:          units.advance(nanoseconds since the start);
//     // another, with a serial port:       units.line().exchange(bytes, answer);
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "vsa/device/chain.hpp"
#include "vsa/device/joint_trials.hpp"
#include "vsa/device/port_line.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {

/// What a unit's EEPROM holds.
struct UnitPages {
  firmware::Memory user,  ///< that a power-up loads
      factory;            ///< its defaults
  bool operator==(const UnitPages&) const = default;
};

/// A unit on the line, and what its shaft does.
struct EmulatedUnit {
  UnitConfig config;     ///< checked as Unit does
  int id = 1;            ///< 1 … 254, unique
  bool held = false;     ///< the shaft stays where it is
  double shaft_rad = 0;  ///< where it begins
  /// Of an earlier day, whose id counts then, even one that another unit has; none: as the configuration ships it.
  std::optional<UnitPages> pages{};
};

/// Units on a line without a robot, each shaft free or held, which a client meets as if they were hardware (`vsa emulate`).
class Emulation {
 public:
  /// Equal units are stepped side by side; `instructions` as JointTrials has them, which change no bit. Throws InputError: no unit, an
  /// id out of range or given twice, a shaft that isn't a number.
  explicit Emulation(std::vector<EmulatedUnit> units, const LineConfig& line = {},
                     std::function<bus::SerialLine::Clock::time_point()> now = bus::SerialLine::Clock::now,
                     std::string_view instructions = {});

  [[nodiscard]] std::size_t size() const noexcept { return units_.size(); }  ///< units
  [[nodiscard]] PortLine& line() noexcept { return port_; }                  ///< for a serial port's thread

  /// Runs all ticks before this simulated time, and the physics up to it in whole milliseconds. By one thread.
  void advance(std::int64_t until_ns);
  [[nodiscard]] std::int64_t now_ns() const noexcept { return now_ns_; }  ///< simulated, since the start

  /// From any thread; from the next tick on. Throws InputError for values out of bounds or no such unit.
  void set_faults(std::size_t unit, const Faults& faults);

  /// What a unit has stored by now. From any thread. Throws InputError: no such unit.
  [[nodiscard]] UnitPages pages(std::size_t unit) const;

  /// What a unit is doing.
  struct Reading {
    std::array<double, 2> motor_rad{};  ///< the pulleys
    double shaft_rad = 0,               ///< q
        shaft_speed_rad_per_s = 0,      ///< q̇
        torque_Nm = 0;                  ///< mean over the last step
  };
  /// By the thread that advances.
  [[nodiscard]] Reading read(std::size_t unit) const;

 private:
  struct Shaft {
    double angle = 0, speed = 0, inverse_inertia = 0;
  };
  [[nodiscard]] std::vector<Station> stations();
  void take_faults();
  void step();

  std::vector<std::shared_ptr<Unit>> units_;  // equal ones share an instance
  std::vector<UnitState> states_;
  std::vector<Shaft> shafts_;
  std::vector<StepPlan> plans_;
  std::vector<firmware::TickInputs> inputs_;
  std::vector<std::size_t> order_;  // units, equal ones together: of joints_ and torques_
  std::vector<JointInStep> joints_;
  std::vector<double> torques_;
  JointTrials trials_;
  Chain chain_;
  PortLine port_;
  std::int64_t now_ns_ = 0;
  std::mutex faults_mutex_;
  std::vector<std::pair<std::size_t, Faults>> faults_;
};

}  // namespace vsa::device
