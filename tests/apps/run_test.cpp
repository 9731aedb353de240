// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <set>

#include "subprocess.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::Subprocess;

std::vector<fs::path> csv_files(const fs::path& directory) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (entry.path().extension() == ".csv") files.insert(entry.path());
  }
  return {files.begin(), files.end()};
}

/// Every file has a header, at least `lines` lines of data, whole lines, all as wide as the header.
void expect_readable_record(const fs::path& directory, std::size_t lines) {
  EXPECT_GT(fs::file_size(directory / "replay.html"), 1000U);
  const auto files = csv_files(directory);
  EXPECT_GE(files.size(), 3U);
  for (const auto& file : files) {
    const std::string text = read_file(file);
    ASSERT_FALSE(text.empty()) << file;
    EXPECT_EQ(text.back(), '\n') << file;
    std::size_t count = 0, columns = 0;
    for (std::size_t at = 0; at < text.size(); ++count) {
      const std::size_t end = text.find('\n', at);
      const auto width =
          static_cast<std::size_t>(std::count(text.begin() + static_cast<long>(at), text.begin() + static_cast<long>(end), ','));
      if (count == 0) columns = width;
      ASSERT_EQ(width, columns) << file << " line " << count + 1;
      at = end + 1;
    }
    EXPECT_GT(count, lines) << file;
  }
}

TEST(Run, TellsItsSummaryAndEndsWithOneWhereThePageCantBeWritten) {
  const Scratch scratch;
  fs::create_directories(scratch / "out" / "replay.html");
  const auto result = run_vsa({"run", "bench_free", "--no-topics", "--duration-s", "0.1", "--record", (scratch / "out").string()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.out.find("energy from supply"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("error: "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("replay.html"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::exists(scratch / "out" / "scenario.toml"));
}

TEST(Run, WithItsStandardFilesClosedWritesItsMessagesIntoNoOther) {
  const Scratch scratch;
  const auto record = [&](const std::string& closed) {
    vsa::test::Surroundings shell;
    shell.program = "/bin/sh";
    const std::string command = std::string("exec \"") + VSA_BINARY_DIR +
                                "/bin/vsa\" run bench_free --no-topics --duration-s 0.1 " +
                                "--speed 100 --fault 'all off' --record \"" + (scratch / "out").string() + "\" " + closed;
    return run_vsa({"-c", command}, shell);
  };
  ASSERT_EQ(record("").exit_code, 0);
  const std::string before = read_file(scratch / "out" / "energy.csv");
  EXPECT_EQ(record("<&- >&- 2>&-").exit_code, 1) << "its summary went nowhere";
  for (const auto& file : csv_files(scratch / "out")) {
    const std::string text = read_file(file);
    EXPECT_EQ(text.find("vsa:"), std::string::npos) << file;
    EXPECT_EQ(text.find("simulated time"), std::string::npos) << file;
  }
  EXPECT_EQ(read_file(scratch / "out" / "energy.csv"), before);
}

TEST(Run, HelpThatCantBeWrittenIsAFailure) {
  vsa::test::Surroundings full;
  full.full_stdout = true;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"--version"}, {"run", "--help"}, {"help"}})
    EXPECT_EQ(run_vsa(arguments, full).exit_code, 1) << arguments.front();
}

TEST(Run, AnyCommandsResultsThatCantBeWrittenAreAFailureThatSaysSo) {
  vsa::test::Surroundings full;
  full.full_stdout = true;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"actuators"},
                                                    {"actuators", "qbmove_maker_pro"},
                                                    {"actuators", "--laws"},
                                                    {"characterize", "qbmove_maker_pro"},
                                                    {"datasheet", "qbmove_maker_pro"},
                                                    {"doctor"},
                                                    {"linearize", "qbmove_maker_pro_6_1"},
                                                    {"emulate", "qbmove_maker_pro", "--duration-s", "0.01"}}) {
    const auto result = run_vsa(arguments, full);
    EXPECT_EQ(result.exit_code, 1) << arguments.front();
    EXPECT_NE(result.err.find("vsa: can't write to standard output\n"), std::string::npos)
        << arguments.front() << ": " << result.err;
  }
}

