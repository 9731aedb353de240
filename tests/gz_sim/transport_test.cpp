// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What reaches a robot in gz-sim from outside, and what it tells: topics, gz-sim's own services, a serial port.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <mutex>
#include <thread>

#include "gz_messages.hpp"
#include "gz_world.hpp"
#include "support/heap.hpp"
#include "vsa/bus/client.hpp"
#include "vsa/serial/serial_channel.hpp"
#ifdef VSA_HAS_PARAMETERS
#include <gz/transport/parameters/Client.hh>
#endif

namespace vsa::test {
namespace {

/// The last state of a robot that arrived, and how many did. A callback may still run when its node has gone, so it shares what it
/// writes.
class States {
 public:
  explicit States(const std::string& model) {
    std::function<void(const msgs::Model&)> take = [heard = heard_](const msgs::Model& message) {
      const std::lock_guard lock(heard->mutex);
      heard->last = topics::decode(message);
      heard->last.time_ns = topics::to_ns(message.header().stamp());
      ++heard->count;
    };
    node_.Subscribe("/model/" + model + "/vsa/joint_state", take);
  }
  [[nodiscard]] host::JointStates last() {
    const std::lock_guard lock(heard_->mutex);
    return heard_->last;
  }
  [[nodiscard]] int count() const { return heard_->count; }

