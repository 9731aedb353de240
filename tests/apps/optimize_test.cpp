// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Searches as users run them: by threads, parts and ranks; killed and resumed; refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "pool_runs.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::plan;
using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::runs_in;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::tables;
using vsa::test::wait_for_runs;
using vsa::test::WithRanks;
using vsa::test::write_file;

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

/// What threads find, made once for all tests; empty: this build has no optimiser.
std::string findings_of_threads() {
  const Scratch scratch;
  write_file(scratch / "plan.toml", search_text());
  const Result r = run_vsa({"optimize", scratch / "plan.toml", "--out", scratch / "threads"});
  if (r.err.find("no optimiser") != std::string::npos) return {};
  EXPECT_EQ(r.exit_code, 0) << r.err;
  std::string found = findings(scratch / "threads");
  EXPECT_EQ(std::count(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(found.find("point,")), '\n'), 1 + 8 * 7);
  return found;
}

class Optimize : public WithRanks {
 protected:
  void SetUp() override {
    static const std::string once = findings_of_threads();
    if (once.empty()) GTEST_SKIP() << "this build has no pagmo";
    write_file(scratch_ / "plan.toml", search_text());
    expected_ = once;
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
    const Result r = run_vsa(job(ranks, {"optimize", plan_, "--out", out}), mpirun());
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
