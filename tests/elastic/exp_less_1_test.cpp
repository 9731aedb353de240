// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/exp_less_1.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using vsa::elastic::exp_less_1;

/// In units of the last place, beside the 64 bits of a long double's mantissa.
double error_ulp(double x) {
  const long double truth = std::expm1(static_cast<long double>(x));
  const auto near = static_cast<double>(truth);
  const double ulp = std::nextafter(near, HUGE_VAL) - near;
  return static_cast<double>(std::abs((static_cast<long double>(exp_less_1(x)) - truth) / static_cast<long double>(ulp)));
}

TEST(ExpLess1, IsWithinTwoUnitsOfTheLastPlace) {
  if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "this machine's long double is no more exact than a double";
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  for (int i = 0; i < 300'000; ++i) {
    const double u = unit(rng), places[] = {708.9 * u, 3 * u, 0.7 * u, std::pow(10.0, -300 * u)};
    worst = std::max(worst, error_ulp(places[i % 4]));
  }
  for (int k = 1; k < 1400; ++k)  // where k changes, on both sides
    for (const double x : {0.34657359027997264 * k, std::nextafter(0.34657359027997264 * k, 0.0)})
      if (x < 709) worst = std::max(worst, error_ulp(x));
  EXPECT_LT(worst, 1.75) << "2 are promised; the most of 2e7 others was 1.71";
  EXPECT_GT(worst, 0.5) << "so exact would be another function";
}

TEST(ExpLess1, HasTheEnds) {
  EXPECT_EQ(exp_less_1(0.0), 0.0);
  EXPECT_EQ(exp_less_1(std::numeric_limits<double>::denorm_min()), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(exp_less_1(709.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(exp_less_1(std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(exp_less_1(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
