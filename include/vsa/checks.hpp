// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What every parameter struct's validate() finds its problems with. A number that was forgotten is NaN and fails here.
//
//   void validate(const SomeParams& params, std::string_view where, Problems& problems);
//
// stands beside the struct and adds what no model of it could work with, each under the key by which files have it; `where` leads
// the key ("drive.", "elbow: drive."). Files and C++ pass the same functions.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "vsa/errors.hpp"

namespace vsa {

/// Finds the problems of one parameter struct.
class Checks {
 public:
  Checks(std::string_view where, Problems& problems) : where_(where), problems_(problems) {}  ///< `where` leads every key

  void within(std::string_view key, double value, double min, double max);  ///< finite, and min ≤ value ≤ max
  void positive(std::string_view key, double value);                        ///< finite, and at least the smallest normal number
  void not_negative(std::string_view key, double value) { within(key, value, 0, kUnbounded); }      ///< finite, and 0 or more
  void finite(std::string_view key, double value) { within(key, value, -kUnbounded, kUnbounded); }  ///< finite
  /// A problem of its own.
  void refuse(std::string_view key, std::string value, std::string message, std::string allowed);

  /// A number as a message shows it: six digits.
  [[nodiscard]] static std::string text(double value);

 private:
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  std::string where_;
  Problems& problems_;
};

}  // namespace vsa
