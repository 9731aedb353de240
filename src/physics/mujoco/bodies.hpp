// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The fields of MuJoCo's model that follow from the links' masses, inertias and frictions, taken out so that they can be put into
// another model of the same world in no time.
//
//   set by us                    body_mass, body_inertia; geom_friction, geom_condim, geom_priority
//   derived by mj_setConst       body_subtreemass, body_invweight0, dof_M0, dof_invweight0, stat.meanmass, stat.meaninertia;
//                                tendon_invweight0, actuator_acc0, flexedge_invweight0, flex_vertmetric; cam_, light_poscom0
//
// Nothing else that mj_setConst derives (lengths, extent, what equalities hold) follows from masses. A position servo's `dampratio`
// has become its damping when the file was compiled, and stays.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "physics/mujoco/model.hpp"
#include "vsa/physics/physics.hpp"

namespace vsa::physics {

/// Which of MuJoCo's objects are a link's.
struct LinkObjects {
  /// Of a geom whose friction has one: mu along, mu2 across.
  struct Direction {
    int geom = 0, body = 0;         ///< body: in whose axes
    std::array<double, 3> along{};  ///< unit vector
    double mu = 0, mu2 = 0;         ///< as the file has them
  };
  std::vector<int> body;                   ///< of a link
  std::vector<bool> is_static;             ///< of a link
  std::vector<std::size_t> geoms;          ///< the link of each geom
  std::vector<std::array<int, 2>> joints;  ///< of a joint's axes; −1: hasn't one
  std::vector<int> free;                   ///< of a link: the joint by which it flies free; −1: it doesn't
  std::vector<Direction> directions;       ///< of geoms
};

class MujocoBodies final : public Bodies {
 public:
  /// As the model has them.
  MujocoBodies(const mjModel& model, const LinkObjects& objects);
  /// `base` with those of its links that differ. `model` and `scratch` are worked with; the model comes out with other masses.
  MujocoBodies(const MujocoBodies& base, std::span<const scene::LinkParameters> links, const LinkObjects& objects, mjModel& model,
               mjData& scratch);
  [[nodiscard]] std::span<const scene::LinkParameters> links() const override { return links_; }
  [[nodiscard]] bool fits(const mjModel& model) const;  ///< whether they are of such a model
  /// What differs between a model that has `now` and one with these.
  void put_into(mjModel& model, const MujocoBodies& now) const;
  void put_masses_into(mjModel& model) const;

 private:
  using Masses = std::vector<mjtNum>;
  struct Surfaces {
    std::vector<mjtNum> mu;
    std::vector<int> condim, priority;
  };
  [[nodiscard]] static std::shared_ptr<const Masses> masses_of(const mjModel& model);
  [[nodiscard]] static Surfaces with_kinds(Surfaces s, const mjModel& model);
  [[nodiscard]] std::shared_ptr<const Surfaces> surfaces_with(const MujocoBodies& base, const LinkObjects& objects,
                                                              const mjModel& model) const;

  std::vector<scene::LinkParameters> links_;
  std::shared_ptr<const Masses> masses_;      // shared by all that have the same
  std::shared_ptr<const Surfaces> surfaces_;  // likewise
};

}  // namespace vsa::physics
