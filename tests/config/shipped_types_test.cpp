// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The presets that the project ships: each value where it belongs, each with a source.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "support.hpp"
#include "support/one_joint.hpp"
#include "vsa/config/schema.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace vsa::test {
namespace {

using config::ActuatorType;

TEST(ShippedTypes, AreInTheDocumentationsTableWithTheirOwnTitles) {
  const std::string text = read(source_dir() / "docs/reference/config.md");
  const std::size_t from = text.find("| type |"), to = text.find("\n\n", from);
  ASSERT_NE(to, std::string::npos);
  std::istringstream table(text.substr(from, to - from));
  std::vector<std::string> names;
  for (std::string row; std::getline(table, row);) {
    if (row.rfind("| `", 0) != 0) continue;
    names.push_back(row.substr(3, row.find('`', 3) - 3));
    const ActuatorType type = shipped().load(names.back());
    EXPECT_NE(row.find("| " + type.rank + " | " + type.title + " |"), std::string::npos) << row;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, shipped().names());
}

TEST(ShippedTypes, EveryOneLoadsAndEveryEntryHasMeaningBoundsAndSource) {
  for (const std::string& name : shipped().names()) {
    const ActuatorType type = shipped().load(name);
    EXPECT_EQ(type.name, name);
    EXPECT_FALSE(type.title.empty() || type.description.empty());
    EXPECT_EQ(type.file.stem(), name);
    EXPECT_FALSE(type.rank.empty()) << name;
    EXPECT_GT(type.entries.size(), 25u);
    for (const config::Entry& e : type.entries) {
      EXPECT_FALSE(e.value.empty() || e.bounds.empty() || e.meaning.empty() || e.source.empty()) << name << " " << e.key;
    }
  }
}

TEST(ShippedTypes, GiveEveryParameterThemselvesSoThatNoneDependsOnADefault) {
  for (const std::string& name : shipped().names()) {
    for (const config::Entry& e : shipped().load(name).entries) {
      // A repair is a departure from the device: none unless a user asks for it.
      if (e.key.rfind("firmware.repair_", 0) == 0) {
        EXPECT_EQ(e.value, "false") << name << " " << e.key;
        continue;
      }
      EXPECT_EQ(e.source.rfind("default:", 0), std::string::npos) << name << " " << e.key;
    }
  }
}

TEST(ShippedTypes, ThePapersMakerProHasTheValuesOfTableIWithTheErratumOnBackEmf) {
  const ActuatorType type = shipped().load("qbmove_maker_pro_paper");
  const device::UnitConfig& u = type.unit;
  const auto* springs = dynamic_cast<const elastic::TwoSinh*>(u.actuator.transmission.get());
  ASSERT_NE(springs, nullptr);
  EXPECT_EQ(springs->params().k_Nm, (std::array<double, 2>{0.022, 0.022}));
  EXPECT_EQ(springs->params().a_per_rad, (std::array<double, 2>{6.85, 6.85}));
  EXPECT_EQ(u.actuator.side[0].motor.inertia_kgm2, 0.001);
  EXPECT_EQ(u.actuator.side[0].motor.viscous_Nms_per_rad, 0.01);
  EXPECT_EQ(u.actuator.side[0].motor.torque_constant_Nm_per_A,
            1.02);  // of the program's matrix; the table's two contradict each other
  EXPECT_EQ(u.actuator.side[0].motor.resistance_Ohm, 2.3);
  EXPECT_FALSE(u.actuator.side[0].motor.inductance_H.has_value());
  EXPECT_EQ(u.actuator.side[0].gearbox.ratio, 1.0);
  EXPECT_EQ(u.actuator.side[0].gearbox.friction.coulomb_Nm, 0.8);
  EXPECT_EQ(u.actuator.side[0].gearbox.friction.presliding_rad, 0.03);
  EXPECT_EQ(u.actuator.supply_V, 12.0);
  EXPECT_EQ(u.actuator.side[0].bridge.dead_band, 0.3);
  EXPECT_TRUE(u.actuator.side[0].bridge.brake_when_off);
  EXPECT_EQ(u.actuator.shaft_friction.coulomb_Nm, 0.01);
  EXPECT_EQ(u.actuator.shaft_inertia_kgm2, 1e-4);
  EXPECT_EQ(u.actuator.side[0].encoder.bits, 12);
  EXPECT_EQ(u.actuator.side[0].polarity, 1);
  EXPECT_EQ(u.preset_max, 0.785);
  EXPECT_EQ(u.substep_max_s, 1e-3);
}

TEST(ShippedTypes, EveryMotorHasOneConstantSoThatNoEnergyIsLostBetweenItsTwoSides) {
  for (const std::string& name : shipped().names()) {
    const drive::MotorParams motor = shipped().load(name).unit.actuator.side[0].motor;
    EXPECT_EQ(motor.torque_constant_Nm_per_A, motor.back_emf_Vs_per_rad) << name;
  }
}

TEST(ShippedTypes, TheMakerProsFirmwareIsThePublishedDefault) {
  const device::UnitConfig unit = shipped().load("qbmove_maker_pro_6_1").unit;
  EXPECT_EQ(unit.memory, firmware::initial_memory(firmware::Model::maker_pro));
  EXPECT_EQ(unit.program.model, firmware::Model::maker_pro);
  EXPECT_EQ(unit.program.dialect, bus::Dialect::six);
  EXPECT_EQ(unit.program.repairs, firmware::Repairs{});
  EXPECT_TRUE(unit.supply_limited());
}

TEST(ShippedTypes, TheBackEmfConstantsSourceExplainsTheErratum) {
  for (const config::Entry& e : shipped().load("qbmove_maker_pro").entries) {
    if (e.key == "drive.back_emf_Vs_per_rad") expect_pieces(e.source, {"Erratum", "prints 0.3", "1.3"});
  }
}

TEST(ShippedTypes, TheRecordedMakerProAndTheUsersDifferInBridgeSupplyAndLoopAndInNothingElse) {
  const ActuatorType recorded = shipped().load("qbmove_maker_pro"), users = shipped().load("qbmove_maker_pro_6_1");
  const std::set<std::string> electronics{"drive.supply_V",          "drive.pwm_pin",       "drive.diode_V",
                                          "drive.inductance_H",      "firmware.generation", "firmware.kp_pct_per_tick",
                                          "firmware.kd_pct_per_tick"};
  std::map<std::string, std::string> values;
  for (const config::Entry& e : users.entries) values[e.key] = e.value;
  for (const config::Entry& e : recorded.entries) {
    if (electronics.count(e.key) == 0) {
      EXPECT_EQ(e.value, values[e.key]) << e.key;
    }
  }
}

TEST(ShippedTypes, TheMakerProHasNoDeadBandOfItsOwnAndTheFirmwaresBoundOnTheStiffness) {
  const device::UnitConfig unit = shipped().load("qbmove_maker_pro").unit;
  EXPECT_EQ(unit.memory.max_stiffness, 3000 << 1);
  EXPECT_EQ(unit.actuator.side[0].bridge.dead_band, 0.0);
  EXPECT_GT(unit.actuator.tendon.friction, 0.0);
}

TEST(ShippedTypes, TheDataSheetsSpringsDiffer) {
  const ActuatorType type = shipped().load("qbmove_maker_pro_datasheet");
  const auto* springs = dynamic_cast<const elastic::TwoSinh*>(type.unit.actuator.transmission.get());
  ASSERT_NE(springs, nullptr);
  EXPECT_EQ(springs->params().k_Nm, (std::array<double, 2>{0.0227, 0.0216}));
  EXPECT_EQ(springs->params().a_per_rad, (std::array<double, 2>{6.7328, 6.9602}));
}

TEST(ShippedTypes, TheAdvancedUnitRunsItsOwnProgramWithItsGainsAndWithoutASupplyLimit) {
  const device::UnitConfig u = shipped().load("qbmove_advanced").unit;
  EXPECT_EQ(u.program.model, firmware::Model::advanced);
  EXPECT_EQ(u.memory, firmware::initial_memory(firmware::Model::advanced));
  EXPECT_FALSE(u.supply_limited());
  EXPECT_EQ(u.actuator.side[0].motor.inertia_kgm2, 0.0233);
}

TEST(ShippedTypes, TheSeriesElasticExampleHasOneMotorAndNoPreset) {
  const device::UnitConfig u = shipped().load("sea_example").unit;
  EXPECT_EQ(u.actuator.transmission->motor_count(), 1);
  EXPECT_EQ(u.actuator.transmission->evaluate({.q = 0.1, .x = {}}).curvature.qq, 10.0);
  EXPECT_EQ(u.preset_max, 0.0);
}

TEST(ShippedTypes, EveryUnitTurnsAnUnloadedShaftToTheCommandAndStaysThere) {
  // Wrong signs of gains and polarity run away; the band is what dead band and gear friction leave of 0.5 rad.
  for (const std::string& name : shipped().names()) {
    device::UnitConfig unit = shipped().load(name).unit;
    if (unit.actuator.linear()) unit = device::at_pinion(unit, 0.05);
    OneJoint joint(unit, 0.0, 0.5 * unit.preset_max, 1e-3, 1'000'000);
    joint.load = [&joint](double) { return -0.01 * joint.v; };
    joint.unit.command(joint.state, 0.5, 0.5 * unit.preset_max);
    double lowest = 1e9, highest = -1e9;
    while (joint.t_ns < 4'000'000'000) {
      joint.step();
      if (joint.t_ns < 3'000'000'000) continue;
      lowest = std::min(lowest, joint.q);
      highest = std::max(highest, joint.q);
    }
    EXPECT_NEAR(lowest, 0.5, 0.12) << name;
    EXPECT_NEAR(highest, 0.5, 0.12) << name;
    EXPECT_LT(highest - lowest, 0.02) << name;
  }
}

TEST(ShippedTypes, GainsAreTruncatedTowardZeroAsTheFirmwaresCastDoes) {
  EXPECT_EQ(config::fixed_16_16(0.1), 6553);
  EXPECT_EQ(config::fixed_16_16(-0.1), -6553);
  EXPECT_EQ(config::fixed_16_16(0.8), 52428);
  EXPECT_EQ(config::fixed_16_16(1.0), 65536);
}

}  // namespace
}  // namespace vsa::test
