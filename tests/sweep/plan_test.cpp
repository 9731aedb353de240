// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "plans.hpp"

namespace vsa::sweep::testing {
namespace {

double number(const Value& v) { return std::get<double>(v); }

TEST(Plan, TheLastListGoesFastestAndRepetitionsAreInnermost) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, "repetitions = 3\n" + kScenario + kMeasure + R"(
[[vary]]
key = "scenario.world"
list = ["bench_load", "bench_free"]
[[vary]]
key = "set.drive.friction_Nm"
name = "friction_Nm"
range = [0.1, 0.5]
count = 5
[[vary]]
key = "set.drive.supply_V"
log = [8.0, 32.0]
count = 3
)");
  EXPECT_EQ(plan.points(), 2U * 5 * 3);
  EXPECT_EQ(plan.runs(), 3U * 30);
  EXPECT_EQ(plan.axes()[0].name, "scenario.world");
  EXPECT_EQ(plan.axes()[1].name, "friction_Nm");
  EXPECT_EQ(value_text(plan.values(0)[0]), "bench_load");
  EXPECT_EQ(value_text(plan.values(15)[0]), "bench_free");
  EXPECT_EQ(number(plan.values(0)[1]), 0.1);
  EXPECT_DOUBLE_EQ(number(plan.values(3 * 2)[1]), 0.3);
  EXPECT_EQ(number(plan.values(3 * 4)[1]), 0.5) << "exact at the end";
  EXPECT_EQ(number(plan.values(0)[2]), 8);
  EXPECT_DOUBLE_EQ(number(plan.values(1)[2]), 16);
  EXPECT_EQ(number(plan.values(2)[2]), 32);
  EXPECT_NE(plan.scenario_text(4).find("friction_Nm' = 0.1"), std::string::npos) << plan.scenario_text(4);
}

const std::string kDrawn = R"(
samples = 256
)" + kScenario + kMeasure +
                           R"(
[[vary]]
key = "drive.friction_Nm"
random = [0.1, 0.4]
[[vary]]
key = "drive.supply_V"
random = [20.0, 0.5]
law = "normal"
[[vary]]
key = "link.mass_kg"
of = "qbmove_bench_load::flange"
random = [0.01, 1.0]
law = "log_uniform"
[[vary]]
key = "set.drive.resistance_Ohm"
sobol = [2.0, 4.0]
[[vary]]
key = "set.drive.armature_kgm2"
sobol = [0.0, 1.0]
)";

TEST(Plan, DrawsKeepTheirBoundsAndRepeat) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kDrawn), again = plan_of(scratch, kDrawn), other = plan_of(scratch, "seed = 2\n" + kDrawn);
  ASSERT_EQ(plan.points(), 256U);
  double sum = 0, logs = 0, supply = 0, spread = 0;
  int differ = 0;
  for (std::size_t p = 0; p < 256; ++p) {
    const auto v = plan.values(p);
    EXPECT_EQ(v, again.values(p));
    differ += v == other.values(p) ? 0 : 1;
    EXPECT_TRUE(number(v[0]) >= 0.1 && number(v[0]) <= 0.4);
    EXPECT_TRUE(number(v[2]) >= 0.01 && number(v[2]) <= 1.0);
    sum += number(v[0]) / 256;
    supply += number(v[1]) / 256;
    spread += std::pow(number(v[1]) - 20, 2) / 256;
    logs += std::log10(number(v[2])) / 256;
  }
  EXPECT_EQ(differ, 256);
  EXPECT_NEAR(sum, 0.25, 4 * 0.3 / std::sqrt(12 * 256));
  EXPECT_NEAR(supply, 20, 4 * 0.5 / 16);
  EXPECT_NEAR(std::sqrt(spread), 0.5, 0.1);
  EXPECT_NEAR(logs, -1, 4 * 2 / std::sqrt(12 * 256));
}

/// Each of 16 × 16 boxes has one of the first 256 points of a Sobol' sequence in two dimensions, but for its corner, left out here.
TEST(Plan, SobolPointsFillTheSquareEvenly) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kDrawn);
  std::set<std::pair<int, int>> boxes;
  for (std::size_t p = 0; p < 255; ++p) {
    const auto v = plan.values(p);
    boxes.emplace(static_cast<int>((number(v[3]) - 2) * 8), static_cast<int>(number(v[4]) * 16));
  }
  EXPECT_EQ(boxes.size(), 255U);
  EXPECT_EQ(boxes.count({0, 0}), 0U);
  EXPECT_EQ(number(plan.values(0)[3]), 3.0);
  EXPECT_EQ(number(plan.values(0)[4]), 0.5);
}

