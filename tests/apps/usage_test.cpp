// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Bad usage and bad input end with exit code 2 and lines that say what would be right.
#include <gtest/gtest.h>

#include <filesystem>

#include "more_commands.hpp"
#include "subprocess.hpp"

namespace {

using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::write_file;

void expect_bad_input(const Result& result, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, 2) << result.err;
  for (const auto& part : parts) EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in:\n" << result.err;
}

TEST(Usage, HelpAndVersionAreNoErrors) {
  const auto help = run_vsa({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* part : {"run", "command", "actuators", "Examples", "Exit codes"}) {
    EXPECT_NE(help.out.find(part), std::string::npos) << part;
  }
  const auto version = run_vsa({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out.rfind("vsa ", 0), 0U) << version.out;
  EXPECT_EQ(run_vsa({"run", "--help"}).exit_code, 0);
}

/// The tables of the reference are the command's; whoever adds a law writes them anew.
TEST(Usage, TheLawsInTheDocumentationAreThoseThatTheCommandWrites) {
  const Scratch scratch;
  const auto page = std::filesystem::path(VSA_SOURCE_DIR) / "docs" / "reference" / "config.md";
  const std::string before = vsa::test::read_file(page);
  std::string without = before;
  const std::size_t row = without.find("| `two_exp` |");
  ASSERT_NE(row, std::string::npos);
  without.erase(row, without.find('\n', row) + 1 - row);
  write_file(scratch / "config.md", without);
  const auto written = run_vsa({"actuators", "--laws", "--markdown", (scratch / "config.md").string()});
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(vsa::test::read_file(scratch / "config.md"), before) << "vsa actuators --laws --markdown docs/reference/config.md";
  const auto printed = run_vsa({"actuators", "--laws"});
  for (const char* part : {"two_exp", "elastic.slack_ratio", "torque scale of the spring to motor 2"})
    EXPECT_NE(printed.out.find(part), std::string::npos) << part;

  write_file(scratch / "plain.md", "# Nothing\n");
  expect_bad_input(run_vsa({"actuators", "--laws", "--markdown", (scratch / "plain.md").string()}),
                   {"plain.md", "vsa actuators --laws: tables"});
  EXPECT_EQ(vsa::test::read_file(scratch / "plain.md"), "# Nothing\n");
  EXPECT_EQ(run_vsa({"actuators", "--laws", "sea_example"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"actuators", "--markdown", (scratch / "plain.md").string()}).exit_code, 2);
}

TEST(Usage, WrongArgumentsAreBadUsage) {
  EXPECT_EQ(run_vsa({}).exit_code, 2);
  EXPECT_EQ(run_vsa({"dance"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"run"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"run", "bench_free", "--fast"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"run", "bench_free", "--paused", "--no-topics"}).exit_code, 2) << "nobody could let it run";
  EXPECT_EQ(run_vsa({"command", "10"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"command", "ten", "20"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"command", "", "20"}).exit_code, 2);
}

TEST(Usage, AFlagThatIsGivenAgainAndAgainLeavesTheWorldAlone) {
  const std::string gain = "firmware.kp_pct_per_tick=0.03";
  EXPECT_EQ(run_vsa({"run", "--set", gain, "bench_free", "--no-topics", "--duration-s", "0.01"}).exit_code, 0);
  expect_bad_input(run_vsa({"run", "--set", "firmware.kp=0.03", "bench_free", "--no-topics", "--duration-s", "0.01"}),
                   {"vsa: --set firmware.kp = \"0.03\": unknown key, did you mean firmware.kp_pct_per_tick?"});
}

TEST(Usage, ANumberWithoutAUnitIsBoundedWithoutOne) {
  expect_bad_input(run_vsa({"run", "bench_free", "--no-topics", "--set", "tendon.friction=2"}), {"0 … 0.99)"});
}

TEST(Usage, AnActuatorWithoutAPresetSaysSo) {
  EXPECT_NE(run_vsa({"actuators", "sea_example"}).out.find("at rest, no stiffness preset"), std::string::npos);
}

TEST(Usage, RepairsThatAreOffAreListedOnRequest) {
  EXPECT_EQ(run_vsa({"actuators", "sea_example"}).out.find("firmware.repair_list_mode_5"), std::string::npos);
  EXPECT_NE(run_vsa({"actuators", "sea_example"}).out.find("firmware.supply_limit"), std::string::npos);
  EXPECT_NE(run_vsa({"actuators", "sea_example", "--all"}).out.find("firmware.repair_list_mode_5"), std::string::npos);
}

TEST(Usage, AWordLikeNoOtherIsNotGuessed) {
  for (const char* word : {"frobnicate", "nonsense"})
    EXPECT_EQ(run_vsa({word}).err.find("did you mean"), std::string::npos) << word;
  EXPECT_EQ(run_vsa({"actuators", "nonsense"}).err.find("did you mean"), std::string::npos);
}

TEST(Usage, HelpIsACommandToo) {
  EXPECT_EQ(run_vsa({"help"}).out, run_vsa({"--help"}).out);
  EXPECT_EQ(run_vsa({"help", "run"}).out, run_vsa({"run", "--help"}).out);
  EXPECT_EQ(run_vsa({"help", "run"}).exit_code, 0);
  expect_bad_input(run_vsa({"help", "rnu"}), {"vsa: rnu: no such command, did you mean run?"});
}

TEST(Usage, HasTheCommandsThatABuildForAFirstRunIsWithout) {
  for (const char* command : vsa::app::kMoreCommands) EXPECT_EQ(run_vsa({command, "--help"}).exit_code, 0) << command;
}

TEST(Usage, AWordNobodyKnowsIsNamedWithTheNearestThatMeansSomething) {
  expect_bad_input(run_vsa({"rnu", "snake_flat"}), {"vsa: rnu: no such command, did you mean run?", "doctor"});
  expect_bad_input(run_vsa({"run", "bench_free", "--duratoin-s", "3"}),
                   {"vsa: run: --duratoin-s: no such option, did you mean --duration-s?"});
  expect_bad_input(run_vsa({"run", "bench_free", "--duratoin-s=3"}), {"--duratoin-s: no such option"});
  expect_bad_input(run_vsa({"run", "snake_flatt"}), {"no such file, did you mean snake_flat?", "bench_free"});
  expect_bad_input(run_vsa({"actuators", "qbmove_maker_pro_6_1", "twice"}), {"vsa: actuators: twice: one word too many"});
}

TEST(Usage, WhatIsNoNumberIsToldWithWhatIsAllowed) {
  expect_bad_input(run_vsa({"run", "bench_free", "--duration-s", "abc"}),
                   {"vsa: --duration-s = abc: isn't a number (allowed: a number)"});
  expect_bad_input(run_vsa({"emulate", "sea_example", "--units", "1.5"}),
                   {"vsa: --units = 1.5: isn't a whole number (allowed: a whole number)"});
  expect_bad_input(run_vsa({"command", "x", "0"}), {"vsa: EQUILIBRIUM_DEG = x: isn't a number"});
  expect_bad_input(run_vsa({"run", "bench_free", "--seed", "-1"}), {"--seed: -1 is out of range (allowed: 0 … 1000000000000000)"});
  expect_bad_input(run_vsa({"run", "bench_free", "--seed", "x"}), {"--seed: x isn't a number (allowed: 0 … 1000000000000000)"});
}

TEST(Usage, AnOldSpellingIsToldByTheCommandsThatHaveTheNewOneAlone) {
  const Result r = run_vsa({"characterize", "--preset", "sea_example"});
  expect_bad_input(r, {"vsa: characterize: --preset: no such option"});
  EXPECT_EQ(r.err.find("--type"), std::string::npos) << r.err;
}

/// By whichever command, once each, and by none that reads no type.
TEST(Usage, OldSpellingsOfTypesAreToldByEveryCommandThatReadsOne) {
  const Scratch scratch;
  write_file(scratch / "old.toml", "[preset]\nname = \"old\"\ntitle = \"T\"\nbase = \"sea_example\"\n");
  vsa::test::Surroundings with;
  with.environment = {{"VSA_PRESET_PATH", (scratch / "old.toml").parent_path().string()}};
  const auto expect_told = [](const std::string& what, const std::string& told) {
    for (const char* part : {"VSA_PRESET_PATH is called VSA_ACTUATOR_PATH now", "old.toml:1: [preset] is called [type] now"}) {
      const std::size_t at = told.find(part);
      ASSERT_NE(at, std::string::npos) << what << " doesn't say '" << part << "':\n" << told;
      EXPECT_EQ(told.find(part, at + 1), std::string::npos) << what << " says it twice:\n" << told;
    }
  };
  const std::string out = scratch / "out";
  const std::vector<std::vector<std::string>> commands{
      {"actuators"},
      {"actuators", "old"},
      {"run", "bench_free", "--type", "old", "--duration-s", "0.01", "--no-topics"},
      {"linearize", "old", "--out", out},
      {"export", "--fmu", "old", "--out", scratch / "old.fmu"},
      {"characterize", "old", "--experiment", "speed", "--out", out},
      {"datasheet", "old", "--out", scratch / "old.html"},
      {"emulate", "old", "--port", "/"}};
  for (const auto& command : commands) {
    const Result result = run_vsa(command, with);
    EXPECT_EQ(result.out.find(" now: "), std::string::npos) << command[0] << ": " << result.out;
    expect_told(command[0], result.err);
  }
  EXPECT_EQ(run_vsa({"actuators", "--help"}, with).err, "");
  EXPECT_EQ(run_vsa({"--complete", "actuators", ""}, with).err, "");
}

TEST(Usage, AnEmptyArgumentIsRefusedAndNamed) {
  expect_bad_input(run_vsa({"run", "bench_free", "--duration-s", "0.01", "--record", ""}), {"--record", "empty"});
  expect_bad_input(run_vsa({"command", "10", "20", "--joint", ""}), {"--joint", "empty"});
}

TEST(Usage, ADurationMustBeAPositiveNumber) {
  for (const char* duration : {"0", "-1", "nan", "inf", "1e9", "abc", ""}) {
    const auto result = run_vsa({"run", "bench_free", "--no-topics", "--duration-s", duration});
    EXPECT_EQ(result.exit_code, 2) << duration << ": " << result.err;
    EXPECT_NE(result.err.find("--duration-s"), std::string::npos) << result.err;
  }
}

TEST(Usage, AMissingWorldIsToldWithTheWorldsThereAre) {
  expect_bad_input(run_vsa({"run", "atlantis"}), {"atlantis", "no such file", "snake_flat"});
  vsa::test::Surroundings lost;
  lost.environment = {{"VSA_DATA_DIR", "/nowhere"}};
  expect_bad_input(run_vsa({"run", "snake_flat"}, lost),
                   {"snake_flat", "no such file", "looked for /nowhere/models/worlds", "VSA_DATA_DIR", "vsa doctor"});
  expect_bad_input(run_vsa({"run", "/nowhere/world.sdf"}), {"/nowhere/world.sdf", "no such file"});
  expect_bad_input(run_vsa({"run", "/tmp"}), {"/tmp", "is a directory"});
}

TEST(Usage, ABrokenWorldIsBadInput) {
  const Scratch scratch;
  write_file(scratch / "broken.sdf", "<sdf version='1.8'><world name='w'><model></world>");
  expect_bad_input(run_vsa({"run", (scratch / "broken.sdf").string(), "--no-topics"}), {"broken.sdf"});
  write_file(scratch / "empty.sdf", "");
  expect_bad_input(run_vsa({"run", (scratch / "empty.sdf").string(), "--no-topics"}), {"empty.sdf"});
}

TEST(Usage, AnUnknownGaitIsToldWithTheGaitsThereAre) {
  expect_bad_input(run_vsa({"run", "snake_flat", "--no-topics", "--gait", "gallop"}), {"gallop", "no such file", "sidewind"});
}

TEST(Usage, AGaitForAnotherRobotIsBadInputBeforeAnythingRuns) {
  const Scratch scratch;
  const auto result = run_vsa({"run", "bench_free", "--no-topics", "--gait", "sidewind", "--record", (scratch / "out").string()});
  expect_bad_input(result, {"joint_2"});
  const auto wide = run_vsa({"run", "snake_flat", "--no-topics", "--gait", "frank_wave"});
  EXPECT_LT(wide.err.find("joint_9,"), wide.err.find("joint_10,")) << wide.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST(Usage, ARecordDirectoryThatCannotBeIsBadInput) {
  const Scratch scratch;
  write_file(scratch / "file", "in the way");
  const auto result =
      run_vsa({"run", "bench_free", "--no-topics", "--duration-s", "1", "--record", (scratch / "file" / "out").string()});
  expect_bad_input(result, {"file/out"});
  EXPECT_EQ(result.out, "") << "nothing may have run";
}

TEST(Usage, ACommandMustBeFiniteAndItsTimeoutPositive) {
  expect_bad_input(run_vsa({"command", "nan", "inf", "--timeout-s", "0"}), {"EQUILIBRIUM_DEG", "PRESET_DEG", "--timeout-s"});
}

}  // namespace
