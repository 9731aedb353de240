// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "doctor/checks.hpp"
#include "vsa/feature.hpp"

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
/// `features`: that the program may have been built without.
int run_doctor(const DoctorOptions& options, LoadingCheck check_loading, const std::vector<Feature>& features = {});

/// With the embedded engine.
void load_world(Findings& findings, const std::filesystem::path& file);

}  // namespace vsa::app
