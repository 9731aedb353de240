// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// gz-sim in this process, headless: a server a test.
//
// A physics system that fails to load leaves a world that steps and doesn't move, so every test looks at motion.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compat.hpp"
#include "robot_system.hpp"
#ifdef VSA_GZ_TRANSPORT
#include <gz/sim/Server.hh>
#include <gz/sim/components/JointPositionReset.hh>
#include <gz/sim/components/JointVelocityReset.hh>
#else
#include <ignition/gazebo/Server.hh>
#include <ignition/gazebo/components/JointPositionReset.hh>
#include <ignition/gazebo/components/JointVelocityReset.hh>
#endif

namespace vsa::test {

namespace sim = plugins::sim;
namespace components = sim::components;

inline constexpr double kDegree = 3.14159265358979 / 180;
inline const std::string kHanging = "0 0 0.4 -1.57079633 0 0";
/// The bench's lever level: gravity's torque on the shaft is largest.
inline const std::string kLevel = "0 0 0.4 -1.57079633 1.57079633 0";
inline const std::string kLevelAside = "3 0 0.4 -1.57079633 1.57079633 0";

/// Environment of gz-sim as a test wants it: our plug-in, on loopback, nobody else's messages. A SimWorld does this itself.
void prepare();
[[nodiscard]] std::string read_file(const std::string& path);
[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& with);

/// <model>…</model>: one of models/, under another name and at a pose.
[[nodiscard]] std::string model_text(const std::string& model, const std::string& name, const std::string& pose = "0 0 0 0 0 0");
[[nodiscard]] std::string without_plugin(std::string model);
[[nodiscard]] std::string bench(const std::string& name, const std::string& pose);

struct WorldText {
  std::string name = "test";
  double step_s = 1e-3;
  bool gravity = true;
  std::vector<std::string> systems{"Physics", "UserCommands"};
  std::string physics{};  ///< the whole element, in place of one with step_s
};
/// <world>…</world> with this inside it, as fast as it goes.
[[nodiscard]] std::string world_text(const std::string& inside, const WorldText& world = {});
[[nodiscard]] std::string sdf_text(const std::string& content);
/// The <physics> of one of models/worlds, but as fast as it goes.
[[nodiscard]] std::string physics_of(const std::string& world);

/// Watches a world. It is a system of its own, since gz-sim's TestFixture doesn't outlive a reset.
class Probe : public sim::System,
              public sim::ISystemConfigure,
#ifdef VSA_HAS_RESET
              public sim::ISystemReset,
#endif
              public sim::ISystemPreUpdate,
              public sim::ISystemPostUpdate {
 public:
  void Configure(const sim::Entity&, const std::shared_ptr<const sdf::Element>&, sim::EntityComponentManager& ecm,
                 sim::EventManager&) override {
    manager = &ecm;
  }
  void PreUpdate(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) override {
    if (before) before(info, ecm);
  }
  void PostUpdate(const sim::UpdateInfo& info, const sim::EntityComponentManager& ecm) override {
    if (after) after(info, ecm);
  }
#ifdef VSA_HAS_RESET
  void Reset(const sim::UpdateInfo&, sim::EntityComponentManager&) override {}
#endif
  std::function<void(const sim::UpdateInfo&, sim::EntityComponentManager&)> before;
  std::function<void(const sim::UpdateInfo&, const sim::EntityComponentManager&)> after;
  sim::EntityComponentManager* manager = nullptr;
};

class SimWorld {
 public:
  /// Of several worlds in `sdf` the first so many are watched.
  explicit SimWorld(const std::string& sdf, unsigned worlds = 1);

  void run(int steps) { server->Run(true, static_cast<std::uint64_t>(steps), false); }
  void idle() { server->RunOnce(true); }  ///< once round, paused
  [[nodiscard]] sim::EntityComponentManager& ecm(unsigned world = 0) const { return *probes[world]->manager; }

  /// NaN where there is no such joint, 0 where the physics hasn't told its angle yet.
  [[nodiscard]] double angle(const std::string& model, const std::string& joint = "shaft", unsigned world = 0) const;
  [[nodiscard]] double speed(const std::string& model, const std::string& joint = "shaft") const;
  /// From the next step on.
  void set_speed(const std::string& model, double rad_per_s, const std::string& joint = "shaft");
  void set_angle(const std::string& model, double rad, const std::string& joint = "shaft");
  /// The shaft's angle after each of so many steps.
  [[nodiscard]] std::vector<double> record(const std::string& model, int steps);

  std::vector<std::shared_ptr<Probe>> probes;
  std::unique_ptr<sim::Server> server;
};

/// A robot whose system isn't loaded by gz-sim but driven from the probe's callbacks, so that a test can speak to the robot itself.
class OwnRobot {
 public:
  /// `model` is a model_text(): its <plugin> is cut out.
  OwnRobot(std::string& model, std::string name);
  /// Call it before every step. Configures the system the first time; `first` is called then.
  void before_step(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm);
  [[nodiscard]] host::Robot& robot() { return system_.seat()->robot(); }

  std::function<void(host::Robot&)> first;

 private:
  std::string name_;
  sdf::ElementPtr element_;
  plugins::SimRobot system_;
  sim::EventManager events_;
  bool configured_ = false;
};

/// The transport and gz-sim's services answer in threads of their own, so the world is run until they have. False: not within 20 s.
bool run_until(SimWorld& w, const std::function<bool()>& condition, int steps = 20);

/// Runs a world without plug-in and probes until the heap stays, for 300 s of simulated time at most. Where gz-common's profiler is
/// compiled in (Fortress from Debian's libraries), it keeps samples until its queue is full, 150 bytes a step for 60 to 90 s: no
/// leak, but it would hide one.
void let_the_host_fill_its_pools();

/// From /proc/self/status.
[[nodiscard]] long threads_of_this_process();

}  // namespace vsa::test
