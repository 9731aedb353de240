// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// gazebo_classic_overhead [ode|dart [PEER.sdf]]: what the plug-in costs a step of the snake's world (12 modules), beside the
// physics alone or, with PEER.sdf, beside the plug-ins of that world (peer.hpp).
//
// Two worlds in one process take turns, a block of steps each: one with the plug-in, one without, whose joints get the torques that
// the first one's got. So both make the same motion, which is checked bit for bit, and the difference is the plug-in's. A clock
// around the plug-in's own call gives a second figure, the stepping thread's processor time.
#include <ignition/msgs/double.pb.h>
#include <ignition/msgs/model.pb.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <ignition/transport/Node.hh>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "classic_world.hpp"
#include "gait_player.hpp"
#include "peer.hpp"
#include "processor_time.hpp"
#include "spread.hpp"
#include "vsa/errors.hpp"
#include "vsa/host/topics.hpp"

namespace {

using namespace std::chrono;  // NOLINT(google-build-using-namespace): a program, not a header
using gazebo::common::UpdateInfo;
using gazebo::event::Events;
using vsa::test::processor_time;
using vsa::test::RobotWorld;
using vsa::test::spread;
using vsa::test::text;

constexpr int kBlock = 1000, kBlocks = 20, kWarmUp = 3000;
constexpr std::size_t kModules = 12;
const std::string kModel = "qbmove_snake";

enum class Listening { none, states, all };

/// A process of its own that listens to the robot's topics until its input ends, and then says how much came.
int listen(bool to_all) {
  // A callback may still run when its node has gone.
  const auto states = std::make_shared<std::atomic<long>>(0), numbers = std::make_shared<std::atomic<long>>(0);
  {
    ignition::transport::Node node;
    std::function<void(const ignition::msgs::Model&)> on_states = [states](const auto&) { ++*states; };
    std::function<void(const ignition::msgs::Double&)> on_number = [numbers](const auto&) { ++*numbers; };
    if (!node.Subscribe(vsa::host::model_topic(kModel, "vsa/joint_state"), on_states)) return 1;
    for (std::size_t i = 0; to_all && i < kModules; ++i) {
      for (const char* leaf : {"stiffness", "deflection", "preset", "current_1", "current_2"}) {
        if (!node.Subscribe(vsa::host::joint_topic(kModel, "joint_" + std::to_string(i), leaf), on_number)) return 1;
      }
    }
    while (std::getchar() != EOF) {
    }
  }
  std::cerr << "  the listener got " << *states << " joint states and " << *numbers << " numbers\n";
  return *states > 0 && (!to_all || *numbers > 0) ? 0 : 1;
}

class Listener {
 public:
  explicit Listener(Listening listening) {
    if (listening == Listening::none) return;
    const std::string command =
        "/proc/" + std::to_string(getpid()) + "/exe listen " + (listening == Listening::all ? "all" : "states");
    pipe_ = popen(command.c_str(), "w");
    if (pipe_ == nullptr) throw std::runtime_error("can't start the listener");
  }
  void end() {
    if (pipe_ != nullptr && pclose(pipe_) != 0) throw std::runtime_error("the listener heard nothing");
    pipe_ = nullptr;
  }

 private:
  std::FILE* pipe_ = nullptr;
};

std::string snake() {
  std::string model = vsa::test::model_text(kModel);
  return model.insert(model.find('>') + 1, "<pose>0 0 0.0335 0 0 0</pose>");
}

const std::string kGround = "<include><uri>model://terrain_flat</uri></include>";

std::vector<gazebo::physics::JointPtr> joints_of(const vsa::test::ClassicWorld& world) {
  std::vector<gazebo::physics::JointPtr> joints;
  for (std::size_t i = 0; i < kModules; ++i) joints.push_back(world.joint(kModel, "joint_" + std::to_string(i)));
  return joints;
}

class Comparison {
 public:
  Comparison(const std::string& engine, bool crawling) : bare_(without_plugin(), engine) {
    before_ = Events::ConnectWorldUpdateBegin([this](const UpdateInfo& info) { before_plugin(info); });
    ours_.emplace("ours", snake(), engine, kGround);  // the plug-in connects itself here
    after_ = Events::ConnectWorldUpdateBegin([this](const UpdateInfo& info) { after_plugin(info); });
    if (crawling) gait_.emplace(VSA_SOURCE_DIR "/models/gaits/sidewind.toml", ours_->robot());
    ours_name_ = ours_->world->Name();
    joints_ = joints_of(bare_);
  }

  /// Blocks of ours and of the peer's in turns.
  void measure_beside(vsa::test::Peer& peer) {
    Listener listener(Listening::states);
    run_ours(kWarmUp);
    (void)peer.run(kWarmUp);
    std::vector<double> ours, theirs, their_step, share;
    for (int k = 0; k < kBlocks; ++k) {
      run_ours(kBlock);
      const vsa::test::PeerCost cost = peer.run(kBlock);
      ours.push_back(last_call_us_);
      theirs.push_back(cost.call_us);
      their_step.push_back(cost.step_us);
      share.push_back(last_call_us_ / cost.call_us);
    }
    listener.end();
    std::cout << "| " << text(spread(their_step)) << " | " << text(spread(theirs)) << " | " << text(spread(ours)) << " | "
              << text(spread(share)) << " |\n";
  }

