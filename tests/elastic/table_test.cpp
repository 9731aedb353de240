// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The law of a measured grid: it goes through its points, its stiffness falls nowhere below 0, and what is no spring is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "all_laws.hpp"

namespace {

using vsa::elastic::Law;
using vsa::elastic::LawFault;
using vsa::elastic::Positions;
using vsa::elastic::SegmentMean;

const Law& table() {
  for (const Law* law : vsa::elastic::laws())
    if (law->name == "table") return *law;
  throw std::runtime_error("no law table");
}

using Torque = std::function<double(double deflection, double preset)>;

/// The law's values: a scale and the grid of a function.
std::vector<double> grid(const std::vector<double>& deflections, const std::vector<double>& presets, const Torque& torque,
                         double scale = 1) {
  std::vector<double> out{scale};
  for (const double p : presets)
    for (const double d : deflections) out.insert(out.end(), {d, torque(d, p), p});
  return out;
}

const std::vector<double> kDeflections{-0.6, -0.4, -0.25, -0.1, 0, 0.1, 0.25, 0.4, 0.6}, kPresets{0, 0.2, 0.5, 0.8};

double sinh_pair(double d, double p) { return 2 * 0.022 * std::cosh(6.85 * p) * std::sinh(6.85 * d); }

TEST(Table, GoesThroughItsPoints) {
  const auto law = table().make(grid(kDeflections, kPresets, sinh_pair));
  for (const double p : kPresets)
    for (const double d : kDeflections)
      EXPECT_NEAR(law->evaluate({0.3 + d, {0.3, p}}).torque, -sinh_pair(d, p), 1e-12) << d << ' ' << p;
  const auto scaled = table().make(grid(kDeflections, kPresets, sinh_pair, 2.5));
  EXPECT_NEAR(scaled->evaluate({0.25, {0, 0.5}}).torque, -2.5 * sinh_pair(0.25, 0.5), 1e-12);
}

TEST(Table, OfAFineGridIsTheLawThatItWasMeasuredFrom) {
  std::vector<double> deflections, presets;
  for (int i = -30; i <= 30; ++i) deflections.push_back(0.02 * i);
  for (int i = 0; i <= 20; ++i) presets.push_back(0.04 * i);
  const auto law = table().make(grid(deflections, presets, sinh_pair));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> d(-0.6, 0.6), p(0, 0.8);
  for (int n = 0; n < 300; ++n) {
    const double x = d(random), y = p(random);
    const auto r = law->evaluate({x, {0, y}});
    const double energy = 2 * 0.022 / 6.85 * std::cosh(6.85 * y) * (std::cosh(6.85 * x) - 1);
    EXPECT_NEAR(r.torque, -sinh_pair(x, y), 2e-3 * std::abs(sinh_pair(x, y)) + 1e-4);
    EXPECT_NEAR(r.energy, energy, 2e-3 * energy + 1e-5);
    EXPECT_NEAR(r.load[1], -6.85 * std::tanh(6.85 * y) * energy, 0.03 * 6.85 * energy + 1e-3);
  }
}

TEST(Table, OfALineAndOneOfAParabolaAreExact) {
  const auto line = table().make(grid({-0.5, -0.1, 0, 0.3}, {0, 0.7}, [](double d, double p) { return (4 + 10 * p) * d; }));
  const auto r = line->evaluate({0.2, {0, 0.33}});
  EXPECT_NEAR(r.torque, -7.3 * 0.2, 1e-14);
  EXPECT_NEAR(r.energy, 0.5 * 7.3 * 0.04, 1e-14);
  EXPECT_NEAR(r.load[1], -0.5 * 10 * 0.04, 1e-14);
  const auto hardening = [](double d, double) { return 3 * d + 5 * d * d; };
  const auto parabola = table().make(grid({0, 0.2, 0.3, 0.6}, {0}, hardening));
  for (const double d : {0.25, 0.28}) EXPECT_NEAR(parabola->evaluate({d, {0, 0}}).torque, -hardening(d, 0), 1e-14);
}

/// Rows with kinks, flats and crossings, as no spring has them but a measurement may.
std::vector<double> wild(std::mt19937& random) {
  std::exponential_distribution<double> rise(1), flat(1);
  std::vector<double> deflections{-0.5, -0.45, -0.2, -0.05, 0, 0.1, 0.12, 0.4}, presets{-0.3, 0, 0.1, 0.9, 1}, out{1};
  for (const double p : presets) {
    std::vector<double> torque{0};
    for (std::size_t i = 1; i < deflections.size(); ++i)
      torque.push_back(torque.back() + (flat(random) < 0.3 ? 0 : std::pow(rise(random), 3)));
    for (std::size_t i = 0; i < deflections.size(); ++i) out.insert(out.end(), {deflections[i], torque[i] - torque[4], p});
  }
  return out;
}

TEST(Table, StiffnessFallsNowhereBelowZeroNorEnergyHoweverWildTheGrid) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> d(-0.8, 0.8), p(-1, 2);
  for (int n = 0; n < 300; ++n) {
    const auto values = wild(random);
    ASSERT_FALSE(table().fault(values)) << table().fault(values)->message;
    const auto law = table().make(values);
    for (int k = 0; k < 300; ++k) {
      const auto r = law->evaluate({d(random), {0, p(random)}});
      ASSERT_GE(r.curvature.qq, -1e-9);
      ASSERT_GE(r.energy, -1e-12);
    }
    EXPECT_NEAR(law->evaluate({0, {0, p(random)}}).torque, 0, 1e-12);
  }
}

