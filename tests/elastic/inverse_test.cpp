// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/inverse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "all_laws.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace {

using vsa::elastic::Command;
using vsa::elastic::command_for;
using vsa::elastic::equilibrium_for;
using vsa::elastic::Response;
using vsa::elastic::rest_under;
using vsa::elastic::SeriesSpring;
using vsa::elastic::Transmission;
using vsa::elastic::TwoSinh;
using vsa::elastic::TwoSinhParams;
using Outcome = Command::Outcome;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPresetMax = 0.785;

Response at(const Transmission& law, double q, double equilibrium, double preset) {
  return law.evaluate({q, law.references({equilibrium, preset})});
}

/// A law that says nothing of how it could be solved: the generic solver's.
class Plain final : public Transmission {
 public:
  explicit Plain(const TwoSinhParams& params) : law_(params) {}
  [[nodiscard]] Response evaluate(const vsa::elastic::Positions& p) const noexcept override { return law_.evaluate(p); }
  [[nodiscard]] std::array<double, 2> references(const vsa::elastic::EquilibriumPreset& c) const noexcept override {
    return law_.references(c);
  }
  [[nodiscard]] vsa::elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return law_.attained(x);
  }

 private:
  TwoSinh law_;
};

/// What the shipped types have (their numbers are actuators/*.toml's kinds: Table I, data sheet, identified, unequal springs).
const TwoSinhParams kLaws[] = {{{0.022, 0.022}, {6.85, 6.85}},
                               {{0.022, 0.0197}, {6.85, 6.85}},
                               {{0.0216, 0.0227}, {6.7, 7.1}},
                               {{0.0216, 0.0227}, {6.7, 7.1}, {0.24, 0.31}, 0.72}};

TEST(Inverse, ACommandsTorqueAndStiffnessGiveTheCommandBack) {
  std::mt19937 chance(7);
  std::uniform_real_distribution<double> angle(-2, 2), deflection(-0.35, 0.35), preset(0.0, kPresetMax);
  for (const TwoSinhParams& params : kLaws) {
    const TwoSinh law(params);
    for (int n = 0; n < 400; ++n) {
      const double q = angle(chance), e = q - deflection(chance), p = preset(chance);
      const Response there = at(law, q, e, p);
      const auto found = equilibrium_for(law, q, there.torque, p);
      ASSERT_TRUE(found);
      ASSERT_NEAR(*found, e, 1e-9);
      const Command c = command_for(law, {q, there.torque, there.curvature.qq}, kPresetMax);
      ASSERT_TRUE(c.found()) << c.text();
      const Response again = at(law, q, c.command.equilibrium, c.command.preset);
      ASSERT_NEAR(again.torque, there.torque, 1e-8 * (1 + std::abs(there.torque)));
      ASSERT_NEAR(again.curvature.qq, there.curvature.qq, 1e-8 * there.curvature.qq);
      ASSERT_GE(c.command.preset, 0);
      ASSERT_LE(c.command.preset, p + kPresetMax / 16);
    }
  }
}

TEST(Inverse, TheClosedFormAndTheSolverAgree) {
  std::mt19937 chance(9);
  std::uniform_real_distribution<double> torque(-2, 2), stiffness(2, 40);
  for (const TwoSinhParams& params : {kLaws[0], kLaws[1]}) {
    const TwoSinh law(params);
    const Plain plain(params);
    for (int n = 0; n < 300; ++n) {
      const double t = torque(chance), s = stiffness(chance);
      const Command exact = command_for(law, {0.3, t, s}, kPresetMax), solved = command_for(plain, {0.3, t, s}, kPresetMax);
      ASSERT_EQ(exact.outcome, solved.outcome) << t << " " << s << ": " << exact.text() << "; " << solved.text();
      if (!exact.found()) continue;
      ASSERT_TRUE(law.command_exactly(0.3, t, s));
      ASSERT_NEAR(exact.command.preset, solved.command.preset, 1e-6);
      ASSERT_NEAR(exact.command.equilibrium, solved.command.equilibrium, 1e-6);
    }
  }
}

