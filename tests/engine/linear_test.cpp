// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Linear actuators: a screw's spring on a joint that slides, in m and N, and the same as a rack on a pinion.
#include <cmath>

#include "support/ledger.hpp"
#include "worlds.hpp"

namespace vsa::engine::testing {
namespace {

constexpr double kMass = 10, kStiffness_N_per_m = 1e5, kRadius_m = 0.04;

WorldOptions options() {
  WorldOptions o;
  o.types = config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  return o;
}

std::string actuator(const std::string& type, const std::string& more = {}) {
  return "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator name='ram'><joint>slide</joint><type>" + type + "</type>" +
         more + "</actuator></plugin>";
}

/// A plate over a base, along or about +z; its moment about z is `moment`.
std::string press(const std::string& joint, const std::string& plugin, double moment = 1, const std::string& gravity = "0 0 0") {
  return world(
      "<model name='press'><link name='base'>" + inertial(1, 1) + "</link><link name='plate'>" + inertial(kMass, moment) +
          "</link><joint name='foot' type='fixed'><parent>world</parent><child>base</child></joint><joint name='slide' type='" +
          joint + "'><parent>base</parent><child>plate</child><axis><xyz>0 0 1</xyz></axis></joint>" + plugin + "</model>",
      gravity);
}

World on_slide(const std::string& gravity = "0 0 0") {
  return World::load_string(press("prismatic", actuator("linear_sea_example"), 1, gravity), options());
}

TEST(Linear, APlateHangsOnItsSpringInMetresAndNewtons) {
  World w = on_slide("0 0 -9.81");
  w.run(5.0);
  const auto r = w.read("ram");
  const double weight = kMass * 9.81, bearing = 2.0, dead_zone = 1.0;
  EXPECT_NEAR(r.torque_Nm, weight, bearing + 0.1);
  EXPECT_NEAR(-r.deflection_rad * kStiffness_N_per_m, r.torque_Nm,
              bearing + 1e-6 * weight);  // the spring's less what the bearing holds
  // The servo's own stiffness, 10 kN/m, within what friction and the integral's dead zone hide.
  EXPECT_NEAR(r.shaft_rad, -weight / 1e4, (bearing + dead_zone) / 1e4 + 2e-5);
  EXPECT_LT(std::abs(r.shaft_speed_rad_per_s), 1e-4);
  EXPECT_NEAR(r.motor_rad[0] * 4e-4, r.equilibrium_rad, 1e-9);
  test::expect_small_closures(w.ledger(), 0.01);
}

TEST(Linear, ARackOnAPinionMovesAsTheSlideDoes) {
  World slide = on_slide();
  const std::string pinion = "<override key='shaft.pinion_m' value='" + std::to_string(kRadius_m) + "'/>";
  World turn =
      World::load_string(press("revolute", actuator("linear_sea_example", pinion), kMass * kRadius_m * kRadius_m), options());
  double most = 0;
  for (int k = 0; k < 1500; ++k) {
    const double wish_m = k < 700 ? 0.02 : -0.01;
    EXPECT_TRUE(slide.command("ram", wish_m, 0));
    EXPECT_TRUE(turn.command("ram", wish_m / kRadius_m, 0));
    slide.step(), turn.step();
    const auto a = slide.read("ram"), b = turn.read("ram");
    most = std::fmax(most, std::abs(a.shaft_rad));
    ASSERT_NEAR(a.shaft_rad, kRadius_m * b.shaft_rad, 2e-6) << k;
    ASSERT_NEAR(a.torque_Nm, b.torque_Nm / kRadius_m, 1.0) << k;
    ASSERT_NEAR(a.stiffness_Nm_per_rad, b.stiffness_Nm_per_rad / (kRadius_m * kRadius_m), 1e-3) << k;
  }
  EXPECT_GT(most, 0.015) << "it went there";
}

TEST(Linear, APresetStiffensTheOutputInNewtonsPerMetre) {
  for (const double preset : {0.0, 4e4}) {
    World w = on_slide();
    EXPECT_TRUE(w.command("ram", 0, preset));
    for (int k = 0; k < 4000; ++k) {
      w.apply_torque(w.joint("press::slide"), 200);
      w.step();
    }
    EXPECT_NEAR(w.joint_angle("press::slide"), 200 / (1e4 + preset), 15.0 / (1e4 + preset)) << preset;
  }
}

TEST(Linear, APlacedOneStartsWithoutAKick) {
  World w = on_slide();
  w.place("ram", 0.03, 0, 0.05);
  w.step();
  EXPECT_NEAR(w.read("ram").shaft_speed_rad_per_s, 0.05, 2e-3);
  EXPECT_NEAR(w.read("ram").shaft_rad, 0.03, 1e-4);
}

TEST(Linear, TheSameTwiceAndAfterAReset) {
  World a = on_slide("0 0 -9.81"), b = on_slide("0 0 -9.81");
  a.run(0.5);
  a.reset();
  a.run(0.3), b.run(0.3);
  EXPECT_EQ(a.read("ram").shaft_rad, b.read("ram").shaft_rad);
}

TEST(Linear, WhatTurnsIsNotPutOnASlideNorTheOtherWayRound) {
  const std::string turns = problems_of(press("prismatic", actuator("sea_example")), options());
  EXPECT_NE(turns.find("is prismatic: sea_example turns its joint"), std::string::npos) << turns;
  const std::string slides = problems_of(press("revolute", actuator("linear_sea_example")), options());
  EXPECT_NE(slides.find("linear_sea_example is a linear actuator"), std::string::npos) << slides;
  EXPECT_NE(slides.find("shaft.pinion_m"), std::string::npos) << slides;
  const std::string unit =
      problems_of(press("prismatic", actuator("linear_sea_example", "<initial equilibrium_rad='0.1'/>")), options());
  EXPECT_NE(unit.find("equilibrium_m"), std::string::npos) << unit;
  const std::string key =
      problems_of(press("prismatic", actuator("linear_sea_example", "<override key='shaft.friction_Nm' value='1'/>")), options());
  EXPECT_NE(key.find("shaft.friction_N"), std::string::npos) << key;
}

}  // namespace
}  // namespace vsa::engine::testing
