// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa command` against a `vsa run` in another process, over real sockets.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "subprocess.hpp"

namespace {

using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Subprocess;
using vsa::test::Surroundings;

class Command : public testing::Test {
 protected:
  /// Each test has a partition of its own.
  Surroundings around{false,
                      false,
                      std::nullopt,
                      {{"IGN_PARTITION", std::string("vsa_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
                                             std::to_string(getpid())}}};
};

TEST_F(Command, MovesTheOnlyRobotThatRuns) {
  Subprocess world({"run", "bench_load", "--realtime"}, around);
  const auto result = run_vsa({"command", "-20", "30", "--timeout-s", "30"}, around);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("-20° with preset 30°"), std::string::npos) << result.out;
  world.send(SIGINT);
  EXPECT_EQ(world.wait().exit_code, 0);
}

TEST_F(Command, NamesTheJointsThereAreWhereOneIsUnknown) {
  Subprocess world({"run", "snake_flat", "--realtime"}, around);
  const auto unknown = run_vsa({"command", "10", "30", "--joint", "knee", "--timeout-s", "30"}, around);
  EXPECT_EQ(unknown.exit_code, 2) << unknown.err;
  EXPECT_NE(unknown.err.find("joint_11"), std::string::npos) << unknown.err;
  const auto known = run_vsa({"command", "10", "30", "--joint", "joint_11", "--timeout-s", "30"}, around);
  EXPECT_EQ(known.exit_code, 0) << known.err;
  EXPECT_NE(known.out.find("joint_11 follows"), std::string::npos) << known.out;
}

TEST_F(Command, SaysThatNobodyRuns) {
  const auto result = run_vsa({"command", "10", "30", "--timeout-s", "1.5"}, around);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no running robot"), std::string::npos) << result.err;
}

TEST_F(Command, SaysWhichRobotsRunWhereTheWantedOneDoesNot) {
  Subprocess world({"run", "bench_load", "--realtime"}, around);
  ASSERT_EQ(run_vsa({"command", "0", "20", "--timeout-s", "30"}, around).exit_code, 0);
  const auto result = run_vsa({"command", "10", "30", "--model", "atlas", "--timeout-s", "2"}, around);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no robot 'atlas' runs (running: "), std::string::npos) << result.err;
}

TEST_F(Command, SaysThatAPausedWorldDoesNotFollow) {
  Subprocess world({"run", "bench_load", "--paused"}, around);
  const auto result = run_vsa({"command", "10", "30", "--timeout-s", "4"}, around);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("is the world paused?"), std::string::npos) << result.err;
}

}  // namespace
