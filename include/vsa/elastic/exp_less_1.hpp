// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace vsa::elastic {

/// eˣ − 1 for 0 ≤ x < 709, within 2 ulp of the true value; beyond it infinity. By additions and multiplications alone, so that every
/// machine gets the same bits, which a C library that chooses its code by the processor doesn't promise.
///   x = k ln 2 + r, |r| ≤ ½ ln 2:   eˣ − 1 = 2ᵏ (eʳ − 1) + (2ᵏ − 1),   eʳ − 1 by its Taylor series to r¹⁴ (the next term: 1e-19 r)
[[nodiscard]] inline double exp_less_1(double x) noexcept {
  constexpr double kPerLn2 = 1.4426950408889634;
  // ln 2 in two parts; the first has 32 bits, so that k times it is exact.
  constexpr double kLn2High = 0x1.62e42fefp-1, kLn2Low = 0x1.473de6af278edp-34;
  if (!(x < 709.0)) return x == x ? HUGE_VAL : x;
  const int k = static_cast<int>(x * kPerLn2 + 0.5);  // NOLINT(bugprone-incorrect-roundings): a tie may go either way
  const double high = x - k * kLn2High, low = k * kLn2Low, r = high - low, lost = (high - r) - low;
  double series = 1.0 / 87178291200.0;  // 1/14!
  constexpr double kTerms[] = {1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0,
                               1.0 / 362880.0,     1.0 / 40320.0,     1.0 / 5040.0,     1.0 / 720.0,
                               1.0 / 120.0,        1.0 / 24.0,        1.0 / 6.0,        0.5};
  for (const double term : kTerms) series = series * r + term;
  const double small = r + (r * r * series + (lost + lost * r));
  if (k == 0) return small;
  const double power = std::ldexp(1.0, k);
  return k < 53 ? (power - 1.0) + power * small : power + power * small;
}

}  // namespace vsa::elastic
