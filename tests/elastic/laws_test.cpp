// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace {

using vsa::elastic::Positions;
using vsa::elastic::SegmentMean;
using vsa::elastic::SeriesSpring;
using vsa::elastic::Transmission;
using vsa::elastic::TwoSinh;

const TwoSinh& maker_pro() {
  static const TwoSinh law({{0.022, 0.022}, {6.85, 6.85}});
  return law;
}

struct Law {
  const char* name;
  std::shared_ptr<const Transmission> law;
};

std::vector<Law> laws() {
  return {{"two equal sinh", std::make_shared<TwoSinh>(vsa::elastic::TwoSinhParams{{0.022, 0.022}, {6.85, 6.85}})},
          {"two unequal sinh", std::make_shared<TwoSinh>(vsa::elastic::TwoSinhParams{{0.0227, 0.0216}, {6.7328, 6.9602}})},
          {"two sinh with linear parts",
           std::make_shared<TwoSinh>(vsa::elastic::TwoSinhParams{{8e-4, 9e-4}, {12.3, 12.1}, {0.27, 0.25}})},
          {"… and tangents beyond",
           std::make_shared<TwoSinh>(vsa::elastic::TwoSinhParams{{8e-4, 9e-4}, {12.3, 12.1}, {0.27, 0.25}, 0.6})},
          {"series spring", std::make_shared<SeriesSpring>(10.0)}};
}

Positions random_place(std::mt19937& rng) {
  std::uniform_real_distribution<double> d(-0.8, 0.8);
  return {d(rng), {d(rng), d(rng)}};
}

double* coordinate(Positions& p, int i) { return i == 0 ? &p.q : &p.x[static_cast<std::size_t>(i - 1)]; }

double gradient(const vsa::elastic::Response& r, int i) { return i == 0 ? -r.torque : -r.load[static_cast<std::size_t>(i - 1)]; }

double hessian(const vsa::elastic::Hessian& h, int i, int j) {
  const double m[3][3] = {{h.qq, h.qx[0], h.qx[1]}, {h.qx[0], h.x0x0, h.x0x1}, {h.qx[1], h.x0x1, h.x1x1}};
  return m[i][j];
}

TEST(ElasticLaws, TorqueAndLoadsAreTheNegativeGradientOfTheEnergy) {
  std::mt19937 rng(1);
  for (const Law& l : laws()) {
    for (int n = 0; n < 200; ++n) {
      const Positions at = random_place(rng);
      const auto r = l.law->evaluate(at);
      for (int i = 0; i < 3; ++i) {
        Positions up = at, down = at;
        const double h = 1e-5;
        *coordinate(up, i) += h;
        *coordinate(down, i) -= h;
        const double slope = (l.law->energy(up) - l.law->energy(down)) / (2 * h);
        EXPECT_NEAR(gradient(r, i), slope, 1e-7 * (1 + std::abs(slope))) << l.name << " coordinate " << i;
        for (int j = 0; j < 3; ++j) {
          const double bend = (gradient(l.law->evaluate(up), j) - gradient(l.law->evaluate(down), j)) / (2 * h);
          EXPECT_NEAR(hessian(r.curvature, i, j), bend, 1e-6 * (1 + std::abs(bend))) << l.name << " " << i << j;
        }
      }
    }
  }
}

TEST(ElasticLaws, TheSegmentMeanDoesExactlyTheWorkOfTheEnergyDifference) {
  std::mt19937 rng(2);
  for (const Law& l : laws()) {
    for (int n = 0; n < 500; ++n) {
      const Positions a = random_place(rng);
      Positions b = random_place(rng);
      if (n % 2 == 0) b = {a.q + 1e-4 * b.q, {a.x[0] + 1e-4 * b.x[0], a.x[1] + 1e-4 * b.x[1]}};
      const SegmentMean m = l.law->mean_over(a, b);
      const double work = m.torque * (b.q - a.q) + m.load[0] * (b.x[0] - a.x[0]) + m.load[1] * (b.x[1] - a.x[1]);
      const double energies = l.law->energy(a) + l.law->energy(b);
      EXPECT_NEAR(work, l.law->energy(a) - l.law->energy(b), 1e-13 * (energies + 1)) << l.name;
    }
  }
}

TEST(ElasticLaws, TheSegmentMeansSlopeIsItsDerivativeAtTheEnd) {
  std::mt19937 rng(3);
  for (const Law& l : laws()) {
    for (int n = 0; n < 100; ++n) {
      const Positions a = random_place(rng), b = random_place(rng);
      const SegmentMean m = l.law->mean_over(a, b);
      for (int i = 0; i < 3; ++i) {
        Positions up = b, down = b;
        *coordinate(up, i) += 1e-5;
        *coordinate(down, i) -= 1e-5;
        const SegmentMean mu = l.law->mean_over(a, up), md = l.law->mean_over(a, down);
        const double dq = -(mu.torque - md.torque) / 2e-5;
        const double d0 = -(mu.load[0] - md.load[0]) / 2e-5;
        EXPECT_NEAR(hessian(m.slope, i, 0), dq, 1e-6 * (1 + std::abs(dq))) << l.name;
        EXPECT_NEAR(hessian(m.slope, i, 1), d0, 1e-6 * (1 + std::abs(d0))) << l.name;
      }
    }
  }
}

