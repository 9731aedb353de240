// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The load test without dynamics, against closed forms and against the simulated bench.
#include "vsa/identify/quasi_static.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "closed_form.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/units.hpp"

namespace vsa::identify {
namespace {

device::UnitConfig unit(const std::string& type, const std::vector<config::Override>& overrides = {}) {
  return test::shipped().load(type, overrides).unit;
}

constexpr double kTurn_rad = 1.6;

double deflection(const QuasiStatic& model, double preset, double torque_Nm, bool rising) {
  const experiment::Branches b = model.branches(preset, {torque_Nm}, {kTurn_rad, std::nullopt});
  return rising ? b.rising_rad[0] : b.falling_rad[0];
}

const std::vector<config::Override> kWithoutFriction{
    {"drive.friction_Nm", "0"}, {"drive.load_loss", "0"}, {"shaft.friction_Nm", "0"}, {"sensor.shaft_zero_rad", "0"}};

TEST(StaticDrive, IsTheProgramsGainTimesTheBridgesStallTorque) {
  // 0.1 % a raw tick; 61 % of the duty at 12 V, in counts of 101: between the ends a straight line, at the ends the stall torque.
  const device::UnitConfig u = unit("qbmove_maker_pro_6_1");
  const StaticDrive drive(u, 0);
  const double stall =
      0.61 * 100 / 101 * 12.0 / u.actuator.side[0].motor.resistance_Ohm * u.actuator.side[0].motor.torque_constant_Nm_per_A;
  EXPECT_NEAR(drive.torque_Nm(3.0), stall, 1e-9);
  EXPECT_NEAR(drive.torque_Nm(-3.0), -stall, 1e-9);
  const double half_rad = 500 * 2 * kPi / 65536;  // 500 raw ticks: half of the output
  EXPECT_NEAR(drive.torque_Nm(half_rad), 0.5 * stall, 0.02 * stall);
  EXPECT_NEAR(drive.torque_Nm(-half_rad), -0.5 * stall, 0.02 * stall);
}

TEST(StaticDrive, OfASecondMotorIsItsOwn) {
  const auto u =
      unit("qbmove_maker_pro_6_1",
           {{"drive_2.resistance_Ohm", "4.6"}, {"drive_2.torque_constant_Nm_per_A", "2.04"}, {"drive_2.dead_band", "0.2"}});
  const double ratio = 2.04 / 4.6 / (u.actuator.side[0].motor.torque_constant_Nm_per_A / u.actuator.side[0].motor.resistance_Ohm);
  EXPECT_NEAR(StaticDrive(u, 1).torque_Nm(1.0), ratio * StaticDrive(u, 0).torque_Nm(1.0), 1e-12);
  EXPECT_EQ(StaticDrive(u, 1).torque_Nm(2e-3), 0.0) << "within its dead band";
  EXPECT_GT(StaticDrive(u, 0).torque_Nm(2e-3), 0.0);
  EXPECT_TRUE(unsupported(unit("qbmove_maker_pro_6_1", {{"drive_2.polarity", "-1"}})));
}

TEST(StaticDrive, GivesNothingWithinADeadBandAndLittleBelowHalfADutyOfAModulatedEnablePin) {
  const double fifth_rad = 200 * 2 * kPi / 65536, most_rad = 900 * 2 * kPi / 65536;  // 20 % and 90 % of the output
  EXPECT_EQ(StaticDrive(unit("qbmove_maker_pro_6_1", {{"drive.dead_band", "0.3"}}), 0).torque_Nm(fifth_rad), 0.0);
  EXPECT_GT(StaticDrive(unit("qbmove_maker_pro_6_1"), 0).torque_Nm(fifth_rad), 0.1);
  const std::vector<config::Override> enable{
      {"drive.pwm_pin", "enable"}, {"drive.pwm_period_s", "0"}, {"firmware.generation", "2"}};
  EXPECT_EQ(StaticDrive(unit("qbmove_maker_pro_6_1", enable), 0).torque_Nm(fifth_rad), 0.0);
  const StaticDrive modulated(unit("qbmove_maker_pro_6_1", enable), 0);
  EXPECT_GT(modulated.torque_Nm(most_rad), 0.7 * modulated.torque_Nm(3.0));
  EXPECT_LT(modulated.torque_Nm(most_rad), 0.85 * modulated.torque_Nm(3.0)) << "2d − 1, and not d";
}

TEST(StaticDrive, IsRefusedWhereTheLoopIsntProportional) {
  EXPECT_FALSE(unsupported(unit("qbmove_maker_pro_6_1")));
  EXPECT_FALSE(unsupported(unit("qbmove_advanced")));
  EXPECT_TRUE(unsupported(unit("qbmove_maker_pro_6_1", {{"firmware.ki_pct_per_tick", "0.001"}})));
  EXPECT_TRUE(unsupported(unit("qbmove_maker_pro_6_1", {{"firmware.kp_pct_per_tick", "-0.1"}})));
  EXPECT_TRUE(unsupported(unit("qbmove_maker_pro_6_1", {{"drive.polarity", "-1"}})));
  device::UnitConfig other = unit("qbmove_maker_pro_6_1");
  other.memory.control_mode = 4;
  EXPECT_TRUE(unsupported(other));
}

TEST(QuasiStatic, WithoutFrictionShowsTheLawItself) {
  // One spring of stiffness k: τ = k δ, whatever the motor's loop gives way.
  const device::UnitConfig u = unit("sea_example", kWithoutFriction);
  const QuasiStatic model(u, 2.0);
  const double k = u.actuator.transmission->evaluate({}).curvature.qq;
  for (const bool rising : {true, false}) EXPECT_NEAR(deflection(model, 0, 0.8, rising), 0.8 / k, 1e-6);
}

TEST(QuasiStatic, TheLoopOfShaftAndTendonsIsAsWideAsTheirFriction) {
  std::vector<config::Override> o = kWithoutFriction;
  o[2].value = "0.03";
  o.push_back({"tendon.friction", "0.1"});
  const device::UnitConfig u = unit("sea_example", o);
  const QuasiStatic model(u, 2.0);
  const double k = u.actuator.transmission->evaluate({}).curvature.qq;
  // rising: τ + f = kδ(1 + μ); falling: τ − f = kδ(1 − μ)
  EXPECT_NEAR(deflection(model, 0, 0.8, true), 0.83 / 1.1 / k, 1e-6);
  EXPECT_NEAR(deflection(model, 0, 0.8, false), 0.77 / 0.9 / k, 1e-6);
}

TEST(QuasiStatic, AfterATurnABristleBendsBackBeforeItSlides) {
  std::vector<config::Override> o = kWithoutFriction;
  o[2].value = "0.05";
  o.push_back({"shaft.presliding_rad", "0.4"});
  const device::UnitConfig u = unit("sea_example", o);
  const QuasiStatic model(u, 2.0);
  const double k = u.actuator.transmission->evaluate({}).curvature.qq;
  // The falling branch begins with the shaft at −1.6 rad and the bristle bent fully: kδ = τ − 0.05 u/0.4, u = −0.4 + (q + 1.6).
  for (const double torque : {1.95, 1.9, 0.5}) {
    const double bend = std::min(-0.4 + kTurn_rad - std::asin(torque / 2.0), 0.4);
    EXPECT_NEAR(deflection(model, 0, torque, false), (torque - 0.05 * bend / 0.4) / k, 1e-6) << torque;
  }
}

TEST(QuasiStatic, TurnsWhereTheCommandsAmplitudeSays) {
  const device::UnitConfig u = unit("sea_example", kWithoutFriction);
  const QuasiStatic model(u, 2.0);
  const double k = u.actuator.transmission->evaluate({}).curvature.qq, amplitude = 0.5;
  // The lever at q takes 2 sin q of the spring: the command that holds it there is q + 2 sin q/k, and the motor's own error more.
  const auto reached = [&](double torque) { return std::isfinite(model.branches(0, {torque}, {1.6, amplitude}).rising_rad[0]); };
  double most = 0;
  for (double q = 0; q + 2 * std::sin(q) / k < amplitude; q += 1e-3) most = 2 * std::sin(q);
  EXPECT_TRUE(reached(0.7 * most));
  EXPECT_FALSE(reached(1.05 * most));
}

TEST(QuasiStatic, AMotorThatIsDrivenBackSpreadsLessAndSoTheJointIsSofter) {
  // With a preset both springs pull their motors together; what friction takes is what the loop needn't give.
  const auto swing = [](const char* loss) {
    const device::UnitConfig u = unit("qbmove_maker_pro_6_1", {{"drive.back_loss", loss}, {"sensor.shaft_zero_rad", "0"}});
    const QuasiStatic model(u, 1.47);
    return deflection(model, 0.55, 1.0, true) - deflection(model, 0.55, -1.0, true);
  };
  EXPECT_GT(swing("0"), swing("0.6") + 1e-3);
}

TEST(QuasiStatic, IsWithinSomeMilliradiansOfTheSimulatedBench) {
  struct Case {
    std::string type;
    std::vector<config::Override> overrides;
    double within_rad;
  };
  // With 12 V the users' motors stall under the whole load. A motor within the dead zone of an open bridge creeps: less exact.
  const Case cases[] = {
      {"qbmove_maker_pro_6_1", {{"drive.supply_V", "24"}}, 0.006},
      {"qbmove_maker_pro", {}, 0.005},
      {"qbmove_maker_pro_6_1", {{"drive.supply_V", "24"}, {"drive.back_loss", "0.8"}}, 0.006},
      {"qbmove_maker_pro_6_1", {{"drive.supply_V", "24"}, {"drive_2.resistance_Ohm", "8"}, {"drive_2.friction_Nm", "0.1"}}, 0.006}};
  for (const Case& c : cases) {
    experiment::Specimen specimen;
    specimen.type = c.type;
    specimen.overrides = c.overrides;
    specimen.library = test::shipped();
    const QuasiStatic model(unit(c.type, c.overrides), experiment::bench_load_peak_Nm(specimen));
    for (const double preset : {0.0, 0.4602, 0.6903}) {
      experiment::StiffnessOptions o;
      o.preset = preset;
      o.lead_in_cycles = 0;
      o.cycles = 1.5;
      const auto simulated = experiment::branches(experiment::as_recording(experiment::run_stiffness(specimen, o), preset));
      const Turn turn{experiment::sweep_target_rad(preset, "rad"), std::nullopt};
      const experiment::Difference d = experiment::difference(model.branches(preset, simulated.torque_Nm, turn), simulated);
      EXPECT_GT(d.points, 100u);
      EXPECT_LT(d.both_rad, c.within_rad) << c.type << ", preset " << preset;
    }
  }
}

}  // namespace
}  // namespace vsa::identify
