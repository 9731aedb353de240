// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/workspace.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/elastic/inverse.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

constexpr double kDutyScale = 101.0;  // the PWM counter's period, as in device/unit.cpp
constexpr double kLagStep_rad = 2e-3;
constexpr double kLagMost_rad = 2 * kPi;
constexpr double kSlideShare_m_per_rad = 0.05;  // a linear actuator's springs give way by as much on a pinion of this radius

/// The last value in [0, most] up to which ok() holds everywhere on a grid of `step`, then by bisection. ok(0) must hold.
template <class Ok>
double last_good(double most, double step, const Ok& ok) {
  double good = 0;
  while (good < most && ok(std::min(most, good + step))) good = std::min(most, good + step);
  if (good >= most) return most;
  double bad = std::min(most, good + step);
  for (double mid = 0.5 * (good + bad); mid > good && mid < bad; mid = 0.5 * (good + bad)) (ok(mid) ? good : bad) = mid;
  return good;
}

/// The firmware's limit, chosen by the supply as its converter reads it.
double full_duty(const device::UnitConfig& unit) {
  if (unit.servo) return 1;
  const auto supply = sensor::supply_from_adc(sensor::supply_adc(unit.actuator.supply_V));
  return (unit.supply_limited() ? firmware::supply_limit_pct(supply, unit.program.generation) : 100) / kDutyScale;
}

}  // namespace

double MotorLine::most_Nm(double speed) const noexcept {
  if (chopped) return (chopped->torque_Nm(chopped->along, speed) - friction_Nm) / (1 + load_loss);
  const double full = full_Nm - friction_Nm - back_Nms_per_rad * speed;
  return std::min(full, limit_Nm - friction_Nm - viscous_Nms_per_rad * speed) / (1 + load_loss);
}
double MotorLine::least_Nm(double speed) const noexcept {
  if (chopped) return chopped->torque_Nm(chopped->against, speed) - friction_Nm;
  const double full = full_Nm + friction_Nm + back_Nms_per_rad * speed;
  return -std::min(full, limit_Nm + friction_Nm + viscous_Nms_per_rad * speed);
}
double MotorLine::no_load_speed_rad_per_s() const noexcept {
  if (!chopped) return stall_Nm <= friction_Nm ? 0.0 : std::max(0.0, (full_Nm - friction_Nm) / back_Nms_per_rad);
  if (most_Nm(0) <= 0) return 0;
  double low = 0, high = chopped->along.supply_V() / chopped->back_emf_Vs_per_rad;  // where no current is left
  for (double mid = 0.5 * (low + high); mid > low && mid < high; mid = 0.5 * (low + high)) (most_Nm(mid) > 0 ? low : high) = mid;
  return low;
}

double standing_voltage(const device::UnitConfig& unit, std::size_t motor, double output, double full_duty) noexcept {
  const drive::BridgeParams& bridge = unit.actuator.side[motor].bridge;
  const double supply_V = unit.actuator.supply_V;
  if (bridge.pin == drive::PwmPin::input) return drive::bridge_voltage(bridge, supply_V, output, full_duty);
  const drive::MotorParams& m = unit.actuator.side[motor].motor;
  const drive::PwmCycle cycle(bridge, supply_V, m.resistance_Ohm, m.inductance_H.value_or(0),
                              drive::bridge_duty(bridge, output, full_duty));
  return cycle.mean(0).current * m.resistance_Ohm;
}

