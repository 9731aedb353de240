// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The whole chain in the embedded engine against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chain/worlds.hpp"
#include "vsa/engine/world.hpp"

namespace {

using vsa::engine::World;
using vsa::test::flange_world;
using vsa::test::FlangeWorld;

constexpr const char* kShaft = "unit::shaft";

double stored(const World& w) {
  const auto e = w.energy();
  return e.kinetic + e.gravitational + w.ledger().stored();
}

double frequency(World& w, double duration_s) {
  std::vector<double> crossings;
  double before = w.joint_angle(kShaft);
  while (w.time_s() < duration_s) {
    w.step();
    const double now = w.joint_angle(kShaft);
    if (before < 0 && now >= 0) crossings.push_back(w.time_s() - w.step_s() * now / (now - before));
    before = now;
  }
  return static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

double stiffness_at(const World& w) { return w.read("a").stiffness_Nm_per_rad; }

TEST(SignalChain, SpringMassFrequencyOfTheUnpoweredUnitAtSeveralPresets) {
  for (const double preset : {0.1, 0.3, 0.5, 0.69}) {
    FlangeWorld f;
    f.preset_rad = preset;
    f.losses = false;
    f.step_s = 5e-4;
    f.inertia_kgm2 = 1e-3;
    World w = World::load_string(flange_world(f));
    const double sigma = stiffness_at(w);
    w.set_joint(kShaft, 0.003, 0.0);
    EXPECT_NEAR(frequency(w, 2.0) * 2 * vsa::kPi / std::sqrt(sigma / 1e-3), 1.0, 3e-3) << preset;
  }
}

TEST(SignalChain, MeetsTheCouplingCriterionInTheEmbeddedEngine) {
  // p = 0.611 rad, J = 4e-4 kg·m², 1 ms: 90–110 % of the energy after 1 s, frequency within 1 %.
  FlangeWorld f;
  f.losses = false;
  World w = World::load_string(flange_world(f));
  const double sigma = stiffness_at(w);
  w.set_joint(kShaft, 0.01, 0.0);
  w.step();
  w.step();
  const double before = stored(w);
  const double hz = frequency(w, 1.0);
  EXPECT_NEAR(stored(w) / before, 1.0, 0.01);
  EXPECT_NEAR(hz * 2 * vsa::kPi / std::sqrt(sigma / 4e-4), 1.0, 0.01);
}

TEST(SignalChain, ABareFlangeKickedFarStaysBoundedAtEveryStep) {
  for (const double step : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
    for (const bool losses : {false, true}) {
      for (const char* type : {"qbmove_maker_pro_6_1", "qbmove_maker_pro_paper"}) {
        FlangeWorld f;
        f.type = type;
        f.inertia_kgm2 = 1e-4;
        f.preset_rad = 0.785;
        f.step_s = step;
        f.losses = losses;
        World w = World::load_string(flange_world(f));
        w.set_joint(kShaft, 0.8, 0.0);
        w.step();
        auto beyond_supply = [&] { return stored(w) - w.ledger().supply; };
        const double first = beyond_supply();
        double worst = 0;
        for (int n = 0; n < 1000; ++n) {
          w.step();
          worst = std::max(worst, beyond_supply() - first);
        }
        EXPECT_LT(worst, 1e-3 * first) << type << ' ' << step << (losses ? " with losses" : " without");
      }
    }
  }
}

void keeps_its_energy(const char* type) {
  FlangeWorld f;
  f.type = type;
  f.inertia_kgm2 = 1e-4;
  f.preset_rad = 0.785;
  f.step_s = 5e-4;
  f.losses = false;
  World w = World::load_string(flange_world(f));
  w.set_joint(kShaft, 0.2, 0.0);
  w.step();
  const double before = stored(w);
  int crossings = 0;
  for (double last = w.joint_angle(kShaft); crossings < 20; last = w.joint_angle(kShaft)) {
    w.step();
    crossings += (last < 0) != (w.joint_angle(kShaft) < 0);
    ASSERT_LT(w.time_s(), 1.0);
  }
  EXPECT_GT(stored(w) / before, 0.9) << type;
  EXPECT_LT(stored(w) / before, 1.01) << type;
}

TEST(SignalChain, KeepsItsEnergyOverTenPeriodsAtHalfAMillisecond) {
  keeps_its_energy("qbmove_maker_pro_6_1");
  keeps_its_energy("qbmove_maker_pro_paper");
}

TEST(SignalChain, StaticDeflectionUnderALoadFollowsTheClosedForm) {
  // The housing is upright, the lever hangs; commanded to the horizontal it sags by the spring's deflection.
  FlangeWorld f;
  f.type = "qbmove_maker_pro_paper";  // whose springs have a closed form
  f.gravity = true;
  f.mass_kg = 0.3;
  f.arm_m = 0.15;
  f.inertia_kgm2 = 0.01;
  f.preset_rad = 0.4;
  World w = World::load_string(flange_world(f));
  w.command("a", 1.2, 0.4);
  w.run(25.0);  // only the shaft's 0.01 N·m damps the swing
  const auto r = w.read("a");
  const double load = 0.3 * 9.81 * 0.15 * std::sin(r.shaft_rad);
  const double x = load / (2 * 0.022 * std::cosh(6.85 * r.preset));
  const double deflection = std::asinh(x) / 6.85;
  EXPECT_NEAR(std::abs(r.deflection_rad), deflection, 0.01 / r.stiffness_Nm_per_rad + 1e-3)
      << "the shaft's friction holds 0.01 N·m";
  EXPECT_NEAR(std::abs(r.torque_Nm), load, 0.01) << "what is left of the swing";
}

TEST(SignalChain, EquilibriumDoesNotDependOnThePreset) {
  FlangeWorld f;
  f.preset_rad = 0.2;
  World w = World::load_string(flange_world(f));
  w.run(0.5);
  const double soft = w.joint_angle(kShaft);
  w.command("a", 0.0, 0.6);
  w.run(2.0);
  EXPECT_NEAR(w.joint_angle(kShaft), soft, 0.01);
  EXPECT_GT(w.read("a").preset, 0.45);
}

TEST(SignalChain, MotorReachesItsSteadySpeed) {
  FlangeWorld f;
  f.inertia_kgm2 = 4e-4;
  f.type = "qbmove_maker_pro_paper";
  World w = World::load_string(flange_world(f));
  w.run(0.05);
  w.command("a", 2.0, 0.611);
  w.run(0.15);
  double speed = 0;
  for (int n = 0; n < 100; ++n) {
    w.step();
    speed += 0.005 * (w.read("a").motor_speed_rad_per_s[0] + w.read("a").motor_speed_rad_per_s[1]);
  }
  const double volts = 61.0 / 101.0 * 12.0;
  const double expected = (1.02 * volts / 2.3 - 0.8) / (0.01 + 1.02 * 1.02 / 2.3);
  EXPECT_NEAR(speed, expected, 0.05 * expected);
}

TEST(SignalChain, WithTheSupplyCutTheWholeEnergyNeverGrows) {
  FlangeWorld f;
  f.gravity = true;
  f.mass_kg = 0.3;
  f.arm_m = 0.1;
  f.inertia_kgm2 = 0.006;
  f.preset_rad = 0.5;
  World w = World::load_string(flange_world(f));
  w.robot(0).set_supply(false);
  w.set_joint(kShaft, 0.6, 0.0);
  w.step();
  w.step();
  const double first = stored(w);
  double last = first, lost = 0;
  for (int n = 0; n < 5000; ++n) {
    w.step();
    const double now = stored(w);
    const auto l = w.ledger();
    lost = std::abs(l.coupling) + std::abs(l.integrator);
    ASSERT_LE(now, last + 2e-5 * (1 + std::abs(first))) << n;
    last = now;
  }
  EXPECT_LT(last, first - 0.01);
  EXPECT_LT(lost, 0.01 * w.ledger().moved());
}

}  // namespace
