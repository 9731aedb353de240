// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Putting an actuator somewhere, copying a robot, and whose snapshots it takes.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include "host/robot_impl.hpp"
#include "vsa/checks.hpp"
#include "vsa/elastic/inverse.hpp"
#include "vsa/errors.hpp"

namespace vsa::host {
namespace {

void check_same(const std::string& key, const std::string& theirs, const std::string& ours, Problems& problems) {
  if (theirs != ours) problems.add({"", key, theirs, "the snapshot is of another robot", ours});
}

/// With which the springs leave a shaft at q alone: q itself, but where the two are unequal.
double balance(const elastic::Transmission& law, double q, double preset) noexcept {
  constexpr double kNothing_Nm = 1e-6;
  if (!(std::abs(law.evaluate({q, law.references({q, preset})}).torque) > kNothing_Nm)) return q;
  return elastic::equilibrium_for(law, q, 0.0, preset).value_or(q);
}

}  // namespace

Robot Robot::clone() const {
  Robot copy(config());
  copy.join(impl_->trees, impl_->shared);
  copy.restore(*snapshot());
  return copy;
}

void Robot::place(std::size_t actuator, const Placement& at, double step_s) {
  static_cast<void>(known(actuator));
  Impl& d = *impl_;
  ActuatorSlot& slot = d.home().actuators[actuator];
  const std::string name = d.config.actuators[actuator].name;
  Problems problems;
  const device::Unit& unit = *d.units[actuator];
  const double equilibrium =
      at.equilibrium_rad ? *at.equilibrium_rad : balance(*unit.config().actuator.transmission, at.angle_rad, at.preset);
  if (!(step_s >= 0 && step_s <= kLongestStep_s))
    problems.add({"", "step_s", Checks::text(step_s), "is out of range", "0 … 0.016"});
  const device::UnitPlace there{at.angle_rad, at.speed_rad_per_s, equilibrium, at.preset, step_s / 2};
  unit.check_place(slot.unit, there, name + ": ", problems);
  problems.throw_if_any();
  d.queue.drop([&](const Order& o) { return o.actuator == actuator; });
  slot.equilibrium.hold(equilibrium);
  slot.preset.hold(at.preset);
  const BusLine& bus = *d.buses[d.config.actuators[actuator].bus];
  const std::lock_guard quiet(bus);
  unit.place(slot.unit, there);
}

void Robot::relocate(std::size_t actuator, double angle_rad, double speed_rad_per_s) {
  static_cast<void>(known(actuator));
  Impl& d = *impl_;
  Problems problems;
  Checks check(d.config.actuators[actuator].name + ": ", problems);
  check.finite("angle_rad", angle_rad);
  check.finite("speed_rad_per_s", speed_rad_per_s);
  problems.throw_if_any();
  const BusLine& bus = *d.buses[d.config.actuators[actuator].bus];
  const std::lock_guard quiet(bus);
  d.units[actuator]->relocate(d.home().actuators[actuator].unit, angle_rad, speed_rad_per_s);
}

void Robot::check(const Snapshot& snapshot) const {
  const RobotConfig& ours = impl_->config;
  if (snapshot.made_of == impl_->made_of) return;
  const RobotConfig& theirs = *snapshot.made_of;
  Problems problems;
  check_same("actuators", std::to_string(theirs.actuators.size()), std::to_string(ours.actuators.size()), problems);
  check_same("buses", std::to_string(theirs.buses.size()), std::to_string(ours.buses.size()), problems);
  problems.throw_if_any();
  const auto text = [](const ActuatorConfig& a) {
    return a.name + " on " + a.joint + ", bus " + std::to_string(a.bus) + ", id " + std::to_string(a.id);
  };
  for (std::size_t i = 0; i < ours.actuators.size(); ++i) {
    const ActuatorConfig &a = theirs.actuators[i], &b = ours.actuators[i];
    check_same("actuator " + std::to_string(i), text(a), text(b), problems);
    check_kind(b.name, a.unit, b.unit, problems);
  }
  const auto bus = [](const BusConfig& b) { return std::to_string(b.baud_Hz) + " Hz" + (b.serial_port ? ", serial port" : ""); };
  for (std::size_t i = 0; i < ours.buses.size(); ++i)
    check_same("bus " + std::to_string(i), bus(theirs.buses[i]), bus(ours.buses[i]), problems);
  problems.throw_if_any();
}

}  // namespace vsa::host
