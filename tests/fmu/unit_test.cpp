// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator's FMU against the unit that the library steps.
#include "vsa/device/unit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "importer.hpp"
#include "vsa/bits.hpp"
#include "vsa/device/reading.hpp"

namespace vsa::test {
namespace {

constexpr std::int64_t kTick = 1'000'000;

bool same_bits(double a, double b) { return bits_as<std::uint64_t>(a) == bits_as<std::uint64_t>(b); }

/// The path of vsa/fmu/unit_model.hpp, written down once more.
struct Direct {
  explicit Direct(const std::string& type) : unit(config::TypeLibrary().load(type).unit) {}
  device::Unit unit;
  device::UnitState state;
  std::int64_t t = 0;
  double mean = 0;

  void step(std::int64_t dt, double q, double v, double a) {
    double impulse = 0;
    for (std::int64_t gone = 0, piece = 0; gone < dt; gone += piece) {
      piece = std::min(dt - gone, kTick - (t + gone) % kTick);
      const double s = static_cast<double>(gone) * 1e-9, speed = v + a * s;
      state.last_speed = speed - a * state.last_dt;
      impulse += static_cast<double>(piece) * 1e-9 * unit.step(state, t + gone, piece, {q + s * (v + 0.5 * a * s), speed, 0.0});
    }
    const double h = static_cast<double>(dt) * 1e-9;
    state.reached = {q + h * (v + 0.5 * a * h), v + a * h};
    mean = impulse / h;
    t += dt;
  }
};

class OfEachKind : public testing::TestWithParam<const char*> {};

TEST_P(OfEachKind, IsBitForBitTheUnitThatTheLibrarySteps) {
  const auto package = exported({.type = GetParam()});
  Direct direct(GetParam());
  Instance2 fmu(*package);
  ASSERT_TRUE(fmu.made());
  const bool preset = package->text().find("\"preset\"") != std::string::npos;
  fmu.set("equilibrium", 0.1);
  if (preset) fmu.set("preset", 0.2);
  fmu.set("shaft_angle", 0.05);
  fmu.start(3.0);  // a start that isn't 0 is the unit's 0
  direct.state = direct.unit.initial(0.1, preset ? 0.2 : 0, 0.05);
  std::int64_t now = 0;
  for (int k = 0; k < 300; ++k) {
    const double t = static_cast<double>(now) * 1e-9;
    const double q = 0.05 + 0.3 * std::sin(9 * t), v = 2.7 * std::cos(9 * t), a = k % 2 == 0 ? 0 : -24.3 * std::sin(9 * t);
    if (k == 50) {
      fmu.set("equilibrium", 0.7);
      if (preset) fmu.set("preset", 0.5);
      direct.unit.command(direct.state, 0.7, preset ? 0.5 : 0);
    }
    fmu.set("shaft_angle", q);
    fmu.set("shaft_speed", v);
    fmu.set("shaft_acceleration", a);
    // Whole ticks, several of them, parts of one, and steps that no tick divides.
    const std::int64_t h = std::array<std::int64_t, 5>{kTick, 5 * kTick, 300'000, 2'700'000, 25 * kTick}[k % 5];
    fmu.step(3.0 + t, static_cast<double>(h) * 1e-9);
    direct.step(h, q, v, a);
    now += h;
    const device::UnitReading r = device::read(direct.unit, direct.state);
    ASSERT_TRUE(same_bits(fmu.get("torque"), r.torque_Nm)) << "at step " << k;
    ASSERT_TRUE(same_bits(fmu.get("mean_torque"), direct.mean)) << "at step " << k;
    ASSERT_TRUE(same_bits(fmu.get("stiffness"), r.stiffness_Nm_per_rad)) << "at step " << k;
    ASSERT_TRUE(same_bits(fmu.get("motor_1_angle"), r.motor_rad[0])) << "at step " << k;
    ASSERT_TRUE(same_bits(fmu.get("motor_1_current"), r.current_A[0])) << "at step " << k;
    ASSERT_TRUE(same_bits(fmu.get("energy_supply"), direct.state.actuator.ledger.supply)) << "at step " << k;
  }
  EXPECT_GT(std::abs(fmu.get("torque")), 0.01);
  EXPECT_GT(fmu.get("energy_supply"), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Types, OfEachKind,
                         testing::Values("qbmove_maker_pro_6_1", "qbmove_advanced", "sea_example", "table_example",
                                         "awas_example"));

TEST(Unit, ForeseesTheShaftAsTheLibraryDoesWhereCouplingIsImplicit) {
  const auto package = exported({.start = {.coupling = fmu::Coupling::implicit, .load_inertia_kgm2 = 0.002}});
  Direct direct("qbmove_maker_pro_6_1");
  Instance2 fmu(*package);
  fmu.set("preset", 0.3);
  fmu.set("equilibrium", 0.4);
  fmu.start();
  direct.state = direct.unit.initial(0.4, 0.3, 0);
  double q = 0, v = 0;
  for (int k = 0; k < 500; ++k) {
    fmu.set("shaft_angle", q);
    fmu.set("shaft_speed", v);
    fmu.step(k * 2e-3, 2e-3);
    const double torque = direct.unit.step(direct.state, k * 2 * kTick, 2 * kTick, {q, v, 1 / 0.002});
    ASSERT_TRUE(same_bits(fmu.get("mean_torque"), torque)) << "at step " << k;
    v += 2e-3 * torque / 0.002;
    q += 2e-3 * v;
  }
  EXPECT_NEAR(q, 0.4, 0.02);
}

TEST(Unit, TwoInstancesDoNotKnowOfEachOther) {
  const auto package = exported();
  Instance2 a(*package, "a"), b(*package, "b"), alone(*package, "alone");
  for (Instance2* i : {&a, &b, &alone}) {
    i->set("preset", 0.2);
    i->start();
  }
  for (int k = 0; k < 100; ++k) {
    a.set("equilibrium", 0.5);
    b.set("equilibrium", -0.4);
    alone.set("equilibrium", 0.5);
    a.step(k * 1e-3, 1e-3);
    b.step(k * 1e-3, 1e-3);
  }
  for (int k = 0; k < 100; ++k) alone.step(k * 1e-3, 1e-3);
  EXPECT_EQ(a.all(), alone.all());
  EXPECT_GT(a.get("torque"), 0.1);
  EXPECT_LT(b.get("torque"), -0.1);
}

TEST(Unit, SlopesAreThoseOfCentralDifferences) {
  for (const char* type : {"qbmove_maker_pro_6_1", "qbmove_maker_pro", "sea_example", "fsj_example"}) {
    const auto package = exported({.type = type});
    Instance2 fmu(*package);
    fmu.set("equilibrium", 0.3);
    fmu.start();
    const unsigned angle = package->reference("shaft_angle"), speed = package->reference("shaft_speed");
    const std::array<unsigned, 4> unknowns{package->reference("torque"), package->reference("deflection"),
                                           package->reference("stiffness"), package->reference("motor_1_angle")};
    int compared = 0;
    for (int k = 0; k < 60; ++k) {
      const double q = 0.2 * std::sin(0.31 * k);
      fmu.set("shaft_angle", q);
      fmu.set("shaft_speed", 0.0);
      fmu.step(k * 1e-3, 1e-3);
      // Off where the motion left it: there the frictions stand at the edge of sliding.
      const double here = fmu.get("deflection") + fmu.get("equilibrium_attained") + (k % 2 == 0 ? 1e-4 : -1e-4);
      fmu.set("shaft_angle", here);
      std::array<double, 4> slope{}, along{};
      const double one = 1, two = 2;
      ASSERT_EQ(FMI(*package, fmi2GetDirectionalDerivative)(fmu.c(), unknowns.data(), 4, &angle, 1, &two, slope.data()), fmi2OK);
      ASSERT_EQ(FMI(*package, fmi2GetDirectionalDerivative)(fmu.c(), unknowns.data(), 4, &speed, 1, &one, along.data()), fmi2OK);
      constexpr double kStep = 3e-7;
      std::array<double, 4> up{}, down{};
      fmu.set("shaft_angle", here + kStep);
      ASSERT_EQ(FMI(*package, fmi2GetReal)(fmu.c(), unknowns.data(), 4, up.data()), fmi2OK);
      fmu.set("shaft_angle", here - kStep);
      ASSERT_EQ(FMI(*package, fmi2GetReal)(fmu.c(), unknowns.data(), 4, down.data()), fmi2OK);
      fmu.set("shaft_angle", here);
      const double middle = fmu.get("torque");
      // Where a friction begins to slide the two sides have different slopes, and there is no derivative.
      if (std::abs((up[0] - middle) - (middle - down[0])) > 1e-3 * std::abs(up[0] - down[0]) + 1e-12) continue;
      ++compared;
      for (std::size_t u = 0; u < 3; ++u) {
        const double difference = (up[u] - down[u]) / (2 * kStep);
        EXPECT_NEAR(slope[u], 2 * difference, 2e-4 * std::abs(difference) + 2e-4) << type << " of " << u << " at step " << k;
      }
      EXPECT_EQ(slope[3], 0);
      EXPECT_EQ(up[3], down[3]);
      for (const double s : along) EXPECT_EQ(s, 0);
    }
    EXPECT_GT(compared, 20) << type;
  }
}

TEST(Unit, AStateComesBackBitForBitAndAsBytesInAnotherInstance) {
  const auto package = exported();
  Instance2 a(*package, "a"), b(*package, "b");
  a.set("drive.supply_V", 11.0);
  a.set("preset", 0.2);
  a.start(2.0);
  a.set("equilibrium", 0.6);
  for (int k = 0; k < 40; ++k) a.step(2 + k * 1e-3, 1e-3);
  fmi2FMUstate state = nullptr;
  ASSERT_EQ(FMI(*package, fmi2GetFMUstate)(a.c(), &state), fmi2OK);
  const std::vector<char> bytes = a.bytes();
  const auto go_on = [](Instance2& i) {
    i.set("shaft_angle", 0.1);
    for (int k = 40; k < 80; ++k) i.step(2 + k * 1e-3, 1e-3);
    return i.all();
  };
  const std::vector<double> first = go_on(a);
  ASSERT_EQ(FMI(*package, fmi2SetFMUstate)(a.c(), state), fmi2OK);
  EXPECT_EQ(a.bytes(), bytes);
  EXPECT_EQ(go_on(a), first);
  b.restore(bytes);  // with the parameters, the time and the mode
  EXPECT_EQ(b.get("drive.supply_V"), 11.0);
  EXPECT_EQ(go_on(b), first);
  Instance2 under_way(*package, "under way");  // with parameters of its own until then
  under_way.start();
  under_way.step(0, 1e-3);
  under_way.restore(bytes);
  EXPECT_EQ(go_on(under_way), first);
  ASSERT_EQ(FMI(*package, fmi2FreeFMUstate)(a.c(), &state), fmi2OK);
}

TEST(Unit, ResetBeginsAnew) {
  const auto package = exported();
  Instance2 a(*package, "a"), fresh(*package, "fresh");
  a.set("drive.supply_V", 9.0);
  a.set("equilibrium", 0.6);
  a.start(1.0);
  for (int k = 0; k < 40; ++k) a.step(1 + k * 1e-3, 1e-3);
  ASSERT_EQ(FMI(*package, fmi2Reset)(a.c()), fmi2OK);
  for (Instance2* i : {&a, &fresh}) {
    i->start();
    i->set("equilibrium", 0.3);
    for (int k = 0; k < 40; ++k) i->step(k * 1e-3, 1e-3);
  }
  EXPECT_EQ(a.all(), fresh.all());
}

TEST(Unit, ParametersActAndAreCheckedAsTheTypesAre) {
  const auto package = exported();
  Instance2 plain(*package, "plain"), weak(*package, "weak"), coasting(*package, "coasting");
  weak.set("drive.supply_V", 6.0);
  for (Instance2* i : {&plain, &weak}) {
    i->set("equilibrium", 0.0);
    i->start();
    i->set("equilibrium", 0.8);
    for (int k = 0; k < 30; ++k) i->step(k * 1e-3, 1e-3);
  }
  EXPECT_LT(weak.get("motor_1_angle"), 0.9 * plain.get("motor_1_angle"));
  coasting.set_word("drive.off_mode", 2);
  EXPECT_EQ(package->variable("drive.off_mode").type, "Enumeration");
  // Each within its bounds, but not together: told at the end of the initialization, and the importer may mend it.
  Instance2 crossed(*package, "crossed");
  crossed.set_word("firmware.limit_low_raw", 20000);
  crossed.set_word("firmware.limit_high_raw", 10000);
  ASSERT_EQ(FMI(*package, fmi2EnterInitializationMode)(crossed.c()), fmi2OK);
  EXPECT_EQ(FMI(*package, fmi2ExitInitializationMode)(crossed.c()), fmi2Error);
  ASSERT_FALSE(crossed.log.empty());
  EXPECT_NE(crossed.log.back().find("firmware.limit"), std::string::npos) << crossed.log.back();
  crossed.set_word("firmware.limit_high_raw", 30000);
  EXPECT_EQ(FMI(*package, fmi2ExitInitializationMode)(crossed.c()), fmi2OK);
}

TEST(Unit, TellsOnceWhereTheStepIsTooLongForTheLoadBehindIt) {
  const auto package = exported();
  for (const bool light : {true, false}) {
    Instance2 fmu(*package);
    fmu.set("load_inertia_kg_m2", light ? 1e-4 : 10.0);
    fmu.set("preset", 0.5);
    fmu.set("equilibrium", 0.2);
    fmu.start();
    for (int k = 0; k < 20; ++k) fmu.step(k * 2e-3, 2e-3);
    ASSERT_EQ(fmu.log.size(), light ? 1U : 0U);
    if (light) {
      EXPECT_NE(fmu.log[0].find("explicit coupling"), std::string::npos) << fmu.log[0];
    }
  }
}

TEST(Unit, TellsOnceThatAPresetIsClamped) {
  const auto package = exported();
  Instance2 fmu(*package);
  fmu.start();
  fmu.set("preset", 3.0);
  for (int k = 0; k < 20; ++k) fmu.step(k * 1e-3, 1e-3);
  ASSERT_EQ(fmu.log.size(), 1U);
  EXPECT_NE(fmu.log[0].find("clamped"), std::string::npos) << fmu.log[0];
}

TEST(Unit, HasTheNamesThatGazeboFmiLooksFor) {
  const auto package = exported({.names = fmu::Names::gazebo_fmi});
  for (const char* name : {"actuatorInput", "jointPosition", "jointVelocity", "jointAcceleration"})
    EXPECT_EQ(package->variable(name).causality, "input");
  EXPECT_EQ(package->variable("jointTorque").causality, "output");
  Instance2 fmu(*package);
  fmu.start();
  fmu.set("actuatorInput", 0.5);
  for (int k = 0; k < 200; ++k) fmu.step(k * 1e-3, 1e-3);
  EXPECT_GT(fmu.get("jointTorque"), 0.05);
  EXPECT_EQ(fmu.get("jointTorque"), fmu.get("jointTorque"));
}

}  // namespace
}  // namespace vsa::test
