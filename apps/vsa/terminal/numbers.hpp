// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/Validators.hpp>
#include <string>

#include "vsa/config/text.hpp"

namespace vsa::app {

/// CLI11 reads an empty argument as 0 or as not given; here it is bad usage.
[[nodiscard]] inline CLI::Validator number_given() {
  return CLI::Validator([](std::string& text) { return text.empty() ? std::string("a number is missing") : std::string(); }, "");
}

/// Of a flag, ends included.
[[nodiscard]] inline CLI::Validator between(double min, double max) {
  const std::string range = config::range_text(min, max);
  return CLI::Validator(
      [=](std::string& text) {
        const auto number = config::parse_number(text);
        const bool good = number && *number >= min && *number <= max;
        return good ? std::string() : text + (number ? " is out of range" : " isn't a number") + " (allowed: " + range + ")";
      },
      range);
}

}  // namespace vsa::app
