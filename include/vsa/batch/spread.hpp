// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Parameters that differ from copy to copy, by chance that repeats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace vsa::batch {

/// One value for one copy. A double for numbers (a switch: 0 or 1), a text for words and switches ("coast", "true").
struct Setting {
  std::size_t copy = 0;                     ///< whose
  std::string who;                          ///< actuator or link; empty: every one that has the key
  std::string key;                          ///< of the parameter
  std::variant<double, std::string> value;  ///< a number, or a word
};

/// How a number is drawn: uniform, uniform in its logarithm, or normal with its ends cut off.
struct Distribution {
  /// Of the draw.
  enum class Kind {
    uniform,                   ///< from a to b
    log_uniform,               ///< from a to b, its logarithm uniform; 0 < a ≤ b
    normal                     ///< mean a, standard deviation b ≥ 0, cut off at three of these
  } kind = Kind::uniform;      ///< whose `a` and `b` the next two are
  double a = 0,                ///< lower end, or mean
      b = 0;                   ///< upper end, or standard deviation
  bool times_nominal = false;  ///< the value is the draw times what the Batch began with
  bool shared = false;         ///< one draw for all of a copy's; else each actuator or link has its own
};

/// A parameter and how it is spread over copies. Of a whole number the nearest to the draw counts.
struct Spread {
  std::string who;    ///< as in Setting
  std::string key;    ///< of the parameter
  Distribution draw;  ///< from which each copy's value comes
};

/// Follows from its arguments and nothing else: by splitmix64 of seed, copy and the FNV-1a hashes of key and who (0 where shared).
[[nodiscard]] double drawn(const Distribution& from, std::uint64_t seed, std::size_t copy, std::string_view who,
                           std::string_view key) noexcept;

}  // namespace vsa::batch
