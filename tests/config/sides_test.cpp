// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// [drive_2] and [sensor_2]: what the second motor has otherwise; and the lead of an input that is a travel.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "config/support.hpp"
#include "vsa/config/schema.hpp"
#include "vsa/elastic/travel.hpp"

namespace vsa::test {
namespace {

using config::ActuatorType;

std::string maker_pro_with(const std::string& more) { return read(source_dir() / "actuators/qbmove_maker_pro_paper.toml") + more; }

ActuatorType load(const std::string& more, const std::vector<config::Override>& overrides = {}) {
  return shipped().load_text(maker_pro_with(more), "qbmove_maker_pro_paper.toml", overrides);
}

TEST(SecondSide, HasTheFirstsNumbersButThoseOfItsOwnTables) {
  const auto type = load(
      "\n[drive_2]\n"
      "friction_Nm = { value = 0.3, unit = \"N·m\", bounds = [0.0, 1.0], source = \"another motor\" }\n"
      "off_mode = { value = \"coast\", source = \"another bridge\" }\n"
      "[sensor_2]\n"
      "encoder_bits = { value = 14, unit = \"bit\", bounds = [1, 16], source = \"another encoder\" }\n");
  const auto& [first, second] = type.unit.actuator.side;
  actuator::SideParams expected = first;
  expected.gearbox.friction.coulomb_Nm = 0.3;
  expected.bridge.brake_when_off = false;
  expected.encoder.bits = 14;
  EXPECT_EQ(second, expected);
  EXPECT_EQ(first.gearbox.friction.coulomb_Nm, 0.8);
  EXPECT_EQ(type.unit.actuator.shaft_encoder.bits, 12);
  const auto entry = [&](const char* key) {
    return std::find_if(type.entries.begin(), type.entries.end(), [&](const config::Entry& e) { return e.key == key; });
  };
  ASSERT_NE(entry("drive_2.friction_Nm"), type.entries.end());
  EXPECT_EQ(entry("drive_2.friction_Nm")->source, "another motor");
  EXPECT_LT(entry("drive.polarity"), entry("drive_2.friction_Nm")) << "listed behind the first side's";
  EXPECT_LT(entry("drive_2.friction_Nm"), entry("shaft.friction_Nm"));
  EXPECT_EQ(entry("drive_2.inertia_kgm2"), type.entries.end()) << "what isn't given isn't listed";
}

TEST(SecondSide, EveryKeyCanBeOverriddenAndChangesNothingElse) {
  const auto base = shipped().load("qbmove_maker_pro_6_1").unit;
  int keys = 0;
  for (const config::Parameter& p : config::parameters()) {
    if (!p.second || p.key == "drive_2.lead_m_per_rad") continue;
    ++keys;
    const std::string value = p.kind == config::Kind::word ? std::string(p.words.substr(0, p.words.find('|'))) : "0.5";
    const auto with = [&](const std::string& v) { return shipped().load("qbmove_maker_pro_6_1", {{std::string(p.key), v}}).unit; };
    auto unit = base;
    if (p.kind == config::Kind::word) {
      const std::string other(p.words.substr(p.words.find('|') + 1));
      EXPECT_NE(with(value).actuator.side[1] == with(other == "enable" ? value : other).actuator.side[1], other != "enable")
          << p.key;
      continue;
    }
    const std::string text = p.key == "drive_2.pwm_period_s" ? "0.0005" : p.kind == config::Kind::integer ? "7" : value;
    unit = with(text);
    EXPECT_NE(unit.actuator.side[1], base.actuator.side[1]) << p.key;
    unit.actuator.side[1] = base.actuator.side[1];
    unit.actuator.transmission = base.actuator.transmission;
    EXPECT_EQ(unit, base) << p.key << " is of the second side only";
  }
  EXPECT_EQ(keys, 20);
}

TEST(SecondSide, KeepsItsOwnWhereTheFirstIsOverridden) {
  const auto type = shipped().load("qbmove_maker_pro_6_1", {{"drive_2.friction_Nm", "0.4"}, {"drive.friction_Nm", "0.5"}});
  EXPECT_EQ(type.unit.actuator.side[0].gearbox.friction.coulomb_Nm, 0.5);
  EXPECT_EQ(type.unit.actuator.side[1].gearbox.friction.coulomb_Nm, 0.4);
}

TEST(SecondSide, IsRefusedWhereTheLawHasOneMotorAndWhereThereIsOneForBoth) {
  const auto refused = [](const char* type, const char* key, const char* value) {
    const auto problems = problems_of([&] { (void)shipped().load(type, {{key, value}}); });
    EXPECT_EQ(problems.size(), 1U) << text_of(problems);
    return text_of(problems);
  };
  expect_pieces(refused("sea_example", "drive_2.friction_Nm", "0.5"),
                {"drive_2.friction_Nm", "the law has one motor: leave this out"});
  expect_pieces(refused("qbmove_maker_pro", "drive_2.supply_V", "12"), {"drive_2.supply_V", "unknown key"});
  expect_pieces(refused("qbmove_maker_pro", "drive_2.frction_Nm", "1"), {"did you mean drive_2.friction_Nm"});
  expect_pieces(refused("qbmove_maker_pro", "drive_2.friction_Nm", "-1"), {"drive_2.friction_Nm", "0 … 1000"});
  expect_pieces(refused("qbmove_maker_pro", "drive_2.lead_m_per_rad", "0.01"), {"is an angle: leave this out"});
}

TEST(SecondSide, OfABaseIsInheritedWhereTheLawHasOne) {
  const Directory directory("second");
  directory.write("two.toml",
                  "[type]\nname = \"two\"\ntitle = \"x\"\nbase = \"qbmove_maker_pro_paper\"\n[drive_2]\n"
                  "friction_Nm = { value = 0.3, unit = \"N·m\", bounds = [0.0, 1.0], source = \"x\" }\n");
  directory.write("again.toml", "[type]\nname = \"again\"\ntitle = \"x\"\nbase = \"two\"\n");
  directory.write("one.toml",
                  "[type]\nname = \"one\"\ntitle = \"x\"\nbase = \"two\"\n[elastic]\nlaw = \"series_spring\"\n"
                  "stiffness_Nm_per_rad = { value = 10.0, unit = \"N·m/rad\", bounds = [1.0, 100.0], source = \"x\" }\n");
  const config::TypeLibrary library({directory.path(), source_dir() / "actuators"});
  EXPECT_EQ(library.load("again").unit.actuator.side[1].gearbox.friction.coulomb_Nm, 0.3);
  const auto problems = problems_of([&] { (void)library.load("one"); });
  EXPECT_TRUE(problems.empty()) << text_of(problems);
}

TEST(SecondSide, OfAModulatedEnablePinNeedsAnInductanceAndSaysWhoseKey) {
  const auto problems = problems_of([] {
    (void)shipped().load("qbmove_maker_pro_6_1", {{"drive_2.pwm_pin", "enable"}, {"drive_2.pwm_period_s", "5e-5"}});
  });
  ASSERT_EQ(problems.size(), 1U) << text_of(problems);
  expect_pieces(problems[0].text(), {"drive_2.inductance_H", "needs the winding's inductance"});
}

TEST(SecondSide, WhatTheFirstHasWrongIsntToldAgain) {
  std::string text =
      maker_pro_with("\n[drive_2]\nfriction_Nm = { value = 0.3, unit = \"N·m\", bounds = [0.0, 1.0], source = \"x\" }\n");
  text = replaced(text, "inertia_kgm2", "inertja_kgm2");
  const auto problems = problems_of([&] { (void)shipped().load_text(text, "qbmove_maker_pro_paper.toml"); });
  ASSERT_EQ(problems.size(), 2U) << text_of(problems);  // unknown, and missing
  for (const Problem& p : problems) EXPECT_EQ(p.key.rfind("drive.", 0), 0U) << p.text();
}

/// Springs to motor 1, and motor 2 on a screw.
class Screwed final : public elastic::Transmission {
 public:
  [[nodiscard]] elastic::Response evaluate(const elastic::Positions& at) const noexcept override {
    const double d = at.q - at.x[0], k = 1 + 100 * at.x[1] * at.x[1];
    elastic::Response r{};
    r.energy = 0.5 * k * d * d, r.torque = -k * d, r.load = {k * d, -100 * at.x[1] * d * d};
    r.curvature = {.qq = k, .qx = {-k, 200 * at.x[1] * d}, .xx = {k, 100 * d * d}, .x0x1 = -200 * at.x[1] * d};
    return r;
  }
  [[nodiscard]] std::array<double, 2> references(const elastic::EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium, c.preset};
  }
  [[nodiscard]] elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override { return {x[0], x[1]}; }
  [[nodiscard]] std::string_view preset_unit() const noexcept override { return "m"; }
  [[nodiscard]] std::string_view input_unit(std::size_t input) const noexcept override { return input == 1 ? "m" : "rad"; }
};

std::vector<Problem> load_screwed(const std::string& lead, ActuatorType* out = nullptr) {
  const Directory directory("screwed");
  directory.write("screwed.toml",
                  "[type]\nname = \"screwed\"\ntitle = \"x\"\nbase = \"sea_example\"\n[elastic]\nlaw = \"screwed\"\n[limits]\n"
                  "preset_max = { value = 0.05, unit = \"m\", bounds = [0.0, 1.0], source = \"x\" }\n" +
                      lead);
  auto laws = config::LawRegistry::standard();
  laws.add("screwed", [](config::LawReader&) { return std::make_shared<Screwed>(); });
  const config::TypeLibrary library({directory.path(), source_dir() / "actuators"}, laws);
  return problems_of([&] {
    const ActuatorType type = library.load("screwed");
    if (out != nullptr) *out = type;
  });
}

TEST(Lead, MakesAnAngleOfATravelAndIsRequiredForIt) {
  const std::string row = "lead_m_per_rad = { value = 0.002, unit = \"m/rad\", bounds = [1e-4, 1e-2], source = \"x\" }\n";
  for (const char* table : {"[drive]\n", "[drive_2]\n"}) {
    ActuatorType type;
    const auto problems = load_screwed(table + row, &type);
    ASSERT_TRUE(problems.empty()) << text_of(problems);
    const auto x = type.unit.actuator.transmission->references({0.3, 0.01});
    EXPECT_EQ(x[0], 0.3);
    EXPECT_DOUBLE_EQ(x[1], 5) << "radians of the pulley";
    EXPECT_EQ(type.unit.preset_max, 0.05);
  }
  const auto missing = load_screwed("");
  ASSERT_EQ(missing.size(), 1U) << text_of(missing);
  expect_pieces(missing[0].text(), {"drive_2.lead_m_per_rad", "input 2 of the law is a travel"});
}

}  // namespace
}  // namespace vsa::test
