// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a robot tells of itself.
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <string>
#include <utility>

#include "host/robot_impl.hpp"
#include "vsa/checks.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/firmware/arithmetic.hpp"
#include "vsa/host/resolution.hpp"

namespace vsa::host {
namespace {

/// With three digits.
std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

ActuatorReading Robot::read(std::size_t actuator, device::Torques torques) const {
  const ActuatorSlot& slot = impl_->shown(known(actuator));
  const device::Unit& unit = *impl_->units[actuator];
  ActuatorReading r;
  r.equilibrium_command_rad = slot.equilibrium.at(impl_->state.time_ns);
  r.preset_command = slot.preset.at(impl_->state.time_ns);
  const device::UnitReading now = device::read(unit, slot.unit, torques);
  r.equilibrium_rad = now.equilibrium_rad;
  r.preset = now.preset;
  r.shaft_rad = now.shaft_rad;
  r.shaft_speed_rad_per_s = now.shaft_speed_rad_per_s;
  r.deflection_rad = r.shaft_rad - r.equilibrium_rad;
  r.stiffness_Nm_per_rad = now.stiffness_Nm_per_rad;
  r.torque_Nm = now.torque_Nm;
  r.mean_torque_Nm = now.mean_torque_Nm;
  r.motor_rad = now.motor_rad;
  r.motor_speed_rad_per_s = now.motor_speed_rad_per_s;
  r.motor_torque_Nm = now.motor_torque_Nm;
  r.current_A = now.current_A;
  r.measured = impl_->buses[impl_->config.actuators[actuator].bus]->measured(slot, unit);
  return r;
}

bool Robot::is_stiff() const { return impl_->state.stiff; }

actuator::Ledger Robot::ledger(std::size_t actuator) const { return impl_->shown(known(actuator)).unit.actuator.ledger; }

actuator::Ledger Robot::ledger() const {
  actuator::Ledger sum;
  for (const ActuatorSlot& slot : impl_->shown().actuators) sum += slot.unit.actuator.ledger;
  return sum;
}

std::vector<Notice> Robot::take_notices() {
  std::vector<Notice> out;
  for (const RawNotice& n : impl_->notices.take()) {
    const ActuatorConfig& a = impl_->config.actuators[n.actuator];
    const std::string unit = a.unit.preset_unit().empty() ? "" : " " + std::string(a.unit.preset_unit());
    const std::string limit = Checks::text(a.unit.preset_max);
    std::string text = a.name;
    switch (n.kind) {
      case NoticeKind::preset:
        text += ": preset " + Checks::text(n.value) + unit + " is beyond ±" + limit + unit + ": clamped";
        break;
      case NoticeKind::limits:
        text += ": equilibrium " + Checks::text(n.value) +
                " rad with this preset drives a motor beyond its limits: clamped as the unit does";
        break;
      case NoticeKind::unresolved: {
        const double x = std::sqrt(n.value);
        const Resolution r = resolution(x);
        text += ": its spring on the inertia behind the joint swings with ω·dt = " + rounded(std::ceil(100 * x) / 100) +
                ": at this step length such a swing has " + rounded(r.frequency) + " times its frequency and " + rounded(r.radius) +
                " times its amplitude after each step" + "; steps shorter by a factor of " + rounded(x / 0.3) +
                " resolve it (<substeps> in the plug-in element, or a smaller <max_step_size>)";
        break;
      }
      case NoticeKind::unsettled:
        text = "the joints' solution did not settle in a step; where that comes again, shorter steps are needed";
        break;
      case NoticeKind::energy:
        text = "energy out of nothing: " + rounded(100 * n.value) +
               " % of what actuators and bodies exchanged (the ledger's coupling): shorter steps are needed";
        break;
      case NoticeKind::rate:
        text = "bus " + impl_->config.buses[a.bus].name + ": " + impl_->buses[a.bus]->port()->wrong_rate().text();
        break;
      case NoticeKind::voltages:
        text += ": commands of equilibrium and preset aren't taken: its controller is motor_voltages";
        break;
      case NoticeKind::port:
        text += ": commands aren't taken: its bus belongs to the serial port " + *impl_->config.buses[a.bus].serial_port;
        break;
    }
    const bool whole = n.kind == NoticeKind::unsettled || n.kind == NoticeKind::energy;
    out.push_back({whole ? std::nullopt : std::optional(n.actuator), std::move(text)});
  }
  return out;
}

std::array<Ticks, 2> Robot::received_inputs(std::size_t actuator) const {
  const UnitConfig& config = impl_->config.actuators[known(actuator)].unit;
  const device::UnitState& state = impl_->shown(actuator).unit;
  if (config.servo) return impl_->units[actuator]->inputs_for(state.servo.command.equilibrium, state.servo.command.preset);
  const BusLine& bus = *impl_->buses[impl_->config.actuators[actuator].bus];
  const firmware::ProgramState& s = state.program;
  const std::int32_t sign = config.program.model == firmware::Model::advanced ? -1 : 1;
  std::array<Ticks, 2> out;
  const std::lock_guard quiet(bus);
  for (int i = 0; i < 2; ++i)
    out[i] = {firmware::cut_16(firmware::shift_right(firmware::wrap_mul(sign, s.loop.ref_new[i]), s.memory.stored.resolution[i]))};
  return out;
}

}  // namespace vsa::host
