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
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);  ///< all parts, empty ones, too
[[nodiscard]] std::string_view trim(std::string_view text);  ///< without blanks, tabs and line ends at both ends

/// What the word may have meant: of the candidates that begin with it, or else of all, the one with the smallest edit distance. Empty
/// where there is none.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& candidates);
/// ", did you mean X?" of the nearest; empty where none is begun by the word or half like it (distance up to 2, or half its length).
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// What a user of an old spelling is told, who is understood for one more release: "<preset> is called <type> now: …".
[[nodiscard]] std::string renamed_text(std::string_view old, std::string_view now);

}  // namespace vsa::config
