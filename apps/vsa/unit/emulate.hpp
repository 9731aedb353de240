// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct EmulateOptions {
  std::string type;
  int units = 1;
  int first_id = 1;
  std::string port;            ///< empty: the type's name
  std::optional<int> dialect;  ///< none: the type's
  bool active = false;
  bool held = false;
  bool low_latency = false;
  bool any_rate = false;
  std::string memory;  ///< file with what the units have stored; empty: it ends with the program
  std::vector<std::string> set;
  std::optional<double> duration_s;
  std::vector<std::string> faults;  ///< "IDS FAULT…" or "all FAULT…", see config/faults_text.hpp
};

/// `vsa emulate TYPE`. Sets the exit code when it was the subcommand.
void setup_emulate(CLI::App& app, int& exit_code);
/// Throws InputError, before there is a port.
int run_emulate(const EmulateOptions& options);

}  // namespace vsa::app
