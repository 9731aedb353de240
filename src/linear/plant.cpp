// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linear/plant.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/checks.hpp"
#include "vsa/device/duty.hpp"
#include "vsa/drive/pwm_cycle.hpp"
#include "vsa/firmware/controller.hpp"
#include "vsa/sensor/sensors.hpp"

namespace vsa::linear {
namespace {

/// The share of the supply at full output.
double full_duty(const device::UnitConfig& unit) noexcept {
  if (unit.servo) return 1;
  const auto supply = sensor::supply_from_adc(sensor::supply_adc(unit.actuator.supply_V));
  return (unit.supply_limited() ? firmware::supply_limit_pct(supply, unit.program.generation) : 100) / device::kDutyScale;
}

bool chopped(const actuator::SideParams& side) noexcept { return side.bridge.pin == drive::PwmPin::enable; }

/// The motor at the pulley with the resistance that its current meets; a chopped one has no current between two periods.
drive::MotorParams motor_of(const actuator::SideParams& side) noexcept {
  drive::MotorParams m = drive::at_pulley(side.motor, side.gearbox.ratio);
  if (!chopped(side)) m.resistance_Ohm += side.bridge.switch_Ohm;
  return m;
}

/// A motor at its pulley on its bridge at the unit's supply.
struct Driven {
  const drive::BridgeParams& bridge;
  const drive::MotorParams& motor;
  double supply_V, full_duty;

