// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/checks.hpp"

#include <cmath>
#include <sstream>
#include <utility>

namespace vsa {

std::string Checks::text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void Checks::within(std::string_view key, double value, double min, double max) {
  if (std::isfinite(value) && value >= min && value <= max) return;
  std::string allowed = "finite";
  if (max < kUnbounded) {
    allowed += ", " + text(min) + " … " + text(max);
  } else if (min > -kUnbounded) {
    allowed += ", ≥ " + text(min);
  }
  refuse(key, text(value), "is out of range", std::move(allowed));
}

void Checks::positive(std::string_view key, double value) {
  if (!(std::isfinite(value) && value >= std::numeric_limits<double>::min()))
    refuse(key, text(value), "is out of range", "finite, above 0");
}

void Checks::refuse(std::string_view key, std::string value, std::string message, std::string allowed) {
  problems_.add({"", where_ + std::string(key), std::move(value), std::move(message), std::move(allowed)});
}

}  // namespace vsa