TEST(Table, TorqueStiffnessAndLoadHaveNoJumps) {
  std::mt19937 random(12);
  const auto law = table().make(wild(random));
  const auto step = [&](const Positions& a, const Positions& b) {
    const auto x = law->evaluate(a), y = law->evaluate(b);
    const double slope = 1e-5 * (1 + std::abs(x.curvature.qq) + std::abs(x.curvature.xx[1])) * 100;
    EXPECT_NEAR(x.torque, y.torque, slope);
    EXPECT_NEAR(x.load[1], y.load[1], slope);
    EXPECT_NEAR(x.curvature.qq, y.curvature.qq, 100 * slope);
  };
  for (double x = -0.8; x < 0.8; x += 1e-3) step({x, {0, 0.5}}, {x + 1e-6, {0, 0.5}});
  for (double y = -1; y < 2; y += 1e-3) step({0.3, {0, y}}, {0.3, {0, y + 1e-6}});
  for (const double y : {-0.3, 0.0, 0.1, 0.9, 1.0, -0.3 - 0.2, 1 + 0.2 / 3}) step({0.3, {0, y - 1e-7}}, {0.3, {0, y + 1e-7}});
}

TEST(Table, MeansOverLongWaysAcrossManyCellsAreExactWithTheirSlope) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> d(-0.8, 0.8), p(-1, 2);
  for (int n = 0; n < 200; ++n) {
    const auto law = table().make(wild(random));
    const Positions a{d(random), {d(random), p(random)}}, b{d(random), {d(random), p(random)}};
    const SegmentMean m = law->mean_over(a, b);
    const double work = m.torque * (b.q - a.q) + m.load[0] * (b.x[0] - a.x[0]) + m.load[1] * (b.x[1] - a.x[1]);
    EXPECT_NEAR(work, law->energy(a) - law->energy(b), 1e-13 * (1 + law->energy(a) + law->energy(b)));
    SegmentMean summed;
    double most = 0;  // the sum misses a part of each jump of a curvature
    constexpr int kParts = 20000;
    for (int i = 0; i < kParts; ++i) {
      const double s = (i + 0.5) / kParts;
      const auto r = law->evaluate({a.q + s * (b.q - a.q), {a.x[0] + s * (b.x[0] - a.x[0]), a.x[1] + s * (b.x[1] - a.x[1])}});
      summed.torque += r.torque / kParts;
      summed.load[1] += r.load[1] / kParts;
      summed.slope.qq += s * r.curvature.qq / kParts;
      summed.slope.xx[1] += s * r.curvature.xx[1] / kParts;
      most = std::max(most, std::abs(r.curvature.xx[1]));
    }
    EXPECT_NEAR(m.torque, summed.torque, 1e-5 * (1 + std::abs(m.torque)));
    EXPECT_NEAR(m.load[1], summed.load[1], 1e-4 * (1 + std::abs(m.load[1])));
    EXPECT_NEAR(m.slope.qq, summed.slope.qq, 1e-3 * (1 + m.slope.qq));
    EXPECT_NEAR(m.slope.xx[1], summed.slope.xx[1], 1e-5 + 10 * most / kParts);
  }
}

TEST(Table, BeyondTheGridTorquesFollowTheirTangentAndPresetsStay) {
  const auto law = table().make(grid(kDeflections, kPresets, sinh_pair));
  const auto at = [&](double d, double p) { return law->evaluate({d, {0, p}}); };
  EXPECT_NEAR(at(0.8, 0.5).torque, at(0.6, 0.5).torque - 0.2 * at(0.6, 0.5).curvature.qq, 1e-10);
  EXPECT_NEAR(at(-2, 0.5).curvature.qq, at(-0.6, 0.5).curvature.qq, 1e-10);
  EXPECT_EQ(at(0.3, 5).torque, at(0.3, 0.8 + 0.201).torque);
  EXPECT_EQ(at(0.3, 5).load[1], 0);
  EXPECT_EQ(at(0.3, -5).load[1], 0);
}

TEST(Table, OfOneSideIsTheMirrorImageOnTheOther) {
  const auto half = table().make(grid({0, 0.1, 0.25, 0.4, 0.6}, kPresets, sinh_pair));
  const auto whole = table().make(grid(kDeflections, kPresets, sinh_pair));
  for (const double d : {-0.7, -0.3, 0.05, 0.5})
    EXPECT_NEAR(half->evaluate({d, {0, 0.3}}).torque, whole->evaluate({d, {0, 0.3}}).torque, 1e-12);
  const auto values = grid({0, 0.1, 0.25, 0.4, 0.6}, kPresets, sinh_pair);
  EXPECT_NE(table().remark(values).find("mirror image"), std::string::npos);
}

