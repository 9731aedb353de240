// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace vsa::config {
namespace {

constexpr std::size_t kDecimals = 4;

/// "0.6903": as experiment_name() writes it, or what it names would never be found.
bool is_preset(std::string_view text) {
  const std::size_t point = text.find('.');
  if (point == 0 || point == std::string_view::npos || text.size() != point + 1 + kDecimals) return false;
  if (point > 1 && text[0] == '0') return false;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  return std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(point), digit) &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(point) + 1, text.end(), digit);
}

}  // namespace

bool names_experiment(std::string_view name) {
  if (name == "preset_step.no_load" || name == "preset_step.loaded") return true;
  for (const std::string_view stem : {"stiffness.", "speed."}) {
    if (name.substr(0, stem.size()) == stem) return is_preset(name.substr(stem.size()));
  }
  return false;
}

std::string experiment_name(std::string_view experiment, double preset) {
  return fmt::format("{}.{:.{}f}", experiment, preset, kDecimals);
}

bool covers(const Evidence& evidence, std::string_view quantity) {
  return std::any_of(evidence.calibrated_on.begin(), evidence.calibrated_on.end(), [&](const std::string& name) {
    return quantity.substr(0, name.size()) == name && (quantity.size() == name.size() || quantity[name.size()] == '.');
  });
}

}  // namespace vsa::config
