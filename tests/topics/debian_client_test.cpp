// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Debian's own command-line client, over real sockets: what docs/reference/topics.md shows.
#include <gtest/gtest.h>
#include <unistd.h>

#include "served_world.hpp"
#include "transport_test.hpp"

namespace {

using vsa::test::kServiceTool;
using vsa::test::kTopicTool;
using vsa::test::run_command;
using vsa::test::ServedWorld;
using vsa::test::until;

class DebianClient : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(access(kTopicTool, X_OK), 0) << "package ignition-transport-cli is missing";
    served.start();
  }
  ServedWorld served{false};
};

TEST_F(DebianClient, ListsTheTopics) {
  // One look can come before all announcements have: each topic must be listed within the tests' patience.
  vsa::test::Output list;
  std::string missing;
  EXPECT_TRUE(until([&] {
    list = run_command(std::string(kTopicTool) + " -l");
    missing.clear();
    for (const char* topic :
         {"/clock", "/world/bench/stats", "/model/bench_arm/vsa/joint_state", "/model/bench_arm/joint/joint_1/stiffness"}) {
      if (list.text.find(std::string(topic) + "\n") == std::string::npos) missing += std::string(topic) + " ";
    }
    return missing.empty();
  })) << missing
      << "missing in\n"
      << list.text;
  EXPECT_EQ(list.exit_code, 0);
}

TEST_F(DebianClient, EchoesAState) {
  // That program can die at its own end, when it has told all (signal 11, once in some hundred runs on a busy machine).
  vsa::test::Output echo;
  EXPECT_TRUE(until([&] {
    echo = run_command(std::string(kTopicTool) + " -e -n 1 -t /model/bench_arm/vsa/joint_state");
    return echo.exit_code == 0;
  })) << echo.exit_code;
  for (const char* part : {"name: \"bench_arm\"", "name: \"shaft\"", "name: \"joint_1_motor_2\"", "preset_command"}) {
    EXPECT_NE(echo.text.find(part), std::string::npos) << part << " isn't in\n" << echo.text;
  }
}

TEST_F(DebianClient, PublishesACommand) {
  const std::string publish =
      std::string(kTopicTool) + " -t /model/bench_arm/joint/joint_1/cmd_equilibrium -m ignition.msgs.Double -p 'data: 0.25'";
  // The client sends once, after a fixed time of its own, and the message is lost where the two haven't found each other by then: on a
  // busy machine most are.
  EXPECT_TRUE(until(
      [&] {
        run_command(publish);
        return served.equilibrium_command_rad() == 0.25;
      },
      10 * vsa::test::kPatience));
}

TEST_F(DebianClient, PausesTheWorld) {
  const std::string pause = std::string(kServiceTool) +
                            " -s /world/bench/control --reqtype ignition.msgs.WorldControl --reptype "
                            "ignition.msgs.Boolean --timeout 5000 -r 'pause: true'";
  // It asks once, too: a request before the two have found each other is lost, in one of eight runs under the thread sanitizer.
  vsa::test::Output reply;
  EXPECT_TRUE(until(
      [&] {
        reply = run_command(pause);
        return reply.text.find("data: true") != std::string::npos;
      },
      10 * vsa::test::kPatience))
      << reply.text;
  EXPECT_TRUE(served.wait_for([this](const auto&) { return served.control.paused(); }));
}

}  // namespace
