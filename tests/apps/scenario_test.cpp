// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs that are files: `vsa run SCENARIO.toml`, and the one that each record holds.
#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "subprocess.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::read_file;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::write_file;

const fs::path kSource = VSA_SOURCE_DIR;
constexpr const char* kMotion =
    "title = \"t\"\n[[keyframe]]\ntime_s = 0.0\nequilibrium_deg = { j1 = 0.0 }\n"
    "[[keyframe]]\ntime_s = 0.3\nequilibrium_deg = { j1 = 20.0 }\n";
constexpr const char* kScenario = R"([scenario]
world = "../robot.sdf"
duration_s = 0.3
topics = false
[motion]
file = "nod.toml"
period_s = 0.02
[[command]]
time_s = 0.1
actuator = "j1"
preset_rad = 0.3
[record]
directory = "first"
)";

/// A scenario with a world and a motion of its own in a directory of the scratch.
fs::path place(const Scratch& scratch, const std::string& scenario = kScenario) {
  fs::create_directories(scratch / "runs");
  write_file(scratch / "robot.sdf", read_file(kSource / "tests/sdf/robot_files/actuated.sdf"));
  write_file(scratch / "runs/nod.toml", kMotion);
  write_file(scratch / "runs/nod_scenario.toml", scenario);
  return scratch / "runs/nod_scenario.toml";
}

void expect_equal_records(const fs::path& a, const fs::path& b) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(a)) {
    if (entry.path().extension() != ".csv") continue;
    ++files;
    EXPECT_TRUE(read_file(entry.path()) == read_file(b / entry.path().filename())) << entry.path().filename();
  }
  EXPECT_GE(files, 3);
}

TEST(Scenario, TheExampleIsRepeatedBitForBitByItsRecord) {
  const Scratch scratch;
  const std::string example = (kSource / "examples/scenario/snake.toml").string();
  const auto first = run_vsa({"run", example, "--no-topics", "--duration-s", "1", "--record", (scratch / "a").string()});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto second = run_vsa({"run", (scratch / "a/scenario.toml").string(), "--record", (scratch / "b").string()});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  expect_equal_records(scratch / "a", scratch / "b");
  EXPECT_NE(read_file(scratch / "a/scenario.toml").find("\ntopics = false\n"), std::string::npos) << "or others may command it";
  EXPECT_EQ(read_file(scratch / "a/scenario.toml"), read_file(scratch / "b/scenario.toml"));
}

