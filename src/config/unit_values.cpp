// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vsa/config/text.hpp"
#include "vsa/config/unit_parameters.hpp"

namespace vsa::config {
namespace {

/// The number at the text's beginning, and what follows it.
struct Parsed {
  double value = 0;
  std::string_view rest;
};
std::optional<Parsed> parse(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  for (std::size_t length = text.size(); length > 0; --length) {
    if (const auto value = parse_number(text.substr(0, length))) return Parsed{*value, text.substr(length)};
  }
  return std::nullopt;
}

}  // namespace

double degrees_of(double ticks, std::uint8_t resolution) { return std::ldexp(ticks, resolution) * 360.0 / 65536.0; }

std::string angle_text(std::int32_t ticks, std::uint8_t resolution) {
  return fmt::format("{:.2f}° ({} ticks)", degrees_of(ticks, resolution), ticks);
}

std::string angles_text(const std::vector<std::int32_t>& ticks, const Resolutions& resolutions) {
  constexpr std::array<const char*, 3> kWhere{"motor 1", "motor 2", "shaft"};
  std::string text;
  for (std::size_t i = 0; i < std::min(ticks.size(), kWhere.size()); ++i)
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", kWhere[i], angle_text(ticks[i], resolutions[i]));
  return text;
}

void ValueReader::refuse(std::size_t index, const std::string& why, const std::string& allowed) {
  problems_.add({"", what_, index < values_.size() ? values_[index] : "", why, allowed});
}

bool ValueReader::expect(std::size_t count, const std::string& example) {
  if (values_.size() == count) return true;
  problems_.add({"", what_, fmt::format("{}", fmt::join(values_, " ")),
                 fmt::format("takes {} value{}", count, count == 1 ? "" : "s"), example});
  return false;
}

double ValueReader::number(std::size_t index, double low, double high, const std::string& unit) {
  const std::string allowed = fmt::format("a number from {} to {}{}", low, high, unit);
  const auto parsed = parse(values_[index]);
  if (!parsed || !parsed->rest.empty()) return refuse(index, "no number", allowed), 0;
  if (parsed->value < low || parsed->value > high) return refuse(index, "out of range", allowed), 0;
  return parsed->value;
}

std::int64_t ValueReader::whole(std::size_t index, std::int64_t low, std::int64_t high, const std::string& unit) {
  const std::string allowed = fmt::format("a whole number from {} to {}{}", low, high, unit);
  const auto parsed = parse(values_[index]);
  if (!parsed || !parsed->rest.empty() || parsed->value != std::floor(parsed->value))
    return refuse(index, "no whole number", allowed), 0;
  if (parsed->value < static_cast<double>(low) || parsed->value > static_cast<double>(high))
    return refuse(index, "out of range", allowed), 0;
  return static_cast<std::int64_t>(parsed->value);
}

std::int32_t ValueReader::ticks(std::size_t index, std::uint8_t resolution, std::int32_t low, std::int32_t high) {
  const std::string allowed = fmt::format("{:.2f} to {:.2f} degrees, or {} to {} as \"910ticks\"", degrees_of(low, resolution),
                                          degrees_of(high, resolution), low, high);
  const auto parsed = parse(values_[index]);
  if (!parsed) return refuse(index, "no angle", allowed), 0;
  double ticks = parsed->value;
  if (parsed->rest.empty() || parsed->rest == "deg" || parsed->rest == "°")
    ticks = std::ldexp(parsed->value * 65536.0 / 360.0, -resolution);
  else if (parsed->rest != "ticks")
    return refuse(index, "no angle", allowed), 0;
  ticks = std::round(ticks);
  if (ticks < low || ticks > high) return refuse(index, "out of range", allowed), 0;
  return static_cast<std::int32_t>(ticks);
}

std::size_t ValueReader::word(std::size_t index, std::span<const std::string_view> words) {
  const auto at = std::find(words.begin(), words.end(), values_[index]);
  if (at != words.end()) return static_cast<std::size_t>(at - words.begin());
  for (std::size_t i = 0; i < words.size(); ++i)
    if (values_[index] == std::to_string(i)) return i;
  return refuse(index, "unknown", fmt::format("{}", fmt::join(words, ", "))), 0;
}

}  // namespace vsa::config