TEST(Inverse, OfASymmetricPairIsThePapersFormula) {
  const TwoSinh law(kLaws[0]);
  const double k = 0.022, a = 6.85, p = 0.5;
  const Command c = command_for(law, {0.0, 0.0, 2 * a * k * std::cosh(a * p)}, kPresetMax);
  ASSERT_TRUE(c.found());
  EXPECT_NEAR(c.command.preset, p, 1e-12);
  EXPECT_NEAR(c.command.equilibrium, 0, 1e-12);
  EXPECT_NEAR(*equilibrium_for(law, 0.2, 1.0, p), 0.2 + std::asinh(1.0 / (2 * k * std::cosh(a * p))) / a, 1e-12);
}

TEST(Inverse, WhatCannotBeReachedIsSaidWithTheRange) {
  const TwoSinh law(kLaws[3]);
  const Command soft = command_for(law, {0, 0.5, 0.1}, kPresetMax), stiff = command_for(law, {0, 0.5, 500}, kPresetMax);
  EXPECT_EQ(soft.outcome, Outcome::too_soft);
  EXPECT_EQ(stiff.outcome, Outcome::too_stiff);
  EXPECT_NEAR(stiff.command.preset, kPresetMax, 0.1) << "the nearest";
  EXPECT_LT(stiff.stiffness_min, stiff.stiffness_max);
  EXPECT_NEAR(at(law, 0, soft.command.equilibrium, soft.command.preset).curvature.qq, soft.stiffness_min, 1e-9);
  EXPECT_NE(stiff.text().find("stiffer"), std::string::npos);
  const SeriesSpring spring(5);
  EXPECT_EQ(command_for(spring, {0, 100, 5}, 0).outcome, Outcome::torque_unreachable);
  EXPECT_FALSE(equilibrium_for(spring, 0, 100, 0));
}

TEST(Inverse, ALawWithoutPresetsHasItsOneStiffness) {
  const SeriesSpring spring(80);
  const Command c = command_for(spring, {0.4, 8, 80}, 0);
  ASSERT_TRUE(c.found());
  EXPECT_NEAR(c.command.equilibrium, 0.5, 1e-12);
  EXPECT_EQ(command_for(spring, {0.4, 8, 81}, 0).outcome, Outcome::too_stiff);
  EXPECT_EQ(command_for(spring, {0.4, 8, 79}, 0).outcome, Outcome::too_soft);
}

/// Parameters of the shipped lever types, whose torque has a peak over the deflection, and their largest presets.
struct Lever {
  const char* law;
  std::vector<double> parameters;
  double preset_max;
};
const Lever kLevers[] = {{"lever_spring", {8000, 0.015, 0.01}, 1.5},
                         {"lever_pivot", {10, 0.05, 0.015, 0.008, 0.01, 0.025}, 1.2},
                         {"lever_cardan", {8000, 0.03, 0.8, 0.5, 2.2}, 1.8}};

std::shared_ptr<const Transmission> made(const Lever& of) {
  for (const vsa::elastic::Law* law : vsa::elastic::laws())
    if (law->name == of.law) return law->make(of.parameters);
  return nullptr;
}

TEST(Inverse, OfALeverGivesEveryCommandBackUpToItsPeak) {
  std::mt19937 chance(11);
  std::uniform_real_distribution<double> angle(-1, 1), deflection(-0.75, 0.75), part(0, 1);
  for (const Lever& lever : kLevers) {
    const auto law = made(lever);
    ASSERT_TRUE(law) << lever.law;
    for (int n = 0; n < 300; ++n) {
      const double e = angle(chance), q = e + deflection(chance), p = part(chance) * lever.preset_max;
      const Response there = at(*law, q, e, p);
      if (!(there.curvature.qq > 1e-6)) continue;
      const auto equilibrium = equilibrium_for(*law, q, there.torque, p);
      ASSERT_TRUE(equilibrium) << lever.law << " " << q - e;
      ASSERT_NEAR(*equilibrium, e, 1e-6);
      const Command c = command_for(*law, {q, there.torque, there.curvature.qq}, lever.preset_max);
      ASSERT_TRUE(c.found()) << lever.law << ": " << c.text();
      const Response again = at(*law, q, c.command.equilibrium, c.command.preset);
      ASSERT_NEAR(again.torque, there.torque, 1e-6 * (1 + std::abs(there.torque)));
      ASSERT_NEAR(again.curvature.qq, there.curvature.qq, 1e-6 * (1 + there.curvature.qq));
    }
  }
}

