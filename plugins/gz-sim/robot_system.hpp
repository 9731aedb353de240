// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// gz-sim: the <plugin name="vsa::Robot"> of a model, from Fortress (6) on. Glue only.
//
// Before every step the system reads each joint's JointPosition and JointVelocity, which it creates so that the physics fills them,
// and writes its JointForceCmd, which the physics clears. In the very first step they are still empty: the joints are at 0 then.
// Where they stay empty no physics moves the model, which is said once. States are published before the step too: nothing that
// they tell comes from the physics' answer, and a PostUpdate would cost every model a thread and the world a barrier a step.
// A time that is set back (a seek, in Fortress also a rewind) comes as a step of negative length. DART ignores that length and
// makes one more step of the former, so the robot does too.
// Load errors are one message on the log and a model without torques; a model that is removed takes its robot with it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compat.hpp"
#include "model_robots.hpp"
#include "model_watch.hpp"
#ifdef VSA_HAS_PARAMETERS
#include "fault_parameter.hpp"
#endif

namespace vsa::plugins {

/// A model's links as a tree of bodies, for the mobility of its joints, which the components don't have. No tree where the model
/// isn't one of hinges, sliders and fixed joints.
class EntityTree final : public LinkTrees {
 public:
  /// `driven`: the actuators' joints, by their entities; null for one that is gone.
  EntityTree(sim::Entity model, const ModelRobot::Joints& driven, sim::EntityComponentManager& ecm);
  void look() override;
  void feel() override;
  [[nodiscard]] bool are_there() const override;

 private:
  struct Item {
    sim::Entity link = sim::kNullEntity, joint = sim::kNullEntity;
    math::Pose3d joint_pose;  ///< in the link
    math::Vector3d axis;      ///< in the joint
  };

  bool build(const std::vector<sim::Entity>& links, const std::vector<sim::Entity>& joints, std::vector<host::TreeBody>& bodies);

  sim::EntityComponentManager& ecm_;
  ModelRobot::Joints driven_;
  std::vector<Item> items_;
  std::vector<std::size_t> passive_;  ///< joints without actuators
};

class SimRobot : public sim::System,
                 public sim::ISystemConfigure,
#ifdef VSA_HAS_PARAMETERS
                 public sim::ISystemConfigureParameters,
#endif
#ifdef VSA_HAS_RESET
                 public sim::ISystemReset,
#endif
                 public sim::ISystemPreUpdate,
                 private ModelRobot {
 public:
  ~SimRobot() override { leave(); }
  void Configure(const sim::Entity& entity, const std::shared_ptr<const sdf::Element>& element, sim::EntityComponentManager& ecm,
                 sim::EventManager& events) override;
  void PreUpdate(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) override;
#ifdef VSA_HAS_PARAMETERS
  void ConfigureParameters(gz::transport::parameters::ParametersRegistry& registry, sim::EntityComponentManager& ecm) override;
#endif
#ifdef VSA_HAS_RESET
  void Reset(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) override;
#endif

  /// Null where loading failed. For tests.
  [[nodiscard]] seat::Seat* seat() noexcept override { return seat_.get(); }

 private:
  void attach(const sdf::Element& element, sim::EntityComponentManager& ecm);
  void leave();
  void let_go();
  [[nodiscard]] const Joints& driven() const noexcept override { return joints_; }
  [[nodiscard]] std::unique_ptr<LinkTrees> link_trees(Links links, const Joints& driven) override;
  void tell(std::int64_t time_ns) override;
  void apply() override;

  sim::Entity model_ = sim::kNullEntity;
  sim::EntityComponentManager* ecm_ = nullptr;
  std::string name_;  ///< scoped, without the world's
  Joints joints_;     ///< of the actuators; null: gone
  std::unique_ptr<seat::Seat> seat_;
  std::unique_ptr<ModelWatch> watch_;
  std::shared_ptr<ModelRobots> robots_;  ///< of its outermost model
#ifdef VSA_HAS_PARAMETERS
  FaultParameter faults_;
#endif
  static constexpr int kPhysicsSteps = 10;  ///< by then any physics has filled the joints' components
  int steps_ = 0;                           ///< since the start or a reset, as far as anyone asks: see any_filled
  std::int64_t last_dt_ns_ = 0;
  bool told_stopped_ = false;
};

}  // namespace vsa::plugins
