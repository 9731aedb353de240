// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Sweeps as users run them: by threads and by parts; killed and resumed; refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "pool_runs.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::by_threads;
using vsa::test::plan;
using vsa::test::plan_text;
using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::runs_in;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::Surroundings;
using vsa::test::tables;
using vsa::test::wait_for_runs;
using vsa::test::write_file;

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
  Surroundings full;
  full.full_stdout = true;
  EXPECT_EQ(run_vsa({"sweep", plan(scratch), "--check"}, full).exit_code, 1);
  EXPECT_EQ(run_vsa({"sweep", plan(scratch), "--run", "3"}, full).exit_code, 1);
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
  std::string hangs = plan_text() + "[limits]\nrun_s = 3.0\n";
  hangs.replace(hangs.find("log = [0.2, 20.0]\ncount = 10"), 28, "list = [0.02, 1e7]");
  write_file(scratch / "plan.toml", hangs);
  const Result r = run_vsa({"sweep", scratch / "plan.toml", "--out", scratch / "out"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("run 2 failed: the limit: run_s = 3 s of wall time"), std::string::npos) << r.err;
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
  // A part of which nothing is left, too: a job's next step mustn't take it for whole.
  const Result part = run_vsa({"sweep", scratch / "plan.toml", "--out", scratch / "out", "--part", "1/2", "--resume"});
  EXPECT_EQ(part.exit_code, 1);
  EXPECT_NE(part.err.find("2 runs of this part failed"), std::string::npos) << part.err;
  EXPECT_EQ(runs_in(scratch / "out"), 12U);
}

TEST(Sweep, OfTwoInOneFolderOnlyPartsWorkSideBySide) {
  const Scratch scratch;
  std::string endless = plan_text();
  endless.replace(endless.find("log = [0.2, 20.0]\ncount = 10"), 28, "list = [0.02, 1e7]");
  write_file(scratch / "plan.toml", endless);
  const std::vector<std::string> asked{"sweep", scratch / "plan.toml", "--out", scratch / "out", "--threads", "1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), asked.begin(), asked.end());
    return more;
  };
  Subprocess alone(asked);
  ASSERT_TRUE(wait_for_runs(scratch / "out", 1));
  for (const auto& other : {with({"--resume"}), with({"--part", "2/8", "--resume"})}) {
    const Result refused = run_vsa(other);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("another one is at work there"), std::string::npos) << refused.err;
  }
  alone.send(SIGINT);
  EXPECT_EQ(alone.wait().exit_code, 128 + SIGINT);
  // Runs 2 and 3 never end, 4 and 5 do.
  Subprocess third(with({"--part", "3/4", "--resume"}));
  const auto logs = [&] { return std::distance(fs::directory_iterator(scratch / "out/log"), fs::directory_iterator()); };
  for (int i = 0; i < 30'000 && logs() < 2; ++i) usleep(1000);
  ASSERT_EQ(logs(), 2);
  EXPECT_EQ(run_vsa(with({"--part", "5/8"})).exit_code, 0);
  EXPECT_EQ(run_vsa(with({"--resume"})).exit_code, 2);
  third.send(SIGINT);
  EXPECT_EQ(third.wait().exit_code, 128 + SIGINT);
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

}  // namespace
