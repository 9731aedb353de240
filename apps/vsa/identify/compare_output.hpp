// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa identify --compare` leaves behind:
//   fits/NAME.json                    one fit of one hypothesis, to all recordings
//   fits/NAME.without.RECORDING.json  to all but one
//   comparison.json                   all of it and the judgement
//   comparison.md                     the table, and the estimates of each hypothesis
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vsa/identify/comparison.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {

/// One fit as JSON and back. Numbers that aren't finite are texts: "nan", "inf", "-inf".
[[nodiscard]] std::string fit_json(const identify::FitRecord& record);
/// None where the file isn't there, isn't such a record, or was asked something else.
[[nodiscard]] std::optional<identify::FitRecord> stored_fit(const std::filesystem::path& file, const std::string& asked);

/// A comparison that is done; `records` in the order of identify::requests().
struct Compared {
  std::string command;
  identify::Comparison comparison;
  std::vector<identify::FitRecord> records;
  std::vector<identify::Judgement> rows;
};

[[nodiscard]] report::Table comparison_table(const Compared& c);
[[nodiscard]] std::string comparison_json(const Compared& c);
[[nodiscard]] std::string comparison_markdown(const Compared& c);

}  // namespace vsa::app
