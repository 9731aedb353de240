// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace vsa::app {

struct ValidateOptions {
  std::string type = "qbmove_maker_pro";
  std::vector<std::string> set;         ///< "drive.friction_Nm=0.7"
  std::vector<std::string> recordings;  ///< directories beside data/
  std::string leave_one_out;            ///< results.json of `vsa identify`; empty: data/TYPE/leave_one_out.json
  std::string out;                      ///< directory; empty: validate_TYPE
  std::string bounds;                   ///< TOML file; empty: data/bounds.toml
  std::string markdown;                 ///< file whose tables are to be replaced; empty: none
};

/// `vsa validate`. Sets the exit code when it was the subcommand.
void setup_validate(CLI::App& app, int& exit_code);
/// Exit code 1 where a bound is broken; the files are written all the same.
int run_validate(const ValidateOptions& options);

}  // namespace vsa::app
