// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A whole world behind FMI: commands of every actuator in; its joint, torques, motors and the robots' places out. The embedded engine
// moves the bodies, buses carry the commands as they do in `vsa run`.
//
// The world goes in steps of its own length. A communication step makes as many as end by its end; a communication point between two
// of them sees the last one's outputs, so any communication step goes, and those that are whole steps lag by nothing. Commands are held
// over a communication step.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "vsa/engine/world.hpp"
#include "vsa/fmu/model.hpp"
#include "vsa/fmu/resources.hpp"

namespace vsa::fmu {

/// A whole world behind FMI: every actuator's commands in; its joint, torques, motors and the robots' places out.
class WorldModel final : public Model {
 public:
  explicit WorldModel(engine::World world);  ///< parameters of actuators and world stay as they are
  [[nodiscard]] const engine::World& world() const noexcept { return world_; }  ///< to look at

 private:
  struct Actuator {
    engine::ActuatorRef ref;
    Reference equilibrium = 0, preset = 0, first_output = 0;
    bool voltages = false;  ///< its inputs are the motors' voltages
    bool has_preset = false;
    std::size_t motors = 0;
    std::array<double, 2> sent{};
  };
  void begin_own() override;
  void step_own(std::int64_t dt_ns) override;
  void input_changed(Reference) override {}
  void evaluate(std::span<double> values) override;
  [[nodiscard]] std::size_t own_size() const override;
  void save_own(std::span<double> out) const override;
  void restore_own(std::span<const double> in) override;

  std::vector<Variable> make_variables();
  void add_actuator(std::vector<Variable>& out, const engine::ActuatorRef& ref, const std::string& prefix);
  void send_commands();

  engine::World world_;
  std::vector<Actuator> actuators_;
  Reference first_joint_ = 0, first_model_ = 0, first_energy_ = 0;
  std::vector<engine::JointHandle> joints_;  ///< with one axis and no actuator
  std::vector<std::string> models_;          ///< with a robot
  bool warned_ = false;
};

/// A world that an FMU is to be made of.
struct WorldPlan {
  std::string world;                    ///< a file, or a built-in one's name
  std::vector<config::Override> set{};  ///< of every actuator
};

/// world.toml, world.sdf (or .urdf), models/ with every model:// that it needs, actuators/ with the types. Throws InputError: an unknown
/// or broken world, and one that names files in another way than model://, which nothing else would find where it is imported.
[[nodiscard]] Resources world_resources(const config::TypeLibrary& library, const WorldPlan& plan);
/// From a folder with those.
[[nodiscard]] std::unique_ptr<WorldModel> open_world(const std::filesystem::path& resources);

}  // namespace vsa::fmu
