// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "host/robot_impl.hpp"
#include "vsa/checks.hpp"
#include "vsa/errors.hpp"

namespace vsa::host {

Robot::Robot(RobotConfig config) : impl_("vsa::host::Robot") {
  Problems problems;
  validate(config, "", problems);
  problems.throw_if_any();
  impl_.take(std::make_unique<Impl>(std::move(config)));
}
Robot::~Robot() = default;
Robot::Robot(Robot&&) noexcept = default;
Robot& Robot::operator=(Robot&&) noexcept = default;

const RobotConfig& Robot::config() const { return impl_->config; }
std::size_t Robot::size() const { return impl_->units.size(); }

std::size_t Robot::known(std::size_t actuator) const {
  if (actuator >= size())
    throw InputError(Problem{"", "actuator", std::to_string(actuator), "no such actuator", "below " + std::to_string(size())});
  return actuator;
}

std::optional<std::size_t> Robot::find(std::string_view actuator_name) const {
  for (std::size_t i = 0; i < size(); ++i)
    if (impl_->config.actuators[i].name == actuator_name) return i;
  return std::nullopt;
}

void Robot::join(std::vector<std::vector<std::size_t>> trees, std::vector<std::size_t> shared) {
  Problems problems;
  std::vector<bool> seen(size());
  const auto take = [&](const std::vector<std::size_t>& actuators) {
    for (const std::size_t a : actuators) {
      if (a >= size() || seen[a])
        problems.add({"", "tree", std::to_string(a), a < size() ? "is in a tree already" : "no such actuator",
                      "each index below " + std::to_string(size()) + " once"});
      if (a < size()) seen[a] = true;
    }
  };
  for (const auto& tree : trees) take(tree);
  take(shared);
  problems.throw_if_any();
  {
    const QuietBuses quiet(impl_->buses);
    impl_->make_clusters(std::move(trees), std::move(shared));
  }
  impl_->keep();  // what was kept went with the clusters
}

std::size_t Robot::mobility_size() const { return impl_->mobility_size; }

void Robot::require_step(const char* here, std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in,
                         std::span<double> torques_out, std::span<const double> mobility) const noexcept {
  require(impl_.there(), here, "the robot was moved from");
  const Impl& d = *impl_;
  require(in.size() == d.units.size() && torques_out.size() == d.units.size(), here,
          "in and torques_out need one entry an actuator");
  require(mobility.empty() || mobility.size() == d.mobility_size, here, "mobility needs mobility_size() numbers, or none");
  require(dt_ns >= 1 && dt_ns <= kLongestStep_ns, here, "a step has 1 ns … 16 ms");
  require(t_ns >= 0 && t_ns <= kLatestNs, here, "t is outside 0 … 4e18 ns");
}

void Robot::advance(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<double> torques_out,
                    std::span<const double> mobility, device::Holder* holder) noexcept {
  constexpr const char* kHere = "vsa::host::Robot::advance";
  require_step(kHere, t_ns, dt_ns, in, torques_out, mobility);
  Impl& d = *impl_;
  require(d.shared.empty(), kHere, "a robot with shared joints steps in its RobotGroup");
  if (!std::all_of(in.begin(), in.end(), is_told)) {
    std::fill(torques_out.begin(), torques_out.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  d.begin_step(t_ns);
  for (Cluster& cluster : d.clusters) d.state.unsettled += cluster.advance(t_ns, dt_ns, in, torques_out, mobility, holder);
  d.end_step(t_ns + dt_ns);
}

void Robot::observe(std::span<const JointIn> joints) noexcept {
  constexpr const char* kHere = "vsa::host::Robot::observe";
  require(impl_.there(), kHere, "the robot was moved from");
  require(joints.size() == impl_->units.size(), kHere, "joints needs one entry an actuator");
  for (std::size_t i = 0; i < size(); ++i) {
    impl_->state.actuators[i].unit.reached = {joints[i].angle_rad, joints[i].speed_rad_per_s};
    if (const Impl::Lodging& l = impl_->lodgings[i]; l.trials != nullptr) l.trials->observe(l.joint);
  }
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
  impl_->queue.push_all(2 * commands.size(), [&](auto&& add) {
    for (const Command& c : commands) {
      if (c.equilibrium_rad) add({c.actuator, Channel::equilibrium, *c.equilibrium_rad});
      if (c.preset) add({c.actuator, Channel::preset, *c.preset});
    }
  });
  return true;
}

bool Robot::follow(std::size_t actuator, Channel channel, std::vector<Knot> knots) {
  std::vector<Path> one;
  one.push_back({actuator, channel, std::move(knots)});
  return follow(std::move(one));
}

bool Robot::follow(std::vector<Path> paths) {
  const auto good = [this](const Path& p) {
    const bool a_channel = p.channel == Channel::equilibrium || p.channel == Channel::preset;
    return p.actuator < size() && a_channel && !p.knots.empty() && in_order(p.knots);
  };
  if (!std::all_of(paths.begin(), paths.end(), good)) return false;
  std::vector<Order> orders;
  orders.reserve(paths.size());
  for (Path& p : paths)
    orders.push_back({p.actuator, p.channel, 0.0, std::make_shared<const std::vector<Knot>>(std::move(p.knots))});
  impl_->queue.push_all(orders.size(), [&](auto&& add) {
    for (Order& order : orders) add(std::move(order));
  });
  return true;
}

void Robot::set_supply(bool on) {
  for (ActuatorSlot& slot : impl_->home().actuators) slot.unit.supply_on = on;
}

void Robot::command_direct(std::size_t actuator, const std::array<double, 2>& values) {
  const ActuatorConfig& a = impl_->config.actuators[known(actuator)];
  Problems problems;
  if (!a.unit.is(control::ServoKind::motor_voltages) && !a.unit.is(control::ServoKind::torque_servo))
    problems.add({"", a.name, "", "its controller takes no voltages and no torque", "control.kind = motor_voltages, torque_servo"});
  for (const double v : values)
    if (!std::isfinite(v)) problems.add({"", a.name, Checks::text(v), "isn't finite", "finite numbers"});
  problems.throw_if_any();
  device::Unit::command_direct(impl_->home().actuators[actuator].unit, values);
}

void Robot::check_faults(std::size_t actuator, const device::Faults& faults) const {
  const ActuatorConfig& a = impl_->config.actuators[known(actuator)];
  Problems problems;
  device::validate(faults, "", problems);
  if (a.unit.servo && (!faults.wiring().clean() || faults.late_s > 0))
    problems.add({"", a.name, std::string(control::name_of(a.unit.servo->kind)),
                  "has no line on which bytes could be lost, flipped or late", "faults of power, encoders, supply and motors"});
  problems.throw_if_any();
}

void Robot::set_faults(std::size_t actuator, const device::Faults& faults) {
  check_faults(actuator, faults);
  impl_->faults.push({actuator, faults});
}

const device::Faults& Robot::faults(std::size_t actuator) const { return impl_->state.actuators[known(actuator)].unit.faults; }

device::PortLine* Robot::serial_line(std::size_t bus) { return bus < impl_->buses.size() ? impl_->buses[bus]->port() : nullptr; }

std::shared_ptr<const Robot::Snapshot> Robot::snapshot() const {
  auto s = std::make_shared<Snapshot>();
  const QuietBuses quiet(impl_->buses);
  s->made_of = impl_->made_of;
  s->state = impl_->shown();
  for (const auto& bus : impl_->buses) s->buses.push_back(bus->state());
  return s;
}

void Robot::restore(const Snapshot& snapshot) {
  check(snapshot);
  impl_->restore(snapshot);
}

void Robot::keep() { impl_->keep(); }
void Robot::go_back() { impl_->go_back(); }

void Robot::reset() {
  impl_->notices.clear();
  impl_->restore(impl_->initial);
}

}  // namespace vsa::host
