// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <sstream>
#include <utility>

namespace vsa::config {
namespace {

constexpr std::size_t kLongestWord = 64;  // beyond it nobody mistyped a key, and the distance would cost time

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replace = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replace, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  // Not std::from_chars: the library of g++ 10 has none for double. A stream in the classic locale knows neither "nan" nor
  // hexadecimal.
  if (text.empty() || text.find('\0') != std::string_view::npos) return std::nullopt;
  std::istringstream in{std::string(text)};
  in.imbue(std::locale::classic());
  double value = 0;
  in >> std::noskipws >> value;
  if (in.fail() || in.peek() != std::istringstream::traits_type::eof() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return value;
}

std::string number_text(double value) {
  // Whole numbers as people write them (2000000, not 2e+06), as long as they are exact.
  if (value == std::trunc(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value == 0 ? 0.0 : value);
  return fmt::format("{}", value);
}

std::string range_text(double min, double max) { return number_text(min) + " … " + number_text(max); }

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  return fmt::format("{}", fmt::join(words, separator));
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::pair<bool, std::size_t> least{true, std::numeric_limits<std::size_t>::max()};  // isn't begun by the word; distance
  for (const std::string& candidate : candidates) {
    const bool other = word.empty() || candidate.compare(0, word.size(), word) != 0;
    const std::pair<bool, std::size_t> distance{other, edit_distance(word.substr(0, kLongestWord), candidate)};
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string near = nearest(word, candidates);
  const bool begun = !word.empty() && near.compare(0, word.size(), word) == 0;
  const bool like = edit_distance(word.substr(0, kLongestWord), near) <= std::max<std::size_t>(2, word.size() / 2);
  return !near.empty() && (begun || like) ? ", did you mean " + near + "?" : "";
}

std::string renamed_text(std::string_view old, std::string_view now) {
  return std::string(old) + " is called " + std::string(now) + " now: the old spelling is understood for one more release";
}

}  // namespace vsa::config
