// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// [evidence]: what a type was calibrated on.
#include "support.hpp"

namespace vsa::test {
namespace {

using config::covers;
using config::Evidence;
using config::names_experiment;

/// sea_example, whose file has the table, with another one.
std::vector<Problem> told(const std::string& table) {
  const Directory directory("evidence");
  const std::string good = read(source_dir() / "actuators/sea_example.toml");
  const auto file = directory.write("sea_example.toml", good.substr(0, good.find("[evidence]")) + table);
  return problems_of([&] { (void)shipped().load_file(file); });
}

std::string listed(const std::string& value) { return "[evidence]\ncalibrated_on = { value = " + value + ", source = \"x\" }\n"; }

TEST(Evidence, OfAnExperimentCoversAllThatIsMeasuredInItAndNoOther) {
  const Evidence e{{"stiffness.0.6903", "preset_step.loaded"}, ""};
  EXPECT_TRUE(covers(e, "stiffness.0.6903") && covers(e, "stiffness.0.6903.rms_rad") && covers(e, "preset_step.loaded.up.rise_s"));
  EXPECT_FALSE(covers(e, "stiffness.0.69031.rms_rad") || covers(e, "stiffness.0.4602.rms_rad") || covers(e, "speed.0.6903.rise_s"));
  EXPECT_FALSE(covers({}, "stiffness.0.6903.rms_rad"));
}

TEST(Evidence, NamesAnExperimentAsItsMeasuresAreNamed) {
  EXPECT_EQ(config::experiment_name("stiffness", 0.6903), "stiffness.0.6903");
  for (const double preset : {0.0, 0.4602, 0.69030001, 12.5})
    EXPECT_TRUE(names_experiment(config::experiment_name("speed", preset)));
  for (const char* bad : {"stiffness.0.69", "stiffness.0.690300", "stiffness", "stiffness.", "stiffness..6903", "stiffness.00.6903",
                          "stiffness.0.6903.rms_rad", "speed.x.7500", "preset_step", "load.0.6903", ""}) {
    EXPECT_FALSE(names_experiment(bad)) << bad << ": would never match";
  }
}

TEST(Evidence, IsReadWithItsSource) {
  const config::ActuatorType type = shipped().load("qbmove_maker_pro");
  ASSERT_TRUE(type.evidence.has_value());
  EXPECT_FALSE(type.evidence->source.empty());
  for (const char* fitted : {"stiffness.0.0000.rms_rad", "stiffness.0.6903.rms_rad"}) EXPECT_TRUE(covers(*type.evidence, fitted));
}

TEST(Evidence, MayBeLeftOutAndMayBeEmpty) {
  EXPECT_TRUE(told("").empty());
  EXPECT_TRUE(told(listed("[]")).empty());
  EXPECT_FALSE(shipped().load("qbmove_maker_pro_paper").evidence.has_value());
  EXPECT_TRUE(shipped().load("sea_example").evidence->calibrated_on.empty());
}

TEST(Evidence, ThatIsWrongIsTold) {
  const auto expect = [](const std::string& table, const std::vector<std::string>& pieces, std::size_t problems = 1) {
    const auto found = told(table);
    EXPECT_EQ(found.size(), problems) << table << text_of(found);
    expect_pieces(text_of(found), pieces);
  };
  expect(listed("[\"stiffness.0.69\"]"),
         {"evidence.calibrated_on.value = \"stiffness.0.69\": names no experiment", "four decimals"});
  expect(listed("[3, \"speed.0.7500\"]"), {"= 3: names no experiment"});
  expect(listed("[\"speed.0.7500\", \"speed.0.7500\"]"), {"\"speed.0.7500\": is named twice"});
  expect(listed("\"speed.0.7500\""), {"must be a list"});
  expect("[evidence]\n", {"evidence.calibrated_on: is missing"});
  expect("[evidence]\ncalibrated_on = [\"speed.0.7500\"]\n", {"calibrated_on = an array: must be a table"});
  expect("[evidence]\ncalibrated_on = { value = [] }\n", {"calibrated_on.source: is missing"});
  expect("[evidence]\ncalibrated_on = { source = \"x\" }\n", {"calibrated_on.value: is missing"});
  expect("[evidence]\ncalibrated_on = { value = [], source = \" \" }\n", {"must be a text that is not empty"});
  expect("[evidence]\ncalibrated_on = { value = [], source = \"x\", unit = \"m\" }\n", {"calibrated_on.unit: unknown key"});
  expect("[evidence]\ncalibrated_onn = { value = [], source = \"x\" }\n", {"did you mean calibrated_on?"}, 2);
}

TEST(Evidence, IsNoParameterThatCouldBeOverridden) {
  const auto found = problems_of([] { (void)shipped().load("sea_example", {{"evidence.calibrated_on", "[]"}}); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].text().find("unknown key"), std::string::npos);
}

}  // namespace
}  // namespace vsa::test
