// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unit/port.hpp"

namespace vsa::app {

struct GetOptions {
  UnitPortOptions port;
  std::vector<std::string> what;  ///< empty: active, inputs, measurements, currents
};

/// `vsa get PORT WHAT…`. Sets the exit code when it was the subcommand.
void setup_get(CLI::App& app, int& exit_code);
/// Throws InputError, NoAnswer.
int run_get(const GetOptions& options);

}  // namespace vsa::app
