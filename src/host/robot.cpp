// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/bus_line.hpp"
#include "host/command_queue.hpp"
#include "host/state.hpp"
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

struct Robot::Impl {
  explicit Impl(RobotConfig c) : config(std::move(c)) {
    units.reserve(config.actuators.size());
    for (const ActuatorConfig& a : config.actuators) units.push_back(unit_for(a.unit));
    state.actuators.resize(units.size());
    for (std::size_t i = 0; i < units.size(); ++i) {
      const ActuatorConfig& a = config.actuators[i];
      ActuatorSlot& slot = state.actuators[i];
      slot.equilibrium.value = a.initial_equilibrium_rad;
      slot.preset.value = a.initial_preset;
      // Where the shaft is will be known at the first step.
      slot.unit = units[i]->initial(a.initial_equilibrium_rad, a.initial_preset, a.initial_equilibrium_rad,
                                    static_cast<std::uint8_t>(a.id));
    }
    plans.resize(units.size());
    notices.reserve(units.size());
    make_buses();
    initial.state = state;
    for (const auto& bus : buses) initial.buses.push_back(bus->state());
  }

  void make_buses() {
    for (std::size_t b = 0; b < config.buses.size(); ++b) {
      std::vector<std::size_t> on_it;
      for (std::size_t i = 0; i < units.size(); ++i)
        if (config.actuators[i].bus == b) on_it.push_back(i);
      std::stable_sort(on_it.begin(), on_it.end(),
                       [this](std::size_t x, std::size_t y) { return config.actuators[x].id < config.actuators[y].id; });
      std::vector<BusMember> members;
      for (const std::size_t i : on_it)
        members.push_back({units[i].get(), &state.actuators[i], &plans[i], static_cast<std::uint8_t>(config.actuators[i].id)});
      buses.push_back(std::make_unique<BusLine>(config.buses[b], std::move(members)));
    }
  }

  /// Units with equal parameters share one instance: a thousand of them then fit the processor's cache. States are their own.
  std::shared_ptr<device::Unit> unit_for(const UnitConfig& unit) {
    for (const auto& known : distinct)
      if (known->config() == unit) return known;
    distinct.push_back(std::make_shared<device::Unit>(unit));
    return distinct.back();
  }

  void take_commands() noexcept {
    queue.drain([this](Order& c) {
      ActuatorSlot& slot = state.actuators[c.actuator];
      (c.channel == Channel::equilibrium ? slot.equilibrium : slot.preset).begin(std::move(c.knots), state.time_ns);
      note_range(c.actuator);
    });
  }

  void take_faults() noexcept {
    faults.drain([this](FaultOrder& f) {
      const ActuatorConfig& a = config.actuators[f.actuator];
      device::Unit::set_faults(state.actuators[f.actuator].unit, f.faults);
      buses[a.bus]->set_wiring(state.actuators[f.actuator], f.faults);
    });
  }

  void notice(std::size_t i, bool& noted, bool now, NoticeKind kind, double value) noexcept {
    if (now && !noted) notices.push_back({i, kind, value});
    noted = noted || now;
  }

  void note_range(std::size_t i) noexcept {
    ActuatorSlot& slot = state.actuators[i];
    const UnitConfig& unit = config.actuators[i].unit;
    const double limit = unit.preset_max;
    const double q = slot.equilibrium.last(), p = slot.preset.last();
    if (config.buses[config.actuators[i].bus].serial_port) return notice(i, slot.noted_port, true, NoticeKind::port, 0);
    notice(i, slot.noted_preset, std::abs(p) > limit, NoticeKind::preset, p);
    const auto x = unit.actuator.transmission->references({q, std::clamp(p, -limit, limit)});
    bool out = false;
    for (int m = 0; m < 2 && unit.memory.limits_on != 0; ++m) {
      const auto [low, high] = unit.reference_range_raw(m);
      out = out || x[m] < radians(Raw{low}) || x[m] > radians(Raw{high});
    }
    notice(i, slot.noted_limits, out, NoticeKind::limits, q);
  }

  void expect(std::int64_t t_ns) noexcept {
    if (t_ns == state.time_ns) return;
    for (const auto& bus : buses) bus->shift_time(t_ns - state.time_ns);
    state.time_ns = t_ns;
  }

  void restore(const Snapshot& from) {
    for (const auto& bus : buses) bus->lock();
    queue.clear();
    faults.clear();
    state = from.state;
    for (std::size_t b = 0; b < buses.size(); ++b) buses[b]->restore(from.buses[b]);
    for (const auto& bus : buses) bus->unlock();
  }

