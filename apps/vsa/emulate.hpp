// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

/// On the units that `units` names; empty: all.
struct FaultOptions {
  std::string units;
  bool off = false;
  double lost_byte = 0, flipped_byte = 0;  ///< probabilities
  double late_ms = 0;
  std::vector<std::string> stuck;  ///< motor_1, motor_2, shaft
  double noise_deg = 0;            ///< every encoder
  std::optional<double> supply_V;
  std::vector<int> unplugged;  ///< 1, 2
  std::uint64_t seed = 1;
};

struct EmulateOptions {
  std::string preset;
  int units = 1;
  int first_id = 1;
  std::string port;  ///< empty: the preset's name
  int dialect = 6;
  bool active = false;
  bool held = false;
  std::vector<std::string> set;
  std::optional<double> duration_s;
  FaultOptions faults;
};

/// `vsa emulate PRESET`. Sets the exit code when it was the subcommand.
void setup_emulate(CLI::App& app, int& exit_code);
/// Throws InputError, before there is a port.
int run_emulate(const EmulateOptions& options);

}  // namespace vsa::app
