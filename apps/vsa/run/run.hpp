// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "vsa/scenario/scenario.hpp"

namespace vsa::app {

inline constexpr double kSlowest = 0.01, kFastest = 100;  // simulated by wall time
inline constexpr double kSlowestRecord_Hz = 1e-3, kFastestRecord_Hz = 1e6;

struct RunOptions : scenario::Scenario {
  bool realtime = false;
  bool view = false;
  std::optional<int> view_port;  ///< none, 0: any free one
  std::string view_records;      ///< where the page's record button writes; empty: here
  std::string speed;             ///< "2", "max"; empty: 1 with realtime or view, else max
  bool low_latency = false;
  bool paused = false;
  bool no_topics = false;
  std::string record;  ///< directory; empty: none
  double record_rate_Hz = 100, page_rate_Hz = 50;
};

/// `vsa run WORLD.sdf` and `vsa run SCENARIO.toml`. Sets the exit code when it was the subcommand.
void setup_run(CLI::App& app, int& exit_code);
int run_run(const RunOptions& options);

}  // namespace vsa::app