TEST(Run, ARefusedOneLeavesAnEarlierRecordAsItWas) {
  const Scratch scratch;
  const auto run = [&] {
    return run_vsa({"run", "bench_free", "--no-topics", "--duration-s", "0.1", "--record", (scratch / "out").string()});
  };
  ASSERT_EQ(run().exit_code, 0);
  const std::string before = read_file(scratch / "out" / "energy.csv");
  fs::remove(scratch / "out" / "run.mcap");
  fs::create_directory(scratch / "out" / "run.mcap");
  const auto refused = run();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("run.mcap"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(scratch / "out" / "energy.csv"), before);
}

TEST(Run, BreaksAUnitFromTheStartAndRefusesWhatItCantBreak) {
  const Scratch scratch;
  const auto record = [&](const char* name, std::vector<std::string> more) {
    std::vector<std::string> args{"run", "snake_flat", "--no-topics", "--gait", "sidewind", "--duration-s", "0.5", "--record"};
    args.push_back((scratch / name).string());
    args.insert(args.end(), more.begin(), more.end());
    return run_vsa(args);
  };
  ASSERT_EQ(record("whole", {}).exit_code, 0);
  const auto broken = record("broken", {"--fault", "joint_6 unplugged=1"});
  ASSERT_EQ(broken.exit_code, 0) << broken.err;
  EXPECT_NE(read_file(scratch / "whole" / "energy.csv"), read_file(scratch / "broken" / "energy.csv"));
  const auto refused = record("refused", {"--fault", "joint_60 off", "--fault", "all stuck=elbow"});
  EXPECT_EQ(refused.exit_code, 2);
  for (const char* part : {"--fault", "joint_60", "stuck=elbow", "motor_1, motor_2, shaft"})
    EXPECT_NE(refused.err.find(part), std::string::npos) << part << " isn't in\n" << refused.err;
  EXPECT_FALSE(fs::exists(scratch / "refused"));
}

TEST(Run, TellsWhatHappenedAndWhereTheRecordLies) {
  const Scratch scratch;
  const auto result = run_vsa(
      {"run", "snake_flat", "--no-topics", "--gait", "sidewind", "--duration-s", "3", "--record", (scratch / "out").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"simulated time", "3.000 s", "real-time factor", "distance travelled", "m net", "energy from supply",
                           "became heat", "replay.html", "energy.csv"}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " isn't in\n" << result.out;
  }
  expect_readable_record(scratch / "out", 300);
}

TEST(Run, ARecordOfAnotherWorldInTheSameDirectoryIsTold) {
  const Scratch scratch;
  const auto into = [&](const char* world) {
    return run_vsa({"run", world, "--no-topics", "--duration-s", "0.05", "--record", (scratch / "out").string()});
  };
  EXPECT_EQ(into("bench_free").err.find("earlier"), std::string::npos);
  EXPECT_EQ(into("bench_free").err.find("earlier"), std::string::npos) << "its own is overwritten";
  const auto other = into("bench_load");
  EXPECT_EQ(other.exit_code, 0);
  EXPECT_NE(other.err.find("out keeps an earlier run's qbmove_bench_free_actuators.csv"), std::string::npos) << other.err;
}

