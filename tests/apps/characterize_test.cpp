// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa characterize`: what it leaves behind, and what it refuses before it runs anything.
#include <gtest/gtest.h>

#include <csignal>
#include <regex>
#include <sstream>

#include "subprocess.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::Surroundings;
using vsa::test::write_file;

/// Its arguments with a short sweep into `out`.
std::vector<std::string> stiffness(const std::string& preset, const fs::path& out, std::vector<std::string> more = {}) {
  std::vector<std::string> all{"characterize", preset, "--experiment", "stiffness", "--period-s", "6",
                               "--cycles",     "1",    "--out",        out};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> out;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    out.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) out.back().push_back(std::stod(cell));
  }
  return out;
}

void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
  const Result result = run_vsa(arguments);
  EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
  for (const auto& part : parts) EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in:\n" << result.err;
}

TEST(Characterize, WritesAReportResultsAndOneRecordingAPreset) {
  const Scratch scratch;
  const fs::path out = scratch / "deep/down";
  const Result result = run_vsa(stiffness("qbmove_maker_pro", out, {"--preset-rad", "0.2", "0.46025"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "") << "no progress in a pipe";
  EXPECT_NE(result.out.find("report.html"), std::string::npos) << result.out;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(out)) files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 4u);
  EXPECT_NE(read_file(out / "report.html").find("qbmove maker pro"), std::string::npos);
  const std::string csv = read_file(out / "stiffness_preset_0.4602rad.csv");
  EXPECT_EQ(csv.rfind("time_s,load_torque_Nm,deflection_rad,", 0), 0u);
  const auto rows = rows_of(csv);
  ASSERT_EQ(rows.size(), 601u) << "one cycle";
  EXPECT_EQ(rows.front()[0], 6) << "after the first";
  EXPECT_EQ(rows.back()[0], 12);
  double largest = 0;
  for (const auto& row : rows) largest = std::max(largest, row[1]);
  EXPECT_NEAR(largest, 1.47, 0.01);
  const std::string json = read_file(out / "results.json");
  for (const char* key :
       {"\"preset_rad\": 0.2", "\"period_s\": 6.0", "\"load_peak_Nm\": 1.4715", "\"area_Nm_rad\"", "\"program\": \"vsa "}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
}

TEST(Characterize, WhatAnEarlierRunLeftThereIsTold) {
  const Scratch scratch;
  const fs::path out = scratch / "out";
  const Result first = run_vsa(stiffness("qbmove_maker_pro_6_1", out, {"--preset-rad", "0.2"}));
  const Result again = run_vsa(stiffness("qbmove_maker_pro_6_1", out, {"--preset-rad", "0.2"}));
  const Result other = run_vsa(stiffness("sea_example", out));
  EXPECT_EQ(first.err, "");
  EXPECT_EQ(again.err, "");
  EXPECT_NE(other.err.find("warning: " + out.string() + " keeps an earlier run's stiffness_preset_0.2000rad.csv\n"),
            std::string::npos)
      << other.err;
}

/// Springs of which one is weaker go further to its side.
TEST(Characterize, UnequalSpringsHaveTwoEnds) {
  const Scratch scratch;
  const Result r =
      run_vsa(stiffness("qbmove_maker_pro_paper", scratch / "out", {"--preset-rad", "0.3", "--set", "elastic.k1_Nm=0.06"}));
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("-0\\.[0-9]+ … 0\\.[0-9]+"))) << "deflection\n" << r.out;
}

TEST(Characterize, TheSameCommandWritesTheSameBytes) {
  const Scratch scratch;
  const auto speed = [&](const std::string& name) {
    return run_vsa({"characterize", "qbmove_maker_pro", "--experiment", "speed", "--preset-rad", "0.1", "0.3", "0.7", "--out",
                    scratch / name});
  };
  ASSERT_EQ(speed("a").exit_code, 0);
  ASSERT_EQ(speed("b").exit_code, 0);
  for (const char* file :
       {"speed_preset_0.1000rad.csv", "speed_preset_0.3000rad.csv", "speed_preset_0.7000rad.csv", "results.json", "report.html"}) {
    const std::string text = read_file(scratch / "a" / file);
    EXPECT_FALSE(text.empty()) << file;
    EXPECT_TRUE(text == read_file(scratch / "b" / file)) << file;
  }
}

