// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How a user or a gait touches a World: commands, joints, hands; and its clones.
#include <fmt/format.h>

#include <algorithm>

#include "engine/world_check.hpp"
#include "engine/world_impl.hpp"

namespace vsa::engine {
namespace {

constexpr double kMostForce = 1e9, kFurthestPoint_m = 1e4;

/// Sets what belongs to `key`; nothing where it is none.
template <class Value>
void put(std::vector<std::pair<std::size_t, Value>>& list, std::size_t key, const Value& value, bool none) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.first == key; });
  if (it != list.end()) list.erase(it);
  if (!none) list.emplace_back(key, value);
}

/// Limits give way, and what a recording has of a joint that hit them may be set; a joint beyond them may be set to where it is.
bool within(const JointInfo& joint, const std::array<double, 2>& range, double now, double angle) {
  const double soft = joint.type == JointInfo::Type::prismatic ? 5e-3 : 0.05;  // m, rad
  return angle >= std::min(range[0] - soft, now) && angle <= std::max(range[1] + soft, now);
}
void check_limits(const JointInfo& joint, const std::array<double, 2>& range, double now, double angle) {
  if (within(joint, range, now, angle)) return;
  throw InputError(Problem{"", joint.name + ": angle", fmt::format("{}", angle), "beyond the joint's limits",
                           fmt::format("{} … {}", range[0], range[1])});
}

struct Follower {
  physics::JointState now, leader, wanted;
};
/// A follower is where its leader has it, but for what the engine's equality gives way: all joints may be set one by one, to where they
/// were.
void check_follower(const description::Coupling& c, const std::vector<JointInfo>& joints, const Follower& f) {
  constexpr double kNear = 0.02, kNearSpeed = 0.1;
  const double there = c.at(f.leader.position), moves = c.slope(f.leader.position) * f.leader.speed;
  const bool angle =
      std::abs(f.wanted.position - there) <= std::max(std::abs(f.now.position - there), kNear * (1 + std::abs(there)));
  const bool speed = f.wanted.speed == 0 || std::abs(f.wanted.speed - moves) <= kNearSpeed * (1 + std::abs(moves));
  if (angle && speed) return;
  const auto state = [](double position, double v) { return fmt::format("{}, speed {}", position, v); };
  throw InputError(Problem{"", joints[c.follower].name, state(f.wanted.position, f.wanted.speed),
                           "follows " + joints[c.leader].name + " (<mimic> or <equality>), which has it at " + state(there, moves),
                           "setting " + joints[c.leader].name + ", which moves it along"});
}

}  // namespace

bool World::command(std::string_view name, double equilibrium_rad, double preset) {
  return command(actuator(name), equilibrium_rad, preset);
}

bool World::command(const ActuatorRef& ref, double equilibrium_rad, double preset) {
  static_cast<void>(at(ref));
  return impl_->robots[ref.robot].robot().command(ref.index, equilibrium_rad, preset);
}

void World::place(std::string_view name, double angle_rad, double preset, double speed_rad_per_s) {
  place(actuator(name), {angle_rad, preset, speed_rad_per_s});
}

void World::place(const ActuatorRef& ref, const host::Placement& to) {
  const std::size_t joint = this->joint(ref).index();
  check_within("angle_rad", to.angle_rad, kMostState);
  check_within("speed_rad_per_s", to.speed_rad_per_s, kMostState);
  if (const auto& range = joints()[joint].range; range && !(to.angle_rad >= (*range)[0] && to.angle_rad <= (*range)[1])) {
    throw InputError(Problem{"", ref.name + ": angle_rad", fmt::format("{}", to.angle_rad),
                             "beyond the limits of " + joints()[joint].name, fmt::format("{} … {}", (*range)[0], (*range)[1])});
  }
  const physics::JointState state{to.angle_rad, to.speed_rad_per_s};
  const Impl::Along along = impl_->along(joint, state);
  if (!along.posture) {
    throw InputError(Problem{"", ref.name + ": angle_rad", fmt::format("{}", to.angle_rad), along.refused,
                             "a place that its loops reach from where they are, or set_joint() of all their joints"});
  }
  impl_->robots[ref.robot].robot().place(ref.index, to, impl_->substep_s());
  impl_->put(joint, state, *along.posture);
  impl_->forget_mobility();
}

