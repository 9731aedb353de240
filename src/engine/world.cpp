// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a World tells, and how a user touches it.
#include "vsa/engine/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/world_check.hpp"
#include "engine/world_impl.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::engine {
namespace {

constexpr double kPullReach_m = 1e4;
constexpr double kFurthest = 1e6;  // m, rad

}  // namespace

World::World(std::unique_ptr<Impl> impl) : impl_("vsa::engine::World", std::move(impl)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const std::string& World::name() const { return impl_->world->name; }
double World::step_s() const { return seconds_of(impl_->dt_ns); }
int World::substeps() const { return impl_->substeps; }
std::int64_t World::time_ns() const { return impl_->time_ns; }
const std::vector<std::string>& World::warnings() const { return impl_->warnings; }

const std::vector<ActuatorRef>& World::actuators() const { return impl_->actuators; }

actuator::Ledger World::ledger() const {
  actuator::Ledger sum;
  for (const RobotSlot& slot : impl_->robots) sum += slot.robot().ledger();
  return sum;
}

const std::vector<LinkInfo>& World::links() const { return impl_->world->infos; }
void World::poses(std::span<Pose> out) const {
  check_size("poses", out.size(), links().size());
  impl_->physics->poses(out);
}
World::Energy World::energy() const { return impl_->physics->energy(); }
int World::contact_count() const { return impl_->physics->contact_count(); }
void World::contacts(std::vector<Contact>& out) const { impl_->physics->contacts(out); }
const std::vector<Pull>& World::pulls() const { return impl_->pulls; }

void World::pull(std::vector<Pull> pulls) {
  Problems problems;
  const auto in = [&](const char* key, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      problems.add({"", key, fmt::format("{}", value), "out of range", fmt::format("{} … {}", low, high)});
    }
  };
  for (const Pull& p : pulls) {
    if (p.link >= links().size() || links()[p.link].is_static) {
      problems.add({"", "link", std::to_string(p.link), "is no link that moves", "an index into links()"});
    }
    for (const double x : p.point_m) in("point_m", x, -kPullReach_m, kPullReach_m);
    for (const double x : p.target_m) in("target_m", x, -kPullReach_m, kPullReach_m);
    in("stiffness_N_per_m", p.stiffness_N_per_m, 0, 1e5);
    in("damping_Ns_per_m", p.damping_Ns_per_m, 0, 1e4);
    in("force_max_N", p.force_max_N, 0, 1e4);
  }
  problems.throw_if_any();
  impl_->pulls = std::move(pulls);
}

std::span<const std::size_t> World::Impl::links_of(std::string_view model) const {
  thread_local std::vector<std::size_t> out;  // a steered gait asks in every step
  out.clear();
  for (std::size_t i = 0; i < world->links.size(); ++i)
    if (is_below(world->links[i].name, model)) out.push_back(i);
  if (!out.empty()) return out;
  std::vector<std::string> models;
  for (const auto& link : world->links) models.push_back(link.model);
  throw InputError(Problem{"", "model", std::string(model), "no such model", list(models)});
}

std::array<double, 3> World::center_of_mass(std::string_view model) const {
  return impl_->physics->center_of_mass(impl_->links_of(model));
}

void World::displace_model(std::string_view model, double yaw_rad, std::array<double, 3> t) {
  for (const double x : {yaw_rad, t[0], t[1], t[2]}) {
    if (!(std::abs(x) <= kFurthest))
      throw InputError(
          Problem{"", "model", std::string(model), fmt::format("can't be displaced by {}", x), fmt::format("±{}", kFurthest)});
  }
  if (!impl_->physics->displace(impl_->links_of(model), yaw_rad, t)) {
    throw InputError(Problem{"", "model", std::string(model), "is fixed to the world and can't be moved", "a free model"});
  }
  impl_->forget_mobility();
}

}  // namespace vsa::engine
