// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/batch/spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vsa/device/dice.hpp"

namespace vsa::batch {
namespace {

constexpr double kCut = 3.0;  ///< standard deviations

std::uint64_t fnv(std::string_view text) noexcept {
  std::uint64_t sum = 14695981039346656037ULL;
  for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return sum;
}

/// One after the other, so that (1, 2) and (2, 1) part.
device::Dice dice_of(std::uint64_t seed, std::uint64_t copy, std::uint64_t key, std::uint64_t who) noexcept {
  device::Dice dice{seed};
  for (const std::uint64_t next : {copy, key, who}) dice.state = dice.next() ^ next;
  return {dice.next()};
}

/// Of spans that no double holds, too.
double between(double a, double b, double part) noexcept {
  return std::isfinite(b - a) ? a + part * (b - a) : (1 - part) * a + part * b;
}

double standard_normal(device::Dice& dice) noexcept {
  for (;;) {
    const double radius = std::sqrt(-2 * std::log(1 - dice.uniform()));
    const double z = radius * std::cos(2 * std::numbers::pi * dice.uniform());
    if (std::abs(z) <= kCut) return z;
  }
}

}  // namespace

double drawn(const Distribution& from, std::uint64_t seed, std::size_t copy, std::string_view who, std::string_view key) noexcept {
  device::Dice dice = dice_of(seed, copy, fnv(key), from.shared ? 0 : fnv(who));
  switch (from.kind) {
    case Distribution::Kind::uniform:
      return std::clamp(between(from.a, from.b, dice.uniform()), from.a, from.b);
    case Distribution::Kind::log_uniform:
      if (!std::isfinite(from.b / from.a))
        return std::clamp(std::exp(between(std::log(from.a), std::log(from.b), dice.uniform())), from.a, from.b);
      return std::clamp(from.a * std::exp(dice.uniform() * std::log(from.b / from.a)), from.a, from.b);
    case Distribution::Kind::normal:
      break;
  }
  return from.a + from.b * standard_normal(dice);
}

}  // namespace vsa::batch
