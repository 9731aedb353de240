// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa identify --compare FILE.toml`: hypotheses side by side (vsa/identify/comparison.hpp).
#pragma once

#include <optional>
#include <string>

namespace vsa::app {

struct CompareOptions {
  std::string file;         ///< the hypotheses
  std::string out;          ///< directory; empty: compare_FILE
  std::optional<int> jobs;  ///< fits side by side; none: as the file says
};

/// Writes each fit into OUT/fits when it is done, takes those from there that were asked the same, and ends with comparison.json,
/// comparison.md and the table on standard output.
int run_compare(const CompareOptions& options);

}  // namespace vsa::app
