// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/reading.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "support/one_joint.hpp"
#include "vsa/bits.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace {

using vsa::test::maker_pro;
using vsa::test::OneJoint;

/// Of a reading, which is made of doubles alone.
using Bits = std::array<std::uint64_t, sizeof(vsa::device::UnitReading) / sizeof(double)>;

TEST(Reading, OfAUnitAtRestTellsWhatItWasPutTo) {
  const vsa::device::Unit unit(maker_pro());
  const auto state = unit.initial(0.4, 0.3, 0.5);
  const auto r = read(unit, state);
  EXPECT_NEAR(r.equilibrium_rad, 0.4, 2e-4) << "a tick is 1.9e-4 rad";
  EXPECT_NEAR(r.preset, 0.3, 2e-4);
  EXPECT_EQ(r.shaft_rad, 0.5);
  EXPECT_EQ(r.shaft_speed_rad_per_s, 0);
  EXPECT_EQ(r.current_A, (std::array<double, 2>{0, 0}));
  const auto law = unit.config().actuator.transmission->evaluate({0.5, r.motor_rad});
  EXPECT_DOUBLE_EQ(r.stiffness_Nm_per_rad, law.curvature.qq);
  EXPECT_NEAR(r.torque_Nm, law.torque, 1e-12);
  EXPECT_LT(r.torque_Nm, 0) << "back to the equilibrium";
  const auto ticks = measured(unit, state);
  EXPECT_NEAR(ticks[2].value * 2 * vsa::kPi / 32768, 0.5, 2e-3) << "a count of the 12-bit encoder is 1.5e-3 rad";
}

/// With and without a presliding of its own: one of 0 is the smallest that a step can use.
TEST(Reading, TheTorquesSlopeIsItsCentralDifference) {
  for (const double presliding_rad : {0.03, 1e-3, 0.0}) {
    vsa::device::UnitConfig config = maker_pro();
    config.actuator.shaft_friction = {0.01, presliding_rad};
    const vsa::device::Unit unit(config);
    auto state = unit.initial(0.4, 0.3, 0.5);
    const double slope = torque_slope(unit, state), step = 1e-7;
    state.reached.angle += step;
    const double above = read(unit, state).torque_Nm;
    state.reached.angle -= 2 * step;
    const double difference = (above - read(unit, state).torque_Nm) / (2 * step);
    EXPECT_NEAR(slope, difference, 1e-4 * std::abs(difference)) << presliding_rad;
  }
}

TEST(Reading, MeanTorqueIsWhatTheLastStepGaveTheHost) {
  OneJoint joint(maker_pro(), 0.0, 0.3, 1e-3, 1'000'000);
  joint.unit.set_inputs(joint.state, joint.unit.inputs_for(0.6, 0.3));
  for (int n = 0; n < 100; ++n) joint.step();
  const auto r = read(joint.unit, joint.state);
  EXPECT_EQ(r.mean_torque_Nm, joint.last_torque);
  EXPECT_GT(std::abs(r.current_A[0]), 0.01);
  EXPECT_GT(r.motor_speed_rad_per_s[0], 0.1);
  EXPECT_NEAR(r.shaft_rad, joint.q, 1e-5);
}

TEST(Reading, WithoutTorquesIsTheSameButForThem) {
  vsa::device::UnitConfig one_motor = vsa::test::without_losses();
  one_motor.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(50);
  for (const auto& [config, preset] : {std::pair{maker_pro(), 0.5}, std::pair{one_motor, 0.0}}) {
    OneJoint joint(config, 0.0, preset, 1e-3, 4'000'000);
    joint.v = 2.0;  // on its way: pulleys and shaft are half a step apart
    joint.unit.set_inputs(joint.state, joint.unit.inputs_for(0.6, preset));
    for (int n = 0; n < 30; ++n) {
      joint.step();
      const auto all = read(joint.unit, joint.state);
      auto some = read(joint.unit, joint.state, vsa::device::Torques::left_out);
      EXPECT_EQ(some.torque_Nm, 0);
      EXPECT_EQ(some.motor_torque_Nm, (std::array<double, 2>{0, 0}));
      some.torque_Nm = all.torque_Nm;
      some.motor_torque_Nm = all.motor_torque_Nm;
      EXPECT_EQ(vsa::bits_as<Bits>(some), vsa::bits_as<Bits>(all)) << n;
    }
    EXPECT_NE(read(joint.unit, joint.state).torque_Nm, 0);
  }
}

TEST(Reading, OfAJointThatIsCarriedAlongIsThatOfOneInstant) {
  // Pulley and shaft go at the same speed: the spring is slack, whatever the step. Half a step between them would be up to 0.1 N·m.
  vsa::device::UnitConfig config = vsa::test::without_losses();
  config.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(50);
  for (const std::int64_t dt_ns : {500'000, 1'000'000, 4'000'000}) {
    OneJoint joint(config, 0.0, 0.0, 0.1, dt_ns);
    joint.v = 1.0;
    joint.unit.place(joint.state, {.speed = joint.v, .lag_s = 0.5e-9 * static_cast<double>(dt_ns)});
    EXPECT_NEAR(read(joint.unit, joint.state).torque_Nm, 0, 1e-9) << "as it is put";
    for (int n = 0; n < 50; ++n) joint.step();
    const auto r = read(joint.unit, joint.state);
    EXPECT_NEAR(r.motor_rad[0], r.shaft_rad, 1e-9) << dt_ns;
    EXPECT_NEAR(r.torque_Nm, 0, 1e-5) << dt_ns;
  }
}

}  // namespace
