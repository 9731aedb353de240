// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Text that users wrote, read strictly, and text that users read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::config {

/// A finite decimal number that fills the whole text, independent of the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
/// A whole decimal number that fills the whole text.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);

/// The shortest text that reads back as the same number: "0.1", "1e-06", "2000000".
[[nodiscard]] std::string number_text(double value);
/// "0 … 100"
[[nodiscard]] std::string range_text(double min, double max);
/// "a, b, c"
[[nodiscard]] std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);
[[nodiscard]] std::string_view trim(std::string_view text);

/// The candidate with the smallest edit distance; empty where there is none.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace vsa::config