 private:
  struct Heard {
    std::mutex mutex;
    host::JointStates last;
    std::atomic<int> count{0};
  };
  std::shared_ptr<Heard> heard_ = std::make_shared<Heard>();
  Node node_;
};

TEST(GzSimTopics, SingleNumbersMoveTheShaftAndTheStatesTellOfIt) {
  SimWorld w(sdf_text(world_text(bench("arm", kHanging))));
  States states("arm");
  Node node;
  auto equilibrium = node.Advertise<msgs::Double>("/model/arm/joint/shaft/cmd_equilibrium");
  auto preset = node.Advertise<msgs::Double>("/model/arm/joint/shaft/cmd_preset");
  ASSERT_TRUE(run_until(w, [&] {
    msgs::Double number;
    number.set_data(0.5);
    equilibrium.Publish(number);
    number.set_data(0.6);
    preset.Publish(number);
    const auto told = states.last().commands;
    return !told.empty() && told[0].equilibrium_rad == 0.5 && told[0].preset == 0.6;
  }));
  w.run(3000);
  EXPECT_GT(w.angle("arm"), 0.3);
  EXPECT_LT(w.angle("arm"), 0.5);
  ASSERT_TRUE(run_until(w, [&] { return states.last().time_ns > 3'000'000'000; }));
  const host::JointStates now = states.last();
  ASSERT_EQ(now.joints.size(), 3u);
  EXPECT_EQ(now.joints[0].name, "shaft");
  EXPECT_NEAR(now.joints[0].position_rad, w.angle("arm"), 1e-3);
  EXPECT_NEAR(now.joints[1].position_rad - now.joints[2].position_rad, 1.2, 0.2) << "twice the preset between the pulleys";
}

TEST(GzSimTopics, ATrajectoryIsFollowedInSimulatedTime) {
  SimWorld w(sdf_text(world_text(bench("arm", kHanging))));
  States states("arm");
  Node node;
  auto publisher = node.Advertise<msgs::JointTrajectory>("/model/arm/vsa/cmd");
  msgs::JointTrajectory message;
  topics::encode(host::Trajectory{{"shaft", "shaft_preset"}, {{{0.0, 0.5}, 0.0}, {{0.6, 0.5}, 2.0}}}, message);
  const auto told = [&] {
    const auto commands = states.last().commands;
    return commands.empty() ? 0.0 : commands[0].equilibrium_rad;
  };
  ASSERT_TRUE(run_until(w, [&] {
    if (told() == 0.0) publisher.Publish(message);
    return told() > 0.01;
  }));
  const double before_rad = told();
  const auto before_ns = states.last().time_ns;
  ASSERT_TRUE(run_until(
      w, [&] { return states.last().time_ns >= before_ns + 500'000'000; }, 10));
  const double passed_s = 1e-9 * static_cast<double>(states.last().time_ns - before_ns);
  if (passed_s < 1.2) {
    EXPECT_NEAR(told() - before_rad, 0.3 * passed_s, 0.02) << "0.6 rad in 2 s";
  }
  ASSERT_TRUE(run_until(
      w, [&] { return told() == 0.6; }, 100));
  w.run(2000);
  EXPECT_GT(w.angle("arm"), 0.35);
}

/// The equilibrium commanded, again and again, until the state tells of it.
void command_equilibrium(SimWorld& w, States& states, double rad) {
  Node node;
  auto equilibrium = node.Advertise<msgs::Double>("/model/arm/joint/shaft/cmd_equilibrium");
  msgs::Double number;
  number.set_data(rad);
  ASSERT_TRUE(run_until(w, [&] {
    equilibrium.Publish(number);
    const auto told = states.last().commands;
    return !told.empty() && told[0].equilibrium_rad == rad;
  }));
}

TEST(GzSimTopics, FaultsAreMadeAndMendedByTheirService) {
  SimWorld w(sdf_text(world_text(bench("arm", kHanging))));
  States states("arm");
  Node node;
  const auto asked = [&node](const std::string& words) {
    msgs::StringMsg request, reply;
    request.set_data(words);
    bool answered = false;
    return node.Request("/model/arm/vsa/faults", request, 5000, reply, answered) && answered ? reply.data() : "no answer";
  };
  EXPECT_EQ(asked("all lost_byte=2").substr(0, 8), "refused:");
  EXPECT_EQ(asked("all lost_byte=1"), "ok: shaft");
  w.run(10);
  command_equilibrium(w, states, 0.5);
  w.run(2000);
  EXPECT_NEAR(w.angle("arm"), 0.0, 0.02) << "no frame reaches the unit";
  EXPECT_EQ(asked("all none"), "ok: shaft");
  w.run(3000);
  EXPECT_GT(w.angle("arm"), 0.15);
}

#ifdef VSA_HAS_PARAMETERS
TEST(GzSimTopics, FaultsAreMadeAndMendedByTheWorldsParameter) {
  SimWorld w(sdf_text(world_text(bench("arm", kHanging))));
  States states("arm");
  gz::transport::parameters::ParametersClient client("/world/test");
  const std::string name = "model.arm.vsa.faults";
  const auto set = [&](const std::string& words) {
    msgs::StringMsg value;
    value.set_data(words);
    return client.SetParameter(name, value);
  };
  w.run(10);
  ASSERT_TRUE(set("all lost_byte=1"));
  w.run(200);
  command_equilibrium(w, states, 0.5);
  w.run(2000);
  EXPECT_NEAR(w.angle("arm"), 0.0, 0.02) << "no frame reaches the unit";
  ASSERT_TRUE(set("all what"));
  w.run(200);
  msgs::StringMsg now;
  ASSERT_TRUE(client.Parameter(name, now));
  EXPECT_EQ(now.data(), "all lost_byte=1") << "what is refused is set back";
  ASSERT_TRUE(set("all none"));
  w.run(3000);
  EXPECT_GT(w.angle("arm"), 0.15);
}
#endif

TEST(GzSimTopics, StatesComeAtTheirRateOfSimulatedTime) {
  SimWorld w(sdf_text(world_text(bench("arm", kHanging))));
  States states("arm");
  ASSERT_TRUE(run_until(w, [&] { return states.count() > 0; }));
  const int before = states.count();
  w.run(2000);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (states.count() < before + 200 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  EXPECT_NEAR(states.count() - before, 200, 3) << "100 Hz";
}

TEST(GzSimTopics, APausedWorldTellsItsStateTenTimesASecond) {
  SimWorld w(sdf_text(world_text(bench("arm", kLevel))));
  States states("arm");
  ASSERT_TRUE(run_until(w, [&] { return states.count() > 0; }));
  w.idle();
  const double angle = w.angle("arm");
  const int before = states.count();
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::seconds(1)) w.idle();
  EXPECT_GE(states.count() - before, 4);
  EXPECT_LE(states.count() - before, 12);
  EXPECT_EQ(w.angle("arm"), angle);
}

TEST(GzSimTopics, ATimeSetBackLeavesTheMotionAsItIs) {
  const std::string sdf = sdf_text(world_text(bench("arm", kLevel)));
  const auto through = SimWorld(sdf).record("arm", 400);
  SimWorld w(sdf);
  Node node;
  auto motion = w.record("arm", 200);
  msgs::LogPlaybackControl back;
  back.mutable_seek()->set_nsec(50'000'000);
  ASSERT_TRUE(ask(node, "/world/test/playback/control", back));
  std::int64_t time_ns = 0;
  w.probes[0]->before = [&](const sim::UpdateInfo& info, sim::EntityComponentManager&) { time_ns = info.simTime.count(); };
  const auto rest = w.record("arm", 200);
  EXPECT_LT(time_ns, 300'000'000) << "it was set back";
  motion.insert(motion.end(), rest.begin(), rest.end());
  EXPECT_EQ(motion, through);
}

TEST(GzSimTopics, AModelSpawnedIntoARunningWorldWorks) {
  SimWorld w(sdf_text(world_text(bench("stays", kLevel))));
  States states("comes");
  Node node;
  w.run(100);
  msgs::EntityFactory request;
  request.set_sdf(sdf_text(bench("comes", kLevelAside)));
  ASSERT_TRUE(ask(node, "/world/test/create", request));
  ASSERT_TRUE(run_until(w, [&] { return !std::isnan(w.angle("comes")); }));
  w.run(2000);
  EXPECT_NEAR(w.angle("comes"), w.angle("stays"), 0.01);
  EXPECT_GT(std::abs(w.angle("comes")), 5 * kDegree);
  EXPECT_TRUE(run_until(w, [&] { return states.count() > 0; })) << "under its own name, without the world's";
}

struct Left {
  std::vector<long> kB;  ///< heap after each cycle
  long threads = 0;      ///< more after the last cycle than after the sixth
};

Left spawn_and_remove(SimWorld& w, const std::string& model, int cycles) {
  Node node;
  msgs::EntityFactory create;
  create.set_sdf(sdf_text(model));
  msgs::Entity remove;
  remove.set_name("comes");
  remove.set_type(msgs::Entity::MODEL);
  Left left;
  long threads = 0;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    if (!ask(node, "/world/test/create", create)) throw std::runtime_error("gz-sim takes no model");
    if (!run_until(w, [&] { return !std::isnan(w.angle("comes")); })) throw std::runtime_error("no model came");
    w.run(50);
    if (!ask(node, "/world/test/remove", remove)) throw std::runtime_error("gz-sim removes no model");
    if (!run_until(w, [&] { return std::isnan(w.angle("comes")); })) throw std::runtime_error("the model stayed");
    w.run(10);
    left.kB.push_back(heap_in_use_kB());
    if (cycle == 5) threads = threads_of_this_process();
  }
  left.threads = threads_of_this_process() - threads;
  return left;
}

TEST(GzSimTopics, ModelsSpawnedAndRemovedWhileTheWorldRunsLeakNothing) {
  const int cycles = std::getenv("VSA_TEST_LONG") != nullptr ? 100 : 20;
  let_the_host_fill_its_pools();
  SimWorld w(sdf_text(world_text(bench("stays", kLevel))));
  const std::string model = bench("comes", kLevelAside);
  // Fortress keeps 29 kB of every model that went, and of one with the plug-in's components 7 to 8 kB more.
  const long host = usual_growth(spawn_and_remove(w, without_plugin(model), cycles).kB);
  const Left left = spawn_and_remove(w, model, cycles);
  std::cout << "heap a cycle: " << usual_growth(left.kB) << " kB, " << host << " of it without the plug-in\n";
  EXPECT_LT(usual_growth(left.kB), host + 12) << "kB a cycle";
  EXPECT_EQ(left.threads, 0);
  EXPECT_GT(std::abs(w.angle("stays")), 5 * kDegree);
  EXPECT_LT(std::abs(w.angle("stays")), 60 * kDegree);
}

TEST(GzSimSerial, AClientOnTheSerialPortMovesTheModel) {
  const std::string path = testing::TempDir() + "vsa_gz_" + std::to_string(getpid());
  const std::string port = "cycle_s=\"auto\"><serial_port>" + path + "</serial_port></bus>";
  SimWorld w(sdf_text(world_text(replaced(bench("arm", kHanging), "cycle_s=\"auto\"/>", port), {.gravity = false})));
  w.run(10);
  vsa::serial::SerialChannel channel(path);
  vsa::bus::Client client(channel, {.reply_timeout = std::chrono::seconds(10)});
  ASSERT_TRUE(client.activate(1, true));
  ASSERT_TRUE(client.set_inputs(1, {vsa::Ticks{7000}, vsa::Ticks{5000}}));
  ASSERT_TRUE(client.measurements(1)) << "the answer comes from the last tick while the world stands";
  w.run(3000);
  const auto answer = client.measurements(1);
  ASSERT_TRUE(answer);
  EXPECT_GT(w.angle("arm"), 20 * kDegree);
  EXPECT_NEAR(answer->positions[2].value * 360 * kDegree / 32768, w.angle("arm"), 0.5 * kDegree);
}

}  // namespace
}  // namespace vsa::test
