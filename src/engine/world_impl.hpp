// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World's insides. States: physics, time and step count, the robots, and the mobilities last asked for; Snapshot holds them all.
#pragma once

#include "description.hpp"
#include "physics.hpp"
#include "vsa/host/mobility_watch.hpp"

namespace vsa::engine {

struct SdfSource;

/// B of a robot's trees, and when it is asked for again.
struct Mobility {
  std::vector<double> matrices;
  host::MobilityWatch watch;
};

struct World::Snapshot {
  PhysicsState physics;
  std::int64_t time_ns = 0, steps = 0;
  std::vector<std::shared_ptr<const host::Robot::Snapshot>> robots;
  std::vector<Mobility> mobility;
};

/// One <plugin>: a robot and what passes between it and the engine.
struct RobotSlot {
  std::string model;  ///< scoped
  host::Robot robot;
  std::vector<std::size_t> joints;  ///< of its actuators, into WorldDescription::joints
  std::vector<host::JointIn> in;
  std::vector<double> torques;
  std::vector<std::vector<std::size_t>> trees;  ///< of joints, by index into WorldDescription::joints
  Mobility mobility;
};

struct World::Impl {
  WorldOptions options;
  WorldDescription world;
  std::vector<std::string> warnings;
  std::unique_ptr<Physics> physics;
  std::vector<RobotSlot> robots;
  std::vector<ActuatorRef> actuators;
  std::vector<Pull> pulls;
  std::int64_t dt_ns = 0, time_ns = 0, steps = 0;
  std::shared_ptr<const Snapshot> initial;

  [[nodiscard]] static std::unique_ptr<Impl> load(const SdfSource& source, WorldOptions options);
  void add_robots(const std::string& file, Problems& problems);
  void step();
  void join_trees();
  void ask_mobility(RobotSlot& slot);
  void drive();
  void observe();
  void forget_mobility();  ///< something was moved
  [[nodiscard]] std::size_t one_axis_joint(std::string_view scoped) const;
  [[nodiscard]] std::vector<std::size_t> links_of(std::string_view model) const;
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;
  void restore(const Snapshot& s);
};

}  // namespace vsa::engine