TEST(Scenario, WhatItSaysShapesTheRun) {
  const Scratch scratch;
  const std::string example = (kSource / "examples/scenario/snake.toml").string();
  std::string text = read_file(example);
  ASSERT_EQ(run_vsa({"run", example, "--no-topics", "--duration-s", "0.7", "--record", (scratch / "whole").string()}).exit_code, 0);
  for (const char* line : {"joint_3 lost_byte", "\"drive.friction_Nm\" = 0.7", "frequency_rad_per_s = 4.0", "amplitude_deg = 50.0",
                           "equilibrium_rad = 0.3", "seed = 7"}) {
    std::string other = text;
    const std::size_t at = other.find(line);
    ASSERT_NE(at, std::string::npos) << line;
    other.replace(at, std::string(line).size(), [&]() -> std::string {
      const std::string changed(line);
      if (changed[0] == 'j') return "joint_4 lost_byte";
      return changed.substr(0, changed.rfind(' ') + 1) + (changed[0] == 's' ? "8" : "0.9");
    }());
    write_file(scratch / "other.toml", other);
    const auto result = run_vsa(
        {"run", (scratch / "other.toml").string(), "--no-topics", "--duration-s", "0.7", "--record", (scratch / "other").string()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(read_file(scratch / "whole/energy.csv"), read_file(scratch / "other/energy.csv")) << line;
  }
}

TEST(Scenario, FilesAreFoundBesideItFromAnyDirectoryAndItsRecordToo) {
  const Scratch scratch;
  const fs::path file = place(scratch), here = fs::current_path();
  fs::current_path(scratch / "runs");
  const auto first = run_vsa({"run", "nod_scenario.toml"});
  fs::current_path("/");
  const auto second = run_vsa({"run", (scratch / "runs/first/scenario.toml").string(), "--record", (scratch / "second").string()});
  fs::current_path(here);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  ASSERT_EQ(second.exit_code, 0) << second.err;
  expect_equal_records(scratch / "runs/first", scratch / "second");
}

TEST(Scenario, FlagsOverrideIt) {
  const Scratch scratch;
  const fs::path file = place(scratch);
  const auto result = run_vsa({"run", file.string(), "--duration-s", "0.2", "--step-s", "0.0005", "--fault", "j1 stuck=shaft",
                               "--set", "drive.friction_Nm=0.7", "--record", (scratch / "mine").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("0.200 s"), std::string::npos) << result.out;
  EXPECT_FALSE(fs::exists(scratch / "runs/first"));
  const std::string saved = read_file(scratch / "mine/scenario.toml");
  for (const char* part : {"duration_s = 0.2", "step_s = 0.0005", "j1 stuck=shaft", "period_s = 0.02", "preset_rad = 0.3",
                           "'drive.friction_Nm' = 0.7"})
    EXPECT_NE(saved.find(part), std::string::npos) << part << " isn't in\n" << saved;
  // Of what the scenario sets, too: a record can be varied by flags, and the last said counts.
  const auto again = run_vsa({"run", (scratch / "mine/scenario.toml").string(), "--set", "drive.friction_Nm=0.5", "--set",
                              "drive.friction_Nm=0.4", "--record", (scratch / "again").string()});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(read_file(scratch / "again/scenario.toml").find("'drive.friction_Nm' = 0.4"), std::string::npos);
  EXPECT_NE(read_file(scratch / "again/energy.csv"), read_file(scratch / "mine/energy.csv"));
}

TEST(Scenario, AFaultsWordsMayStandApartByAnyBlanks) {
  const Scratch scratch;
  std::string one = read_file(kSource / "tests/sdf/robot_files/actuated.sdf");
  one.insert(one.find("</actuator>"), "<initial equilibrium_rad='0.5' preset_rad='0.3'/>");  // so that it moves
  const std::size_t begin = one.find("<model"), end = one.find("</model>") + 8;
  std::string second = one.substr(begin, end - begin);
  second.replace(second.find("\"m\""), 3, "\"second\"");
  write_file(scratch / "two.sdf", one.substr(0, end) + second + one.substr(end));
  const auto energies = [&](const std::string& fault) {
    const auto r = run_vsa({"run", (scratch / "two.sdf").string(), "--no-topics", "--duration-s", "0.1", "--fault", fault,
                            "--record", (scratch / "out").string()});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return read_file(scratch / "out/energy.csv");
  };
  const std::string off = energies("all off");
  ASSERT_NE(energies("all none"), off);
  EXPECT_EQ(energies("all\toff"), off);
  EXPECT_EQ(energies(" all off"), off);
}

TEST(Scenario, CommandsAfterItsEndAreTold) {
  const Scratch scratch;
  const auto told = [&](const std::string& times) {
    std::string text = "[scenario]\nworld = \"bench_free\"\nduration_s = 0.05\ntopics = false\n";
    std::istringstream in(times);
    for (std::string time; in >> time;) text += "[[command]]\ntime_s = " + time + "\nactuator = \"shaft\"\nequilibrium_rad = 0.1\n";
    write_file(scratch / "s.toml", text);
    const auto r = run_vsa({"run", (scratch / "s.toml").string()});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return r.out + r.err;
  };
  EXPECT_EQ(told("0.0 0.049").find("given"), std::string::npos);
  // Steps begin at 0, 0.001, … 0.049.
  EXPECT_NE(told("0.0 0.0495").find("warning: 1 command isn't given, the run ends at 0.05 s: shaft at 0.0495 s\n"),
            std::string::npos);
  EXPECT_NE(told("0.0 0.05").find("warning: 1 command isn't given, the run ends at 0.05 s: shaft at 0.05 s\n"), std::string::npos);
  EXPECT_NE(told("0.0 0.1 5.0").find("warning: 2 commands aren't given, the run ends at 0.05 s: shaft at 0.1 s is the first\n"),
            std::string::npos);
}

TEST(Scenario, WhatAFlagNeedsTheFileMayHave) {
  const Scratch scratch;
  const auto run = [&](const char* file, std::vector<std::string> flags) {
    write_file(scratch / "s.toml", std::string("[scenario]\nworld = \"bench_free\"\nduration_s = 0.05\ntopics = false\n") + file);
    flags.insert(flags.begin(), {"run", (scratch / "s.toml").string()});
    return run_vsa(flags);
  };
  EXPECT_EQ(run("view = true\nspeed = \"max\"\n", {"--view-port", "0"}).exit_code, 0);
  EXPECT_EQ(run("view = true\nspeed = \"max\"\n", {"--view-records", (scratch / "records").string()}).exit_code, 0);
  EXPECT_EQ(run("speed = 10\n", {"--low-latency"}).exit_code, 0);
  for (const auto& [file, says] : {std::pair{"view_port = 0\n", "--view-port (view_port)"},
                                   {"view_records = \"here\"\n", "--view-records (view_records)"},
                                   {"low_latency = true\n", "--low-latency (low_latency)"}}) {
    const auto alone = run(file, {});
    EXPECT_EQ(alone.exit_code, 2) << file;
    EXPECT_NE(alone.err.find(says), std::string::npos) << alone.err;
  }
}

TEST(Scenario, MistakesAreToldAllAtOnceWithFileAndKey) {
  const Scratch scratch;
  const fs::path file = place(scratch, R"([scenario]
world = "../robot.sdf"
duration = 3
step_s = "fast"
seed = -1
view_port = 70000
concave = "melt"
faults = "off"
[motion]
file = "noddy.toml"
[recrod]
[[command]]
time_s = 0
actuator = "j1"
[record]
rate_Hz = 0.0
)");
  const auto result = run_vsa({"run", file.string(), "--record", (scratch / "out").string()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_FALSE(fs::exists(scratch / "out"));
  for (const char* part : {"nod_scenario.toml: scenario.duration: unknown key, did you mean duration_s?",
                           "scenario.step_s = \"fast\": not a number", "scenario.seed = -1: out of range", "scenario.view_port",
                           "refuse, hull, decompose", "scenario.faults", "motion.file = noddy.toml: no such file",
                           "recrod: unknown key, did you mean record?", "commands nothing", "record.rate_Hz = 0"})
    EXPECT_NE(result.err.find(part), std::string::npos) << part << " isn't in\n" << result.err;
}

TEST(Scenario, AMotionsChangesAndCommandsAreCheckedAgainstTheirs) {
  const Scratch scratch;
  const auto told = [&](const std::string& from, const std::string& to) {
    std::string text = kScenario;
    text.replace(text.find(from), from.size(), to);
    const auto result = run_vsa({"run", place(scratch, text).string()});
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_FALSE(fs::exists(scratch / "runs/first"));
    return result.err;
  };
  EXPECT_NE(told("period_s = 0.02", "perriod_s = 0.02").find("motion.perriod_s"), std::string::npos);
  EXPECT_NE(told("period_s = 0.02", "period_s = 2.0").find("motion.period_s = 2: out of range"), std::string::npos);
  EXPECT_NE(told("\"j1\"", "\"j7\"").find("command.actuator = j7"), std::string::npos);
  EXPECT_NE(told("preset_rad = 0.3", "equilibrium_rad = 0.3").find("keyframes command it"), std::string::npos);
  EXPECT_NE(told("[scenario]", "[scenario").find("nod_scenario.toml:1"), std::string::npos);
}

TEST(Scenario, ARecordDoesNotWriteOverTheScenarioItComesFrom) {
  const Scratch scratch;
  fs::rename(place(scratch), scratch / "runs/scenario.toml");
  const std::string before = read_file(scratch / "runs/scenario.toml");
  const auto result = run_vsa({"run", (scratch / "runs/scenario.toml").string(), "--record", (scratch / "runs").string()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--record"), std::string::npos) << result.err;
  EXPECT_EQ(read_file(scratch / "runs/scenario.toml"), before);
}

TEST(Scenario, CommandsFromTopicsAreOwnedUpTo) {
  const Scratch scratch;
  Subprocess world({"run", "bench_load", "--realtime", "--record", (scratch / "out").string()});
  EXPECT_EQ(run_vsa({"command", "-20", "30", "--timeout-s", "120"}).exit_code, 0);
  world.send(SIGINT);
  EXPECT_EQ(world.wait().exit_code, 0);
  const std::string saved = read_file(scratch / "out/scenario.toml");
  EXPECT_NE(saved.find("Commands came on topics"), std::string::npos) << saved;
  EXPECT_NE(saved.find("duration_s = "), std::string::npos) << saved;
  EXPECT_EQ(saved.find("0000000"), std::string::npos) << "milliseconds as they are\n" << saved;
  EXPECT_EQ(saved.find("topics ="), std::string::npos) << saved;
}

TEST(Scenario, NamesThatArentUtf8AreRefusedAndNoRecordIsTouched) {
  const Scratch scratch;
  place(scratch);
  const std::string odd = (scratch / "robot\xff.sdf").string();
  fs::copy_file(scratch / "robot.sdf", odd);
  const auto run = [&](const std::string& world, const std::vector<std::string>& more) {
    std::vector<std::string> all{"run", world, "--no-topics", "--duration-s", "0.01"};
    all.insert(all.end(), more.begin(), more.end());
    return run_vsa(all);
  };
  EXPECT_EQ(run(odd, {}).exit_code, 0);
  const auto recorded = run(odd, {"--record", (scratch / "out").string()});
  EXPECT_EQ(recorded.exit_code, 2) << recorded.err;
  EXPECT_NE(recorded.err.find("robot\\xff.sdf: can't stand in a scenario"), std::string::npos) << recorded.err;
  EXPECT_FALSE(fs::exists(scratch / "out"));
  std::string text = read_file(scratch / "robot.sdf");
  text.replace(text.find("<link name=\"") + 12, 0, "\xe9");
  write_file(scratch / "latin.sdf", text);
  const auto latin = run((scratch / "latin.sdf").string(), {});
  EXPECT_EQ(latin.exit_code, 2) << latin.err;
}

}  // namespace
