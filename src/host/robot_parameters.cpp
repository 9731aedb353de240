// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Giving actuators other parameters, one by one or all at once.
#include <algorithm>
#include <array>
#include <mutex>
#include <string>

#include "host/robot_impl.hpp"
#include "vsa/host/unit_kind.hpp"

namespace vsa::host {
namespace {

/// With which id the unit has them, and whether the page is written, is the unit's own.
bool same_parameters(firmware::Memory a, const firmware::Memory& b) noexcept {
  a.id = b.id;
  a.valid = b.valid;
  return a == b;
}

/// What the program works with, and comes back with when it is switched on.
bool has_own(const firmware::MemoryState& m, const firmware::Memory& own) noexcept {
  return same_parameters(m.current, own) && same_parameters(m.stored, own);
}

void put(firmware::MemoryState& m, const firmware::Memory& parameters) noexcept {
  for (firmware::Memory* copy : {&m.stored, &m.current, &m.user, &m.factory}) {
    const std::uint8_t id = copy->id;
    const bool valid = copy->valid;
    *copy = parameters;
    copy->id = id;
    copy->valid = valid;
  }
}

/// What a unit works out in its first steps and then keeps takes as long as two steps: once, not each time that a robot goes over to
/// these parameters.
std::shared_ptr<const actuator::Actuator> prepared(const UnitConfig& config, std::int64_t dt_ns) {
  device::Unit unit(config);
  device::UnitState scratch = unit.initial(0, 0, 0);
  for (int k = 0; k < 2; ++k) unit.step(scratch, k * dt_ns, dt_ns, {});
  return std::make_shared<const actuator::Actuator>(unit.physics());
}

void take_unit(ActuatorConfig& to, const ActuatorConfig& from) {
  to.unit = from.unit;
  to.changed = from.changed;
  to.prepared = from.prepared;
  if (to.type != from.type) to.type = from.type;
}

}  // namespace

std::array<int, 4> kind_of(const UnitConfig& u) noexcept {
  return {u.servo ? static_cast<int>(u.servo->kind) : -1, static_cast<int>(u.program.model), static_cast<int>(u.program.dialect),
          u.actuator.transmission ? u.actuator.transmission->motor_count() : 0};
}

/// A batch whose copies have parameters of their own asks at every step: words are for where something is wrong.
void check_kind(const std::string& name, const UnitConfig& from, const UnitConfig& to, Problems& problems) {
  if (kind_of(from) == kind_of(to)) return;
  const auto number = [](auto value) { return std::to_string(static_cast<int>(value)); };
  const auto same = [&](const char* key, const std::string& theirs, const std::string& ours) {
    if (theirs != ours) problems.add({"", name + ": " + key, theirs, "a unit's state can't go over to this", ours});
  };
  const auto controller = [](const UnitConfig& unit) {
    return unit.servo ? std::string(control::name_of(unit.servo->kind)) : std::string("qbmove");
  };
  same("control.kind", controller(from), controller(to));
  same("firmware.model", number(from.program.model), number(to.program.model));
  same("firmware.dialect", number(from.program.dialect), number(to.program.dialect));
  same("number of motors", number(from.actuator.transmission->motor_count()), number(to.actuator.transmission->motor_count()));
}

void Robot::check(const std::shared_ptr<const RobotConfig>& parameters) const { impl_->check(parameters.get()); }

void Robot::Impl::check(const RobotConfig* theirs) const {
  constexpr const char* kAllowed = "parameters() of this robot or of another with the same actuators";
  if (theirs == made_of.get()) return;
  if (theirs == nullptr) throw InputError(Problem{"", "parameters", "none", "are missing", kAllowed});
  if (theirs->actuators.size() != units.size())
    throw InputError(Problem{"", "parameters", std::to_string(theirs->actuators.size()) + " actuators", "are of another robot",
                             std::to_string(units.size())});
  Problems problems;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const ActuatorConfig &a = theirs->actuators[i], &b = config.actuators[i];
    if (a.name != b.name) problems.add({"", "parameters", a.name, "are of another robot", b.name});
    if (a.unit.actuator.transmission == nullptr) {
      device::validate(a.unit, b.name + ": ", problems);
    } else {
      check_kind(b.name, a.unit, b.unit, problems);
    }
  }
  problems.throw_if_any();
}

void Robot::set_parameters(std::size_t actuator, const UnitConfig& unit) {
  const ActuatorConfig& now = impl_->config.actuators[known(actuator)];
  Problems problems;
  device::validate(unit, now.name + ": ", problems);
  problems.throw_if_any();
  check_kind(now.name, unit, now.unit, problems);
  problems.throw_if_any();
  impl_->set_parameters(actuator, unit);
}

void Robot::set_parameters(std::size_t actuator, const UnitConfig& unit, std::string type,
                           std::shared_ptr<const Settings> changed) {
  set_parameters(actuator, unit);
  impl_->config.actuators[actuator].type = std::move(type);
  impl_->config.actuators[actuator].changed = std::move(changed);
  impl_->made_of = impl_->initial.made_of = std::make_shared<const RobotConfig>(impl_->config);
}