TEST(Plan, ItsFingerprintIsThatOfWhatItSaysAndOfTheFilesThatItNames) {
  const Scratch scratch;
  const std::string text = kScenario + kMeasure;
  const auto print = [&](const std::string& of) { return plan_of(scratch, of).fingerprint(); };
  EXPECT_EQ(print(text), print("# a remark\n\n" + text));
  EXPECT_NE(print(text), print("seed = 2\n" + text));
  const std::string own = "\n[scenario]\nworld = \"own.sdf\"\nduration_s = 0.05\n" + kMeasure;
  scratch.write("own.sdf", "<sdf version=\"1.9\"/>");
  const auto before = print(own);
  scratch.write("own.sdf", "<sdf version=\"1.9\"></sdf>");
  EXPECT_NE(before, print(own));
}

TEST(Plan, AnMjcfsActuatorsAndTheTypesThatAWorldNamesAreSuchFiles) {
  const Scratch scratch;
  setenv("VSA_ACTUATOR_PATH", (scratch / "").c_str(), 1);
  const auto own = [&](const std::string& world) {
    const std::string text = "\n[scenario]\nworld = \"" + world + "\"\nduration_s = 0.05\n" + kMeasure;
    return plan_of(scratch, text).fingerprint();
  };
  scratch.write("a.xml", "<mujoco/>");
  scratch.write("a.vsa.xml", "<actuator><type>mine</type></actuator>");
  scratch.write("b.sdf", "<actuator name='a'><type> mine </type></actuator>");
  scratch.write("mine.toml", "[type]\nname = \"mine\"\n");
  const auto mjcf = own("a.xml"), sdf = own("b.sdf");
  scratch.write("mine.toml", "[type]\nname = \"mine\"\n# another\n");
  EXPECT_NE(mjcf, own("a.xml"));
  EXPECT_NE(sdf, own("b.sdf"));
  const auto other_type = own("a.xml");
  scratch.write("a.vsa.xml", "<actuator><type>sea_example</type></actuator>");
  EXPECT_NE(other_type, own("a.xml"));
  unsetenv("VSA_ACTUATOR_PATH");
}

