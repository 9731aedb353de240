// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Sweeps by ranks of an MPI job: the same bytes, whoever dies.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "pool_runs.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::by_threads;
using vsa::test::plan;
using vsa::test::plan_text;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::runs_in;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::tables;
using vsa::test::wait_for_runs;
using vsa::test::WithRanks;
using vsa::test::write_file;

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
    const Result r = run_vsa(job(ranks, {"sweep", plan(scratch), "--out", out}), mpirun());
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(tables(out) == expected) << ranks;
    EXPECT_EQ(runs_in(out), 40U) << "nothing twice";
  }
  const Result threads = run_vsa(job(2, {"sweep", plan(scratch), "--out", scratch / "both", "--threads", "2"}), mpirun());
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
    Subprocess sweep(job(2, {"sweep", plan(scratch), "--out", out}), mpirun());
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
    const Result r = run_vsa(job(2, {"sweep", plan(scratch), "--out", out, "--resume"}), mpirun());
    EXPECT_EQ(r.exit_code, 0) << died.exit_code << r.err;
    EXPECT_TRUE(tables(out) == expected) << who;
  }
}

TEST_F(Ranks, BadInputIsToldOnce) {
  const Scratch scratch;
  write_file(scratch / "bad.toml", plan_text("wrong = 1\n"));
  const Result r = run_vsa(job(2, {"sweep", scratch / "bad.toml", "--out", scratch / "out"}), mpirun());
  EXPECT_EQ(r.exit_code, 2) << r.err;
  EXPECT_NE(r.err.find("wrong: unknown key"), std::string::npos);
  EXPECT_NE(r.err.find("vsa-mpi: " + (scratch / "bad.toml").string()), std::string::npos) << "told by whom: " << r.err;
  EXPECT_EQ(r.err.find("wrong: unknown key"), r.err.rfind("wrong: unknown key")) << r.err;
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

}  // namespace
