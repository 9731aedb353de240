// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/world_server.hpp"

#include <gtest/gtest.h>
#include <ignition/msgs/boolean.pb.h>
#include <ignition/msgs/clock.pb.h>
#include <ignition/msgs/stringmsg.pb.h>
#include <ignition/msgs/world_control.pb.h>
#include <ignition/msgs/world_stats.pb.h>

#include <atomic>
#include <ignition/transport/Node.hh>
#include <thread>

#include "served_world.hpp"
#include "transport_test.hpp"

namespace {

namespace msgs = ignition::msgs;
using vsa::test::kPatience;
using vsa::test::Mailbox;
using vsa::test::ServedWorld;
using vsa::test::until;
constexpr unsigned kPatience_ms = std::chrono::milliseconds(kPatience).count();

class WorldServer : public testing::Test {
 protected:
  /// What the service answers; the loop goes on meanwhile.
  std::optional<bool> ask(const msgs::WorldControl& request) {
    msgs::Boolean reply;
    bool result = false;
    const bool done = other.Request("/world/bench/control", request, kPatience_ms, reply, result);
    return done && result ? std::optional(reply.data()) : std::nullopt;
  }

  ServedWorld served{true};
  ignition::transport::Node other;
};

TEST_F(WorldServer, StepsExactlyAsAskedWhilePaused) {
  served.start();
  msgs::WorldControl request;
  request.set_pause(true);
  request.set_multi_step(25);
  ASSERT_EQ(ask(request), true);
  ASSERT_TRUE(served.wait_for([](const auto& world) { return world.time_ns() == 25'000'000; }));
  request.clear_multi_step();
  request.set_step(true);
  ASSERT_EQ(ask(request), true);
  ASSERT_TRUE(served.wait_for([](const auto& world) { return world.time_ns() == 26'000'000; }));
}

TEST_F(WorldServer, RunsPausesAndRunsToATime) {
  served.start();
  msgs::WorldControl request;
  ASSERT_EQ(ask(request), true) << "an absent pause lets it run";
  ASSERT_TRUE(served.wait_for([](const auto& world) { return world.time_ns() > 50'000'000; }));
  request.set_pause(true);
  ASSERT_EQ(ask(request), true);
  ASSERT_TRUE(served.wait_for([this](const auto&) { return served.control.paused(); }));
  const std::int64_t goal_ns = served.time_ns() + 1'000'000'000;
  request.Clear();
  request.mutable_run_to_sim_time()->set_sec(goal_ns / 1'000'000'000);
  request.mutable_run_to_sim_time()->set_nsec(static_cast<int>(goal_ns % 1'000'000'000));
  ASSERT_EQ(ask(request), true);
  ASSERT_TRUE(served.wait_for([goal_ns](const auto& world) { return world.time_ns() >= goal_ns; }));
  ASSERT_TRUE(served.wait_for([this](const auto&) { return served.control.paused(); }));
  EXPECT_EQ(served.time_ns(), goal_ns);
}

TEST_F(WorldServer, BreaksAUnitOnRequestAndSaysWhatItWontDo) {
  served.start();
  const auto ask_for = [this](const std::string& words) {
    msgs::StringMsg request, reply;
    request.set_data(words);
    bool result = false;
    const bool done = other.Request("/model/bench_arm/vsa/faults", request, kPatience_ms, reply, result);
    return done && result ? reply.data() : std::string("no answer");
  };
  msgs::WorldControl run;
  ASSERT_EQ(ask(run), true);
  EXPECT_EQ(ask_for("joint_1 off"), "ok: joint_1");
  ASSERT_TRUE(served.wait_for([](const auto& world) { return !world.robot(0).faults(0).powered; }));
  const std::string refused = ask_for("joint_1 supply_V=lots");
  EXPECT_EQ(refused.rfind("refused: ", 0), 0U) << refused;
  EXPECT_NE(refused.find("supply_V=lots"), std::string::npos) << refused;
  EXPECT_EQ(ask_for("all none"), "ok: joint_1");
  ASSERT_TRUE(served.wait_for([](const auto& world) { return world.robot(0).faults(0).powered; }));
}

TEST_F(WorldServer, ResetsToTheFirstSample) {
  served.start();
  msgs::WorldControl request;
  request.set_pause(true);
  request.set_multi_step(300);
  ASSERT_EQ(ask(request), true);
  ASSERT_TRUE(served.wait_for([](const auto& world) { return world.time_ns() == 300'000'000; }));
  request.clear_multi_step();
  request.mutable_reset()->set_all(true);
  ASSERT_EQ(ask(request), true);
  EXPECT_TRUE(served.wait_for([](const auto& world) { return world.time_ns() == 0; }));
}

TEST_F(WorldServer, RefusesWhatItCannotHonour) {
  served.start();
  msgs::WorldControl time_only, model_only, seed;
  time_only.mutable_reset()->set_time_only(true);
  model_only.mutable_reset()->set_model_only(true);
  seed.set_seed(7);
  EXPECT_EQ(ask(time_only), false);
  EXPECT_EQ(ask(time_only), false);
  EXPECT_EQ(ask(model_only), false);
  EXPECT_EQ(ask(seed), false);
  EXPECT_EQ(served.lines.all().size(), 3U) << "one line a kind";
  EXPECT_EQ(served.time_ns(), 0) << "a refused request lets nothing run";
}

TEST_F(WorldServer, TheClockIsSimulatedTimeAndTheStatsSayWhetherItIsPaused) {
  Mailbox<std::int64_t> clock;
  Mailbox<bool> paused;
  auto on_clock = clock.handler<msgs::Clock>([](const msgs::Clock& m) { return m.sim().sec() * 1'000'000'000 + m.sim().nsec(); });
  auto on_stats = paused.handler<msgs::WorldStatistics>([](const msgs::WorldStatistics& m) { return m.paused(); });
  ASSERT_TRUE(other.Subscribe("/clock", on_clock));
  ASSERT_TRUE(other.Subscribe("/world/bench/stats", on_stats));
  served.start();
  EXPECT_TRUE(clock.wait([](std::int64_t ns) { return ns == 0; }, kPatience)) << "a paused world tells its time too";
  EXPECT_TRUE(paused.wait([](bool value) { return value; }, kPatience));
  msgs::WorldControl request;
  request.set_pause(true);
  request.set_multi_step(40);
  ASSERT_EQ(ask(request), true);
  EXPECT_TRUE(clock.wait([](std::int64_t ns) { return ns == 40'000'000; }, kPatience));
  request.Clear();
  ASSERT_EQ(ask(request), true);
  EXPECT_TRUE(paused.wait([](bool value) { return !value; }, kPatience));
  EXPECT_TRUE(clock.wait([](std::int64_t ns) { return ns > 100'000'000; }, kPatience));
}

TEST_F(WorldServer, TheStateOfAPausedRobotCanBeSeen) {
  served.start();
  vsa::topics::CommandClient client;
  client.watch("bench_arm");
  EXPECT_TRUE(client.wait_for_state(kPatience).has_value());
}

}  // namespace