World::Impl::Along World::Impl::along(std::size_t joint, physics::JointState state) {
  // First with all actuators where they are, where the loops have the freedoms for it.
  std::vector<std::size_t> held = put_here;
  held.insert(held.end(), driven.begin(), driven.end());
  for (std::vector<std::size_t>* some : {&held, &put_here})
    some->erase(std::remove(some->begin(), some->end(), joint), some->end());
  std::optional<physics::LoopPosture> posture = physics->loops_with(joint, state, held);
  if (!posture && held.size() > put_here.size()) posture = physics->loops_with(joint, state, put_here);
  if (!posture) {
    std::string kept;
    for (const std::size_t j : put_here) kept += (kept.empty() ? "" : ", ") + names->joints[j].name;
    const std::string with = state.speed == 0 ? "" : fmt::format(", or not with a speed of {:.6g}", state.speed);
    return {std::nullopt, "isn't reached" + with + ": " + engine::list(names->joints[joint].held) + " would open" +
                              (kept.empty() ? "" : " (" + kept + ", put elsewhere since the last step, stays)")};
  }
  for (const auto& [j, to] : posture->along) {
    const JointInfo& info = names->joints[j];
    const auto& range = info.range;
    if (!range || within(info, *range, physics->joint(j).position, to.position)) continue;
    return {std::nullopt,
            fmt::format("takes {} along, to {:.6g}, beyond its limits {} … {}", info.name, to.position, (*range)[0], (*range)[1])};
  }
  return {std::move(posture), ""};
}

void World::Impl::put(std::size_t joint, physics::JointState state, const physics::LoopPosture& posture) {
  if (posture.numbers.empty()) {
    physics->set_joint(joint, state);
  } else {
    put_here.push_back(joint);
    constexpr double kMoved = 1e-9;
    std::vector<std::size_t> along;
    for (const auto& [j, to] : posture.along) {
      const physics::JointState now = physics->joint(j);
      const bool moves = std::abs(to.position - now.position) > kMoved || std::abs(to.speed - now.speed) > kMoved;
      if (moves && std::find(driven.begin(), driven.end(), j) != driven.end()) along.push_back(j);
    }
    physics->take(posture);
    for (const std::size_t j : along) placed(j);
  }
  set_followers(joint);
}

void World::Impl::set_followers(std::size_t leader) {
  std::vector<std::size_t> due{leader};
  for (std::size_t turns = 0; !due.empty() && turns <= world->couplings.size(); ++turns) {
    std::vector<std::size_t> next;
    for (const description::Coupling& c : world->couplings) {
      if (std::find(due.begin(), due.end(), c.leader) == due.end()) continue;
      const physics::JointState of = physics->joint(c.leader);
      physics->set_joint(c.follower, {c.at(of.position), c.slope(of.position) * of.speed});
      next.push_back(c.follower);
    }
    due = std::move(next);
  }
}

std::size_t World::find_actuator(std::string_view name) const {
  return static_cast<std::size_t>(&actuator(name) - impl_->actuators.data());
}
const std::string& World::model_of(std::size_t actuator) const { return impl_->actuators.at(actuator).model; }
void World::send(std::size_t actuator, std::optional<double> equilibrium_rad, std::optional<double> preset) {
  const ActuatorRef& ref = impl_->actuators.at(actuator);
  impl_->robots[ref.robot].robot().command(ref.index, equilibrium_rad, preset);
}
motion::Commanded World::commanded(std::size_t actuator) const {
  const host::ActuatorReading now = read(impl_->actuators.at(actuator));
  return {now.equilibrium_command_rad, now.preset_command};
}

host::ActuatorReading World::read(std::string_view name) const { return read(actuator(name)); }
host::ActuatorReading World::read(const ActuatorRef& ref) const {
  static_cast<void>(at(ref));
  return impl_->robots[ref.robot].robot().read(ref.index);
}

