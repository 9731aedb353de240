// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A type whose law is made of a CSV file beside it.
#include <gtest/gtest.h>

#include <string>

#include "support.hpp"

namespace vsa::test {
namespace {

using config::ActuatorType;
using config::TypeLibrary;

constexpr const char* kGrid =
    "preset_rad,deflection_rad,load_torque_Nm,time_s\n"
    "0,-0.2,-1,0\n0,0.2,1,1\n0,0,0,2\n"
    "1,0,0,3\n1,0.2,3,4\n1,-0.2,-3,5\n";

std::string type_text(const std::string& grid = "grid.csv", const std::string& name = "mine") {
  return "[type]\nname = \"" + name + "\"\ntitle = \"mine\"\nbase = \"qbmove_maker_pro_paper\"\n[elastic]\nlaw = \"table\"\n" +
         "grid = { value = \"" + grid + "\", source = \"my bench\" }\n" +
         "torque_scale = { value = 2.0, unit = \"1\", bounds = [0.1, 10.0], source = \"test\" }\n" +
         "[limits]\npreset_max = { value = 1.0, unit = \"rad\", bounds = [0.0, 1.0], source = \"test\" }\n";
}

const config::Entry& entry(const ActuatorType& type, const std::string& key) {
  for (const config::Entry& e : type.entries)
    if (e.key == key) return e;
  throw std::runtime_error("no entry " + key);
}

TEST(TableType, ReadsTheGridBesideItsFileInAnyOrderOfColumnsAndRows) {
  const Directory directory("table");
  const auto grid = directory.write("grid.csv", kGrid);
  const ActuatorType type = shipped().load_file(directory.write("mine.toml", type_text()));
  const auto& law = *type.unit.actuator.transmission;
  EXPECT_NEAR(law.evaluate({0.1, {0, 0}}).torque, -1, 1e-12);
  EXPECT_NEAR(law.evaluate({0.1, {0, 0.5}}).torque, -2, 1e-12);
  EXPECT_EQ(law.preset_unit(), "rad");
  EXPECT_EQ(entry(type, "elastic.grid").value, grid.string());
  EXPECT_EQ(entry(type, "elastic.grid").kind, config::Kind::file);
  EXPECT_EQ(entry(type, "elastic.grid").source, "my bench");
  ASSERT_EQ(type.remarks.size(), 1u);
  expect_pieces(type.remarks[0], {"3 deflections from -0.2 to 0.2 rad, 2 presets", "largest distance from a point: 0 N·m"});
  EXPECT_EQ(shipped()
                .load_file(directory.path() / "mine.toml", {{"elastic.torque_scale", "4"}})
                .unit.actuator.transmission->evaluate({0.1, {0, 0}})
                .torque,
            2 * law.evaluate({0.1, {0, 0}}).torque);
}

TEST(TableType, OfABaseReadsTheGridBesideTheBase) {
  const Directory directory("table_base"), elsewhere("table_derived");
  directory.write("grid.csv", kGrid);
  directory.write("mine.toml", type_text());
  const auto file = elsewhere.write("other.toml", "[type]\nname = \"other\"\ntitle = \"other\"\nbase = \"mine\"\n");
  const ActuatorType type = TypeLibrary({directory.path(), source_dir() / "actuators"}).load_file(file);
  EXPECT_EQ(entry(type, "elastic.grid").value, (directory.path() / "grid.csv").string());
}

TEST(TableType, WithoutAPresetColumnHasNoPreset) {
  const Directory directory("table_single");
  directory.write("grid.csv", "load_torque_Nm,deflection_rad\n0,0\n1,0.1\n3,0.2\n");
  std::string text = type_text();
  text.erase(text.find("[limits]"));
  const ActuatorType type = shipped().load_text(text, directory.path() / "mine.toml");
  EXPECT_EQ(type.unit.actuator.transmission->preset_unit(), "");
  EXPECT_EQ(type.unit.preset_max, 0);
  expect_pieces(type.remarks.at(0), {"1 preset, one side, of which the other is the mirror image"});
}

TEST(TableType, TellsFileLineAndWhatIsAllowedOfABadGrid) {
  const Directory directory("table_bad");
  const auto file = directory.write("mine.toml", type_text());
  const auto told = [&](const std::string& grid) {
    directory.write("grid.csv", grid);
    const auto problems = problems_of([&] { (void)shipped().load_file(file); });
    EXPECT_LE(problems.size(), 2u) << text_of(problems);
    return text_of(problems);
  };
  const std::string good = kGrid;
  expect_pieces(told(replaced(good, "0,0.2,1,1", "0,0.2,nan,1")),
                {"grid.csv:3: load_torque_Nm = nan: not a number", "a finite number"});
  expect_pieces(told(replaced(good, "0,0.2,1,1", "0,200,1,1")), {"grid.csv:3: deflection_rad = 200: is outside", "-100 … 100"});
  expect_pieces(told(replaced(good, "0,0.2,1,1", "0,0.2,-2,1")), {"grid.csv:3: elastic.grid: the torque falls from 0 to -2 N·m"});
  expect_pieces(told(replaced(good, "0,0.2,1,1", "0,0,1,1")),
                {"grid.csv:4: elastic.grid: two torques", "of its branches give the mean"});
  expect_pieces(told(replaced(good, "0,0.2,1,1\n", "")),
                {"elastic.grid: at preset 0 rad there is no point at deflection 0.2 rad", "a whole grid"});
  expect_pieces(told(replaced(good, "load_torque_Nm", "load_torque_Ncm")),
                {"grid.csv:1: column", "load_torque_Ncm", "load_torque_Nm"});
  expect_pieces(told(replaced(good, "deflection_rad", "deflection_deg")), {"the column's unit isn't the expected one"});
  expect_pieces(told("deflection_rad,load_torque_Nm\n"), {"grid.csv: has no rows"});
  expect_pieces(told(""), {"the file is empty"});
}

TEST(TableType, RefusesAFileThatIsNoneAndAnOverrideOfIt) {
  const Directory directory("table_none");
  directory.write("grid.csv", kGrid);
  const auto told = [&](const std::string& text, const std::vector<config::Override>& overrides = {}) {
    return text_of(problems_of([&] { (void)shipped().load_text(text, directory.path() / "mine.toml", overrides); }));
  };
  expect_pieces(told(type_text("gird.csv")), {"gird.csv: there is no such file"});
  expect_pieces(told(type_text(".")), {"this is a directory"});
  expect_pieces(told(replaced(type_text(), "\"grid.csv\"", "3")),
                {"mine.toml:7: elastic.grid = 3: must be the name of a file",
                 "a CSV file with deflection_rad, load_torque_Nm, preset_rad (optional)"});
  expect_pieces(told(replaced(type_text(), "source = \"my bench\"", "unit = \"1\", source = \"x\"")),
                {"elastic.grid.unit", "not a number"});
  expect_pieces(told(replaced(type_text(), "grid = {", "grit = {")),
                {"elastic.grid: is missing (CSV file of a whole grid", "elastic.grit: unknown key, did you mean elastic.grid?"});
  expect_pieces(told(type_text(), {{"elastic.grid", "other.csv"}}),
                {"override elastic.grid = \"other.csv\": a file can't be overridden: use another type"});
}

}  // namespace
}  // namespace vsa::test
