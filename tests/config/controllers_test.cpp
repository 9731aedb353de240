// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which controller a type has, and whose keys it takes.
#include <gtest/gtest.h>

#include "support.hpp"
#include "vsa/config/plugin_xml.hpp"

namespace vsa::test {
namespace {

using config::ActuatorType;
using control::ServoKind;

std::string type_of(const std::string& base, const std::string& rest) {
  return "[type]\nname = \"mine\"\ntitle = \"mine\"\nbase = \"" + base + "\"\n" + rest;
}

ActuatorType load(const std::string& text) { return shipped().load_text(text, "mine.toml"); }
std::string told(const std::string& text) {
  return text_of(problems_of([&] { (void)load(text); }));
}

TEST(Controller, IsTheQbmovesWhereTheFileSaysNothing) {
  const ActuatorType type = shipped().load("qbmove_maker_pro");
  EXPECT_EQ(type.controller, "qbmove");
  EXPECT_FALSE(type.unit.servo.has_value());
}

TEST(Controller, OfAShippedServoHasTheFilesNumbers) {
  const ActuatorType type = shipped().load("sea_hardening_example");
  EXPECT_EQ(type.controller, "position_servo");
  ASSERT_TRUE(type.unit.servo.has_value());
  EXPECT_EQ(type.unit.servo->position.gain_per_s, 25.0);
  EXPECT_EQ(type.unit.servo->position.integral_Nm_per_rad, 1.0);
  EXPECT_EQ(type.unit.servo->reference_max_rad, 2.876);
  for (const config::Entry& e : type.entries) EXPECT_NE(e.key.rfind("firmware.", 0), 0u) << e.key;
}

TEST(Controller, OfATorqueServoGivesThePresetItsUnit) {
  const ActuatorType type = shipped().load("anydrive_ad119e20");
  EXPECT_TRUE(type.unit.is(ServoKind::torque_servo));
  EXPECT_EQ(type.unit.preset_unit(), "N·m/rad");
  EXPECT_EQ(type.unit.preset_max, 100.0);
  EXPECT_EQ(type.unit.servo->torque.stiffness_Nm_per_rad, 20.0);
}

TEST(Controller, AnotherThanTheBasesLeavesTheBasesKeys) {
  const std::string band = "[drive]\ndead_band = { value = 0.0, unit = \"1\", bounds = [0.0, 0.0], source = \"mine\" }\n";
  const ActuatorType type = load(type_of("qbmove_maker_pro_paper", "[control]\nkind = \"motor_voltages\"\n" + band));
  EXPECT_TRUE(type.unit.is(ServoKind::motor_voltages));
  const ActuatorType back = load(type_of("sea_hardening_example", "[control]\nkind = \"qbmove\"\n"));
  EXPECT_FALSE(back.unit.servo.has_value());
  for (const config::Entry& e : back.entries) EXPECT_NE(e.key.rfind("control.", 0), 0u) << e.key;
}

TEST(Controller, SameAsTheBasesTakesItsKeys) {
  const std::string gain =
      "[control]\nposition_gain_per_s = { value = 7.0, unit = \"1/s\", bounds = [0.1, 10.0], source = \"mine\" }\n";
  const ActuatorType type = load(type_of("sea_hardening_example", gain));
  EXPECT_EQ(type.unit.servo->position.gain_per_s, 7.0);
  EXPECT_EQ(type.unit.servo->position.speed_gain_Nms_per_rad, 0.5);
}

TEST(Controller, KeysOfAnotherAreRefusedAndSayWhose) {
  const std::string firmware = "[firmware]\nmodel = { value = \"maker_pro\", source = \"mine\" }\n";
  expect_pieces(told(type_of("sea_hardening_example", firmware)),
                {"mine.toml:6: firmware.model", "is of the controller qbmove: control.kind is position_servo"});
  const std::string gain =
      "[control]\nposition_gain_per_s = { value = 7.0, unit = \"1/s\", bounds = [0.1, 10.0], source = \"mine\" }\n";
  expect_pieces(told(type_of("qbmove_maker_pro", gain)),
                {"control.position_gain_per_s", "is of the controller position_servo: control.kind is qbmove"});
  expect_pieces(told(type_of("anydrive_ad119e20", gain)), {"is of the controller position_servo: control.kind is torque_servo"});
  const auto problems = problems_of([] { (void)shipped().load("sea_hardening_example", {{"firmware.kp_pct_per_tick", "0.1"}}); });
  expect_pieces(text_of(problems), {"firmware.kp_pct_per_tick", "is of the controller qbmove"});
}

TEST(Controller, ThatDoesNotExistIsRefusedWithTheOnesThereAre) {
  expect_pieces(told(type_of("sea_hardening_example", "[control]\nkind = \"position_sevo\"\n")),
                {"mine.toml:6: control.kind", "is no controller, did you mean position_servo?", "motor_voltages"});
}

TEST(Controller, CantBeOverridden) {
  const auto problems = problems_of([] { (void)shipped().load("qbmove_maker_pro", {{"control.kind", "position_servo"}}); });
  expect_pieces(text_of(problems), {"override control.kind", "a controller has parameters of its own and can't be overridden"});
}

TEST(Controller, OfATorqueServoHasAnInitialPresetInItsOwnUnit) {
  const auto plugin = [](const std::string& attribute) {
    return "<plugin name='vsa::Robot' filename='f'><actuator><joint>j</joint><type>anydrive_ad119e20</type><initial " + attribute +
           "/></actuator></plugin>";
  };
  const auto robot = config::parse_plugin(plugin("preset_Nm_per_rad='15'"), "arm.sdf", shipped());
  EXPECT_EQ(robot.actuators[0].initial_preset, 15.0);
  const auto problems = problems_of([&] { (void)config::parse_plugin(plugin("preset_rad='0.2'"), "arm.sdf", shipped()); });
  expect_pieces(text_of(problems), {"preset_rad", "is not this actuator's preset", "preset_Nm_per_rad"});
}

TEST(Controller, WithoutItsGainsIsRefused) {
  const std::string text = told(type_of("qbmove_maker_pro_paper", "[control]\nkind = \"position_servo\"\n"));
  for (const char* key : {"control.current_max_A", "control.position_gain_per_s", "control.reference_max_rad"})
    expect_pieces(text, {std::string(key) + ": is missing"});
  EXPECT_EQ(text.find("control.torque_gain"), std::string::npos) << text;
}

TEST(Controller, AsksForABridgeThatGivesWhatItIsTold) {
  const std::string text = told(type_of("qbmove_maker_pro_paper", "[control]\nkind = \"motor_voltages\"\n"));
  expect_pieces(text, {"drive.dead_band = 0.3", "a servo's drive gives the voltages that it is told"});
}

}  // namespace
}  // namespace vsa::test
