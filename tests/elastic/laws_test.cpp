// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "all_laws.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace {

using vsa::elastic::Positions;
using vsa::elastic::SegmentMean;
using vsa::elastic::Transmission;
using vsa::elastic::TwoSinh;
using vsa::test::random_place;
using vsa::test::SomeLaw;

const TwoSinh& maker_pro() {
  static const TwoSinh law({{0.022, 0.022}, {6.85, 6.85}});
  return law;
}

std::vector<SomeLaw> laws() { return vsa::test::all_laws(6); }

double* coordinate(Positions& p, int i) { return i == 0 ? &p.q : &p.x[static_cast<std::size_t>(i - 1)]; }

double gradient(const vsa::elastic::Response& r, int i) { return i == 0 ? -r.torque : -r.load[static_cast<std::size_t>(i - 1)]; }

double hessian(const vsa::elastic::Hessian& h, int i, int j) {
  const double m[3][3] = {{h.qq, h.qx[0], h.qx[1]}, {h.qx[0], h.xx[0], h.x0x1}, {h.qx[1], h.x0x1, h.xx[1]}};
  return m[i][j];
}

TEST(ElasticLaws, TorqueAndLoadsAreTheNegativeGradientOfTheEnergy) {
  std::mt19937 rng(1);
  for (const SomeLaw& l : laws()) {
    for (int n = 0; n < 200; ++n) {
      const Positions at = random_place(l, rng);
      const auto r = l.law->evaluate(at);
      const double scale = 1 + std::abs(r.curvature.qq) + std::abs(r.curvature.xx[1]);
      for (int i = 0; i < 3; ++i) {
        Positions up = at, down = at;
        const double h = 1e-5;
        *coordinate(up, i) += h;
        *coordinate(down, i) -= h;
        const double slope = (l.law->energy(up) - l.law->energy(down)) / (2 * h);
        EXPECT_NEAR(gradient(r, i), slope, 1e-7 * scale) << l.name << " coordinate " << i;
        for (int j = 0; j < 3; ++j) {
          const double above = gradient(l.law->evaluate(up), j) - gradient(r, j),
                       below = gradient(r, j) - gradient(l.law->evaluate(down), j);
          const double knot = l.name.rfind("table", 0) == 0 ? std::abs(above - below) / h : 0;  // its curvature has bends
          EXPECT_NEAR(hessian(r.curvature, i, j), (above + below) / (2 * h), 1e-6 * scale + knot) << l.name << " " << i << j;
        }
      }
    }
  }
}

