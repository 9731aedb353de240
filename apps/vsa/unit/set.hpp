// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unit/port.hpp"

namespace vsa::app {

struct SetOptions {
  UnitPortOptions port;
  std::string what;
  std::vector<std::string> values;
  bool store = false;
};

/// `vsa set PORT WHAT VALUE…`. Sets the exit code when it was the subcommand.
void setup_set(CLI::App& app, int& exit_code);
/// Throws InputError, before anything is sent where the values alone show it; NoAnswer.
int run_set(const SetOptions& options);

}  // namespace vsa::app