std::shared_ptr<const RobotConfig> Robot::parameters() const { return impl_->made_of; }

std::shared_ptr<const RobotConfig> Robot::parameters_with(const RobotConfig& base,
                                                          std::span<const std::pair<std::size_t, ActuatorConfig>> changes,
                                                          std::int64_t dt_ns) const {
  impl_->check(&base);
  Problems problems;
  if (dt_ns < 1 || dt_ns > kLongestStep_ns) problems.add({"", "dt_ns", std::to_string(dt_ns), "is out of range", "1 … 16000000"});
  for (const auto& [actuator, to] : changes) {
    const std::string& name = impl_->config.actuators[known(actuator)].name;
    const std::size_t before = problems.list().size();
    device::validate(to.unit, name + ": ", problems);
    if (problems.list().size() == before) check_kind(name, to.unit, base.actuators[actuator].unit, problems);
  }
  problems.throw_if_any();
  auto out = std::make_shared<RobotConfig>(base);
  const ActuatorConfig* last = nullptr;
  for (const auto& [actuator, to] : changes) {
    ActuatorConfig& a = out->actuators[actuator];
    const std::shared_ptr<const elastic::Transmission> law = a.unit.actuator.transmission;
    take_unit(a, to);
    // Laws that are alike are one from here on: whoever compares sees that at a glance.
    if (law != nullptr && law->equals(*a.unit.actuator.transmission)) a.unit.actuator.transmission = law;
    a.prepared = last != nullptr && last->unit == a.unit ? last->prepared : prepared(a.unit, dt_ns);
    last = &a;
  }
  return out;
}

void Robot::set_parameters(const std::shared_ptr<const RobotConfig>& parameters) {
  Impl& d = *impl_;
  if (parameters == d.made_of) return;
  const std::shared_ptr<const RobotConfig> before = d.made_of;
  d.use(parameters);
  const QuietBuses quiet(d.buses);
  d.adopt(*before);
  for (std::size_t i = 0; i < size(); ++i) {
    if (!device::alike(before->actuators[i].unit, d.config.actuators[i].unit)) d.initial.state.actuators[i].unit = d.first_state(i);
  }
  d.initial.made_of = d.made_of;
}

void Robot::use(const std::shared_ptr<const RobotConfig>& parameters) { impl_->use(parameters); }

void Robot::renew_memories() {
  Impl& d = *impl_;
  const QuietBuses quiet(d.buses);
  for (std::size_t i = 0; i < size(); ++i) {
    firmware::MemoryState& m = d.home().actuators[i].unit.program.memory;
    const firmware::Memory& ours = d.config.actuators[i].unit.memory;
    if (!has_own(m, ours)) put(m, ours);
  }
}

bool Robot::has_own_memories() const {
  for (std::size_t i = 0; i < size(); ++i)
    if (!has_own(impl_->state.actuators[i].unit.program.memory, impl_->config.actuators[i].unit.memory)) return false;
  return true;
}

void Robot::Impl::drop_unused() {
  distinct.erase(std::remove_if(distinct.begin(), distinct.end(), [](const auto& u) { return u.use_count() == 1; }),
                 distinct.end());
}

void Robot::Impl::set_parameters(std::size_t i, const UnitConfig& unit) {
  if (device::alike(unit, config.actuators[i].unit)) return;
  home();
  const UnitConfig before = config.actuators[i].unit;
  BusLine& bus = *buses[config.actuators[i].bus];
  const std::shared_ptr<device::Unit> next = unit_for(unit);
  config.actuators[i].unit = next->config();
  config.actuators[i].prepared = nullptr;
  made_of = std::make_shared<const RobotConfig>(config);
  {
    const std::lock_guard quiet(bus);
    bus.set_unit(state.actuators[i], *next);
    units[i] = next;
    next->adopt(state.actuators[i].unit, before);
  }
  for (Cluster& cluster : clusters) cluster.exchange(units);
  initial.state.actuators[i].unit = first_state(i);
  initial.made_of = made_of;
  drop_unused();
}

/// All that may fail comes first.
void Robot::Impl::use(const std::shared_ptr<const RobotConfig>& to) {
  if (to == made_of) return;
  check(to.get());
  home();
  std::vector<std::shared_ptr<device::Unit>> next = units;
  for (std::size_t i = 0; i < units.size(); ++i)
    if (!(units[i]->config() == to->actuators[i].unit)) next[i] = unit_for(to->actuators[i].unit, to->actuators[i].prepared.get());
  {
    const QuietBuses quiet(buses);
    for (std::size_t i = 0; i < units.size(); ++i) {
      take_unit(config.actuators[i], to->actuators[i]);
      if (next[i] != units[i]) buses[config.actuators[i].bus]->set_unit(state.actuators[i], *next[i]);
    }
    units.swap(next);
  }
  next.clear();
  made_of = to;
  for (Cluster& cluster : clusters) cluster.exchange(units);
  drop_unused();
}

void Robot::Impl::adopt(const RobotConfig& from) noexcept {
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (!device::alike(from.actuators[i].unit, config.actuators[i].unit))
      units[i]->adopt(home().actuators[i].unit, from.actuators[i].unit);
  }
}

}  // namespace vsa::host