TEST(Characterize, AnOverrideChangesWhatIsMeasuredAndIsToldInTheResults) {
  const Scratch scratch;
  ASSERT_EQ(run_vsa({"characterize", "qbmove_maker_pro", "--experiment", "preset-step", "--out", scratch / "a"}).exit_code, 0);
  ASSERT_EQ(run_vsa({"characterize", "qbmove_maker_pro", "--experiment", "preset-step", "--set", "drive.friction_Nm=0.1", "--out",
                     scratch / "b"})
                .exit_code,
            0);
  EXPECT_NE(read_file(scratch / "a" / "preset_step_loaded.csv"), read_file(scratch / "b" / "preset_step_loaded.csv"));
  EXPECT_NE(read_file(scratch / "b" / "results.json").find("\"drive.friction_Nm\": \"0.1\""), std::string::npos);
}

TEST(Characterize, AnActuatorWithoutAPresetHasOneRunAnExperiment) {
  const Scratch scratch;
  const Result result = run_vsa({"characterize", "sea_example", "--period-s", "6", "--cycles", "1", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::exists(scratch / "out" / "stiffness.csv"));
  EXPECT_TRUE(fs::exists(scratch / "out" / "speed.csv"));
  EXPECT_NE(result.out.find("The encoders resolve the loop to ±0.0086 N·m·rad"), std::string::npos) << result.out;
  EXPECT_EQ(read_file(scratch / "out" / "stiffness.csv").find("preset"), std::string::npos);
  expect_refused({"characterize", "sea_example", "--experiment", "preset-step", "--preset-rad", "0.2"},
                 {"--experiment = preset-step", "--preset-rad = 0.2", "no stiffness preset"});
  expect_refused({"characterize", "sea_example", "--experiment", "speed", "--load-kg", "5"}, {"--load-kg = 5", "has no load"});
  expect_refused({"characterize", "qbmove_maker_pro", "--load-kg", "1000"},
                 {"vsa: --load-kg = 1000: the elastic law doesn't carry it within a turn (allowed: a smaller load)"});
  for (const std::string step : {"0", "1"}) {
    const std::string told = "vsa: --step-s = " + step + ": out of range (allowed: 1e-06 … 0.016 s)\n";
    const std::vector<std::vector<std::string>> commands{{"run", "bench_free", "--no-topics"},
                                                         {"characterize", "sea_example"},
                                                         {"datasheet", "sea_example"},
                                                         {"datasheet", "--all"}};
    for (std::vector<std::string> command : commands) {
      command.insert(command.end(), {"--step-s", step});
      expect_refused(command, {told});
    }
  }
}

TEST(Characterize, AShorterStepIsTakenAndEndsTheWarningOfOneThatIsTooLong) {
  const Scratch scratch;
  const auto speed = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"characterize", "qbmove_maker_pro_6_1", "--experiment", "speed", "--preset-rad", "0.75",
                                 "--out",        scratch / "out"};
    all.insert(all.end(), more.begin(), more.end());
    return run_vsa(all);
  };
  const Result own = speed({}), shorter = speed({"--step-s", "0.00025"});
  EXPECT_NE(own.err.find("steps shorter by"), std::string::npos) << own.err;
  ASSERT_EQ(shorter.exit_code, 0) << shorter.err;
  EXPECT_EQ(shorter.err, "");
  EXPECT_NE(read_file(scratch / "out" / "results.json").find("--step-s 0.00025"), std::string::npos);
  EXPECT_NE(shorter.out, own.out);
  expect_refused({"characterize", "qbmove_maker_pro", "--step-s", "1"}, {"--step-s = 1: out of range"});
}

TEST(Characterize, APresetThatStaysIsOneNumber) {
  const Scratch scratch;
  const Result result = run_vsa(stiffness("qbmove_maker_pro", scratch / "out", {"--preset-rad", "0", "0.6903"}));
  EXPECT_EQ(result.out.find("0.000 … 0.000"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" … "), std::string::npos) << "a preset that doesn't is a range\n" << result.out;
}

TEST(Characterize, BadInputIsToldTogetherBeforeAnythingRuns) {
  const Scratch scratch;
  expect_refused(
      stiffness("qbmove_maker_pro", scratch / "out", {"--preset-rad", "0.9", "0.2", "0.20001", "--amplitude-rad", "nan"}),
      {"--preset-rad = 0.9", "0 … 0.785 rad", "--preset-rad = 0.20001", "twice", "--amplitude-rad = nan"});
  EXPECT_FALSE(fs::exists(scratch / "out"));
  expect_refused({"characterize", "qbmove_maker_pro", "--set", "friction", "--set", "=1"}, {"\"friction\"", "\"=1\"", "key=value"});
  expect_refused({"characterize", "qbmove_maker_pro", "--set", "drive.friktion_Nm=1", "--set", "drive.supply_V=99"},
                 {"did you mean drive.friction_Nm", "drive.supply_V"});
  expect_refused({"characterize", "nosuch"}, {"unknown actuator type", "qbmove_maker_pro"});
  expect_refused({"characterize", "qbmove_maker_pro", "--experiment", "dance"}, {"dance", "stiffness"});
  expect_refused({"characterize", "qbmove_maker_pro", "--experiment", "speed", "--cycles", "3"}, {"--cycles", "stiffness"});
  expect_refused({"characterize", "qbmove_maker_pro", "--experiment", "preset-step", "--preset-rad", "0"}, {"0 to 0"});
}

