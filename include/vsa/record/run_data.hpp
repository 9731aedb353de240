// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a recording holds, as plain data: the part that doesn't change (RunInfo) and one moment (Sample). The writers know only
// these, so that they can be tested, and used, without a simulator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vsa/actuator/ledger.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/output_file.hpp"
#include "vsa/scene/energy.hpp"
#include "vsa/scene/link.hpp"

namespace vsa::record {

/// An actuator, as headers and pages name it.
struct ActuatorInfo {
  std::string name;                 ///< unique in its robot
  std::string joint;                ///< scoped joint name, as configured
  std::string type;                 ///< the actuator type's name
  std::string preset_unit = "rad";  ///< of commands and readings; "" where it has no preset
  int motors = 2;                   ///< 1 or 2: columns of a missing motor stay empty
  std::vector<std::size_t> links;   ///< into RunInfo::links: the bodies to highlight for it
  bool linear = false;              ///< its shaft slides: readings in m and N
};

/// A robot of the world.
struct RobotInfo {
  std::string model;                    ///< scoped model name
  std::vector<ActuatorInfo> actuators;  ///< in the order of Sample::actuators
};

/// What doesn't change during a run.
struct RunInfo {
  std::string world;                   ///< the world's name
  double step_s = 0;                   ///< of the simulator
  std::vector<RobotInfo> robots;       ///< in the order of Sample::actuators
  std::vector<scene::LinkInfo> links;  ///< of Sample::poses
  std::string
      faults{};  ///< what is broken from the start and the seeds of its chances, as `vsa run --fault` takes it; empty: nothing
};

/// One moment. The same shape for every sample of a run.
struct Sample {
  std::int64_t time_ns = 0;                      ///< simulated
  std::vector<host::ActuatorReading> actuators;  ///< robots in order, each robot's actuators in order
  std::vector<scene::Pose> poses;                ///< one an entry of RunInfo::links
  actuator::Ledger ledger;                       ///< over all actuators
  std::optional<scene::Energy> bodies{};         ///< of all of them; none: the simulator doesn't tell
};

/// A line of the summary, as the command line prints it and the page shows it.
struct Statistic {
  std::string label;  ///< what it is
  std::string value;  ///< with its unit
};

/// Writing failed after the recording had begun.
using RecordError = OutputError;

/// Decides by integer time which steps are samples: the first step at or after each multiple of the period (rounded to 1 ns), so
/// that sample times never drift and a rate above the step rate takes every step.
class Cadence {
 public:
  explicit Cadence(double rate_Hz);  ///< (0, 1e6] Hz, rounded to whole ns
  /// Whether the sample at this time is wanted.
  [[nodiscard]] bool due(std::int64_t time_ns) const noexcept { return time_ns >= next_ns_; }
  /// The sample at this time is made.
  void taken(std::int64_t time_ns) noexcept { next_ns_ = (time_ns / period_ns_ + 1) * period_ns_; }
  void restart() noexcept { next_ns_ = 0; }                                     ///< back to time 0
  [[nodiscard]] std::int64_t period_ns() const noexcept { return period_ns_; }  ///< between two samples

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
};

}  // namespace vsa::record
