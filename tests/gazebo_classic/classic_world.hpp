// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Gazebo Classic in this process, headless: one server, and a world a test.
#pragma once

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <string>
#include <vector>

namespace vsa::test {

/// A world with this inside it, and a step of 1 ms. Gravity is left out where `gravity` is false.
[[nodiscard]] std::string world_sdf(const std::string& name, const std::string& inside, bool gravity = true);
/// One of models/, under another name.
[[nodiscard]] std::string include(const std::string& model, const std::string& name, const std::string& pose = "0 0 0.4 0 0 0");
[[nodiscard]] std::string read_file(const std::string& path);

class ClassicWorld {
 public:
  explicit ClassicWorld(const std::string& sdf, const std::string& engine = "ode");
  ~ClassicWorld();
  ClassicWorld(const ClassicWorld&) = delete;
  ClassicWorld& operator=(const ClassicWorld&) = delete;

  void run(int steps) { gazebo::runWorld(world, static_cast<unsigned>(steps)); }
  [[nodiscard]] gazebo::physics::JointPtr joint(const std::string& model, const std::string& joint = "shaft") const;
  [[nodiscard]] double angle(const std::string& model, const std::string& name = "shaft") const;
  /// Angle after each of so many steps.
  [[nodiscard]] std::vector<double> record(const std::string& model, int steps);

  gazebo::physics::WorldPtr world;
};

}  // namespace vsa::test
