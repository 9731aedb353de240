// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs that are fits: one local solution each, from its own start, with some parameters held and some recordings left out. Many starts,
// profiles, leave-one-out fits and compared structures are plans of them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vsa/config/toml_section.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/identify/bench_model.hpp"

namespace vsa::sweep {

struct FitTask {
  experiment::Specimen specimen;
  std::string parameters;                         ///< as vsa identify has them
  std::vector<std::filesystem::path> recordings;  ///< fitted to
  std::vector<std::filesystem::path> left_out;    ///< only judged on
  std::map<std::string, double> from, hold;       ///< by the parameter's name; others begin at the type's value
  identify::SweepOptions bench;
  int iterations = 20;
  bool by_scatter = true;
};

/// Of a [study]'s keys those of a fit; relative files are beside `file`.
[[nodiscard]] FitTask read_fit(config::TomlSection& study, const std::filesystem::path& file, experiment::Specimen specimen,
                               Problems& problems);
/// Reads type and recordings, and gives the names of all numbers that a fit will have. Throws InputError.
[[nodiscard]] std::vector<std::string> fit_numbers(const FitTask& task);
/// None: not wanted any more.
[[nodiscard]] std::optional<std::map<std::string, double>> run_fit(const FitTask& task, const std::function<bool()>& wanted);

}  // namespace vsa::sweep