TEST(ElasticLaws, TheSegmentMeanDoesExactlyTheWorkOfTheEnergyDifference) {
  std::mt19937 rng(2);
  for (const SomeLaw& l : laws()) {
    for (int n = 0; n < 500; ++n) {
      const Positions a = random_place(l, rng);
      Positions b = random_place(l, rng);
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
  for (const SomeLaw& l : laws()) {
    const bool closed = l.name.rfind("two_", 0) == 0 || l.name.rfind("series", 0) == 0;  // others: as far as a step goes
    for (int n = 0; n < 100; ++n) {
      const Positions a = random_place(l, rng);
      Positions b = random_place(l, rng);
      if (!closed || n % 2 == 0) b = {a.q + 1e-2 * b.q, {a.x[0] + 1e-2 * b.x[0], a.x[1] + 1e-2 * b.x[1]}};
      const SegmentMean m = l.law->mean_over(a, b);
      for (int i = 0; i < 3; ++i) {
        Positions up = b, down = b;
        *coordinate(up, i) += 1e-5;
        *coordinate(down, i) -= 1e-5;
        const SegmentMean mu = l.law->mean_over(a, up), md = l.law->mean_over(a, down);
        const double dq = -(mu.torque - md.torque) / 2e-5;
        const double d0 = -(mu.load[0] - md.load[0]) / 2e-5;
        const double d1 = -(mu.load[1] - md.load[1]) / 2e-5;
        const double tolerance = (closed ? 1e-6 : 1e-5) * (1 + std::abs(m.slope.qq) + std::abs(m.slope.xx[1]));
        EXPECT_NEAR(hessian(m.slope, i, 0), dq, tolerance) << l.name;
        EXPECT_NEAR(hessian(m.slope, i, 1), d0, tolerance) << l.name;
        EXPECT_NEAR(hessian(m.slope, i, 2), d1, tolerance) << l.name;
      }
    }
  }
}

TEST(ElasticLaws, SignedEnergiesSumToTheEnergyAndTheirSlopesAreTheTensions) {
  std::mt19937 rng(4);
  for (const SomeLaw& l : laws()) {
    for (int n = 0; n < 200 && l.law->spring_count() > 0; ++n) {
      const Positions at = random_place(l, rng);
      const auto w = l.law->signed_energies(at);
      const auto r = l.law->evaluate(at);
      EXPECT_NEAR(std::abs(w[0]) + std::abs(w[1]), r.energy, 1e-13 * (1 + r.energy)) << l.name;
      const double h = 1e-5;
      const auto up = l.law->signed_energies({at.q + h, at.x}), down = l.law->signed_energies({at.q - h, at.x});
      for (std::size_t i = 0; i < static_cast<std::size_t>(l.law->spring_count()); ++i) {
        const double slope = (up[i] - down[i]) / (2 * h);
        // Across a slack spring the difference sees both signs.
        const double kink = std::abs(r.load[i]) < h * r.curvature.qq ? h * r.curvature.qq : 0;
        EXPECT_NEAR(slope, std::abs(r.load[i]), 1e-6 * (1 + slope) + kink) << l.name << " spring " << i;
      }
    }
  }
}

TEST(ElasticLaws, MeansFromAnOriginAreThoseOfItsPositions) {
  std::mt19937 rng(5);
  for (const SomeLaw& l : laws()) {
    for (int n = 0; n < 500; ++n) {
      const Positions a = random_place(l, rng);
      Positions b = random_place(l, rng);
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
  for (const SomeLaw& l : laws()) {
    Positions at = random_place(l, rng);
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

TEST(ElasticLaws, AreFiniteAndStoreNothingNegativeFarOutsideOfTheirReachToo) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> far(-10, 10);
  for (const SomeLaw& l : laws()) {
    for (int n = 0; n < 500; ++n) {
      const Positions a{far(rng), {far(rng), far(rng)}}, b{far(rng), {far(rng), far(rng)}};
      const auto r = l.law->evaluate(a);
      EXPECT_GE(r.energy, -1e-12 * std::abs(r.torque)) << l.name;
      const SegmentMean m = l.law->mean_over(a, b);
      for (const double v : {r.energy, r.torque, r.load[0], r.load[1], r.curvature.qq, r.curvature.x0x1, r.curvature.xx[1],
                             m.torque, m.load[0], m.load[1], m.slope.qq, m.slope.xx[0], m.slope.xx[1]})
        EXPECT_TRUE(std::isfinite(v)) << l.name;
    }
  }
}

TEST(ElasticLaws, CommandsAndWhatTheInputsAmountToAreInverse) {
  std::mt19937 rng(8);
  std::uniform_real_distribution<double> part(-1, 1);
  for (const SomeLaw& l : laws()) {
    for (int n = 0; n < 20; ++n) {
      const double equilibrium = part(rng), preset = l.preset * std::abs(part(rng));
      const auto there = l.law->attained(l.law->references({equilibrium, preset}));
      EXPECT_NEAR(there.equilibrium, equilibrium, 1e-15) << l.name;
      EXPECT_NEAR(there.preset, preset, 1e-15) << l.name;
    }
  }
}

TEST(ElasticLaws, TheShaftRestsWhereTheCommandSaysAndTheTorqueIsOddAboutThat) {
  for (const SomeLaw& l : vsa::test::all_laws(0)) {
    if (l.name == "two_sinh_linear") continue;  // its springs differ
    for (const double preset : {0.3 * l.preset, l.preset}) {
      const auto x = l.law->references({0.2, preset});
      EXPECT_NEAR(l.law->evaluate({0.2, x}).torque, 0, 1e-12) << l.name;
      for (double d = 0.1; d < 1; d += 0.2) {
        const double there = l.law->evaluate({0.2 + d * l.deflection_rad, x}).torque;
        const double back = l.law->evaluate({0.2 - d * l.deflection_rad, x}).torque;
        EXPECT_NEAR(there, -back, 1e-12 * (1 + std::abs(there))) << l.name;
        EXPECT_LT(there, 0) << l.name;
      }
    }
  }
}

TEST(ElasticLaws, StiffnessAtRestRisesWithThePreset) {
  for (const SomeLaw& l : laws()) {
    double before = 0;
    for (double part = 0.1; part <= 1 && l.preset > 0; part += 0.1) {
      const auto x = l.law->references({0.2, part * l.preset});
      const double stiffness = l.law->evaluate({l.law->attained(x).equilibrium, x}).curvature.qq;
      EXPECT_GE(stiffness, before) << l.name << " at " << part;
      // Beyond its edge, or with its clutch engaged.
      const bool straight = (l.name.rfind("two_sinh_linear", 0) == 0 || l.name.rfind("bi_stiffness ", 0) == 0) && part > 0.5;
      EXPECT_TRUE(stiffness > before || straight) << l.name << " at " << part;
      before = stiffness;
    }
  }
}

TEST(ElasticLaws, AreEqualToThemselvesAndToNoOther) {
  const auto all = laws(), again = laws();
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < all.size(); ++k)
      EXPECT_EQ(all[i].law->equals(*again[k].law), i == k) << all[i].name << again[k].name;
}

TEST(ElasticLaws, HaveNamesParametersAndSourcesOfTheirOwn) {
  std::set<std::string_view> names;
  std::string_view before;
  for (const vsa::elastic::Law* law : vsa::elastic::laws()) {
    EXPECT_LT(before, law->name) << "the list is by name: call it k" << law->name << " in its file";
    before = law->name;
    EXPECT_TRUE(names.insert(law->name).second) << law->name;
    EXPECT_FALSE(law->title.empty() || law->equation.empty() || law->source.empty()) << law->name;
    std::set<std::string_view> keys;
    for (const auto& p : law->parameters) {
      EXPECT_TRUE(keys.insert(p.key).second) << law->name << ' ' << p.key;
      EXPECT_LT(p.min, p.max) << law->name << ' ' << p.key;
      EXPECT_FALSE(p.meaning.empty() || p.unit.empty()) << law->name << ' ' << p.key;
    }
  }
}

TEST(ElasticLaws, HaveTheStiffnessAtRestOfTheirEquations) {
  for (const SomeLaw& l : vsa::test::all_laws(0)) {
    const vsa::test::Typical& row = vsa::test::typical().at(l.name);
    const auto x = l.law->references({0.4, row.rest_preset});
    EXPECT_NEAR(l.law->evaluate({0.4, x}).curvature.qq, row.stiffness, 1e-12 * std::max(10.0, row.stiffness)) << l.name;
  }
}

TEST(ElasticLaws, OfLeversAskNothingOfTheMoverAtRest) {
  for (const SomeLaw& l : laws()) {
    if (l.name.rfind("lever", 0) != 0) continue;
    for (double part = 0; part <= 1.2; part += 0.1) {
      const auto r = l.law->evaluate({0.4, l.law->references({0.4, part * l.preset})});
      EXPECT_EQ(r.load[1], 0) << l.name;
      EXPECT_EQ(r.energy, 0) << l.name;
      EXPECT_NE(l.law->evaluate({0.5, l.law->references({0.4, (part + 0.1) * l.preset})}).load[1], 0) << l.name;
    }
  }
}

TEST(ElasticLaws, AnUnlikePairOfPullingExponentialsRestsAsideByHalfTheLogarithm) {
  for (const vsa::elastic::Law* law : vsa::elastic::laws()) {
    if (law->name != "two_exp") continue;
    const double k1 = 0.5, k2 = 0.2, a = 8;
    const auto pair = law->make(std::array{k1, k2, a, 0.0});
    for (const double preset : {0.05, 0.2, 0.4}) {
      const double rest = 0.3 + 0.5 * std::log(k1 / k2) / a;
      const auto r = pair->evaluate({rest, pair->references({0.3, preset})});
      EXPECT_NEAR(r.torque, 0, 1e-12 * r.load[1]);
      EXPECT_NEAR(r.curvature.qq, 2 * a * std::sqrt(k1 * k2) * std::exp(a * preset), 1e-10);
    }
    const auto full = law->make(std::array{0.022, 0.022, 6.85, 1.0});
    const TwoSinh twice({{0.044, 0.044}, {6.85, 6.85}});
    const Positions at{0.3, {0.5, -0.1}};
    EXPECT_NEAR(full->evaluate(at).torque, twice.evaluate(at).torque, 1e-14);
    EXPECT_NEAR(full->energy(at), twice.energy(at), 1e-14);
  }
}

TEST(ElasticLaws, GoOnSmoothlyBeyondAPivotsStop) {
  for (const SomeLaw& l : vsa::test::all_laws(0)) {
    if (l.name != "lever_pivot" && l.name != "lever_cardan") continue;
    const auto at = [&](double mover) { return l.law->evaluate({0.2, {0, mover}}); };
    const double stop = l.name == "lever_pivot" ? 2.0 : 3.2, step = 1e-6;
    EXPECT_NEAR(at(stop + step).energy, at(stop - step).energy, 1e-3);
    EXPECT_NEAR(at(stop + step).load[1], at(stop - step).load[1], 1e-3);
    EXPECT_NEAR(at(stop + step).curvature.xx[1], at(stop - step).curvature.xx[1], 1e-3);
    EXPECT_LT(at(100).energy, 1e6) << "no pole at L";
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