  void measure(Listening listening, const std::string& title) {
    Listener listener(listening);
    run_ours(kWarmUp);
    run_bare(kWarmUp);
    run_ours(kBlock);  // one ahead from here on: torques for the other
    std::vector<double> ours, bare, difference, call;
    double ours_us = last_ours_us_, call_us = last_call_us_;
    for (int k = 0; k < kBlocks; ++k) {
      const double mine = ours_us, my_call = call_us;
      if (k % 2 == 0) run_ours(kBlock), ours_us = last_ours_us_, call_us = last_call_us_;
      const double theirs = run_bare(kBlock);
      if (k % 2 == 1) run_ours(kBlock), ours_us = last_ours_us_, call_us = last_call_us_;
      ours.push_back(mine);
      call.push_back(my_call);
      bare.push_back(theirs);
      difference.push_back(mine - theirs);
    }
    run_bare(kBlock);
    check_same_motion();
    listener.end();
    std::cout << "| " << title << " | " << text(spread(bare)) << " | " << text(spread(ours)) << " | " << text(spread(difference))
              << " | " << text(spread(call)) << " |\n";
  }

 private:
  static std::string without_plugin() {
    return vsa::test::world_sdf("bare", kGround + vsa::test::without(snake(), "<plugin", "</plugin>"));
  }

  void before_plugin(const UpdateInfo& info) {
    if (gait_ && info.worldName == ours_name_)
      gait_->play(info.simTime.sec * std::int64_t{1'000'000'000} + info.simTime.nsec - 1'000'000);
    call_begin_ = processor_time();
  }

  void after_plugin(const UpdateInfo& info) {
    const auto now = processor_time();
    if (info.worldName == ours_name_) {
      in_call_ += now - call_begin_;
      for (std::size_t i = 0; i < kModules; ++i) torques_.push_back(ours_->torques()[i]);
    } else {
      for (std::size_t i = 0; i < kModules; ++i) joints_[i]->SetForce(0, torques_[taken_++]);
    }
  }

  static double us_a_step(steady_clock::duration time, int steps) { return duration<double, std::micro>(time).count() / steps; }

  void run_ours(int steps) {
    in_call_ = {};
    const auto start = steady_clock::now();
    ours_->run(steps);
    last_ours_us_ = us_a_step(steady_clock::now() - start, steps);
    last_call_us_ = us_a_step(in_call_, steps);
  }

  double run_bare(int steps) {
    const auto start = steady_clock::now();
    bare_.run(steps);
    return us_a_step(steady_clock::now() - start, steps);
  }

  void check_same_motion() {
    if (taken_ != torques_.size()) throw std::runtime_error("the two worlds made different numbers of steps");
    const auto own = joints_of(*ours_);
    for (std::size_t i = 0; i < kModules; ++i) {
      if (own[i]->Position(0) != joints_[i]->Position(0)) throw std::runtime_error("the two worlds moved differently");
    }
  }

  vsa::test::ClassicWorld bare_;
  std::optional<RobotWorld> ours_;
  std::optional<vsa::test::GaitPlayer> gait_;
  std::string ours_name_;
  std::vector<gazebo::physics::JointPtr> joints_;  ///< of the world without the plug-in
  std::vector<double> torques_;
  std::size_t taken_ = 0;
  nanoseconds call_begin_{}, in_call_{};
  double last_ours_us_ = 0, last_call_us_ = 0;
  gazebo::event::ConnectionPtr before_, after_;
};

void compare_with_physics(const std::string& engine) {
  std::cout
      << "µs a step of 1 ms, " << engine << ": median (quartiles) of " << kBlocks << " blocks of " << kBlock << " steps, in turns\n"
      << "| snake of 12 modules | physics alone | with our plug-in | difference | in the plug-in's call |\n|---|---|---|---|---|\n";
  for (const bool crawling : {false, true}) {
    Comparison comparison(engine, crawling);
    const std::string motion = crawling ? "sidewinding" : "lying still";
    comparison.measure(Listening::none, motion + ", nobody listens");
    comparison.measure(Listening::states, motion + ", joint states at 100 Hz");
    comparison.measure(Listening::all, motion + ", joint states and 60 numbers at 100 Hz");
  }
}

void compare_with_peer(vsa::test::Peer& peer, const std::string& engine, const std::string& world) {
  Comparison comparison(engine, false);
  std::cout << "µs a step, " << engine << ": median (quartiles) of " << kBlocks << " blocks of " << kBlock
            << " steps, in turns with those of " << world << "\n"
            << "| its step | in its plug-ins' calls | in ours, still, joint states at 100 Hz | ours : its |\n|---|---|---|---|\n";
  comparison.measure_beside(peer);
}

int run(const std::string& engine, const std::string& peer_world) {
  std::optional<vsa::test::Peer> peer;
  if (!peer_world.empty()) peer.emplace(peer_world, engine);
  vsa::test::start_server();
  if (peer)
    compare_with_peer(*peer, engine, peer_world);
  else
    compare_with_physics(engine);
  gazebo::shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "ode";
  try {
    if (word == "listen") return listen(argc > 2 && std::string(argv[2]) == "all");
    if (word == "peer") vsa::test::serve_peer(argc > 2 ? argv[2] : "", argc > 3 ? argv[3] : "");
    if (word != "ode" && word != "dart") throw vsa::InputError({"", "engine", word, "isn't one of ours", "ode, dart"});
    return run(word, argc > 2 ? argv[2] : "");
  } catch (const vsa::InputError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
