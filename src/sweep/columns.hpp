// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "vsa/sweep/folder.hpp"

namespace vsa::sweep {

/// Of the table: numbers or texts, one a run.
struct Column {
  std::string name;
  bool is_number = true;
  std::vector<double> numbers;  ///< NaN: none
  std::vector<std::string> texts;
};
/// A text as a CSV file has it (RFC 4180).
[[nodiscard]] std::string cell(const std::string& text);
[[nodiscard]] std::vector<Column> columns(const Plan& plan, const Results& results);

}  // namespace vsa::sweep
