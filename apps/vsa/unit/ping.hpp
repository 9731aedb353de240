// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unit/port.hpp"

namespace vsa::app {

/// `vsa ping [PORT]`. Sets the exit code when it was the subcommand.
void setup_ping(CLI::App& app, int& exit_code);
/// Empty ids: all.
int run_ping(UnitPortOptions options);

}  // namespace vsa::app
