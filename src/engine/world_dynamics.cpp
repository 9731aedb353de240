// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a controller asks of a World: velocities, mass matrix, bias torques, Jacobians.
#include "engine/world_check.hpp"
#include "engine/world_impl.hpp"

namespace vsa::engine {

Pose World::pose(LinkHandle link) const { return impl_->physics->pose(at(link)); }
Twist World::velocity(LinkHandle link) const { return impl_->physics->velocity(at(link)); }
std::size_t World::dof_count() const { return impl_->physics->dofs(); }
std::optional<std::size_t> World::free_dof(LinkHandle link) const { return impl_->physics->free_dof(at(link)); }

void World::mass_matrix(std::span<double> out) const {
  check_size("mass_matrix", out.size(), dof_count() * dof_count());
  impl_->physics->mass_matrix(out);
}

void World::bias_torques(std::span<double> out) const {
  check_size("bias_torques", out.size(), dof_count());
  impl_->physics->bias(out, true);
}

void World::gravity_torques(std::span<double> out) const {
  check_size("gravity_torques", out.size(), dof_count());
  impl_->physics->bias(out, false);
}

void World::jacobian(LinkHandle link, const std::array<double, 3>& point_m, std::span<double> out) const {
  const std::size_t index = at(link);
  constexpr double kFurthestPoint_m = 1e4;
  for (const double x : point_m) check_within("point_m", x, kFurthestPoint_m);
  check_size("jacobian", out.size(), 6 * dof_count());
  impl_->physics->jacobian(index, point_m, out);
}

}  // namespace vsa::engine
