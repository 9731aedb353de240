// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Sweeps as users run them: by threads, by parts, by ranks of an MPI job; killed and resumed; refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>

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

const fs::path kBin = fs::path(VSA_BINARY_DIR) / "bin";

/// 40 runs whose lengths differ a hundredfold, of which two fail.
std::string plan_text(const std::string& more = "") {
  return more + R"(
repetitions = 2
[scenario]
world = "bench_pole"
duration_s = 0.2
faults = ["shaft noise_rad=0.003"]
[[vary]]
key = "set.drive.friction_Nm"
name = "friction_Nm"
range = [0.3, 0.6]
count = 2
[[vary]]
key = "scenario.duration_s"
log = [0.2, 20.0]
count = 10
[[measure]]
name = "shaft_rad"
signal = "shaft_rad"
actuator = "shaft"
statistic = "rms"
[[measure]]
name = "supply_J"
signal = "supply_J"
)";
}

std::string plan(const Scratch& scratch, const std::string& more = "") {
  write_file(scratch / "plan.toml", plan_text(more));
  return scratch / "plan.toml";
}

std::string tables(const fs::path& folder) {
  const std::string h5 = fs::exists(folder / "results.h5") ? read_file(folder / "results.h5") : "";
  return read_file(folder / "results.csv") + h5;
}

