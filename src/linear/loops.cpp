// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linear/loops.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "vsa/firmware/controller.hpp"
#include "vsa/units.hpp"

namespace vsa::linear {
namespace {

using Eigen::MatrixXd;

void check_loop(const device::UnitConfig& unit, Problems& problems) {
  const firmware::Memory& m = unit.memory;
  const auto say = [&](const char* key, const std::string& value) {
    problems.add({"", key, value, "isn't linearised with the firmware averaged or sampled", "0"});
  };
  if (m.control_mode != static_cast<std::uint8_t>(firmware::ControlMode::position))
    say("control mode", std::to_string(m.control_mode));
  if (m.input_mode != 0) say("input mode", std::to_string(m.input_mode));
  if (m.position.i != 0) say("firmware.ki_pct_per_tick", std::to_string(m.position.i / 65536.0));
}

}  // namespace

std::string motor_signal(int motor, const char* what) { return "motor " + std::to_string(motor + 1) + ' ' + what; }

Loops find_loops(const device::UnitConfig& unit, const Plant& plant, std::vector<std::string>& notices) {
  if (unit.servo) return {control::kTick_s, {}};
  Problems problems;
  check_loop(unit, problems);
  problems.throw_if_any();
  // 16.16 fixed point, % per raw; an advanced program counts its motors' angles and references the other way.
  const double sign = unit.program.model == firmware::Model::advanced ? -1.0 : 1.0;
  Loops out;
  out.period_s = firmware::loop_facts(unit.program.generation).ticks * 1e-9 * static_cast<double>(firmware::kTickNs);
  for (int i = 0; i < plant.motors; ++i) {
    const double gain = plant.slopes[i].volts_per_percent, per_rad = sign * unit.actuator.side[i].polarity / (2.0 * kPi);
    out.motors.push_back({plant.angle(i), 1 + i, unit.memory.position.p * per_rad * gain, unit.memory.position.d * per_rad * gain});
    if (gain == 0)
      notices.push_back(motor_signal(i, "rests inside its bridge's dead band: small outputs of the firmware don't reach it"));
  }
  return out;
}

void tell_of_averaging(const System& system, std::vector<std::string>& notices) {
  constexpr double kOfRate = 0.1;
  for (const Pole& pole : poles(system)) {
    if (!(pole.s.real() > 0 && pole.frequency_Hz > kOfRate / control::kTick_s)) continue;
    notices.push_back("a pole of " + std::to_string(std::lround(pole.frequency_Hz)) +
                      " Hz grows in the averaged firmware, which is good up to a tenth of the loops' rate: take it sampled");
    return;
  }
}

void average(System& m, const Loops& loops) {
  m.firmware = Firmware::averaged;
  for (const MotorLoop& l : loops.motors) {
    const Eigen::VectorXd volt = m.b.col(l.input);
    m.a.col(l.angle) -= l.p_V_per_rad * volt;
    m.a.col(l.angle + 1) -= l.d_V_per_rad * loops.period_s * volt;
    m.b.col(l.input) *= l.p_V_per_rad;
  }
}

/// exp of the system with its inputs as constant states gives both e^{AT} and what held inputs add.
void sample(System& m, const Loops& loops) {
  const Eigen::Index n = m.a.rows(), inputs = m.b.cols();
  m.firmware = Firmware::sampled;
  m.held_a = m.a;
  m.held_b = m.b;
  m.period_s = loops.period_s;
  MatrixXd whole = MatrixXd::Zero(n + inputs, n + inputs);
  whole.topLeftCorner(n, n) = m.a * loops.period_s;
  whole.topRightCorner(n, inputs) = m.b * loops.period_s;
  const MatrixXd held = whole.exp();
  const Eigen::Index all = n + static_cast<Eigen::Index>(loops.motors.size());
  m.a = MatrixXd::Zero(all, all);
  m.b = MatrixXd::Zero(all, inputs);
  m.a.topLeftCorner(n, n) = held.topLeftCorner(n, n);
  m.b.topRows(n) = held.topRightCorner(n, inputs);
  Eigen::Index last = n;
  for (const MotorLoop& l : loops.motors) {
    const Eigen::VectorXd volt = m.b.col(l.input);
    m.a.col(l.angle) -= (l.p_V_per_rad + l.d_V_per_rad) * volt;
    m.a.col(last) += l.d_V_per_rad * volt;
    m.a(last++, l.angle) = 1;
    m.b.col(l.input) *= l.p_V_per_rad;
    m.states.push_back({m.states[static_cast<std::size_t>(l.angle)].name + " at the last loop", "rad"});
  }
}

double static_stiffness(const Plant& plant, const Loops& loops) {
  const elastic::Hessian& h = plant.curvature;
  double shaft = h.qq + plant.shaft_stiffness;
  MatrixXd own = MatrixXd::Zero(plant.motors, plant.motors);
  Eigen::VectorXd across(plant.motors);
  for (int i = 0; i < plant.motors; ++i) {
    const MotorSlopes& s = plant.slopes[i];
    const double p_V_per_rad = loops.motors.empty() ? 0.0 : loops.motors[static_cast<std::size_t>(i)].p_V_per_rad;
    shaft += s.tendon_stiffness;
    across[i] = h.qx[i] - s.tendon_stiffness;
    own(i, i) =
        h.xx[i] + s.tendon_stiffness + s.stuck_stiffness + plant.motor[i].torque_constant_Nm_per_A * s.amps_per_volt * p_V_per_rad;
    if (i == 1) own(0, 1) = own(1, 0) = h.x0x1;
  }
  const double left = shaft - across.dot(own.completeOrthogonalDecomposition().solve(across));
  return std::abs(left) <= 1e-12 * shaft ? 0.0 : left;
}

void slide(std::vector<Signal>& signals) {
  for (Signal& s : signals)
    if (s.name.rfind("motor", 0) != 0) s = {sliding(s.name), sliding(s.unit)};
}

}  // namespace vsa::linear
