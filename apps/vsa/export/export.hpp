// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace vsa::app {

/// `vsa export`, --mjcf or --fmu. Sets the exit code when it was the subcommand.
void setup_export(CLI::App& app, int& exit_code);

}  // namespace vsa::app
