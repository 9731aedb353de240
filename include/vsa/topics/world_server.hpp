// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world on the transport: its robots' topics (host/topics.hpp), /clock, /world/W/stats and the services /world/W/control and
// /model/M/vsa/faults (vsa/seat/seat.hpp).
//
// WorldControl → Boolean. Honoured: pause, step, multi_step, reset.all, run_to_sim_time, as in gz-sim (in that message an absent
// `pause` is false and lets the world run). Refused whole, with reply false and one reported line: reset.time_only,
// reset.model_only and a seed, since the simulator draws no random numbers. The reply says that the request is queued; it is done
// between two steps.
#pragma once

#include <memory>

#include "vsa/engine/world.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/seat/run_control.hpp"

namespace vsa::topics {

/// A world on the transport: its robots' topics, its clock and statistics, and the services that pause, step and reset it. World
/// and control must outlive it. All but the constructor's `report` stays in the thread that calls.
class WorldServer {
 public:
  /// Throws InputError for names that can't be topics. `report` gets readable lines, from any thread: all that the robots' seats
  /// have to tell as long as the server lives.
  WorldServer(engine::World& world, seat::RunControl& control, const host::RobotTopics::Report& report);
  ~WorldServer();
  WorldServer(const WorldServer&) = delete;
  WorldServer& operator=(const WorldServer&) = delete;

  /// After every step: publishes what is due to those who listen. /clock: every step, but at most 1000 a wall second; states: at
  /// the robot's state rate, in simulated time; stats: 5 a wall second.
  void stepped();

  /// After a reset and now and then while paused: publishes everything as it is, 10 times a wall second at most.
  void idle();

  /// Commands and control requests refused so far.
  [[nodiscard]] std::uint64_t refused() const noexcept;
  /// Commands and orders of faults that came for the robots, taken or refused.
  [[nodiscard]] std::uint64_t heard() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::topics
