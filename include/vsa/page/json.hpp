// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// JSON as pages and files of results have it; bytes that aren't UTF-8 are replaced. A page's is safe inside <script>: '<', '>', '&' and
// line separators are escaped. For the library's own rooms; whoever includes it needs nlohmann::json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::page {

/// Members keep their order.
using Json = nlohmann::ordered_json;

/// The shortest digits that read back the same number, whole ones without a point. JSON has no NaN and no infinity: null.
[[nodiscard]] Json number(double value);
/// Of a single-precision number: the shortest that reads back the same float.
[[nodiscard]] Json number(float value);
/// Rounded to so many digits.
[[nodiscard]] Json number(double value, int digits);

/// As it stands in a page, on one line.
[[nodiscard]] std::string text(const Json& json);
[[nodiscard]] inline std::string json_string(std::string_view value) { return text(Json(value)); }  ///< quoted and escaped

/// A result, which keeps its point where it is whole: 5.0. null: not finite.
[[nodiscard]] Json real(double value);
[[nodiscard]] Json reals(const std::vector<double>& values);  ///< real() of each
/// What a results.json begins with: who wrote it, and on which command.
[[nodiscard]] Json results_head(const std::string& command);
/// As it stands in a results.json, indented.
[[nodiscard]] std::string results_text(const Json& json);

/// What somebody wrote. InputError with `file`, line and key: no JSON, a member given twice, of which a parser takes one in silence;
/// `allowed`: what was expected.
[[nodiscard]] Json read_json(std::string_view text, const std::string& file, const std::string& allowed);

/// UTF-8, with U+FFFD for what was none.
[[nodiscard]] std::string well_formed(std::string_view value);

/// Standard base64 of the numbers' little-endian bytes.
[[nodiscard]] std::string base64(const std::vector<float>& values);
[[nodiscard]] std::string base64_wide(const std::vector<double>& values);  ///< the same, eight bytes each

}  // namespace vsa::page