TEST(Plan, WhatItNamesIsBesideItWhereverItsScenarioIs) {
  const Scratch scratch;
  fs::create_directories(scratch / "a");
  fs::create_directories(scratch / "b");
  const auto gait = [](const char* amplitude) {
    return "[group.shaft]\nkind = \"sine\"\namplitude_deg = " + std::string(amplitude) + "\n";
  };
  scratch.write("b/s.toml", kScenario + "[motion]\nfile = \"of_scenario.toml\"\n");
  scratch.write("b/of_scenario.toml", gait("1.0"));
  scratch.write("a/of_plan.toml", gait("2.0"));
  scratch.write("b/of_plan.toml", gait("3.0"));
  const auto said = [&](const std::string& more) {
    const Plan plan = Plan::load(scratch.write("a/p.toml", "scenario = \"../b/s.toml\"\n" + more + kMeasure));
    try {
      return plan.scenario_text(0);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  const auto names = [&](const std::string& text, const fs::path& file) {
    return text.find(fs::absolute(file).string()) != text.npos;
  };
  EXPECT_TRUE(names(said(""), scratch / "b/of_scenario.toml") || names(said(""), scratch / "a/../b/of_scenario.toml")) << said("");
  const std::string own = "[motion]\nfile = \"of_plan.toml\"\n",
                    varied = "[[vary]]\nkey = \"motion.file\"\nlist = [\"of_plan.toml\"]\n";
  EXPECT_TRUE(names(said(own), scratch / "a/of_plan.toml")) << said(own);
  EXPECT_TRUE(names(said(varied), scratch / "a/of_plan.toml")) << said(varied);
  const auto print = [&] { return Plan::load(scratch / "a/p.toml").fingerprint(); };
  for (const std::string& plan : {own, varied}) {
    static_cast<void>(said(plan));
    scratch.write("a/of_plan.toml", gait("2.0"));
    const auto before = print();
    scratch.write("b/of_plan.toml", gait("4.0"));
    EXPECT_EQ(print(), before);
    scratch.write("a/of_plan.toml", gait("5.0"));
    EXPECT_NE(print(), before);
  }
  const std::string nowhere = said("[[vary]]\nkey = \"scenario.world\"\nlist = [\"nowhere.sdf\"]\n");
  EXPECT_EQ(nowhere.rfind((scratch / "a/p.toml").string() + ": scenario.world = nowhere.sdf: no such file", 0), 0U) << nowhere;
}

TEST(Plan, SeedsOfRepetitionsAreSeeds) {
  const Scratch scratch;
  const std::string faults = "\n[scenario]\nworld = \"bench_load\"\nduration_s = 0.05\nfaults = [\"shaft noise_rad=0.01\"]\n";
  const Plan plan = plan_of(scratch, "seed = 1000000000000000\nrepetitions = 2\n" + faults + kMeasure);
  EXPECT_NE(plan.scenario_text(0).find("seed = 1000000000000000"), std::string::npos) << plan.scenario_text(0);
  EXPECT_NE(plan.scenario_text(1).find("seed = 1000002"), std::string::npos) << plan.scenario_text(1);
}

TEST(Plan, RecordingsAndATypesGridAreSuchFiles) {
  const Scratch scratch;
  const std::string fit =
      "\n[study]\nkind = \"fit\"\ntype = \"sea_example\"\nparameters = [\"elastic.stiffness_Nm_per_rad\"]\n"
      "recordings = [\"a_points.csv\"]\n[[measure]]\nname = \"k\"\nvalue = \"cost\"\n";
  const auto print = [&](const std::string& of) { return plan_of(scratch, of).fingerprint(); };
  const std::string points = "load_torque_Nm,deflection_rad\n0,0\n1,0.01\n2,0.02\n";
  scratch.write("a_points.csv", points);
  const auto before = print(fit);
  EXPECT_EQ(before, print(fit));
  scratch.write("a_points.csv", points + "3,0.03\n");
  EXPECT_NE(before, print(fit));
  const std::string of_grid = "\n[scenario]\nworld = \"bench_free\"\ntype = \"mine\"\nduration_s = 0.05\n" + kMeasure;
  scratch.write("mine.toml", "[type]\nname = \"mine\"\n[elastic]\nlaw = \"table\"\ngrid = { value = \"g.csv\", source = \"s\" }\n");
  scratch.write("g.csv", "1\n");
  setenv("VSA_ACTUATOR_PATH", (scratch / "").c_str(), 1);
  const auto first_grid = print(of_grid);
  scratch.write("g.csv", "2\n");
  EXPECT_NE(first_grid, print(of_grid));
  unsetenv("VSA_ACTUATOR_PATH");
}

TEST(Plan, ATypeOfTheSearchPathAndItsBaseAreSuchFiles) {
  const Scratch scratch;
  const std::string type = "\n[scenario]\nworld = \"bench_free\"\ntype = \"mine\"\nduration_s = 0.05\n" + kMeasure;
  const std::string mine = "[type]\nname = \"mine\"\nbase = \"first\"\n", first = "[type]\nname = \"first\"\n";
  scratch.write("mine.toml", mine);
  scratch.write("first.toml", first);
  setenv("VSA_ACTUATOR_PATH", (scratch / "").c_str(), 1);
  const auto print = [&] { return plan_of(scratch, type).fingerprint(); };
  const auto before = print();
  scratch.write("first.toml", first + "# another\n");
  const auto other_base = print();
  scratch.write("mine.toml", mine + "# another\n");
  EXPECT_NE(before, other_base);
  EXPECT_NE(other_base, print());
  unsetenv("VSA_ACTUATOR_PATH");
}

TEST(Plan, AScenariosFileIsTheBaseAndThePlansTablesReplaceItsOwn) {
  const Scratch scratch;
  scratch.write("base.toml",
                kScenario + "topics = false\nview = true\n[set]\n\"drive.friction_Nm\" = 0.2\n[record]\ndirectory = \"x\"\n");
  const Plan plan = plan_of(scratch, "scenario = \"base.toml\"\n" + kMeasure);
  EXPECT_NE(plan.scenario_text(0).find("0.2"), std::string::npos);
  const Plan changed = plan_of(scratch, "scenario = \"base.toml\"\n[set]\n\"drive.friction_Nm\" = 0.3\n" + kMeasure);
  EXPECT_EQ(changed.scenario_text(0).find("0.2"), std::string::npos);
  EXPECT_NE(changed.scenario_text(0).find("0.3"), std::string::npos);
}

struct Bad {
  const char* name;
  std::string text, told;
  bool with_worlds = false;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }  // NOLINT(readability-identifier-naming): GoogleTest calls it

class BadPlan : public ::testing::TestWithParam<Bad> {};

std::string vary(const std::string& text) { return kScenario + kMeasure + "[[vary]]\n" + text; }
std::string measure(const std::string& text) { return kScenario + "[[measure]]\nname = \"m\"\n" + text; }

TEST_P(BadPlan, IsRefusedWithItsReason) {
  const Scratch scratch;
  const std::string told = refusal(scratch, GetParam().text, GetParam().with_worlds);
  EXPECT_NE(told.find(GetParam().told), std::string::npos) << told;
}

INSTANTIATE_TEST_SUITE_P(
    Plan, BadPlan,
    ::testing::Values(
        Bad{"NotToml", "repetitions = = 3", "plan.toml:1"}, Bad{"NoScenario", kMeasure, "scenario: is missing"},
        Bad{"NoMeasure", kScenario, "measure: is missing"},
        Bad{"UnknownKey", "repetition = 3\n" + kScenario + kMeasure, "repetition: unknown key, did you mean repetitions?"},
        Bad{"EmptyRange", vary("key = \"set.drive.friction_Nm\"\nrange = [0.1, 0.1]\ncount = 3"), "is empty"},
        Bad{"RangeWithoutCount", vary("key = \"set.drive.friction_Nm\"\nrange = [0.1, 0.2]"), "vary.count: is missing"},
        Bad{"EmptyList", vary("key = \"set.drive.friction_Nm\"\nlist = []"), "isn't a list with values"},
        Bad{"LogOfNothing", vary("key = \"set.drive.friction_Nm\"\nlog = [0.0, 1.0]\ncount = 3"), "numbers above 0"},
        Bad{"NoValues", vary("key = \"set.drive.friction_Nm\""), "nothing says which values"},
        Bad{"TwoKindsOfValues", vary("key = \"set.drive.friction_Nm\"\nlist = [1.0]\nrandom = [0.0, 1.0]"),
            "several say which values"},
        Bad{"DrawsWithoutSamples", vary("key = \"set.drive.friction_Nm\"\nrandom = [0.0, 1.0]"), "samples: is missing"},
        Bad{"SamplesOfNothing", "samples = 3\n" + kScenario + kMeasure, "no axis is drawn"},
        Bad{"FactorOfAWord", vary("key = \"drive.off_mode\"\nfactor = true\nlist = [\"coast\"]"), "a factor is a number"},
        Bad{"MixedKeys", vary("key = [\"set.drive.friction_Nm\", \"link.mass_kg\"]\nlist = [1.0]"), "mixes"},
        Bad{"WhatChangesNoNumber", vary("key = \"scenario.view\"\nlist = [true]"), "changes none of a run's numbers"},
        Bad{"TooMany", "repetitions = 1000000\n" + vary("key = \"set.drive.friction_Nm\"\nrange = [0.1, 0.2]\ncount = 1000000"),
            "runs are more than a plan may have (allowed: at most 10000000)"},
        Bad{"TwoColumnsOfAName", kScenario + kMeasure + kMeasure, "two columns of one name"},
        Bad{"ColumnPoint", measure("signal = \"supply_J\"") + "\n[[measure]]\nname = \"point\"\nsignal = \"supply_J\"",
            "two columns of one name"},
        Bad{"ColumnNotice", measure("signal = \"supply_J\"") + "\n[[measure]]\nname = \"notice\"\nsignal = \"supply_J\"",
            "two columns of one name"},
        Bad{"ColumnThatHdf5HasNot", kScenario + kMeasure + "[[measure]]\nname = \".\"\nsignal = \"supply_J\"",
            "no column's name in HDF5"},
        Bad{"ColumnWithAControlCharacter",
            measure("signal = \"supply_J\"") + "\n[[measure]]\nname = \"a\\u0000b\"\nsignal = \"supply_J\"",
            "no column's name in HDF5"},
        Bad{"AKeyOfTwoAxes",
            vary("name = \"a\"\nkey = \"drive.supply_V\"\nlist = [6, 12]\n[[vary]]\nkey = \"drive.supply_V\"\nlist = [8]"),
            "vary.key = drive.supply_V: is varied twice"},
        Bad{"AKeyOfTheTypeAndOfAll",
            vary("key = \"set.drive.supply_V\"\nlist = [6]\n[[vary]]\nkey = \"drive.supply_V\"\nlist = [8]"), "is varied twice"},
        Bad{"AFactorOfWhatIsListed",
            vary("key = \"drive.supply_V\"\nlist = [6]\n[[vary]]\nname = \"f\"\nkey = \"drive.supply_V\"\nfactor = true\nlist = "
                 "[1.1]"),
            "is varied twice"},
        Bad{"AFloatInTheMiddleOfAList", vary("key = \"drive.supply_V\"\nlist = [10.0, -1.0, 12.0]"), "(with drive.supply_V = -1)",
            true},
        Bad{"TrueForANumber", vary("key = \"drive.supply_V\"\nlist = [10, true]"), "plan.toml: shaft: drive.supply_V = \"true\"",
            true},
        Bad{"TrueForALink", vary("key = \"link.mass_kg\"\nof = \"qbmove_bench_load::flange\"\nlist = [1.0, true]"),
            "true: isn't a number", true},
        Bad{"UnknownStatistic", measure("signal = \"supply_J\"\nstatistic = \"average\""), "statistic = average"},
        Bad{"SettleWithoutBand", measure("signal = \"shaft_rad\"\nstatistic = \"settle_s\"\nactuator = \"shaft\""),
            "measure.band: is missing"},
        Bad{"LastOfAll", measure("signal = \"shaft_rad\""), "needs one actuator"},
        Bad{"NoTimeLeft", measure("signal = \"supply_J\"\nfrom_s = 2.0\nto_s = 1.0"), "no time is left"},
        Bad{"OfTwoThings", measure("signal = \"shaft_rad\"\nactuator = \"shaft\"\nlink = \"x\""), "of one thing"},
        Bad{"NoDuration", "[scenario]\nworld = \"bench_load\"\n" + kMeasure, "duration_s: is missing", true},
        Bad{"UnknownSignal", measure("signal = \"supply_W\""), "supply_W: there is none of that name, did you mean supply_J", true},
        Bad{"UnknownActuator", measure("signal = \"shaft_rad\"\nactuator = \"elbow\""), "elbow", true},
        Bad{"NothingFliesFree", measure("signal = \"travel_net_m\""), "no robot of this world flies free", true},
        Bad{"NothingToStartElsewhere", kScenario + kMeasure + "[start]\nyaw_deg = 2.0\n", "no robot of this world flies free",
            true},
        Bad{"UnknownScenarioKey", vary("key = \"scenario.worlds\"\nlist = [\"bench_load\"]"), "worlds", true},
        Bad{"NoCommand", vary("key = \"command.0.preset_rad\"\nlist = [0.1]"), "the scenario has no commands", true},
        Bad{"ValueOutOfBoundsAtItsEnd", vary("key = \"set.drive.friction_Nm\"\nrange = [0.1, 1e9]\ncount = 3"),
            "(with set.drive.friction_Nm = 1000000000)", true},
        Bad{"UnknownParameter", vary("key = \"drive.frictions\"\nlist = [0.1]"), "drive.frictions", true},
        Bad{"UnknownLink", vary("key = \"link.mass_kg\"\nof = \"arm\"\nlist = [0.1]"), "arm", true},
        Bad{"RepetitionsThatAreAllTheSame", "repetitions = 2\n" + kScenario + kMeasure, "nothing differs between them", true},
        Bad{"ARunThatIsOverBefore", measure("signal = \"supply_J\"\nfrom_s = 0.05"), "the run is over before (m)", true},
        Bad{"UnknownWorld", "[scenario]\nworld = \"nowhere\"\nduration_s = 1.0\n" + kMeasure, "nowhere", true}),
    [](const auto& row) { return row.param.name; });

TEST(Plan, AllProblemsAreToldAtOnce) {
  const Scratch scratch;
  const std::string told = refusal(scratch, "repetitions = 0\nwrong = 1\n[start]\nyaw_deg = 400.0\n" + kScenario);
  for (const char* part : {"repetitions", "wrong", "start.yaw_deg", "measure: is missing"})
    EXPECT_NE(told.find(part), std::string::npos) << part << "\n" << told;
}

}  // namespace
}  // namespace vsa::sweep::testing
