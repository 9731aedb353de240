// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "vsa/sweep/measure.hpp"

namespace {

using vsa::sweep::Measure;
using vsa::sweep::Statistic;

constexpr double kPi = 3.14159265358979323846;

template <class F>
double of(const std::string& statistic, F&& f, double band = 0, double order = 0, double mean = 0) {
  Measure m;
  m.statistic = statistic;
  m.band = band;
  m.order = order;
  Statistic s(m);
  for (int i = 0; i <= 10'000; ++i) s.add(1e-3 * i, mean + f(1e-3 * i));
  return s.value();
}

TEST(Statistic, OfASineOverWholePeriodsAreThoseOfTheFormulas) {
  const auto sine = [](double t) { return 2 * std::sin(2 * kPi * t); };
  EXPECT_NEAR(of("mean", sine), 0, 1e-9);
  EXPECT_NEAR(of("rms", sine), std::sqrt(2), 2e-4);
  EXPECT_NEAR(of("std", sine), std::sqrt(2), 2e-4);
  EXPECT_NEAR(of("rms", sine, 0, 0, 3), std::sqrt(11), 2e-4);
  EXPECT_NEAR(of("std", sine, 0, 0, 3), std::sqrt(2), 2e-4);
  EXPECT_NEAR(of("std", sine, 0, 0, 1e9), std::sqrt(2), 2e-4) << "a large mean costs no digits";
  EXPECT_NEAR(of("integral", sine, 0, 0, 3), 30, 1e-9);
  EXPECT_NEAR(of("peak", sine, 0, 0, -1), 3, 1e-6);
  EXPECT_NEAR(of("min", sine), -2, 1e-6);
  EXPECT_NEAR(of("max", sine), 2, 1e-6);
  EXPECT_NEAR(of("range", sine, 0, 0, 7), 4, 1e-6);
  EXPECT_NEAR(of("quantile", sine, 0, 0.75), std::sqrt(2), 1e-3) << "a quarter of a sine's time is above sin 45°";
  EXPECT_NEAR(of("quantile", sine, 0, 0.5), 0, 1e-3);
  EXPECT_NEAR(of("quantile", sine, 0, 1), 2, 1e-6);
}

TEST(Statistic, FirstAndLast) {
  EXPECT_EQ(of("first", [](double t) { return 5 + t; }), 5);
  EXPECT_EQ(of("last", [](double t) { return 5 + t; }), 15);
}

TEST(Statistic, AnExponentialSettlesAtTheLogarithmOfItsBand) {
  const auto decay = [](double t) { return std::exp(-t / 0.5); };
  EXPECT_NEAR(of("settle_s", decay, 0.02), 0.5 * std::log(1 / 0.02), 2e-3);
  EXPECT_EQ(of(
                "settle_s", [](double) { return 4.0; }, 0.02),
            0);
  EXPECT_TRUE(std::isnan(of(
      "settle_s", [](double t) { return t; }, 0.02)))
      << "never";
}

TEST(Statistic, NothingIsNoNumberAndANumberThatIsNoneStays) {
  for (const std::string& name : vsa::sweep::statistic_names()) {
    Measure m;
    m.statistic = name;
    m.band = 1;
    m.order = 0.5;
    EXPECT_TRUE(std::isnan(Statistic(m).value())) << name;
    if (name == "first" || name == "last") continue;
    Statistic s(m);
    for (const double v : {1.0, std::nan(""), 2.0}) s.add(v, v);
    EXPECT_TRUE(std::isnan(s.value())) << name << " " << s.value();
  }
}

}  // namespace
