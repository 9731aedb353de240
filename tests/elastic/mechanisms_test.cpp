// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What single laws are there for: a profile that stiffens, a pivot on a straight line, a spring that is engaged.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "vsa/elastic/law.hpp"

namespace {

using vsa::elastic::Transmission;

std::shared_ptr<const Transmission> made(std::string_view name, std::vector<double> values) {
  for (const vsa::elastic::Law* law : vsa::elastic::laws())
    if (law->name == name) return law->make(values);
  ADD_FAILURE() << name;
  return nullptr;
}

TEST(Mechanisms, AProfileStiffensTheMaccepaThatSoftensWithoutIt) {
  const auto plain = made("maccepa", {323, 0.03, 0.18, 0.010}), over = made("maccepa_2", {323, 0.03, 0.18, 0.010, 0.05});
  const auto stiffness = [](const auto& law, double d) { return law->evaluate({d, law->references({0, 8})}).curvature.qq; };
  for (double d = 0.1; d < 1; d += 0.1) {
    EXPECT_LT(stiffness(plain, d), stiffness(plain, d - 0.1)) << d;
    EXPECT_GT(stiffness(over, d), 1.05 * stiffness(over, d - 0.1)) << d;
  }
}

TEST(Mechanisms, AProfileOfNoRadiusIsAPlainMaccepa) {
  const auto plain = made("maccepa", {323, 0.03, 0.18, 0.010}), none = made("maccepa_2", {323, 0.03, 0.18, 0.010, 0});
  for (double d = -1.55; d < 1.56; d += 0.1) {
    for (const double mover : {-1.0, 0.0, 2.0}) {
      const auto a = plain->evaluate({d, {0, mover}}), b = none->evaluate({d, {0, mover}});
      EXPECT_NEAR(a.energy, b.energy, 1e-14);
      EXPECT_NEAR(a.torque, b.torque, 1e-14);
      EXPECT_NEAR(a.curvature.qq, b.curvature.qq, 1e-13);
    }
  }
}

TEST(Mechanisms, MaccepaTwoHasThePublicProgramsTorque) {
  // l1va/maccepa_manipulator's torque with k = 4800 N/m, B = 22 mm, C = 42 mm, R = 14.5 mm, 4.5 mm of winch, motor 2 at 2.5 rad.
  const auto law = made("maccepa_2", {4800, 0.022, 0.042, 0.0045, 0.0145});
  const double deflection[] = {0.1, 0.3, 0.5, 0.7}, torque[] = {0.294236, 1.360863, 3.362333, 5.347476};
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(law->evaluate({deflection[i], {0, 2.5}}).torque, -torque[i], 1e-5);
    EXPECT_NEAR(law->evaluate({0, {deflection[i], 2.5}}).torque, torque[i], 1e-5);
  }
}

TEST(Mechanisms, CardanGearsMoveThePivotOfALeverAlongAStraightLine) {
  const double start = 0.6, gear = 0.5, mover = 1.7, place = 1 - std::cos(start + gear * mover);  // of two half lengths
  const auto gears = made("lever_cardan", {8000, 0.03, start, gear, 2.2}),
             pivot = made("lever_pivot", {7.2, 2, 2, place, 1e-6, 1.9});
  for (const double d : {-0.5, 0.1, 0.4}) {
    EXPECT_NEAR(gears->evaluate({d, {0, mover}}).energy, pivot->evaluate({d, {0, 0}}).energy, 1e-12);
    EXPECT_NEAR(gears->evaluate({d, {0, mover}}).torque, pivot->evaluate({d, {0, 0}}).torque, 1e-12);
  }
}

TEST(Mechanisms, WhoeverEngagesADeflectedSpringBendsItAndGetsThatBack) {
  const auto law = made("bi_stiffness", {5, 15, 2.5});
  const auto engage = law->mean_over({0.4, {0, -1}}, {0.4, {0, 3}}), back = law->mean_over({0.4, {0, 3}}, {0.4, {0, -1}});
  EXPECT_NEAR(-4 * engage.load[1], 0.5 * 15 * 0.4 * 0.4, 1e-12);
  EXPECT_NEAR(back.load[1], engage.load[1], 1e-12);
  EXPECT_NEAR(law->evaluate({0.4, {0, -1}}).torque, -5 * 0.4, 1e-12) << "open";
  EXPECT_NEAR(law->evaluate({0.4, {0, 3}}).torque, -20 * 0.4, 1e-12) << "engaged";
  EXPECT_EQ(made("bi_stiffness", {0, 15, 2.5})->evaluate({0.4, {0, 0}}).torque, 0) << "let go";
}

}  // namespace
