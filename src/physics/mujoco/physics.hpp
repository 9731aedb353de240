// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Physics on MuJoCo (versions.hpp tells of which). A step is its pipeline without mj_step's silent repair (which resets a bad state and goes on):
//
//   prepare()  mj_fwdPosition, mj_fwdVelocity          poses, M = LᵀDL, contacts; nothing of it is computed twice, but constraints
//                                                      where contacts get a direction of friction, and Coriolis torques
//                                                      (centered_bias.hpp)
//   push()     what users apply, before
//   foresee()  M⁻¹ of forces, or in trees with equalities or held mj_fwdConstraint, with what else pushed in the last step;
//              holds_else() again, with torques that are tried
//   advance()  mj_fwdActuation … mj_fwdConstraint      v̇ with the applied torques
//              check, mj_Euler, check                  v' = v + dt·(M + dt·B)⁻¹M v̇ with joint damping B; q' = q + dt·v'
//
// Contacts live in fixed arrays: where they overflow, prepare() doubles them and starts again, so the result is as if they had been
// that large from the beginning.
// State: qpos, qvel, qacc_warmstart (v̇ of the last step, the solver's first guess), what pushed in the last step, and what of it users
// applied. There are no activations.
#pragma once

#include <string>
#include <vector>

#include "physics/description.hpp"
#include "physics/mujoco/bodies.hpp"
#include "physics/mujoco/centered_bias.hpp"
#include "physics/mujoco/directed_friction.hpp"
#include "physics/mujoco/model.hpp"
#include "vsa/physics/holding.hpp"
#include "vsa/physics/mujoco.hpp"
#include "vsa/physics/physics.hpp"

namespace vsa::physics {

class MujocoPhysics final : public Physics {
 public:
  MujocoPhysics(std::shared_ptr<mjModel> model, const description::World& world, LinkObjects objects, Coriolis coriolis);

  void prepare() override;
  void set_stiff(std::span<const std::size_t> joints) override;
  bool is_held(std::span<const std::size_t> joints) const override;
  std::vector<std::vector<std::size_t>> trees(std::span<const std::size_t> joints) const override;
  void mobility(std::span<const std::size_t> joints, std::span<double> out) override;
  void free_mobility(std::span<const std::size_t> joints, std::span<double> out) override;
  void first_mobility(std::span<const std::size_t> joints, std::span<double> out) override;
  void zero_mobility(std::span<const std::size_t> joints, std::span<double> out) const override;
  std::vector<std::size_t> neighbours(std::span<const std::size_t> joints) const override;
  std::vector<std::size_t> beside(std::span<const std::size_t> joints) const override;
  double turned_rad(std::span<const std::size_t> dofs) const override;
  void foresee(std::span<const std::size_t> joints, std::span<double> out) override;
  bool holds_else(std::span<const std::size_t> joints, std::span<const double> torques, std::span<double> accelerations,
                  std::span<double> mobility) override;
  void apply(std::size_t joint, double torque) override;
  void pull(const scene::Pull& pull) override;
  std::optional<Refusal> advance() override;
  JointState joint(std::size_t joint) const override;
  void set_joint(std::size_t joint, JointState state) override;
  void poses(std::span<scene::Pose> links) const override;
  std::array<double, 3> center_of_mass(std::span<const std::size_t> links) const override;
  bool displace(std::span<const std::size_t> links, double yaw, const std::array<double, 3>& shift) override;
  scene::Energy energy() const override;
  int contact_count() const override;
  std::vector<scene::Overlap> overlaps() const override;
  void contacts(std::vector<scene::Contact>& out) const override;
  StateLayout state_layout() const override;
  std::size_t state_size() const override;
  void save(std::span<double> out) const override;
  void restore(std::span<const double> in) override;
  std::unique_ptr<Physics> clone() const override;
  void push(std::size_t joint, double torque) override;
  void push(std::size_t link, const scene::Wrench& wrench) override;
  std::size_t dofs() const override;
  std::optional<std::size_t> joint_dof(std::size_t joint) const override;
  std::optional<std::size_t> free_dof(std::size_t link) const override;
  scene::Pose pose(std::size_t link) const override;
  scene::Twist velocity(std::size_t link) const override;
  void mass_matrix(std::span<double> out) const override;
  void bias(std::span<double> out, bool moving) const override;
  void jacobian(std::size_t link, const std::array<double, 3>& point, std::span<double> out) const override;
  std::shared_ptr<const Bodies> bodies() const override { return bodies_; }
  std::shared_ptr<const Bodies> bodies_with(const Bodies& base, std::span<const scene::LinkParameters> links) override;
  void use(std::shared_ptr<const Bodies> bodies) override;
  std::optional<LoopPosture> loops_with(std::size_t joint, JointState state, std::span<const std::size_t> held) override;
  void take(const LoopPosture& posture) override;

 private:
  MujocoPhysics(const MujocoPhysics& other);
  struct Address {
    int q = -1, v = -1;
  };
  void make_data();
  bool grow(bool contacts_only);  ///< false: it is as large as it may be
  void changed();
  void look(const mjModel& m, mjData& d) const;
  const mjData& view() const;
  std::vector<mjContact> touching() const;
  std::optional<Refusal> find_fault() const;
  std::optional<Refusal> check(const mjtNum* values, int n, bool positions, const char* quantity) const;

  /// Adds `part` times what holds up the links without gravity.
  void hold_up(mjData& d, mjtNum* forces, double part) const;
  void take_dampers();
  void give_dampers_back();
  [[nodiscard]] std::vector<int> dofs_of(std::span<const std::size_t> joints) const;
  void solve_diagonal(mjData& d, std::span<const std::size_t> joints, std::span<double> out);
  void try_torques();
  mjModel& own_model();

  std::shared_ptr<mjModel> model_;  // of all of the file: never changed, but replaced by grow() and own_model()
  bool own_ = false;                // nobody else has that model
  DataPtr data_;
  DataPtr view_;  // kinematics of the present state, brought up to date when somebody looks
  mutable bool view_stale_ = true;
  LinkObjects objects_;
  std::shared_ptr<const MujocoBodies> bodies_;  // that model_ has
  std::vector<Address> joint_;                  // of a one-axis joint
  std::vector<int> root_;                       // of a link: the joint id of its free root, −1: tied to the world
  std::vector<std::size_t> weightless_;         // links that gravity leaves alone
  DirectedFriction directed_;
  Holding holding_;
  CenteredBias centered_;
  std::vector<std::string> q_owner_, v_owner_;
  std::vector<double> before_;  // the state, of the last prepare()
  std::vector<mjtNum> pushed_;  // in the last step: applied and, in trees without equalities, by constraints
  std::vector<mjtNum> asked_;   // of these: by push()
  std::vector<mjtNum> tried_;   // what pushes while torques are tried
  std::vector<mjtNum> unit_, column_, jacobian_, mobility_, mass_matrix_;
  std::vector<int> stiff_;  // dofs of joints
  bool damped_ = false;     // some joint has damping
  bool stepped_ = false;    // data_ holds the contacts of the last step
};

}  // namespace vsa::physics
