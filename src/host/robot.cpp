// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "host/robot_impl.hpp"
#include "vsa/errors.hpp"

namespace vsa::host {
namespace {

void check_whole(const RobotConfig& config) {
  Problems problems;
  for (std::size_t i = 0; i < config.actuators.size(); ++i) {
    const ActuatorConfig& a = config.actuators[i];
    if (a.bus >= config.buses.size()) problems.add({"", a.name, std::to_string(a.bus), "no such bus", "an index into buses"});
    for (std::size_t j = 0; j < i; ++j) {
      const ActuatorConfig& b = config.actuators[j];
      if (a.name == b.name) problems.add({"", a.name, "", "two actuators have this name", "unique names"});
      if (a.joint == b.joint)
        problems.add({"", a.name, a.joint, "joint is driven by " + b.name + " already", "one actuator a joint"});
      if (a.bus == b.bus && a.id == b.id)
        problems.add({"", a.name, std::to_string(a.id), "id is used by " + b.name + " on the same bus", "unique ids on a bus"});
    }
  }
  problems.throw_if_any();
}

}  // namespace

Robot::Robot(RobotConfig config) {
  check_whole(config);
  impl_ = std::make_unique<Impl>(std::move(config));
}
Robot::~Robot() = default;
Robot::Robot(Robot&&) noexcept = default;
Robot& Robot::operator=(Robot&&) noexcept = default;

const RobotConfig& Robot::config() const noexcept { return impl_->config; }
std::size_t Robot::size() const noexcept { return impl_->units.size(); }

std::optional<std::size_t> Robot::find(std::string_view actuator_name) const noexcept {
  for (std::size_t i = 0; i < size(); ++i)
    if (impl_->config.actuators[i].name == actuator_name) return i;
  return std::nullopt;
}

void Robot::join(std::vector<std::vector<std::size_t>> trees) {
  Problems problems;
  std::vector<bool> seen(size());
  for (const auto& tree : trees) {
    for (const std::size_t a : tree) {
      if (a >= size() || seen[a])
        problems.add({"", "tree", std::to_string(a), a < size() ? "is in a tree already" : "no such actuator",
                      "each index below " + std::to_string(size()) + " once"});
      if (a < size()) seen[a] = true;
    }
  }
  problems.throw_if_any();
  impl_->make_clusters(std::move(trees));
}

std::size_t Robot::mobility_size() const noexcept { return impl_->mobility_size; }

void Robot::advance(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<double> torques_out,
                    std::span<const double> mobility) noexcept {
  Impl& d = *impl_;
  d.expect(t_ns);
  d.take_commands();
  d.take_faults();
  for (Cluster& cluster : d.clusters) d.state.unsettled += cluster.advance(t_ns, dt_ns, in, torques_out, mobility);
  d.state.time_ns = t_ns + dt_ns;
  if (++d.state.steps % kLookSteps == 0 && size() > 0) d.look();
}

void Robot::observe(std::span<const JointIn> joints) noexcept {
  for (std::size_t i = 0; i < size(); ++i)
    impl_->state.actuators[i].unit.reached = {joints[i].angle_rad, joints[i].speed_rad_per_s};
}

bool Robot::command(std::size_t actuator, std::optional<double> equilibrium_rad, std::optional<double> preset) {
  const Command one{actuator, equilibrium_rad, preset};
  return command(std::span(&one, 1));
}

bool Robot::command(std::span<const Command> commands) {
  for (const Command& c : commands) {
    if (c.actuator >= size()) return false;
    if (!std::isfinite(c.equilibrium_rad.value_or(0.0)) || !std::isfinite(c.preset.value_or(0.0))) return false;
  }
  std::vector<Order> orders;
  for (const Command& c : commands) {
    if (c.equilibrium_rad) orders.push_back(make_order(c.actuator, Channel::equilibrium, {{0.0, *c.equilibrium_rad}}));
    if (c.preset) orders.push_back(make_order(c.actuator, Channel::preset, {{0.0, *c.preset}}));
  }
  impl_->queue.push(std::move(orders));
  return true;
}

bool Robot::follow(std::size_t actuator, Channel channel, std::vector<Knot> knots) {
  if (actuator >= size() || knots.empty()) return false;
  double last = -1.0;
  for (const Knot& k : knots) {
    if (!std::isfinite(k.time_s) || !std::isfinite(k.value) || k.time_s < 0 || k.time_s <= last || k.time_s > 1e9) return false;
    last = k.time_s;
  }
  impl_->queue.push({make_order(actuator, channel, std::move(knots))});
  return true;
}

void Robot::set_supply(bool on) noexcept {
  for (ActuatorSlot& slot : impl_->state.actuators) slot.unit.supply_on = on;
}

void Robot::set_faults(std::size_t actuator, const device::Faults& faults) {
  Problems problems;
  if (actuator >= size())
    problems.add({"", "actuator", std::to_string(actuator), "no such actuator", "below " + std::to_string(size())});
  device::check(faults, "", problems);
  problems.throw_if_any();
  impl_->faults.push({{actuator, faults}});
}

const device::Faults& Robot::faults(std::size_t actuator) const { return impl_->state.actuators.at(actuator).unit.faults; }

device::PortLine* Robot::serial_line(std::size_t bus) noexcept {
  return bus < impl_->buses.size() ? impl_->buses[bus]->port() : nullptr;
}

std::shared_ptr<const Robot::Snapshot> Robot::snapshot() const {
  auto s = std::make_shared<Snapshot>();
  for (const auto& bus : impl_->buses) bus->lock();
  s->state = impl_->state;
  for (const auto& bus : impl_->buses) s->buses.push_back(bus->state());
  for (const auto& bus : impl_->buses) bus->unlock();
  return s;
}

void Robot::restore(const Snapshot& snapshot) { impl_->restore(snapshot); }

void Robot::reset() {
  impl_->notices.clear();
  impl_->restore(impl_->initial);
}

}  // namespace vsa::host
