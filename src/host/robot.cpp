// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
    std::vector<int> on_bus(config.buses.size(), 0);
    order.resize(units.size());
    for (std::size_t i = 0; i < units.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return config.actuators[a].id < config.actuators[b].id; });
    place.resize(units.size());
    for (std::size_t i : order) place[i] = on_bus[config.actuators[i].bus]++;
    for (std::size_t b = 0; b < config.buses.size(); ++b)
      schedules.push_back(bus::make_schedule(std::max(on_bus[b], 1), config.buses[b].baud_Hz, config.buses[b].cycle_s));
    for (const ActuatorConfig& a : config.actuators) schedule_of.push_back(&schedules[a.bus]);
    state.actuators.resize(units.size());
    for (std::size_t i = 0; i < units.size(); ++i) {
      const ActuatorConfig& a = config.actuators[i];
      ActuatorSlot& slot = state.actuators[i];
      slot.equilibrium.value = a.initial_equilibrium_rad;
      slot.preset.value = a.initial_preset;
      // The shaft's true place is known at the first step; until then it rests on its equilibrium.
      slot.unit = units[i]->initial(a.initial_equilibrium_rad, a.initial_preset, a.initial_equilibrium_rad);
    }
    notices.reserve(units.size());
    initial = state;
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

  void note_range(std::size_t i) noexcept {
    ActuatorSlot& slot = state.actuators[i];
    const double limit = config.actuators[i].unit.preset_max;
    const firmware::LoopParams& loop = config.actuators[i].unit.loop;
    const double q = slot.equilibrium.last(), p = slot.preset.last();
    const auto x = config.actuators[i].unit.actuator.transmission->references({q, std::clamp(p, -limit, limit)});
    bool out = std::abs(p) > limit;
    if (out && !slot.noted_preset) notices.push_back({i, NoticeKind::preset, p});
    slot.noted_preset = slot.noted_preset || out;
    out = false;
    for (int m = 0; m < 2 && loop.limits_on; ++m) {
      out = out || x[m] < radians(Raw{loop.limits_raw[2 * m]}) || x[m] > radians(Raw{loop.limits_raw[2 * m + 1]});
    }
    if (out && !slot.noted_limits) notices.push_back({i, NoticeKind::limits, q});
    slot.noted_limits = slot.noted_limits || out;
  }

  using Mail = std::array<device::TickMail, device::kMaxTicksPerStep>;

  /// Fixes the contents of unit i's next SET_INPUTS frame if it sets out before `before_ns`.
  void send_frame(std::size_t i, std::int64_t before_ns) noexcept;
  /// Frames that reach unit i before each tick of the step; returns the number of ticks.
  int collect_mail(std::size_t i, std::int64_t t_ns, std::int64_t dt_ns, Mail& mail) noexcept;

  RobotConfig config;
  std::vector<std::shared_ptr<device::Unit>> units;
  std::vector<std::shared_ptr<device::Unit>> distinct;
  std::vector<bus::Schedule> schedules;
  std::vector<const bus::Schedule*> schedule_of;  // one an actuator
  std::vector<std::size_t> order;                 // by id
  std::vector<int> place;                         // the unit's place on its bus, 0 = first
  RobotState state, initial;
  CommandQueue queue;
  NoticeList notices;
};

void Robot::Impl::send_frame(std::size_t i, std::int64_t before_ns) noexcept {
  ActuatorSlot& slot = state.actuators[i];
  const bus::Schedule& schedule = *schedule_of[i];
  const std::int64_t sent = schedule.inputs_at_ns(slot.cycle * schedule.cycle_ns, place[i]) - schedule.inputs_at_ns(0, 0);
  if (slot.sent || sent >= before_ns) return;
  slot.sent = true;
  slot.sent_inputs = units[i]->inputs_for(slot.equilibrium.at(sent), slot.preset.at(sent));
}

int Robot::Impl::collect_mail(std::size_t i, std::int64_t t_ns, std::int64_t dt_ns, Mail& mail) noexcept {
  const bus::Schedule& schedule = *schedule_of[i];
  ActuatorSlot& slot = state.actuators[i];
  const int ticks = std::min(device::Unit::ticks_in(t_ns, dt_ns), device::kMaxTicksPerStep);
  std::int64_t at = (t_ns + firmware::kTickNs - 1) / firmware::kTickNs * firmware::kTickNs;
  for (int k = 0; k < ticks; ++k, at += firmware::kTickNs) {
    mail[static_cast<std::size_t>(k)] = {};
    // The latest frame that is complete before the tick counts.
    while (schedule.inputs_at_ns(slot.cycle * schedule.cycle_ns, place[i]) <= at) {
      send_frame(i, at);
      mail[static_cast<std::size_t>(k)] = {true, slot.sent_inputs};
      slot.reply_due_ns = schedule.request_at_ns(slot.cycle * schedule.cycle_ns, place[i]);
      slot.sent = false;
      ++slot.cycle;
    }
  }
  // A frame whose bytes set out in this step carries what was commanded by now, even if it arrives in the next.
  send_frame(i, t_ns + dt_ns);
  return ticks;
}

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
  d.state.time_ns = t_ns;
  d.take_commands();
  Impl::Mail mail;
  for (std::size_t i = 0; i < d.units.size(); ++i) {
    ActuatorSlot& slot = d.state.actuators[i];
    const int ticks = d.collect_mail(i, t_ns, dt_ns, mail);
    if (slot.reply_due_ns >= 0 && slot.reply_due_ns < t_ns) {
      slot.measured = firmware::measurements(d.units[i]->config().loop, slot.unit.loop);
      slot.reply_due_ns = -1;
    }
    const double inverse = in[i].inverse_inertia ? *in[i].inverse_inertia : 1.0 / d.units[i]->config().actuator.shaft_inertia_kgm2;
    slot.shaft_rad = in[i].angle_rad;
    torques_out[i] = d.units[i]->step(slot.unit, t_ns, dt_ns, {in[i].angle_rad, in[i].speed_rad_per_s, inverse},
                                      {mail.data(), static_cast<std::size_t>(ticks)});
  }
  d.state.time_ns = t_ns + dt_ns;
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
    r.current_A[m] = unit.physics().motor_current(u.actuator, m, u.held.voltage[m], u.held.terminal);
  }
  r.measured = slot.measured;
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
    out.push_back(
        {n.actuator, n.kind == NoticeKind::preset
                         ? a.name + ": preset " + std::to_string(n.value) + " " + unit + " is beyond ±" + limit + ": clamped"
                         : a.name + ": equilibrium " + std::to_string(n.value) +
                               " rad with this preset drives a motor beyond its limits: clamped as the unit does"});
  }
  return out;
}

void Robot::set_supply(bool on) noexcept {
  for (ActuatorSlot& slot : impl_->state.actuators) slot.unit.supply_on = on;
}

std::shared_ptr<const Robot::Snapshot> Robot::snapshot() const {
  auto s = std::make_shared<Snapshot>();
  s->state = impl_->state;
  return s;
}

void Robot::restore(const Snapshot& snapshot) {
  impl_->queue.clear();
  impl_->state = snapshot.state;
}

void Robot::reset() {
  impl_->queue.clear();
  impl_->notices.clear();
  impl_->state = impl_->initial;
}

}  // namespace vsa::host