MotorLine motor_line(const device::UnitConfig& unit, std::size_t motor) {
  const actuator::SideParams& side = unit.actuator.side[motor];
  const drive::BridgeParams& bridge = side.bridge;
  const drive::MotorParams m = drive::at_pulley(side.motor, side.gearbox.ratio);
  const bool chopped = bridge.pin == drive::PwmPin::enable;
  const double resistance = m.resistance_Ohm + (chopped ? 0.0 : bridge.switch_Ohm);
  MotorLine line;
  line.full_duty = full_duty(unit);
  line.voltage_V = standing_voltage(unit, motor, 1.0, line.full_duty);
  line.stall_current_A = line.voltage_V / resistance;
  line.full_Nm = m.torque_constant_Nm_per_A * line.stall_current_A;
  if (unit.servo && !unit.is(control::ServoKind::motor_voltages)) {
    line.stall_current_A = std::min(line.stall_current_A, unit.servo->current_max_A);
    line.limit_Nm = m.torque_constant_Nm_per_A * unit.servo->current_max_A;
  }
  line.torque_constant_Nm_per_A = m.torque_constant_Nm_per_A;
  line.resistance_Ohm = resistance;
  line.stall_Nm = m.torque_constant_Nm_per_A * line.stall_current_A;
  line.viscous_Nms_per_rad = m.viscous_Nms_per_rad;
  line.back_Nms_per_rad = m.torque_constant_Nm_per_A * m.back_emf_Vs_per_rad / resistance + m.viscous_Nms_per_rad;
  line.friction_Nm = drive::at_pulley(side.gearbox.friction, side.gearbox.ratio).coulomb_Nm;
  line.load_loss = side.gearbox.load_loss;
  line.back_loss = side.gearbox.back_loss.value_or(line.load_loss);
  if (chopped) {
    const auto at = [&](double duty) {
      return drive::PwmCycle(bridge, unit.actuator.supply_V, m.resistance_Ohm, m.inductance_H.value_or(0), duty);
    };
    line.chopped = {at(line.full_duty), at(-line.full_duty), m.torque_constant_Nm_per_A, m.back_emf_Vs_per_rad,
                    m.viscous_Nms_per_rad};
  }
  return line;
}

BestPower best_power(const std::vector<WorkspacePoint>& boundary) {
  BestPower best;
  for (const WorkspacePoint& p : boundary) {
    const double power = p.speed_rad_per_s * p.reach.torque_Nm;
    if (power > best.power_W) best = {power, p.reach.torque_Nm, p.speed_rad_per_s};
  }
  return best;
}

Workspace::Workspace(const device::UnitConfig& unit)
    : unit_(unit), lines_{motor_line(unit, 0), motor_line(unit, unit.actuator.sides() - 1)} {}

elastic::Response Workspace::at(double preset, double lag_rad, int direction) const {
  const elastic::Transmission& law = *unit_.actuator.transmission;
  const auto x = law.references({0.0, preset});
  return law.evaluate({law.attained(x).equilibrium - direction * lag_rad, x});
}

/// How far the unloaded shaft lags behind its equilibrium: with springs alike not at all.
double Workspace::lag_at_rest(double preset, int direction) const {
  const elastic::Transmission& law = *unit_.actuator.transmission;
  const auto x = law.references({0.0, preset});
  const double equilibrium = law.attained(x).equilibrium;
  return direction * (equilibrium - elastic::rest_under(law, x).value_or(equilibrium));
}

bool Workspace::carries(const elastic::Response& r, const std::array<double, 2>& rates, double speed, Task task) const {
  for (int i = 0; i < unit_.actuator.transmission->motor_count(); ++i) {
    const MotorLine& line = lines_[static_cast<std::size_t>(i)];
    const double torque = -r.load[i], helped = (1 - line.back_loss) * std::abs(torque);
    if (task == Task::unpowered) {
      if (helped > line.friction_Nm) return false;
    } else if (task == Task::hold || rates[i] == 0) {
      if (helped > line.stall_Nm + line.friction_Nm) return false;
    } else {
      const double pulley = std::abs(rates[i]) * speed, along = std::copysign(1.0, rates[i]) * torque;
      if (along > line.most_Nm(pulley) || along < line.least_Nm(pulley)) return false;
    }
  }
  return true;
}

Reach Workspace::reach(double preset, double speed, Task task, int direction) const {
  const elastic::Transmission& law = *unit_.actuator.transmission;
  const auto ahead = law.references({0.5, preset}), behind = law.references({-0.5, preset});
  const std::array<double, 2> rates{direction * (ahead[0] - behind[0]), direction * (ahead[1] - behind[1])};
  const auto ok = [&](double lag) {
    const elastic::Response r = at(preset, lag, direction);
    return r.curvature.qq >= 0 && carries(r, rates, speed, task);  // where the law softens to nothing, the joint gives way
  };
  const double rest = lag_at_rest(preset, direction);
  if (!ok(rest)) return {kNaN, kNaN, kNaN, kNaN};
  const double share = unit_.actuator.linear() ? kSlideShare_m_per_rad : 1.0;
  const double lag = rest + last_good(share * kLagMost_rad, share * kLagStep_rad, [&](double more) { return ok(rest + more); });
  const elastic::Response r = at(preset, lag, direction);
  const double shaft = unit_.actuator.shaft_friction.coulomb_Nm;
  const double torque = direction * r.torque + (task == Task::move ? -shaft : shaft);
  return {lag, torque, r.curvature.qq, r.energy};
}

