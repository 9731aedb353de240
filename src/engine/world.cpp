// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a World tells, and how a user touches it.
#include "vsa/engine/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "world_impl.hpp"

namespace vsa::engine {
namespace {

constexpr double kPullReach_m = 1e4;

/// "a, b, c" without doubles.
std::string list(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string joined_scope(std::string_view scoped) {
  std::string out;
  for (std::size_t i = 0; i < scoped.size(); ++i) {
    const bool colons = scoped.substr(i, 2) == "::";
    out += colons ? '/' : scoped[i];
    i += colons ? 1 : 0;
  }
  return out;
}

}  // namespace

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const std::string& World::name() const noexcept { return impl_->world.name; }
double World::step_s() const noexcept { return static_cast<double>(impl_->dt_ns) * 1e-9; }
std::int64_t World::time_ns() const noexcept { return impl_->time_ns; }
double World::time_s() const noexcept { return static_cast<double>(impl_->time_ns) * 1e-9; }
const std::vector<std::string>& World::warnings() const noexcept { return impl_->warnings; }

const std::vector<ActuatorRef>& World::actuators() const noexcept { return impl_->actuators; }

const ActuatorRef& World::actuator(std::string_view name) const {
  const ActuatorRef* found = nullptr;
  std::vector<std::string> names;
  for (const ActuatorRef& a : impl_->actuators) {
    const std::string full = a.model + "/" + a.name, scoped = joined_scope(impl_->robots[a.robot].model) + "/" + a.name;
    names.push_back(full);
    if (full == name || scoped == name) return a;
    if (a.name != name) continue;
    if (found != nullptr) {
      throw InputError(
          Problem{"", "actuator", std::string(name), "several models have it", full + ", " + found->model + "/" + a.name});
    }
    found = &a;
  }
  if (found == nullptr) throw InputError(Problem{"", "actuator", std::string(name), "no such actuator", list(names)});
  return *found;
}

bool World::command(std::string_view name, double equilibrium_rad, double preset) {
  const ActuatorRef& ref = actuator(name);
  return robot(ref.robot).command(ref.index, equilibrium_rad, preset);
}

host::ActuatorReading World::read(std::string_view name) const { return read(actuator(name)); }
host::ActuatorReading World::read(const ActuatorRef& ref) const { return robot(ref.robot).read(ref.index); }
std::size_t World::robot_count() const noexcept { return impl_->robots.size(); }
host::Robot& World::robot(std::size_t index) noexcept { return impl_->robots[index].robot; }
const host::Robot& World::robot(std::size_t index) const noexcept { return impl_->robots[index].robot; }
const std::string& World::robot_model(std::size_t index) const noexcept { return impl_->robots[index].model; }

actuator::Ledger World::ledger() const {
  actuator::Ledger sum;
  for (const RobotSlot& slot : impl_->robots) sum += slot.robot.ledger();
  return sum;
}

const std::vector<LinkInfo>& World::links() const noexcept { return impl_->world.infos; }
void World::poses(std::span<Pose> out) const { impl_->physics->poses(out); }
World::Energy World::energy() const { return impl_->physics->energy(); }
int World::contact_count() const noexcept { return impl_->physics->contact_count(); }
void World::contacts(std::vector<Contact>& out) const { impl_->physics->contacts(out); }
const std::vector<Pull>& World::pulls() const noexcept { return impl_->pulls; }

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

std::vector<std::size_t> World::Impl::links_of(std::string_view model) const {
  const std::string prefix = std::string(model) + "::";
  std::vector<std::size_t> out;
  std::vector<std::string> models;
  for (std::size_t i = 0; i < world.links.size(); ++i) {
    if (world.links[i].name.rfind(prefix, 0) == 0) out.push_back(i);
    models.push_back(world.links[i].model);
  }
  if (out.empty()) throw InputError(Problem{"", "model", std::string(model), "no such model", list(models)});
  return out;
}

std::array<double, 3> World::center_of_mass(std::string_view model) const {
  const Vec3 c = impl_->physics->center_of_mass(impl_->links_of(model));
  return {c.X(), c.Y(), c.Z()};
}

std::size_t World::Impl::one_axis_joint(std::string_view scoped) const {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < world.joints.size(); ++j) {
    if (!world.joints[j].one_axis()) continue;
    if (world.joints[j].name == scoped) return j;
    names.push_back(world.joints[j].name);
  }
  throw InputError(Problem{"", "joint", std::string(scoped), "no such joint with one axis", list(names)});
}

double World::joint_angle(std::string_view joint) const { return impl_->physics->joint(impl_->one_axis_joint(joint)).position; }
double World::joint_speed(std::string_view joint) const { return impl_->physics->joint(impl_->one_axis_joint(joint)).speed; }

void World::set_joint(std::string_view joint, double angle, double speed) {
  if (!std::isfinite(angle) || !std::isfinite(speed)) {
    throw InputError(
        Problem{"", "joint", std::string(joint), fmt::format("can't be set to {}, {}", angle, speed), "finite numbers"});
  }
  const std::size_t index = impl_->one_axis_joint(joint);
  impl_->physics->set_joint(index, {angle, speed});
  impl_->forget_mobility();
  for (RobotSlot& slot : impl_->robots) {
    for (std::size_t i = 0; i < slot.joints.size(); ++i)
      if (slot.joints[i] == index) slot.in[i].placed = true;
  }
}

void World::displace_model(std::string_view model, double yaw_rad, std::array<double, 3> t) {
  if (!std::isfinite(yaw_rad) || !std::isfinite(t[0]) || !std::isfinite(t[1]) || !std::isfinite(t[2])) {
    throw InputError(Problem{"", "model", std::string(model), "displacement isn't finite", "finite numbers"});
  }
  if (!impl_->physics->displace(impl_->links_of(model), yaw_rad, {t[0], t[1], t[2]})) {
    throw InputError(Problem{"", "model", std::string(model), "is fixed to the world and can't be moved", "a free model"});
  }
  impl_->forget_mobility();
}

}  // namespace vsa::engine