  RobotConfig config;
  std::vector<std::shared_ptr<device::Unit>> units;
  std::vector<std::shared_ptr<device::Unit>> distinct;
  RobotState state;
  std::vector<device::StepPlan> plans;
  std::vector<std::unique_ptr<BusLine>> buses;
  Snapshot initial;
  CommandQueue queue;
  FaultQueue faults;
  NoticeList notices;
};

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

void Robot::advance(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<double> torques_out) noexcept {
  Impl& d = *impl_;
  d.expect(t_ns);
  d.take_commands();
  d.take_faults();
  for (std::size_t i = 0; i < d.units.size(); ++i) {
    ActuatorSlot& slot = d.state.actuators[i];
    const double inverse = in[i].inverse_inertia ? *in[i].inverse_inertia : 1.0 / d.units[i]->config().actuator.shaft_inertia_kgm2;
    slot.shaft_rad = in[i].angle_rad;
    d.units[i]->begin_step(slot.unit, d.plans[i], t_ns, dt_ns, {in[i].angle_rad, in[i].speed_rad_per_s, inverse});
  }
  const std::int64_t end_ns = t_ns + dt_ns;
  for (std::int64_t at = device::Unit::first_tick_ns(t_ns); at < end_ns; at += firmware::kTickNs)
    for (const auto& bus : d.buses) bus->tick(at);
  for (std::size_t i = 0; i < d.units.size(); ++i) torques_out[i] = d.units[i]->end_step(d.state.actuators[i].unit, d.plans[i]);
  // A frame whose bytes set out in this step carries what was commanded by now, even if it arrives in the next.
  for (const auto& bus : d.buses) bus->run_to(end_ns);
  d.state.time_ns = end_ns;
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

ActuatorReading Robot::read(std::size_t actuator) const {
  const ActuatorSlot& slot = impl_->state.actuators.at(actuator);
  const device::Unit& unit = *impl_->units[actuator];
  const device::UnitState& u = slot.unit;
  ActuatorReading r;
  r.equilibrium_command_rad = slot.equilibrium.at(impl_->state.time_ns);
  r.preset_command = slot.preset.at(impl_->state.time_ns);
  const auto attained = unit.config().actuator.transmission->attained({u.actuator.motor[0].angle, u.actuator.motor[1].angle});
  r.equilibrium_rad = attained.equilibrium;
  r.preset = attained.preset;
  r.shaft_rad = slot.shaft_rad;
  r.shaft_speed_rad_per_s = u.last_speed;
  r.deflection_rad = r.shaft_rad - r.equilibrium_rad;
  r.stiffness_Nm_per_rad = unit.physics().spring(u.actuator, r.shaft_rad).curvature.qq;
  r.torque_Nm = u.applied_torque;
  for (int m = 0; m < unit.physics().motors(); ++m) {
    r.motor_rad[m] = u.actuator.motor[m].angle;
    r.motor_speed_rad_per_s[m] = u.actuator.motor[m].speed;
    r.motor_torque_Nm[m] = u.actuator.load[m];
    r.current_A[m] = unit.physics().motor_current(u.actuator, m, u.held.voltage[m], u.held.terminal[m]);
  }
  r.measured = impl_->buses[impl_->config.actuators[actuator].bus]->measured(slot, unit);
  return r;
}

actuator::Ledger Robot::ledger(std::size_t actuator) const { return impl_->state.actuators.at(actuator).unit.actuator.ledger; }

actuator::Ledger Robot::ledger() const {
  actuator::Ledger sum;
  for (const ActuatorSlot& slot : impl_->state.actuators) sum += slot.unit.actuator.ledger;
  return sum;
}

std::vector<Notice> Robot::take_notices() {
  std::vector<Notice> out;
  for (const RangeNotice& n : impl_->notices.take()) {
    const ActuatorConfig& a = impl_->config.actuators[n.actuator];
    const auto unit = std::string(a.unit.actuator.transmission->preset_unit());
    const std::string limit = std::to_string(a.unit.preset_max);
    std::string text = a.name;
    switch (n.kind) {
      case NoticeKind::preset:
        text += ": preset " + std::to_string(n.value) + " " + unit + " is beyond ±" + limit + ": clamped";
        break;
      case NoticeKind::limits:
        text += ": equilibrium " + std::to_string(n.value) +
                " rad with this preset drives a motor beyond its limits: clamped as the unit does";
        break;
      case NoticeKind::port:
        text += ": commands aren't taken: its bus belongs to the serial port " + *impl_->config.buses[a.bus].serial_port;
        break;
    }
    out.push_back({n.actuator, std::move(text)});
  }
  return out;
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