std::string by_threads(const Scratch& scratch) {
  const Result r = run_vsa({"sweep", plan(scratch), "--out", scratch / "threads"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  return tables(scratch / "threads");
}

std::size_t runs_in(const fs::path& folder) {
  std::size_t lines = 0;
  std::error_code none;
  for (const auto& log : fs::directory_iterator(folder / "log", none)) {
    const std::string text = read_file(log.path());
    lines += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    lines -= text.empty() ? 0 : 1;
  }
  return lines;
}

/// Until the folder has so many; false: the tests' patience is at its end.
bool wait_for_runs(const fs::path& folder, std::size_t count) {
  const auto end = std::chrono::steady_clock::now() + vsa::test::kPatience;
  while (runs_in(folder) < count) {
    if (std::chrono::steady_clock::now() > end) return false;
    usleep(1000);
  }
  return true;
}

TEST(Sweep, ThreadsAndPartsGiveTheSameBytes) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  EXPECT_EQ(std::count(expected.begin(),
                       expected.begin() + static_cast<std::ptrdiff_t>(read_file(scratch / "threads/results.csv").size()), '\n'),
            41);
  for (const char* part : {"3/3", "1/3", "2/3"}) {
    const Result r = run_vsa({"sweep", plan(scratch), "--out", scratch / "parts", "--part", part, "--threads", "1"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
  }
  EXPECT_FALSE(fs::exists(scratch / "parts/results.csv"));
  // Two merges at once.
  Subprocess first({"sweep", plan(scratch), "--out", scratch / "parts", "--merge"});
  Subprocess second({"sweep", plan(scratch), "--out", scratch / "parts", "--merge"});
  EXPECT_EQ(first.wait().exit_code, 0);
  EXPECT_EQ(second.wait().exit_code, 0);
  EXPECT_TRUE(tables(scratch / "parts") == expected);
}

/// Two folders of machines that share none, brought together by copying logs.
TEST(Sweep, LogsOfTwoFoldersMakeOneTable) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  for (const char* part : {"1/2", "2/2"}) {
    const fs::path out = scratch / (std::string("of_") + part[0]);
    EXPECT_EQ(run_vsa({"sweep", plan(scratch), "--out", out, "--part", part}).exit_code, 0);
  }
  for (const auto& log : fs::directory_iterator(scratch / "of_2/log"))
    fs::copy(log.path(), (scratch / "of_1/log") / (log.path().filename().string() + "-of-2"));
  EXPECT_EQ(run_vsa({"sweep", plan(scratch), "--out", scratch / "of_1", "--merge"}).exit_code, 0);
  EXPECT_TRUE(tables(scratch / "of_1") == expected);
}

TEST(Sweep, KilledAnywhereItGoesOnWhereItWas) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  for (const int signal : {SIGKILL, SIGINT, SIGTERM}) {
    const fs::path out = scratch / ("killed_" + std::to_string(signal));
    std::size_t known = 0;
    int deaths = 0;
    while (known < 40 && deaths < 3) {
      Subprocess sweep(
          {"sweep", plan(scratch), "--out", out, known == 0 ? "--threads" : "--resume", known == 0 ? "2" : "--threads=2"});
      ASSERT_TRUE(wait_for_runs(out, std::min<std::size_t>(known + 3, 40)));
      sweep.send(signal);
      const int code = sweep.wait().exit_code;
      known = runs_in(out);
      if (code == 0) break;  // it was quicker than the signal
      EXPECT_EQ(code, 128 + signal);
      ++deaths;
    }
    EXPECT_GE(deaths, 1);
    const Result r = run_vsa({"sweep", plan(scratch), "--out", out, "--resume"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(tables(out) == expected) << signal;
    EXPECT_EQ(runs_in(out), 40U) << "nothing twice";
  }
}

TEST(Sweep, AFullDiskEndsItAndNothingIsLost) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  Surroundings full;
  full.largest_file = 700;
  const Result r = run_vsa({"sweep", plan(scratch), "--out", scratch / "full"}, full);
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("log/"), std::string::npos) << r.err;
  EXPECT_GT(runs_in(scratch / "full"), 0U);
  EXPECT_EQ(run_vsa({"sweep", plan(scratch), "--out", scratch / "full", "--resume"}).exit_code, 0);
  EXPECT_TRUE(tables(scratch / "full") == expected);
}

TEST(Sweep, WhatFailsIsListedWithTheCommandThatRepeatsIt) {
  const Scratch scratch;
  write_file(scratch / "plan.toml", plan_text() + "[[vary]]\nkey = \"command.0.time_s\"\nlist = [0.0]\n");
  const Result none = run_vsa({"sweep", scratch / "plan.toml", "--out", scratch / "out"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("the scenario has no commands"), std::string::npos) << none.err;
  EXPECT_FALSE(fs::exists(scratch / "out"));
  std::string hangs = plan_text() + "[limits]\nrun_s = 0.5\n";
  hangs.replace(hangs.find("log = [0.2, 20.0]\ncount = 10"), 28, "list = [0.02, 1e7]");
  write_file(scratch / "plan.toml", hangs);
  const Result r = run_vsa({"sweep", scratch / "plan.toml", "--out", scratch / "out"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("run 2 failed: the limit: run_s = 0.5 s of wall time"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("again: vsa sweep " + (scratch / "plan.toml").string() + " --run 2"), std::string::npos);
  EXPECT_NE(r.out.find("4 of 8, 4 failed"), std::string::npos) << r.out;
  const Result again = run_vsa({"sweep", scratch / "plan.toml", "--run", "2"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.out.find("the limit"), std::string::npos) << again.out;
  const Result one = run_vsa({"sweep", scratch / "plan.toml", "--run", "0"});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_NE(one.out.find("supply_J"), std::string::npos) << one.out;
  EXPECT_EQ(run_vsa({"sweep", scratch / "plan.toml", "--run", "8"}).exit_code, 2);
  // What failed stays failed until somebody wants it tried again.
  EXPECT_EQ(runs_in(scratch / "out"), 8U);
  EXPECT_EQ(run_vsa({"sweep", scratch / "plan.toml", "--out", scratch / "out", "--resume"}).exit_code, 1);
  EXPECT_EQ(runs_in(scratch / "out"), 8U);
  EXPECT_EQ(run_vsa({"sweep", scratch / "plan.toml", "--out", scratch / "out", "--resume", "--retry-failed"}).exit_code, 1);
  EXPECT_EQ(runs_in(scratch / "out"), 12U);
}

TEST(Sweep, ResultsThatAreThereAreNotWrittenOver) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  const Result twice = run_vsa({"sweep", plan(scratch), "--out", scratch / "threads"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("--resume"), std::string::npos) << twice.err;
  const Result other = run_vsa({"sweep", plan(scratch, "seed = 7\n"), "--out", scratch / "threads", "--resume"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("another plan"), std::string::npos) << other.err;
  EXPECT_TRUE(tables(scratch / "threads") == expected);
}

TEST(Sweep, BadInputIsRefusedBeforeAnythingRuns) {
  const Scratch scratch;
  const std::string file = plan(scratch);
  for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{{"--part", "0/3"},
                                                                                   {"--part", "4/3"},
                                                                                   {"--part", "3"},
                                                                                   {"--part", "a/b"},
                                                                                   {"--threads", "0"},
                                                                                   {"--merge", "--part", "1/2"},
                                                                                   {"--retry-failed"},
                                                                                   {"--run", "1"},
                                                                                   {"--check"},
                                                                                   {"--merge", "--resume"},
                                                                                   {"--merge"},
                                                                                   {"--run", "-1"}}) {
    std::vector<std::string> arguments{"sweep", file, "--out", scratch / "out"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const Result r = run_vsa(arguments);
    EXPECT_EQ(r.exit_code, 2) << bad[0] << r.err;
    EXPECT_FALSE(r.err.empty());
  }
  EXPECT_EQ(run_vsa({"sweep", scratch / "nothing.toml"}).exit_code, 2);
  EXPECT_EQ(runs_in(scratch / "out"), 0U);
  const Result check = run_vsa({"sweep", file, "--check"});
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(check.out.find("40 (20 points × 2 repetitions)"), std::string::npos) << check.out;
}

/// vsa-mpi as `mpirun` starts it; where this build has none, or the machine no mpirun, that is said.
class WithRanks : public ::testing::Test {
 protected:
  /// Why there are none; empty: there are.
  [[nodiscard]] static std::string no_ranks() {
    if (!fs::exists(kBin / "vsa-mpi")) return "this build found no MPI";
    return std::system("command -v mpirun > /dev/null") != 0 ? "no mpirun on this machine" : "";
  }
  [[nodiscard]] static Surroundings mpirun() {
    Surroundings s;
    s.program = "/usr/bin/env";
    // As root, and more ranks than processors: what a test needs and Open MPI refuses unless told.
    s.environment = {{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                     {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                     {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                     {"ASAN_OPTIONS", "detect_leaks=0"},  // Open MPI's own
                     {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"}};
    return s;
  }
  static std::vector<std::string> job(int ranks, const std::vector<std::string>& arguments) {
    std::vector<std::string> out{"mpirun", "-n", std::to_string(ranks), (kBin / "vsa-mpi").string(), "sweep"};
    out.insert(out.end(), arguments.begin(), arguments.end());
    return out;
  }
};

class Ranks : public WithRanks {
 protected:
  void SetUp() override {
    if (const std::string why = no_ranks(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_F(Ranks, GiveTheBytesThatThreadsGive) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  for (const int ranks : {1, 2, 4}) {
    const fs::path out = scratch / ("ranks_" + std::to_string(ranks));
    const Result r = run_vsa(job(ranks, {plan(scratch), "--out", out}), mpirun());
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(tables(out) == expected) << ranks;
    EXPECT_EQ(runs_in(out), 40U) << "nothing twice";
  }
  const Result threads = run_vsa(job(2, {plan(scratch), "--out", scratch / "both", "--threads", "2"}), mpirun());
  EXPECT_EQ(threads.exit_code, 0) << threads.err;
  EXPECT_TRUE(tables(scratch / "both") == expected);
}

/// The process numbers of a job's ranks: each has a log that ends in HOST-PID-N.
std::vector<pid_t> ranks_of(const fs::path& folder) {
  std::vector<pid_t> out;
  std::error_code none;
  for (const auto& log : fs::directory_iterator(folder / "log", none)) {
    const std::string name = log.path().filename();
    const std::size_t end = name.rfind('-'), begin = name.rfind('-', end - 1);
    out.push_back(std::stoi(name.substr(begin + 1, end - begin - 1)));
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST_F(Ranks, AJobOfWhichAnyoneDiesGoesOnWhereItWas) {
  const Scratch scratch;
  const std::string expected = by_threads(scratch);
  for (const int who : {0, 1, 2}) {  // a rank (the first started is 0), another one, mpirun itself
    const fs::path out = scratch / ("died_" + std::to_string(who));
    Subprocess sweep(job(2, {plan(scratch), "--out", out}), mpirun());
    ASSERT_TRUE(wait_for_runs(out, 4));
    ASSERT_EQ(ranks_of(out).size(), 2U) << "each made its log before the first run was dealt";
    if (who == 2) {
      sweep.send(SIGKILL);
    } else {
      kill(ranks_of(out)[static_cast<std::size_t>(who)], SIGKILL);
    }
    const Result died = sweep.wait();
    for (const pid_t rank : ranks_of(out))
      for (int i = 0; i < 10'000 && kill(rank, 0) == 0; ++i) usleep(1000);
    const Result r = run_vsa(job(2, {plan(scratch), "--out", out, "--resume"}), mpirun());
    EXPECT_EQ(r.exit_code, 0) << died.exit_code << r.err;
    EXPECT_TRUE(tables(out) == expected) << who;
  }
}

TEST_F(Ranks, BadInputIsToldOnce) {
  const Scratch scratch;
  write_file(scratch / "bad.toml", plan_text("wrong = 1\n"));
  const Result r = run_vsa(job(2, {scratch / "bad.toml", "--out", scratch / "out"}), mpirun());
  EXPECT_EQ(r.exit_code, 2) << r.err;
  EXPECT_NE(r.err.find("wrong: unknown key"), std::string::npos);
  EXPECT_EQ(r.err.find("wrong: unknown key"), r.err.rfind("wrong: unknown key")) << r.err;
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

std::string search_text() {
  return R"(
repetitions = 2
[scenario]
world = "bench_pole"
duration_s = 5.0
faults = ["shaft noise_rad=0.003"]
[[command]]
time_s = 0.0
actuator = "shaft"
equilibrium_rad = 0.5
preset_rad = 0.1
[[vary]]
key = "command.0.preset_rad"
name = "preset_rad"
search = [0.0, 0.7]
[[vary]]
key = "command.0.equilibrium_rad"
name = "equilibrium_rad"
search = [0.1, 1.0]
[[measure]]
name = "error_rad"
signal = "error_rad"
actuator = "shaft"
statistic = "rms"
[[measure]]
name = "supply_J"
signal = "supply_J"
[optimize]
population = 8
generations = 6
[[objective]]
measure = "error_rad"
goal = "minimize"
[[objective]]
measure = "supply_J"
goal = "minimize"
)";
}

std::string findings(const fs::path& folder) { return read_file(folder / "candidates.csv") + tables(folder); }

class Optimize : public WithRanks {
 protected:
  void SetUp() override {
    write_file(scratch_ / "plan.toml", search_text());
    const Result r = run_vsa({"optimize", plan_, "--out", scratch_ / "threads"});
    if (r.err.find("no optimiser") != std::string::npos) GTEST_SKIP() << "this build has no pagmo";
    EXPECT_EQ(r.exit_code, 0) << r.err;
    expected_ = findings(scratch_ / "threads");
    EXPECT_EQ(std::count(expected_.begin(), expected_.begin() + static_cast<std::ptrdiff_t>(expected_.find("point,")), '\n'),
              1 + 8 * 7);
  }
  Scratch scratch_;
  std::string plan_ = scratch_ / "plan.toml", expected_;
};

TEST_F(Optimize, ThreadsAndPartsFindTheSame) {
  EXPECT_EQ(run_vsa({"optimize", plan_, "--out", scratch_ / "one", "--threads", "1"}).exit_code, 0);
  EXPECT_TRUE(findings(scratch_ / "one") == expected_);
  {
    Subprocess second({"optimize", plan_, "--out", scratch_ / "parts", "--part", "2/2"});
    EXPECT_EQ(run_vsa({"optimize", plan_, "--out", scratch_ / "parts", "--part", "1/2"}).exit_code, 0);
    EXPECT_EQ(second.wait().exit_code, 0);
  }
  EXPECT_TRUE(findings(scratch_ / "parts") == expected_);
}

TEST_F(Optimize, KilledItGoesOnWhereItWas) {
  for (const int signal : {SIGKILL, SIGINT}) {
    const fs::path out = scratch_ / ("killed_" + std::to_string(signal));
    Subprocess sweep({"optimize", plan_, "--out", out, "--threads", "1"});
    ASSERT_TRUE(wait_for_runs(out, 20));
    sweep.send(signal);
    EXPECT_EQ(sweep.wait().exit_code, 128 + signal);
    EXPECT_EQ(run_vsa({"optimize", plan_, "--out", out}).exit_code, 2) << "without --resume";
    EXPECT_EQ(run_vsa({"optimize", plan_, "--out", out, "--resume"}).exit_code, 0);
    EXPECT_TRUE(findings(out) == expected_) << signal;
    EXPECT_EQ(runs_in(out), 2U * 8 * 7) << "nothing twice";
  }
}

TEST_F(Optimize, WhatFailedIsTriedAgainWhereThatIsWanted) {
  std::string text = search_text();
  text.replace(text.find("duration_s = 5.0"), 16, "duration_s = 1e7");
  write_file(scratch_ / "long.toml", text + "[limits]\nrun_s = 0.001\n");
  std::vector<std::string> arguments{"optimize", scratch_ / "long.toml", "--out", scratch_ / "failed"};
  EXPECT_EQ(run_vsa(arguments).exit_code, 1) << "every candidate failed";
  EXPECT_EQ(runs_in(scratch_ / "failed"), 2U * 8 * 7);
  arguments.emplace_back("--resume");
  EXPECT_EQ(run_vsa(arguments).exit_code, 1);
  EXPECT_EQ(runs_in(scratch_ / "failed"), 2U * 8 * 7);
  arguments.emplace_back("--retry-failed");
  EXPECT_EQ(run_vsa(arguments).exit_code, 1);
  EXPECT_EQ(runs_in(scratch_ / "failed"), 4U * 8 * 7);
}

TEST_F(Optimize, RanksFindTheSame) {
  if (const std::string why = no_ranks(); !why.empty()) GTEST_SKIP() << why;
  for (const int ranks : {1, 3}) {
    const fs::path out = scratch_ / ("ranks_" + std::to_string(ranks));
    std::vector<std::string> arguments = job(ranks, {plan_, "--out", out});
    arguments[4] = "optimize";
    const Result r = run_vsa(arguments, mpirun());
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(findings(out) == expected_) << ranks;
  }
}

TEST_F(Optimize, APlanOfOneCommandIsRefusedByTheOther) {
  const Result swept = run_vsa({"sweep", plan_, "--out", scratch_ / "x"});
  EXPECT_EQ(swept.exit_code, 2);
  EXPECT_NE(swept.err.find("vsa optimize"), std::string::npos) << swept.err;
  const Scratch other;
  const Result searched = run_vsa({"optimize", plan(other), "--out", other / "x"});
  EXPECT_EQ(searched.exit_code, 2);
  EXPECT_NE(searched.err.find("nothing is searched"), std::string::npos) << searched.err;
}

}  // namespace