TEST(ElasticLaws, SignedEnergiesSumToTheEnergyAndTheirSlopesAreTheTensions) {
  std::mt19937 rng(4);
  for (const Law& l : laws()) {
    for (int n = 0; n < 200; ++n) {
      const Positions at = random_place(rng);
      const auto w = l.law->signed_energies(at);
      const auto r = l.law->evaluate(at);
      EXPECT_NEAR(std::abs(w[0]) + std::abs(w[1]), r.energy, 1e-13 * (1 + r.energy)) << l.name;
      const double h = 1e-5;
      const auto up = l.law->signed_energies({at.q + h, at.x}), down = l.law->signed_energies({at.q - h, at.x});
      for (std::size_t i = 0; i < static_cast<std::size_t>(l.law->spring_count()); ++i) {
        const double slope = (up[i] - down[i]) / (2 * h);
        EXPECT_NEAR(slope, std::abs(r.load[i]), 1e-6 * (1 + slope)) << l.name << " spring " << i;
      }
    }
  }
}

TEST(ElasticLaws, MeansFromAnOriginAreThoseOfItsPositions) {
  std::mt19937 rng(5);
  for (const Law& l : laws()) {
    for (int n = 0; n < 500; ++n) {
      const Positions a = random_place(rng);
      Positions b = random_place(rng);
      if (n % 2 == 0) b = {a.q + 1e-2 * b.q, {a.x[0] + 1e-2 * b.x[0], a.x[1] + 1e-2 * b.x[1]}};
      const SegmentMean asked = l.law->mean_over(a, b), m = l.law->mean_from(l.law->origin(a), b, 0);
      const double scale = 1e-13 * (1 + std::abs(asked.load[0]) + std::abs(asked.load[1]));
      EXPECT_NEAR(m.torque, asked.torque, scale) << l.name;
      for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(m.load[i], asked.load[i], scale) << l.name;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(hessian(m.slope, i, j), hessian(asked.slope, i, j), 20 * scale) << l.name;
      }
    }
  }
}

TEST(ElasticLaws, AnOriginMovedALongWayInSmallAndLargeStepsStillHasTheEnergiesOfWhereItIs) {
  std::mt19937 rng(6);
  std::uniform_real_distribution<double> d(-1, 1);
  for (const Law& l : laws()) {
    Positions at = random_place(rng);
    vsa::elastic::Origin here = l.law->origin(at);
    for (int n = 0; n < 20000; ++n) {
      const double reach = n % 100 == 0 ? 0.3 : 0.01;
      const auto step = [&](double p) { return std::abs(p) < 0.8 ? p + reach * d(rng) : 0.7 * p; };
      at = {step(at.q), {step(at.x[0]), step(at.x[1])}};
      here = l.law->moved(here, at);
      const double energy = l.law->energy(at);
      const auto w = l.law->signed_energies(at), found = l.law->signed_energies_of(here);
      ASSERT_NEAR(l.law->energy_of(here), energy, 1e-13 * (1 + energy)) << l.name << " after " << n;
      for (std::size_t i = 0; i < 2; ++i) ASSERT_NEAR(found[i], w[i], 1e-13 * (1 + energy)) << l.name << " after " << n;
    }
  }
}

TEST(ElasticLaws, DefaultQuadratureAgreesWithTheClosedFormOnAShortSegment) {
  const Positions a{0.3, {0.5, -0.4}}, b{0.31, {0.49, -0.405}};
  const SegmentMean closed = maker_pro().mean_over(a, b);
  const SegmentMean gauss = maker_pro().Transmission::mean_over(a, b);
  EXPECT_NEAR(gauss.torque, closed.torque, 1e-12);
  EXPECT_NEAR(gauss.load[0], closed.load[0], 1e-12);
  EXPECT_NEAR(gauss.slope.qq, closed.slope.qq, 1e-9);
}

TEST(TwoSinh, StiffnessAtRestHasThePublishedValuesOverThePreset) {
  // 2 a k cosh(a p) with Table I; the list is in the model notes, to two digits.
  const double preset[] = {0, 0.2, 0.46, 0.575, 0.69, 0.785};
  const double sigma[] = {0.30, 0.63, 3.5, 7.8, 17, 33};
  for (int i = 0; i < 6; ++i) {
    const double p = preset[i];
    EXPECT_NEAR(maker_pro().evaluate({0, {p, -p}}).curvature.qq, sigma[i], 0.03 * sigma[i]) << p;
  }
}

TEST(TwoSinh, EquilibriumOfTheSymmetricPairDoesNotDependOnThePreset) {
  for (double p = -0.785; p <= 0.785; p += 0.157) EXPECT_NEAR(maker_pro().evaluate({0.4, {0.4 + p, 0.4 - p}}).torque, 0.0, 1e-14);
}

TEST(TwoSinh, StaticDeflectionFollowsTheClosedForm) {
  // τ = −2k cosh(a p) sinh(a δ)
  for (double p : {0.0, 0.3, 0.69}) {
    for (double d : {-0.4, -0.01, 0.2}) {
      EXPECT_NEAR(maker_pro().evaluate({d, {p, -p}}).torque, -2 * 0.022 * std::cosh(6.85 * p) * std::sinh(6.85 * d), 1e-12);
    }
  }
}

TEST(TwoSinh, NothingIsLostNearZero) {
  const double tiny = 1e-12;
  const auto r = maker_pro().evaluate({tiny, {0, 0}});
  EXPECT_NEAR(r.torque / (-2 * 0.022 * 6.85 * tiny), 1.0, 1e-12);
  EXPECT_NEAR(r.energy / (0.022 * 6.85 * tiny * tiny), 1.0, 1e-12);
}

TEST(TwoSinh, ReferencesAndAttainedAreInverse) {
  const auto x = maker_pro().references({0.3, 0.5});
  EXPECT_DOUBLE_EQ(x[0], 0.8);
  EXPECT_DOUBLE_EQ(x[1], -0.2);
  EXPECT_DOUBLE_EQ(maker_pro().attained(x).equilibrium, 0.3);
  EXPECT_DOUBLE_EQ(maker_pro().attained(x).preset, 0.5);
}

}  // namespace
