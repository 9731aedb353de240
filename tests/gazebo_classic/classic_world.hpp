// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Gazebo Classic in this process, headless: one server, and a world a test.
#pragma once

#include <functional>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "robot_plugin.hpp"

namespace vsa::test {

inline constexpr double kDegree = 3.14159265358979 / 180;
/// A bench's shaft along the world's y, the lever along x: gravity's torque on it is largest.
inline const std::string kLeverLevel = "0 0 0.4 -1.57079633 1.57079633 0";

/// Gazebo, as a test wants it: on loopback, nothing downloaded, our plug-in and our models. gazebo::shutdown() ends it.
void start_server();
[[nodiscard]] std::string temporary_directory();
/// A world with this inside it, and a step of 1 ms. Gravity is left out where `gravity` is false.
[[nodiscard]] std::string world_sdf(const std::string& name, const std::string& inside, bool gravity = true);
/// One of models/, under another name.
[[nodiscard]] std::string include(const std::string& model, const std::string& name, const std::string& pose = "0 0 0.4 0 0 0");
[[nodiscard]] std::string read_file(const std::string& path);
/// The text of one of models/: <model>…</model>.
[[nodiscard]] std::string model_text(const std::string& model);
/// With the first `what` replaced, which must be there.
[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& with);
/// What comes before and after it, from the first `from` to the next `to`.
[[nodiscard]] std::string without(std::string text, const std::string& from, const std::string& to);
[[nodiscard]] bool long_run();  ///< VSA_TEST_LONG

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
  /// Gazebo takes requests five times a wall second. False: not within 20 s of these.
  [[nodiscard]] bool run_until(const std::function<bool()>& condition);

  gazebo::physics::WorldPtr world;
};

/// A world with this model in it, its plug-in made here and not by Gazebo, so that its robot is at hand before the first step.
/// world->Reset() doesn't know the plug-in: call reset().
class RobotWorld : public ClassicWorld {
 public:
  /// `model`: <model name="NAME">…</model> with its plug-in. `others`: what else is in the world. Throws where the plug-in doesn't
  /// load.
  RobotWorld(const std::string& name, const std::string& model, const std::string& engine = "ode", const std::string& others = "",
             bool gravity = true);

  [[nodiscard]] host::Robot& robot() { return plugin_->seat()->robot(); }
  [[nodiscard]] std::span<const double> torques() const { return plugin_->seat()->torques(); }  ///< of the last step
  void reset();

 private:
  std::unique_ptr<plugins::ClassicRobot> plugin_;
};

/// A model's plug-in, made and loaded by hand.
[[nodiscard]] std::unique_ptr<plugins::ClassicRobot> load_robot(const gazebo::physics::WorldPtr& world, const std::string& model);

}  // namespace vsa::test
