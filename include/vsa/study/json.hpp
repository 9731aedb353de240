// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What all results.json have in common.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vsa::study {

/// Keys in the order in which they are written.
using Json = nlohmann::ordered_json;

/// null: not finite.
[[nodiscard]] Json json_number(double value);
[[nodiscard]] Json json_numbers(const std::vector<double>& values);

/// What a file begins with: who wrote it, and on which command.
[[nodiscard]] Json json_head(const std::string& command);
/// As it stands in a file; bytes that aren't UTF-8 (of a file's name) are replaced.
[[nodiscard]] std::string json_text(const Json& json);

}  // namespace vsa::study