  [[nodiscard]] drive::PwmMean chopped_mean(double duty) const noexcept {
    return drive::PwmCycle(bridge, supply_V, motor.resistance_Ohm, motor.inductance_H.value_or(0), duty).mean(0.0);
  }
  /// The smallest duty that gives it this current at standstill; the current only grows with it. Beyond the full one: infinite.
  [[nodiscard]] double duty_for(double amps) const noexcept {
    if (amps == 0) return 0;
    double low = 0, high = full_duty;
    if (!(supply_V > 0) || chopped_mean(high).current < std::abs(amps)) return HUGE_VAL;
    for (int i = 0; i < 200 && high - low > 1e-15 * full_duty; ++i) {
      const double middle = 0.5 * (low + high);
      (chopped_mean(middle).current < std::abs(amps) ? low : high) = middle;
    }
    return std::copysign(high, amps);
  }
};

/// Current and voltage of a motor under its spring's load, and their slopes there. ∂ī/∂d is the closed form's central difference.
MotorSlopes slopes_of(const Driven& on, double load_Nm) noexcept {
  const drive::MotorParams& m = on.motor;
  const double full_V = on.full_duty * on.supply_V;
  MotorSlopes s;
  s.amps = load_Nm == 0 ? 0.0 : -load_Nm / m.torque_constant_Nm_per_A;
  if (on.bridge.pin == drive::PwmPin::enable) {
    const double duty = on.duty_for(s.amps);
    s.volts = duty == 0 ? 0.0 : duty * on.supply_V;
    if (std::isinf(duty)) s.volts = std::copysign(HUGE_VAL, s.amps);
    if (on.supply_V > 0 && std::isfinite(duty)) {
      constexpr double kStep = 1e-6;
      const double rise = on.chopped_mean(duty + kStep).current - on.chopped_mean(duty - kStep).current;
      s.amps_per_volt = duty == 0 ? 0.0 : rise / (2 * kStep * on.supply_V);
      s.amps_per_speed = on.chopped_mean(duty).conductance * m.back_emf_Vs_per_rad;
    }
  } else {
    s.volts = s.amps * m.resistance_Ohm;
    s.amps_per_volt = 1.0 / m.resistance_Ohm;
    s.amps_per_speed = m.back_emf_Vs_per_rad / m.resistance_Ohm;
    if (m.inductance_H) s.lag_s = *m.inductance_H / m.resistance_Ohm;
  }
  const bool silent = on.bridge.dead_band > 0 && std::abs(s.volts) <= 1e-9 * full_V;
  s.volts_per_percent = silent ? 0.0 : full_V / (1.0 - on.bridge.dead_band) / 100.0;
  return s;
}

/// Where τ(q) + load = 0. The torque falls with q for a convex law; looked for within the turns that a program counts.
std::optional<double> shaft_under(const elastic::Transmission& law, const elastic::Positions& near, double load_Nm) noexcept {
  constexpr double kFurthest = 100;
  const auto pull = [&](double q) { return law.evaluate({q, near.x}).torque + load_Nm; };
  double low = near.q, high = near.q;
  for (double reach = 1e-3; pull(low) < 0 || pull(high) > 0; reach *= 2) {
    if (!(reach < kFurthest)) return std::nullopt;
    low = near.q - reach;
    high = near.q + reach;
  }
  for (int i = 0; i < 200 && high - low > 1e-15; ++i) {
    const double middle = 0.5 * (low + high);
    (pull(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void check_point(const device::Unit& unit, const OperatingPoint& p, Problems& problems) {
  const auto say = [&](const char* key, double v, const char* allowed) {
    problems.add({"", key, Checks::text(v), "is out of range", allowed});
  };
  if (p.inertia_kgm2 && !(*p.inertia_kgm2 > 0 && std::isfinite(*p.inertia_kgm2))) say("inertia_kgm2", *p.inertia_kgm2, "above 0");
  if (!(p.damping_Nms_per_rad >= 0 && std::isfinite(p.damping_Nms_per_rad)))
    say("damping_Nms_per_rad", p.damping_Nms_per_rad, "≥ 0");
  if (!std::isfinite(p.load_Nm)) say("load_Nm", p.load_Nm, "a finite number");
  if (unit.config().preset_unit().empty() && p.preset != 0) {
    problems.add({"", "preset", Checks::text(p.preset), "this actuator has no stiffness preset", "0"});
  } else {
    unit.check_place(unit.switched_on(0, 1, 0), {p.shaft_rad.value_or(0), 0, p.equilibrium_rad, p.preset, 0}, "", problems);
  }
}

void stick(Plant& out, const device::UnitConfig& unit, const std::array<double, 2>& load, Problems& problems) {
  const actuator::ActuatorParams& p = unit.actuator;
  out.shaft_stiffness = drive::Friction(actuator::shaft_friction(p)).stiffness;
  out.tendon_damping_s = p.tendon.damping_s;
  const drive::Friction tendon(drive::FrictionParams{p.tendon.friction, p.tendon.presliding_J});
  for (int i = 0; i < out.motors; ++i) {
    const actuator::SideParams& side = p.side[i];
    const drive::Friction gear(drive::at_pulley(side.gearbox.friction, side.gearbox.ratio));
    if (gear.coulomb_Nm > 0 && gear.presliding_rad <= 0 && (i == 0 || !(side.gearbox == p.side[0].gearbox))) {
      problems.add({"", i == 0 ? "drive.presliding_rad" : "drive_2.presliding_rad", "0",
                    "a gear that sticks without presliding has no stiffness", "above 0"});
    }
    out.slopes[i].stuck_stiffness = gear.stiffness;
    if (i < p.transmission->spring_count()) out.slopes[i].tendon_stiffness = tendon.stiffness * load[i] * load[i];
  }
}

void drive_motors(Plant& out, const device::UnitConfig& unit, const std::array<double, 2>& load, Problems& problems) {
  const double supply_V = unit.actuator.supply_V, full = full_duty(unit), full_V = full * supply_V;
  for (int i = 0; i < out.motors; ++i) {
    const actuator::SideParams& side = unit.actuator.side[i];
    out.motor[i] = motor_of(side);
    MotorSlopes& s = out.slopes[i] = slopes_of({side.bridge, out.motor[i], supply_V, full}, load[i]);
    out.rest.motor_V[i] = s.volts;
    out.rest.motor_A[i] = s.amps;
    const std::string motor = "motor " + std::to_string(i + 1);
    if (!(std::abs(s.volts) <= full_V * (1 + 1e-12))) {
      problems.add({"", motor + " voltage", std::isinf(s.volts) ? "" : Checks::text(s.volts),
                    "its spring's load of " + Checks::text(load[i]) + " N·m needs more than there is",
                    "±" + Checks::text(full_V) + " V (drive.supply_V and the firmware's limit)"});
    } else if (s.amps_per_volt == 0) {
      out.notices.push_back(motor +
                            " rests without current on a modulated enable pin: a small duty gives none, and it turns freely");
    }
  }
}

}  // namespace

Plant find_plant(const device::UnitConfig& config, const OperatingPoint& p, DryFriction friction) {
  const device::Unit unit(config);
  Problems problems;
  check_point(unit, p, problems);
  problems.throw_if_any();
  const elastic::Transmission& law = *config.actuator.transmission;
  Plant out;
  out.motors = law.motor_count();
  out.inertia = p.inertia_kgm2.value_or(config.actuator.shaft_inertia_kgm2);
  out.damping = p.damping_Nms_per_rad;
  elastic::Positions at{p.equilibrium_rad, law.references({p.equilibrium_rad, p.preset})};
  const std::optional<double> shaft = p.shaft_rad ? p.shaft_rad : shaft_under(law, at, p.load_Nm);
  if (!shaft)
    throw InputError({"", "load_Nm", Checks::text(p.load_Nm), "no angle of the shaft holds it", "what the springs carry"});
  at.q = *shaft;
  const elastic::Response r = law.evaluate(at);
  out.rest.at = at;
  out.rest.load_Nm = -r.torque;
  out.curvature = r.curvature;
  drive_motors(out, config, r.load, problems);
  if (friction == DryFriction::stuck) stick(out, config, r.load, problems);
  problems.throw_if_any();
  return out;
}

Eigen::MatrixXd state_matrix(const Plant& p) {
  const int n = p.states();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  const elastic::Hessian& h = p.curvature;
  const std::array<double, 2> own = h.xx;
  a(0, 1) = 1;
  a(1, 0) = -(h.qq + p.shaft_stiffness) / p.inertia;
  a(1, 1) = -p.damping / p.inertia;
  for (int i = 0; i < p.motors; ++i) {
    const MotorSlopes& s = p.slopes[i];
    const drive::MotorParams& m = p.motor[i];
    const double j = m.inertia_kgm2;
    const int x = p.angle(i), w = x + 1;
    const double kappa = s.tendon_stiffness, rub = kappa * p.tendon_damping_s;
    a(x, w) = 1;
    a(1, 0) -= kappa / p.inertia;
    a(1, 1) -= rub / p.inertia;
    a(1, x) = (kappa - h.qx[i]) / p.inertia;
    a(1, w) = rub / p.inertia;
    a(w, 0) = (kappa - h.qx[i]) / j;
    a(w, 1) = rub / j;
    a(w, x) = -(own[i] + kappa + s.stuck_stiffness) / j;
    a(w, w) = -(m.viscous_Nms_per_rad + rub) / j;
    if (p.motors == 2) a(w, p.angle(1 - i)) = -h.x0x1 / j;
    if (s.lag_s) {
      a(w, w + 1) = m.torque_constant_Nm_per_A / j;
      a(w + 1, w) = -s.amps_per_speed / *s.lag_s;
      a(w + 1, w + 1) = -1.0 / *s.lag_s;
    } else {
      a(w, w) -= m.torque_constant_Nm_per_A * s.amps_per_speed / j;
    }
  }
  return a;
}

Eigen::MatrixXd input_matrix(const Plant& p) {
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(p.states(), 1 + p.motors);
  b(1, 0) = 1.0 / p.inertia;
  for (int i = 0; i < p.motors; ++i) {
    const MotorSlopes& s = p.slopes[i];
    if (s.lag_s) {
      b(p.angle(i) + 2, 1 + i) = s.amps_per_volt / *s.lag_s;
    } else {
      b(p.angle(i) + 1, 1 + i) = p.motor[i].torque_constant_Nm_per_A * s.amps_per_volt / p.motor[i].inertia_kgm2;
    }
  }
  return b;
}

Eigen::MatrixXd output_matrix(const Plant& p, Eigen::Index states) {
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(3 + p.motors, states);
  c(0, 0) = c(1, 1) = 1;
  c(2, 0) = -p.curvature.qq;
  for (int i = 0; i < p.motors; ++i) {
    c(2, p.angle(i)) = -p.curvature.qx[i];
    c(3 + i, p.angle(i)) = 1;
  }
  return c;
}

double held_stiffness(const Plant& p) {
  double out = p.curvature.qq + p.shaft_stiffness;
  for (const MotorSlopes& s : p.slopes) out += s.tendon_stiffness;
  return out;
}

}  // namespace vsa::linear
