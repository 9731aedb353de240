// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One run of a world: what is loaded, in which order a step does what, and what is told at the end.
//
//   pages' requests → control requests → gait, scenario's commands → world.step() → record → travel → topics → view → wall clock
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/run.hpp"
#include "terminal/console.hpp"
#include "terminal/pace.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/motion/travel.hpp"
#include "vsa/record/recorder.hpp"
#include "vsa/scenario/player.hpp"
#include "vsa/seat/run_control.hpp"
#include "vsa/topics/world_server.hpp"
#include "vsa/view/live_view.hpp"

namespace vsa::app {

class RunSession {
 public:
  /// Loads everything; throws InputError before anything runs.
  RunSession(const RunOptions& options, Console& console);

  /// Runs to the end of the duration or to a signal; returns that signal or 0. Throws SimulationError or RecordError: the world is
  /// where it was, and finish() still works.
  int run();

  /// Closes the record, with a note on why the run ended early, and returns what is worth telling.
  std::vector<record::Statistic> finish(const std::string& note);
  /// Why a recording isn't whole, a sentence each; none: all are.
  [[nodiscard]] const std::vector<std::string>& failures() const noexcept { return failures_; }

 private:
  [[nodiscard]] bool done() const { return end_ns_ && world_.time_ns() >= *end_ns_; }
  void open_view(const RunOptions& options);
  void open_ports();
  void tell_of_other_records();
  void tell_of_late_commands(double duration_s) const;
  void write_scenario(std::vector<std::string> remarks);
  [[nodiscard]] std::vector<std::string> outside();
  void step();
  void reset();
  void idle();
  void take_speed();
  void keep_time();
  [[nodiscard]] double speed_factor() const;
  [[nodiscard]] std::vector<record::Statistic> statistics() const;

  Console& console_;
  RunOptions options_;
  std::optional<double> speed_;  // simulated by wall time; none: as fast as it can
  engine::World world_;
  scenario::Player player_;
  std::string robot_model_;  // top-level model of the first robot; empty: none, or one that is bolted down
  double travel_window_s_;
  seat::RunControl control_;
  std::optional<record::Recorder> recorder_;
  std::optional<topics::WorldServer> server_;
  motion::Travel travel_;
  record::Cadence travel_cadence_;
  std::optional<view::LiveView> view_;
  std::uint64_t speed_changes_ = 0;
  RealTimePace pace_;
  Stopwatch wall_;
  std::optional<std::int64_t> end_ns_;
  std::uint64_t steps_ = 0;
  int resets_ = 0;
  std::vector<std::string> failures_;
  bool has_ports_ = false, told_late_ = false;
};

}  // namespace vsa::app
