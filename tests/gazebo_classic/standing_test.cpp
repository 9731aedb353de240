// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world that stands (paused, or not run) still tells its state, so that who comes late sees it.
#include <gazebo/msgs/param_v.pb.h>
#include <gtest/gtest.h>
#include <ignition/msgs/double.pb.h>
#include <ignition/msgs/model.pb.h>
#include <ignition/msgs/stringmsg.pb.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <gazebo/transport/transport.hh>
#include <ignition/transport/Node.hh>
#include <memory>
#include <mutex>
#include <vector>

#include "classic_world.hpp"

namespace vsa::test {
namespace {

using Clock = std::chrono::steady_clock;

/// What arrives on the joint states' topic: simulated stamps. A callback may still run when its node has gone, so it shares what it
/// writes.
class StateListener {
 public:
  explicit StateListener(const std::string& topic) {
    std::function<void(const ignition::msgs::Model&)> take = [heard = heard_](const ignition::msgs::Model& message) {
      const std::lock_guard lock(heard->mutex);
      const auto& stamp = message.header().stamp();
      heard->stamps_ns.push_back(stamp.sec() * std::int64_t{1'000'000'000} + stamp.nsec());
      heard->arrived.notify_all();
    };
    if (!node_.Subscribe(topic, take)) throw std::runtime_error("can't listen to " + topic);
  }
  /// False: not within 20 s.
  bool wait_for(const std::function<bool(const std::vector<std::int64_t>&)>& condition) {
    std::unique_lock lock(heard_->mutex);
    return heard_->arrived.wait_for(lock, std::chrono::seconds(20), [&] { return condition(heard_->stamps_ns); });
  }
  std::size_t count() {
    const std::lock_guard lock(heard_->mutex);
    return heard_->stamps_ns.size();
  }

 private:
  struct Heard {
    std::mutex mutex;
    std::condition_variable arrived;
    std::vector<std::int64_t> stamps_ns;
  };
  std::shared_ptr<Heard> heard_ = std::make_shared<Heard>();
  ignition::transport::Node node_;
};

TEST(StandingWorld, PublishesItsLastStateTenTimesAWallSecond) {
  ClassicWorld w(world_sdf("standing", include("qbmove_bench_load", "bench", kLeverLevel)));
  w.run(50);
  StateListener listener("/model/bench/vsa/joint_state");
  ASSERT_TRUE(listener.wait_for([](const auto& stamps) { return !stamps.empty(); }));
  const auto start = Clock::now();
  const std::size_t before = listener.count();
  ASSERT_TRUE(listener.wait_for([&](const auto& stamps) { return stamps.size() >= before + 11; }));
  EXPECT_GT(Clock::now() - start, std::chrono::milliseconds(950)) << "no more often than that";
  ASSERT_TRUE(listener.wait_for([](const auto& stamps) {
    return std::all_of(stamps.begin(), stamps.end(), [](std::int64_t ns) { return ns == 50'000'000; });
  }));
}

TEST(StandingWorld, ShowsASingleStepAndATimeThatIsSetBack) {
  ClassicWorld w(world_sdf("stepped", include("qbmove_bench_load", "bench", kLeverLevel)));
  w.run(50);
  StateListener listener("/model/bench/vsa/joint_state");
  const auto last_is = [](std::int64_t ns) {
    return [ns](const std::vector<std::int64_t>& stamps) { return !stamps.empty() && stamps.back() == ns; };
  };
  ASSERT_TRUE(listener.wait_for(last_is(50'000'000)));
  w.run(1);
  EXPECT_TRUE(listener.wait_for(last_is(51'000'000)));
  w.world->ResetTime();
  EXPECT_TRUE(listener.wait_for(last_is(0)));
}

TEST(StandingWorld, TakesFaultsByTheirServiceForTheStepsThatFollow) {
  ClassicWorld w(world_sdf("faults", include("qbmove_bench_load", "bench", kLeverLevel)));
  w.run(10);
  ignition::transport::Node node;
  const auto asked = [&node](const std::string& words) {
    ignition::msgs::StringMsg request, reply;
    request.set_data(words);
    bool answered = false;
    return node.Request("/model/bench/vsa/faults", request, 5000, reply, answered) && answered ? reply.data() : "no answer";
  };
  EXPECT_EQ(asked("all lost_byte=2").substr(0, 8), "refused:");
  auto equilibrium = node.Advertise<ignition::msgs::Double>("/model/bench/joint/shaft/cmd_equilibrium");
  ignition::msgs::Double half;
  half.set_data(0.5);
  const auto moved = [&] {
    const double from = w.angle("bench");
    for (int i = 0; i < 40; ++i) {  // the two may still be finding each other
      equilibrium.Publish(half);
      w.run(50);
    }
    return w.angle("bench") - from;
  };
  w.run(2000);
  EXPECT_EQ(asked("all lost_byte=1"), "ok: shaft");
  EXPECT_NEAR(moved(), 0.0, 0.01) << "no frame reaches the unit";
  EXPECT_EQ(asked("all none"), "ok: shaft");
  EXPECT_GT(moved(), 0.3);
}

TEST(StandingWorld, IsHeardOnGazebosOwnTransportToo) {
  ClassicWorld w(world_sdf("own", include("qbmove_bench_load", "bench", kLeverLevel)));
  w.run(50);
  std::mutex mutex;
  std::condition_variable arrived;
  std::vector<double> presets;
  const gazebo::transport::NodePtr node(new gazebo::transport::Node);
  node->Init(w.world->Name());
  struct Sink {
    std::function<void(double)> take;
    void receive(const boost::shared_ptr<const gazebo::msgs::Param_V>& message) {
      EXPECT_EQ(message->param(0).name(), "time");
      EXPECT_EQ(message->param_size(), 6);
      for (const gazebo::msgs::Param& param : message->param()) {
        if (param.name() == "shaft/preset") take(param.value().double_value());
      }
    }
  };
  Sink sink{[&](double preset) {
    const std::lock_guard lock(mutex);
    presets.push_back(preset);
    arrived.notify_all();
  }};
  auto subscriber = node->Subscribe("/model/bench/vsa/readings", &Sink::receive, &sink);
  {
    std::unique_lock lock(mutex);
    EXPECT_TRUE(arrived.wait_for(lock, std::chrono::seconds(20), [&] { return presets.size() >= 3; }));
  }
  subscriber.reset();
  node->Fini();
  ASSERT_FALSE(presets.empty());
  EXPECT_NEAR(presets.front(), 0.2, 0.05);
}

}  // namespace
}  // namespace vsa::test