double Workspace::moves_Nm(double preset) const {
  const double to = reach(preset, 0).torque_Nm, fro = reach(preset, 0, Task::move, -1).torque_Nm;
  return fro < to || std::isnan(fro) ? fro : to;
}

bool Workspace::winds(double preset) const {
  const elastic::Response r = at(preset, lag_at_rest(preset, 1), 1);
  for (int i = 0; i < unit_.actuator.transmission->motor_count(); ++i) {
    if (std::abs(r.load[i]) > lines_[static_cast<std::size_t>(i)].most_Nm(0)) return false;
  }
  return true;
}

double Workspace::attainable_preset() const {
  if (unit_.actuator.transmission->preset_unit().empty() || !winds(0)) return 0;
  return last_good(unit_.preset_max, unit_.preset_max / 500, [this](double p) { return winds(p); });
}

double Workspace::no_load_speed(double preset, int direction) const {
  const auto turns = [&](double speed) { return reach(preset, speed, Task::move, direction).torque_Nm >= 0; };  // NaN: no
  if (!turns(0)) return 0;
  const double most = 2 * std::max(lines_[0].no_load_speed_rad_per_s(), lines_[1].no_load_speed_rad_per_s()) + 1e-9;
  return last_good(most, most / 20, turns);
}

std::vector<WorkspacePoint> Workspace::boundary(double preset, int points, int direction) const {
  const double fastest = no_load_speed(preset, direction);
  std::vector<WorkspacePoint> out;
  for (int i = 0; i < points; ++i) {
    const double speed = fastest * i / (points - 1);
    out.push_back({speed, reach(preset, speed, Task::move, direction)});
  }
  return out;
}

std::vector<LawPoint> Workspace::law_curve(double preset, int points) const {
  // A shaft that is driven forwards lags: its deflection is negative.
  const double low = -reach(preset, 0, Task::move, 1).deflection_rad, high = reach(preset, 0, Task::move, -1).deflection_rad;
  std::vector<LawPoint> out;
  for (int i = 0; i < points; ++i) {
    const double deflection = low + (high - low) * i / (points - 1);
    const elastic::Response r = at(preset, deflection, -1);
    out.push_back({deflection, -r.torque, r.curvature.qq});
  }
  return out;
}

double Workspace::stiffness_at_rest(double preset) const { return at(preset, lag_at_rest(preset, 1), 1).curvature.qq; }
double Workspace::energy_at_rest(double preset) const { return at(preset, lag_at_rest(preset, 1), 1).energy; }

/// How far the shaft gives way to an external load; none: beyond the task's reach.
std::optional<double> Workspace::lag_under(double preset, double load_Nm, Task task) const {
  const int direction = load_Nm < 0 ? 1 : -1;
  const Reach most = reach(preset, 0, task, direction);
  if (!(direction * at(preset, most.deflection_rad, direction).torque >= std::abs(load_Nm))) return std::nullopt;
  double low = lag_at_rest(preset, direction), high = most.deflection_rad;  // within reach the torque grows
  for (double mid = 0.5 * (low + high); mid > low && mid < high; mid = 0.5 * (low + high))
    (direction * at(preset, mid, direction).torque < std::abs(load_Nm) ? low : high) = mid;
  return high;
}

double Workspace::stiffness_under(double preset, double load_Nm) const {
  const auto lag = lag_under(preset, load_Nm, Task::move);
  return lag ? at(preset, *lag, load_Nm < 0 ? 1 : -1).curvature.qq : kNaN;
}

Holding Workspace::holding(double preset, double load_Nm) const {
  const auto lag = lag_under(preset, load_Nm, Task::hold);
  if (!lag) return {kNaN, kNaN};
  const elastic::Response r = at(preset, *lag, load_Nm < 0 ? 1 : -1);
  Holding out;
  for (int i = 0; i < unit_.actuator.transmission->motor_count(); ++i) {
    const MotorLine& line = lines_[i];
    const double driven = std::max(0.0, (1 - line.back_loss) * std::abs(r.load[i]) - line.friction_Nm);
    const double current = driven / line.torque_constant_Nm_per_A;
    out.current_A += current;
    out.power_W += line.resistance_Ohm * current * current;
  }
  return out;
}

}  // namespace vsa::experiment
