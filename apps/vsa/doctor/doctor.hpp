// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "doctor/checks.hpp"

namespace CLI {
class App;
}

namespace vsa::app {

struct DoctorOptions {
  std::string world;  ///< empty: only the surroundings
  std::string devices = "/dev";
};

/// `vsa doctor [WORLD]`. Sets the exit code when it was the subcommand.
void setup_doctor(CLI::App& app, int& exit_code);
int run_doctor(const DoctorOptions& options, LoadingCheck check_loading);

/// With the embedded engine.
void load_world(Findings& findings, const std::filesystem::path& file);

}  // namespace vsa::app
