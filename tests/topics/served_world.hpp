// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A bench world of one qbmove with a lever, run and served by a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "transport_test.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/topics/command_client.hpp"
#include "vsa/topics/world_server.hpp"

namespace vsa::test {

inline constexpr const char* kBenchSdf = R"(<sdf version="1.8"><world name="bench">
  <physics name="1ms" type="ignored"><max_step_size>0.001</max_step_size></physics>
  <model name="bench_arm">
    <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
    <link name="base"><inertial><mass>1</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy><izz>1e-3</izz></inertia></inertial></link>
    <link name="lever"><inertial><mass>0.1</mass><inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial></link>
    <joint name="shaft" type="revolute"><parent>base</parent><child>lever</child><axis><xyz>0 0 1</xyz></axis></joint>
    <plugin name="vsa::Robot" filename="libvsa-robot.so">
      <actuator name="joint_1"><joint>shaft</joint><type>qbmove_maker_pro_6_1</type><bus id="1">arm</bus>
        <initial equilibrium_rad="0" preset_rad="0.2"/></actuator>
      <bus name="arm" baud="2000000" cycle_s="auto"/>
      <state_rate_Hz>100</state_rate_Hz>
    </plugin>
  </model></world></sdf>)";

inline engine::World load_bench() {
  engine::WorldOptions options;
  options.types = config::TypeLibrary({std::string(VSA_SOURCE_DIR) + "/actuators"});
  return engine::World::load_string(kBenchSdf, options);
}

/// The loop of `vsa run`, in small.
class ServedWorld {
 public:
  explicit ServedWorld(bool paused)
      : control(paused), server(world_, control, [this](const std::string& line) { lines.put(line); }) {}
  ~ServedWorld() {
    stop_ = true;
    control.request({});  // wakes the loop
    if (loop_.joinable()) loop_.join();
  }

  void start() {
    loop_ = std::thread([this] {
      while (!stop_) turn();
    });
  }

  /// Until the condition holds between two turns of the loop, within the tests' patience.
  bool wait_for(const std::function<bool(const engine::World&)>& condition) {
    std::unique_lock lock(mutex_);
    return turned_.wait_for(lock, kPatience, [&] { return condition(world_); });
  }
  [[nodiscard]] std::int64_t time_ns() {
    const std::lock_guard lock(mutex_);
    return world_.time_ns();
  }
  [[nodiscard]] double equilibrium_command_rad() {
    const std::lock_guard lock(mutex_);
    return world_.read("joint_1").equilibrium_command_rad;
  }

 private:
  engine::World world_ = load_bench();
  std::mutex mutex_;  // guards world_ and server while the loop runs
  std::condition_variable turned_;
  std::atomic<bool> stop_{false};

 public:
  Mailbox<std::string> lines;
  seat::RunControl control;
  topics::WorldServer server;

 private:
  void turn() {
    auto next = seat::RunControl::Next::wait;
    {
      const std::lock_guard lock(mutex_);
      next = control.next(world_.time_ns());
      if (next == seat::RunControl::Next::step) {
        world_.step();
        server.stepped();
      } else {
        if (next == seat::RunControl::Next::reset) world_.reset();
        server.idle();
      }
    }
    turned_.notify_all();
    if (next == seat::RunControl::Next::wait) control.wait(std::chrono::milliseconds(20));
  }

  std::thread loop_;
};

}  // namespace vsa::test