TEST(Run, ARobotThatIsBoltedDownHasNoDistance) {
  const auto result = run_vsa({"run", "bench_load", "--no-topics", "--duration-s", "2"});
  EXPECT_EQ(result.out.find("distance"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("energy from supply"), std::string::npos);
}

TEST(Run, TwoProcessesWithAGaitWriteTheSameBytes) {
  const Scratch scratch;
  for (const char* name : {"a", "b"}) {
    const auto result = run_vsa(
        {"run", "snake_rubble", "--no-topics", "--gait", "sidewind", "--duration-s", "2", "--record", (scratch / name).string()});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  const auto files = csv_files(scratch / "a");
  ASSERT_GE(files.size(), 3U);
  for (const auto& file : files) {
    EXPECT_TRUE(read_file(file) == read_file(scratch / "b" / file.filename())) << file.filename() << " differs";
  }
}

TEST(Run, ServingTopicsChangesNoByte) {
  const Scratch scratch;
  const auto quiet = run_vsa({"run", "bench_load", "--no-topics", "--duration-s", "1", "--record", (scratch / "a").string()});
  const auto served = run_vsa({"run", "bench_load", "--duration-s", "1", "--record", (scratch / "b").string()});
  ASSERT_EQ(quiet.exit_code, 0) << quiet.err;
  ASSERT_EQ(served.exit_code, 0) << served.err;
  for (const auto& file : csv_files(scratch / "a"))
    EXPECT_TRUE(read_file(file) == read_file(scratch / "b" / file.filename())) << file;
}

struct Interrupt {
  int signal;
  std::vector<std::string> duration;
  int exit_code;
};

class RunInterrupted : public testing::TestWithParam<Interrupt> {};

TEST_P(RunInterrupted, LeavesAReadableRecordAndASummary) {
  const Scratch scratch;
  const fs::path out = scratch / "out";
  std::vector<std::string> arguments{"run", "bench_load", "--no-topics", "--record", out.string()};
  arguments.insert(arguments.end(), GetParam().duration.begin(), GetParam().duration.end());
  Subprocess vsa(arguments);
  std::error_code none;
  ASSERT_TRUE(vsa.read_until([&](const Result&) {
    const auto size = fs::file_size(out / "energy.csv", none);
    return !none && size > 20000;
  })) << "it didn't get to run";
  vsa.send(GetParam().signal);
  const auto result = vsa.wait();
  EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.err;
  EXPECT_NE(result.out.find("simulated time"), std::string::npos) << result.out;
  expect_readable_record(out, 50);
}

INSTANTIATE_TEST_SUITE_P(BySignals, RunInterrupted,
                         testing::Values(Interrupt{SIGINT, {}, 0}, Interrupt{SIGTERM, {}, 0},
                                         Interrupt{SIGINT, {"--duration-s", "1e6"}, 130},
                                         Interrupt{SIGTERM, {"--duration-s", "1e6"}, 143}));

TEST(Run, ShowsProgressOnATerminalAndNoneInAPipe) {
  const std::vector<std::string> arguments{"run", "bench_load", "--no-topics", "--realtime", "--duration-s", "0.5"};
  const auto piped = run_vsa(arguments);
  EXPECT_EQ(piped.exit_code, 0);
  EXPECT_EQ(piped.err.find('\r'), std::string::npos) << piped.err;
  EXPECT_EQ(piped.err.find("/ 0.5 s"), std::string::npos) << piped.err;
  const auto shown = run_vsa(arguments, {true, false, std::nullopt, {}});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_NE(shown.err.find("/ 0.5 s"), std::string::npos) << shown.err;
}

TEST(Run, InRealTimeTakesAsLongAsItSimulates) {
  const auto start = std::chrono::steady_clock::now();
  const auto result = run_vsa({"run", "bench_load", "--no-topics", "--realtime", "--duration-s", "0.7"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(690));
}

TEST(Run, AFullDiskIsAFailureThatKeepsWhatWasWritten) {
  const Scratch scratch;
  vsa::test::Surroundings small;
  small.largest_file = 20000;
  const auto result =
      run_vsa({"run", "bench_load", "--no-topics", "--duration-s", "1e6", "--record", (scratch / "out").string()}, small);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("out/"), std::string::npos) << "the file should be named:\n" << result.err;
  EXPECT_GT(fs::file_size(scratch / "out" / "energy.csv"), 1000U);
}

TEST(Run, ABlowUpIsAFailureThatTellsTimeAndLinkAndKeepsTheRecord) {
  const Scratch scratch;
  vsa::test::write_file(scratch / "falls.sdf", R"(<sdf version="1.8"><world name="falls"><gravity>0 0 -1e13</gravity>
    <physics name="1ms" type="ignored"><max_step_size>0.001</max_step_size></physics>
    <model name="ball"><link name="ball"><inertial><mass>1</mass>
      <inertia><ixx>1e-3</ixx><iyy>1e-3</iyy><izz>1e-3</izz></inertia></inertial></link></model></world></sdf>)");
  const auto result = run_vsa(
      {"run", (scratch / "falls.sdf").string(), "--no-topics", "--duration-s", "1", "--record", (scratch / "out").string()});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("ball"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("0.000"), std::string::npos) << result.err;
  EXPECT_GT(fs::file_size(scratch / "out" / "replay.html"), 1000U);
  EXPECT_NE(read_file(scratch / "out" / "links.csv").find('\n'), std::string::npos);
}

TEST(Run, ASummaryThatCannotBeWrittenIsAFailure) {
  const auto result = run_vsa({"run", "bench_load", "--no-topics", "--duration-s", "0.1"}, {false, true, std::nullopt, {}});
  EXPECT_EQ(result.exit_code, 1);
}

}  // namespace