TEST(Inverse, ARefusalNamesNoRangeThatHoldsWhatWasWanted) {
  std::mt19937 chance(12);
  std::uniform_real_distribution<double> torque(-6, 6), stiffness(0, 60);
  int refused = 0;
  for (const Lever& lever : kLevers) {
    const auto law = made(lever);
    for (int n = 0; n < 200; ++n) {
      const double wanted = stiffness(chance);
      const Command c = command_for(*law, {0.1, torque(chance), wanted}, lever.preset_max);
      if (c.outcome != Outcome::too_soft && c.outcome != Outcome::too_stiff) continue;
      ++refused;
      ASSERT_FALSE(wanted > c.stiffness_min * (1 + 1e-6) && wanted < c.stiffness_max * (1 - 1e-6)) << lever.law << ": " << c.text();
    }
  }
  EXPECT_GT(refused, 10);
}

TEST(Inverse, NumbersThatAreNoneAreNoCommand) {
  const TwoSinh law(kLaws[0]);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(equilibrium_for(law, bad, 0, 0));
    EXPECT_FALSE(equilibrium_for(law, 0, bad, 0));
    EXPECT_FALSE(equilibrium_for(law, 0, 0, bad));
    EXPECT_EQ(command_for(law, {bad, 0, 1}, 1).outcome, Outcome::not_a_number);
    EXPECT_EQ(command_for(law, {0, bad, 1}, 1).outcome, Outcome::not_a_number);
    EXPECT_EQ(command_for(law, {0, 0, bad}, 1).outcome, Outcome::not_a_number);
    EXPECT_EQ(command_for(law, {0, 0, 1}, bad).outcome, Outcome::not_a_number);
  }
  EXPECT_EQ(command_for(law, {0, 0, -1}, 1).outcome, Outcome::not_a_number);
  EXPECT_EQ(command_for(law, {0, 0, 1}, -1).outcome, Outcome::not_a_number);
  EXPECT_FALSE(equilibrium_for(law, 0, 1e300, 0, 10));
  static_cast<void>(equilibrium_for(law, 1e300, 1, 0));
  static_cast<void>(equilibrium_for(law, 0, 1e200, 0, 1e3));
}

/// Every law, springs as they come: the torque is the load's there, and the shaft comes back to it.
TEST(Inverse, AFreeShaftRestsWhereTheTorqueIsTheLoads) {
  std::mt19937 chance(11);
  int found = 0;
  for (const vsa::test::SomeLaw& some : vsa::test::all_laws(4)) {
    for (int n = 0; n < 20; ++n) {
      const vsa::elastic::Positions place = vsa::test::random_place(some, chance);
      const double load = -some.law->evaluate(place).torque, from = some.law->attained(place.x).equilibrium;
      const auto rest = rest_under(*some.law, place.x, load);
      if (!rest) continue;  // a lever beyond its peak
      ++found;
      const Response there = some.law->evaluate({*rest, place.x});
      EXPECT_NEAR(there.torque, -load, 1e-9 * (1 + std::abs(load) + there.curvature.qq)) << some.name;
      EXPECT_GE(there.curvature.qq, -1e-9) << some.name;
      EXPECT_GE((*rest - from) * (some.law->evaluate({from, place.x}).torque + load), 0) << some.name << ": against the push";
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(Inverse, AntagonistsAreThoseWhoseReferencesAreSumAndDifference) {
  for (const vsa::test::SomeLaw& some : vsa::test::all_laws(0)) {
    const bool two = some.name.rfind("two_", 0) == 0 && some.name != "two_cams";  // there motor 2 turns the cams apart
    EXPECT_EQ(vsa::elastic::antagonistic(*some.law), two) << some.name;
  }
}

TEST(Inverse, AShaftThatNothingStopsDoesNotRest) {
  const SeriesSpring soft(0.1);
  EXPECT_FALSE(rest_under(soft, {0, 0}, 5));
  EXPECT_NEAR(*rest_under(soft, {0.5, 0}, 5, 100), 50.5, 1e-12);
  EXPECT_EQ(*rest_under(soft, {0.5, 0}), 0.5);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(rest_under(soft, {bad, 0}));
    EXPECT_FALSE(rest_under(soft, {0, 0}, bad));
    EXPECT_FALSE(rest_under(soft, {0, 0}, 5, bad));
  }
}

}  // namespace
