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
  /// Tries again with more time where an answer came too soon for a busy machine: before the two processes had found each other.
  Result command_that_says(const std::string& part, std::vector<std::string> words) const {
    Result result;
    words.insert(words.begin(), "command");
    words.insert(words.end(), {"--timeout-s", ""});
    for (const char* timeout_s : {"3", "12", "60"}) {
      words.back() = timeout_s;
      result = run_vsa(words, around);
      if (result.err.find(part) != std::string::npos) break;
    }
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    return result;
  }

  /// Each test has a partition of its own: what the last one ran may not have left yet.
  Surroundings around{false,
                      false,
                      std::nullopt,
                      {{"IGN_PARTITION", std::string("vsa_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
                                             std::to_string(getpid())}}};
};

TEST_F(Command, MovesTheOnlyRobotThatRuns) {
  Subprocess world({"run", "bench_load", "--realtime"}, around);
  const auto result = run_vsa({"command", "-20", "30", "--timeout-s", "120"}, around);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("-20° with preset 30°"), std::string::npos) << result.out;
  world.send(SIGINT);
  EXPECT_EQ(world.wait().exit_code, 0);
}

TEST_F(Command, NamesTheJointsThereAreWhereOneIsUnknown) {
  Subprocess world({"run", "snake_flat", "--realtime"}, around);
  const auto unknown = run_vsa({"command", "10", "30", "--joint", "knee", "--timeout-s", "120"}, around);
  EXPECT_EQ(unknown.exit_code, 2) << unknown.err;
  EXPECT_NE(unknown.err.find("joint_11"), std::string::npos) << unknown.err;
  const auto known = run_vsa({"command", "10", "30", "--joint", "joint_11", "--timeout-s", "120"}, around);
  EXPECT_EQ(known.exit_code, 0) << known.err;
  EXPECT_NE(known.out.find("joint_11 follows"), std::string::npos) << known.out;
  EXPECT_NE(known.out.find("as far as its limits"), std::string::npos) << known.out;
  const auto all = run_vsa({"command", "10", "30", "--timeout-s", "120"}, around);
  EXPECT_NE(all.out.find("as far as their limits"), std::string::npos) << all.out;
}

TEST_F(Command, SaysThatNobodyRuns) {
  const auto result = run_vsa({"command", "10", "30", "--timeout-s", "1.5"}, around);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no running robot"), std::string::npos) << result.err;
}

TEST_F(Command, SaysWhichRobotsRunWhereTheWantedOneDoesNot) {
  Subprocess world({"run", "bench_load", "--realtime"}, around);
  ASSERT_EQ(run_vsa({"command", "0", "20", "--timeout-s", "120"}, around).exit_code, 0);
  EXPECT_EQ(command_that_says("no robot 'atlas' runs (running: ", {"10", "30", "--model", "atlas"}).exit_code, 1);
}

TEST_F(Command, EndsWellWhileTheOtherTellsOfItself) {
  Subprocess world({"run", "snake_flat", "--realtime"}, around);
  ASSERT_EQ(run_vsa({"command", "0", "20", "--timeout-s", "120"}, around).exit_code, 0);
  // In this while after its first word a robot's name and topics come in, many of them just as the command gives up.
  for (const char* timeout_s : {"0.05", "0.1", "0.2", "0.3", "0.5"}) {
    const auto result = run_vsa({"command", "0", "20", "--timeout-s", timeout_s}, around);
    EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << timeout_s << " s: " << result.exit_code << '\n' << result.err;
  }
}

TEST_F(Command, ALinearActuatorIsToldInItsOwnUnits) {
  const vsa::test::Scratch scratch;
  vsa::test::write_file(scratch / "press.sdf", R"(<sdf version="1.9"><world name="w"><model name="press">
    <link name="base"><inertial><mass>1</mass></inertial></link>
    <link name="plate"><inertial><mass>10</mass></inertial></link>
    <joint name="foot" type="fixed"><parent>world</parent><child>base</child></joint>
    <joint name="slide" type="prismatic"><parent>base</parent><child>plate</child><axis><xyz>0 0 1</xyz></axis></joint>
    <plugin name="vsa::Robot" filename="libvsa-robot.so">
      <actuator name="ram"><joint>slide</joint><type>linear_sea_example</type></actuator></plugin></model></world></sdf>)");
  Subprocess world({"run", (scratch / "press.sdf").string(), "--realtime", "--record", (scratch / "out").string()}, around);
  const auto result = run_vsa({"command", "0.02", "2000", "--timeout-s", "120"}, around);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("ram follows 0.02 m with preset 2000 N/m"), std::string::npos) << result.out;
  world.send(SIGINT);
  EXPECT_EQ(world.wait().exit_code, 0);
  const std::string table = vsa::test::read_file(scratch / "out/press_actuators.csv");
  for (const char* told : {",0.02,", ",2000,"})
    EXPECT_NE(table.find(told), std::string::npos) << table.substr(table.size() - std::min<std::size_t>(table.size(), 300));
}

TEST_F(Command, SaysThatAPausedWorldDoesNotFollow) {
  Subprocess world({"run", "bench_load", "--paused"}, around);
  EXPECT_EQ(command_that_says("is the world paused?", {"10", "30"}).exit_code, 1);
}

}  // namespace
