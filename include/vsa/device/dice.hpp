// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chance that repeats: the same seed gives the same throws on every machine, and a copy goes on as the original does.
#pragma once

#include <cstdint>

namespace vsa::device {

/// splitmix64 (Steele, Lea, Flood 2014: Fast splittable pseudorandom number generators).
struct Dice {
  std::uint64_t state = 0;  ///< the seed; each throw moves it on
  static auto fields(auto& s, auto&& visit) { return visit("state", "", s.state); }

  /// 64 bits, each 0 or 1 with equal chance.
  std::uint64_t next() noexcept {
    std::uint64_t z = state += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// True with this probability; nothing is thrown for 0 or less.
  bool hits(double probability) noexcept { return probability > 0 && uniform() < probability; }
  bool operator==(const Dice&) const = default;
};

}  // namespace vsa::device