std::size_t World::robot_count() const { return impl_->robots.size(); }
host::Robot& World::robot(std::size_t index) {
  static_cast<void>(robot_model(index));
  return impl_->robots[index].robot();
}
const host::Robot& World::robot(std::size_t index) const {
  static_cast<void>(robot_model(index));
  return impl_->robots[index].robot();
}
seat::Seat& World::seat(std::size_t index) {
  static_cast<void>(robot_model(index));
  return *impl_->robots[index].seat;
}
const std::string& World::robot_model(std::size_t index) const {
  if (index >= robot_count())
    throw InputError(Problem{"", "robot", fmt::format("{}", index), "no such robot", fmt::format("below {}", robot_count())});
  return impl_->robots[index].seat->model();
}

double World::joint_angle(JointHandle joint) const { return impl_->physics->joint(at(joint)).position; }
double World::joint_angle(std::string_view joint) const { return joint_angle(this->joint(joint)); }
double World::joint_speed(JointHandle joint) const { return impl_->physics->joint(at(joint)).speed; }
double World::joint_speed(std::string_view joint) const { return joint_speed(this->joint(joint)); }

void World::set_joint(std::string_view joint, double angle, double speed) { set_joint(this->joint(joint), angle, speed); }
void World::set_joint(JointHandle joint, double angle, double speed) {
  const std::size_t index = at(joint);
  check_within("angle", angle, kMostState);
  check_within("speed", speed, kMostState);
  const physics::JointState now = impl_->physics->joint(index);
  const auto own = [index](const description::Coupling& c) { return c.follower == index; };
  const auto coupling = std::find_if(impl_->world->couplings.begin(), impl_->world->couplings.end(), own);
  const physics::JointState to{angle, speed};
  if (coupling != impl_->world->couplings.end()) {
    check_follower(*coupling, joints(), {now, impl_->physics->joint(coupling->leader), to});
    impl_->put(index, to, {});
  } else {
    if (const auto& range = joints()[index].range) check_limits(joints()[index], *range, now.position, angle);
    const Impl::Along along = impl_->along(index, to);
    impl_->put(index, to, along.posture.value_or(physics::LoopPosture{}));
    // Others may be about to be set, too: the loop is pulled together.
    if (!along.posture) impl_->put_here.push_back(index);
  }
  impl_->placed(index);
}

void World::apply_wrench(LinkHandle link, const Wrench& wrench) {
  const std::size_t index = at(link);
  if (links()[index].is_static) throw InputError(Problem{"", "link", links()[index].name, "is static", "a link that moves"});
  for (const double x : wrench.force_N) check_within("force_N", x, kMostForce);
  for (const double x : wrench.torque_Nm) check_within("torque_Nm", x, kMostForce);
  for (const double x : wrench.point_m) check_within("point_m", x, kFurthestPoint_m);
  constexpr std::array<double, 3> kNone{};
  put(impl_->wrenches, index, wrench, wrench.force_N == kNone && wrench.torque_Nm == kNone);
}

void World::apply_torque(JointHandle joint, double torque_Nm) {
  const std::size_t index = at(joint);
  check_within("torque_Nm", torque_Nm, kMostForce);
  put(impl_->torques, index, torque_Nm, torque_Nm == 0);
}

void World::Impl::push() {
  for (const auto& [joint, torque] : torques) physics->push(joint, torque);
  for (const auto& [link, wrench] : wrenches) physics->push(link, wrench);
  for (const Pull& pull : pulls) physics->pull(pull);
}

void World::Impl::let_go() {
  pulls.clear();
  wrenches.clear();
  torques.clear();
}

World World::clone() const {
  auto to = std::make_unique<Impl>();
  to->options = impl_->options;
  to->world = impl_->world;
  to->names = impl_->names;
  to->warnings = impl_->warnings;
  to->physics = impl_->physics->clone();
  for (const RobotSlot& slot : impl_->robots) to->robots.push_back({slot.seat->clone(), slot.joints, slot.beside});
  to->group = impl_->group.another(to->seats());
  to->trees = impl_->trees;
  to->driven = impl_->driven;
  to->make_room();
  to->actuators = impl_->actuators;
  to->pulls = impl_->pulls;
  to->wrenches = impl_->wrenches;
  to->torques = impl_->torques;
  to->put_here = impl_->put_here;
  to->dt_ns = impl_->dt_ns;
  to->substeps = impl_->substeps;
  to->time_ns = impl_->time_ns;
  to->steps = impl_->steps;
  to->initial = impl_->initial;
  to->before = impl_->before;
  return World(std::move(to));
}

}  // namespace vsa::engine