TEST(Table, OfOnePresetIsASeriesElasticActuatorWithoutPreset) {
  const auto law = table().make(grid(kDeflections, {0}, [](double d, double) { return 10 * d + 50 * d * d * d; }));
  EXPECT_EQ(law->motor_count(), 1);
  EXPECT_EQ(law->preset_unit(), "");
  EXPECT_EQ(law->spring_count(), 1);
  const auto w = law->signed_energies({-0.2, {0.1, 0}});
  EXPECT_NEAR(w[0], -law->energy({-0.2, {0.1, 0}}), 1e-15);
  EXPECT_EQ(law->references({0.3, 0.7})[1], 0);
  EXPECT_EQ(law->evaluate({0.2, {0, 7}}).torque, law->evaluate({0.2, {0, 0}}).torque);
}

TEST(Table, TellsItsSizeAndItsLargestDistanceFromAPoint) {
  EXPECT_EQ(table().remark(grid(kDeflections, kPresets, sinh_pair)),
            "9 deflections from -0.6 to 0.6 rad, 4 presets; the law's largest distance from a point: 0 N·m");
  const auto aside = grid(kDeflections, {0, 0.5}, [](double d, double p) { return 20 * d + (p > 0 ? 0.04 : 0.01); });
  const std::string told = table().remark(aside);
  EXPECT_NE(told.find("from a point: 0.04 N·m"), std::string::npos) << told;
  EXPECT_NE(told.find("preset 0.5 rad: what the torque is at rest is taken off"), std::string::npos) << told;
  EXPECT_NEAR(table().make(aside)->evaluate({0.25, {0, 0.5}}).torque, -5, 1e-12);
}

void expect_refused(const std::vector<double>& values, const std::string& message, const std::string& allowed,
                    std::optional<std::size_t> row) {
  const std::optional<LawFault> fault = table().fault(values);
  ASSERT_TRUE(fault) << message;
  EXPECT_EQ(fault->key, "grid");
  EXPECT_NE(fault->message.find(message), std::string::npos) << fault->message;
  EXPECT_NE(fault->allowed.find(allowed), std::string::npos) << fault->allowed;
  EXPECT_EQ(fault->row, row) << message;
}

TEST(Table, RefusesWhatIsNoSpringOrNoGridAndTellsTheRow) {
  const auto good = grid({-0.2, -0.1, 0, 0.1, 0.2}, {0, 1}, [](double d, double p) { return (5 + 5 * p) * d; });
  ASSERT_FALSE(table().fault(good));
  const auto with = [&](std::size_t row, double d, double torque, double p) {
    auto out = good;
    out[1 + 3 * row] = d, out[2 + 3 * row] = torque, out[3 + 3 * row] = p;
    return out;
  };
  expect_refused({1}, "no points", "at least 3", std::nullopt);
  expect_refused(with(4, 0.1, 0.5, 0), "given twice", "once", 4);
  expect_refused(with(4, 0.1, 0.6, 0), "two torques at deflection 0.1 rad, preset 0 rad: 0.5 and 0.6 N·m",
                 "no loop; of its branches give the mean", 4);
  expect_refused(with(4, 0.3, 1.5, 0), "at preset 0 rad there is no point at deflection 0.2 rad", "a whole grid", 9);
  expect_refused(with(3, 0.1, -0.1, 0), "the torque falls from 0 to -0.1 N·m at deflection 0.1 rad, preset 0 rad", "don't fall", 3);
  expect_refused(grid({0, 0.1}, {0, 1}, sinh_pair), "2 deflections", "at least 3", std::nullopt);
  expect_refused(grid({0.1, 0.2, 0.3}, {0}, sinh_pair), "from 0.1 to 0.3 rad", "from 0 or below to above 0", std::nullopt);
  expect_refused(grid({-0.1, -0.05, 0}, {0}, sinh_pair), "from -0.1 to 0 rad", "to above 0", std::nullopt);
  expect_refused(grid({-0.1, 0, 0.1}, {0, 1}, [](double d, double p) { return p * d; }), "no torque at preset 0 rad", "a spring",
                 0);
  expect_refused(grid({-0.1, 0, 0.1}, {0}, [](double d, double) { return 5 * d + 0.1; }), "the torque at deflection 0 is 0.1 N·m",
                 "up to 5 %", 0);
}

TEST(Table, IsEqualToOneOfTheSameRowsInAnyOrder) {
  auto values = grid({-0.2, -0.1, 0, 0.1, 0.2}, {0, 1}, [](double d, double p) { return (5 + 5 * p) * d; });
  const auto one = table().make(values);
  for (std::size_t k = 0; k < 3; ++k) std::swap(values[4 + k], values[25 + k]);
  const auto other = table().make(values);
  EXPECT_TRUE(one->equals(*other));
  values[0] = 1.5;
  EXPECT_FALSE(one->equals(*table().make(values)));
}

}  // namespace