TEST(Characterize, APlaceThatCannotBeWrittenToIsNamed) {
  const Scratch scratch;
  write_file(scratch / "file", "mine");
  expect_refused({"characterize", "sea_example", "--experiment", "speed", "--out", scratch / "file"}, {"--out", "file"});
  EXPECT_EQ(read_file(scratch / "file"), "mine");
}

TEST(Characterize, AFullDiskLeavesNoHalfFile) {
  const Scratch scratch;
  Surroundings small;
  small.largest_file = 50'000;
  const Result result = run_vsa({"characterize", "sea_example", "--experiment", "speed", "--out", scratch / "out"}, small);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("speed.csv"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_empty(scratch / "out"));
}

TEST(Characterize, ASignalStopsItAndNothingIsWritten) {
  const Scratch scratch;
  Surroundings terminal;
  terminal.terminal = true;
  Subprocess run({"characterize", "qbmove_maker_pro", "--experiment", "stiffness", "--period-s", "3600", "--cycles", "1000",
                  "--out", scratch / "out"},
                 terminal);
  ASSERT_TRUE(run.read_until([](const Result& r) { return r.err.find("real time") != std::string::npos; }))
      << "progress on a terminal";
  run.send(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 128 + SIGINT);
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

// The program with its data, away from its pages: runs that would take days end at once.
TEST(Report, WhoseTemplateIsNowhereIsToldBeforeTheWork) {
  const Scratch scratch;
  fs::create_directories(scratch / "bin");
  fs::create_directories(scratch / "share/vsa");
  for (const std::string data : {"actuators", "models", "data"})
    fs::create_directory_symlink(std::string(VSA_SOURCE_DIR) + "/" + data, scratch / ("share/vsa/" + data));
  fs::copy_file(fs::path(VSA_BINARY_DIR) / "bin" / "vsa", scratch / "bin/vsa");
  Surroundings alone;
  alone.program = scratch / "bin/vsa";
  const std::string recording = std::string(VSA_SOURCE_DIR) + "/data/qbmove_maker_pro/stiffness_preset_0.6903rad_branches.csv";
  const std::vector<std::vector<std::string>> commands{
      {"characterize", "qbmove_maker_pro", "--period-s", "3600", "--cycles", "1000", "--out", scratch / "out"},
      {"identify", recording, "--type", "qbmove_maker_pro", "--parameters", "shaft.friction_Nm", "--period-s", "3600", "--out",
       scratch / "out"},
      {"validate", "--out", scratch / "out"},
      {"datasheet", "sea_example", "--out", scratch / "sheet.html"}};
  for (const auto& command : commands) {
    const Result result = run_vsa(command, alone);
    EXPECT_EQ(result.exit_code, 2) << command.front() << '\n' << result.err;
    EXPECT_NE(result.err.find("template is nowhere"), std::string::npos) << command.front() << '\n' << result.err;
  }
  EXPECT_FALSE(fs::exists(scratch / "out"));
  EXPECT_FALSE(fs::exists(scratch / "sheet.html"));
}

TEST(Run, AnotherActuatorCanBePutOnAWorld) {
  const Scratch scratch;
  const Result result = run_vsa({"run", "bench_free", "--no-topics", "--duration-s", "0.02", "--type", "sea_example", "--set",
                                 "elastic.stiffness_Nm_per_rad=12.5", "--record", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(read_file(scratch / "out" / "qbmove_bench_free_actuators.csv").find(",12.5,"), std::string::npos);
  expect_refused({"run", "bench_free", "--no-topics", "--duration-s", "0.02", "--type", "nosuch"}, {"unknown actuator type"});
  expect_refused({"run", "bench_free", "--no-topics", "--duration-s", "0.02", "--set", "drive.friction_Nm"},
                 {"--set", "key=value"});
}

TEST(Run, UnderstandsTheOldSpellingOfTypeAndSaysSo) {
  const Result result = run_vsa({"run", "bench_free", "--no-topics", "--duration-s", "0.02", "--preset=sea_example"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("--preset is called --type now"), std::string::npos) << result.err;
}

}  // namespace
