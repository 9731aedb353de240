// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linear/servo_loop.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numeric>

#include "linear/loops.hpp"
#include "vsa/elastic/travel.hpp"

namespace vsa::linear {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Row = Eigen::RowVectorXd;

std::string motor_name(int i) { return "motor " + std::to_string(i + 1); }

/// Writes a controller as rows over (c, y, r).
class Writer {
 public:
  Writer(const device::UnitConfig& unit, const Plant& plant, bool sampled, Index states, Index inputs)
      : servo_(*unit.servo), plant_(plant), sampled_(sampled), n_(states), y_(plant.states()), r_(inputs) {
    next_ = MatrixXd::Zero(n_, n_ + y_ + r_);
    volts_ = MatrixXd::Zero(plant.motors, n_ + y_ + r_);
    for (std::size_t i = 0; i < 2; ++i) sign_[i] = unit.actuator.side[i].polarity;
  }

  [[nodiscard]] Row of_state(Index i) const { return Row::Unit(n_ + y_ + r_, i); }
  [[nodiscard]] Row of_plant(Index i) const { return Row::Unit(n_ + y_ + r_, n_ + i); }
  [[nodiscard]] Row of_input(Index i) const { return Row::Unit(n_ + y_ + r_, n_ + y_ + i); }

  /// ω̂ of the angle at y_i, whose speed is at y_{i+1}.
  Row speed(Index i, const std::string& whose) {
    const Index s = take(whose + " speed as estimated", "rad/s");
    if (!sampled_) {
      next_.row(s) = (of_plant(i + 1) - of_state(s)) / (servo_.speed_filter_s + 0.5 * control::kTick_s);
      return of_state(s);
    }
    const Index last = take(whose + " angle at the last tick", "rad");
    const double share = control::kTick_s / (control::kTick_s + servo_.speed_filter_s);
    Row estimate = (1 - share) * of_state(s) + share / control::kTick_s * (of_plant(i) - of_state(last));
    next_.row(s) = estimate;
    next_.row(last) = of_plant(i);
    return estimate;
  }

  /// ξ; of a gain of 0 there is none.
  Row integral(double gain, const Row& error, const std::string& whose) {
    if (gain == 0) return Row::Zero(n_ + y_ + r_);
    const Row rate = gain * error;
    const Index s = take(whose + " integral", "N·m");
    next_.row(s) = sampled_ ? Row(of_state(s) + control::kTick_s * rate) : rate;
    return of_state(s);
  }

  void drive(int motor, const Row& torque, const Row& speed) {
    const drive::MotorParams& m = plant_.motor[motor];
    volts_.row(motor) = sign_[motor] * (m.resistance_Ohm / m.torque_constant_Nm_per_A * torque + m.back_emf_Vs_per_rad * speed);
  }
  void pass(int motor) { volts_.row(motor) = sign_[motor] * of_input(motor); }

  [[nodiscard]] ServoLoop done(std::vector<Signal> inputs) const {
    return {next_.leftCols(n_),
            next_.middleCols(n_, y_),
            next_.rightCols(r_),
            volts_.leftCols(n_),
            volts_.middleCols(n_, y_),
            volts_.rightCols(r_),
            signals_,
            std::move(inputs)};
  }

 private:
  Index take(std::string name, const char* unit) {
    signals_.push_back({std::move(name), unit});
    return static_cast<Index>(signals_.size()) - 1;
  }

  const control::ServoParams& servo_;
  const Plant& plant_;
  bool sampled_;
  Index n_, y_, r_;
  std::array<double, 2> sign_{};
  MatrixXd next_, volts_;
  std::vector<Signal> signals_;
};

ServoLoop position_loop(const device::UnitConfig& unit, const Plant& plant, bool sampled) {
  const control::PositionServoParams& p = unit.servo->position;
  Writer w(unit, plant, sampled, plant.motors * ((sampled ? 2 : 1) + (p.integral_Nm_per_rad == 0 ? 0 : 1)), plant.motors);
  std::vector<Signal> inputs;
  for (int i = 0; i < plant.motors; ++i) {
    const Row speed = w.speed(plant.angle(i), motor_name(i));
    const Row error = p.gain_per_s * (w.of_input(i) - w.of_plant(plant.angle(i))) - speed;
    w.drive(i, p.speed_gain_Nms_per_rad * error + w.integral(p.integral_Nm_per_rad, error, motor_name(i)), speed);
    inputs.push_back({motor_signal(i, "reference"), "rad"});
  }
  return w.done(std::move(inputs));
}

ServoLoop torque_loop(const device::UnitConfig& unit, const Plant& plant, double preset, bool sampled) {
  const control::TorqueServoParams& p = unit.servo->torque;
  Writer w(unit, plant, sampled, 2 * (sampled ? 2 : 1) + (p.integral_per_s == 0 ? 0 : 1), 1);
  const Row motor_speed = w.speed(plant.angle(0), motor_name(0)), shaft_speed = w.speed(0, "shaft");
  const double stiffness = std::fmax(p.stiffness_Nm_per_rad + preset, 0.0);
  const Row wish = stiffness * (w.of_input(0) - w.of_plant(0)) - p.damping_Nms_per_rad * shaft_speed;
  const Row spring = -plant.curvature.qq * w.of_plant(0) - plant.curvature.qx[0] * w.of_plant(plant.angle(0));
  const Row error = wish - spring;
  const double h = elastic::shaft_per_pulley(*unit.actuator.transmission, 0);
  const Row integral = w.integral(h * p.integral_per_s, error, motor_name(0));
  w.drive(0, h * (wish + p.gain * error) + integral - p.motor_damping_Nms_per_rad * motor_speed, motor_speed);
  return w.done({{"equilibrium", "rad"}});
}

ServoLoop no_loop(const device::UnitConfig& unit, const Plant& plant) {
  Writer w(unit, plant, false, 0, plant.motors);
  std::vector<Signal> inputs;
  for (int i = 0; i < plant.motors; ++i) {
    w.pass(i);
    inputs.push_back({motor_signal(i, "voltage"), "V"});
  }
  return w.done(std::move(inputs));
}

}  // namespace

namespace {

ServoLoop loop_of(const device::UnitConfig& unit, const Plant& plant, double preset, Firmware firmware) {
  const bool sampled = firmware == Firmware::sampled;
  switch (unit.servo->kind) {
    case control::ServoKind::position_servo:
      return position_loop(unit, plant, sampled);
    case control::ServoKind::torque_servo:
      return torque_loop(unit, plant, preset, sampled);
    case control::ServoKind::motor_voltages:
      break;
  }
  return no_loop(unit, plant);
}

}  // namespace

ServoLoop servo_loop(const device::UnitConfig& unit, const Plant& plant, double preset, Firmware firmware) {
  ServoLoop out = loop_of(unit, plant, preset, firmware);
  if (unit.actuator.linear())
    for (auto* signals : {&out.states, &out.inputs}) slide(*signals);
  return out;
}

PlacedServo alone(ServoLoop loop, const Plant& plant) {
  PlacedServo out{std::move(loop), std::vector<Index>(static_cast<std::size_t>(plant.states())), 1, ""};
  std::iota(out.states.begin(), out.states.end(), Index{0});
  return out;
}

void close(System& m, const PlacedServo& servo) {
  const ServoLoop& l = servo.loop;
  const Index n = m.a.rows(), own = l.a.rows(), inputs = m.b.cols(), motors = l.f.rows();
  const MatrixXd volts = m.b.middleCols(servo.input, motors);
  MatrixXd a = MatrixXd::Zero(n + own, n + own), b = MatrixXd::Zero(n + own, inputs);
  a.topLeftCorner(n, n) = m.a;
  a.topRightCorner(n, own) = volts * l.c;
  a.bottomRightCorner(own, own) = l.a;
  b.topRows(n) = m.b;
  b.block(0, servo.input, n, motors) = volts * l.f;
  b.block(n, servo.input, own, motors) = l.e;
  for (std::size_t k = 0; k < servo.states.size(); ++k) {
    a.col(servo.states[k]).head(n) += volts * l.d.col(static_cast<Index>(k));
    a.col(servo.states[k]).tail(own) += l.b.col(static_cast<Index>(k));
  }
  m.a = std::move(a);
  m.b = std::move(b);
  for (const Signal& s : l.states) m.states.push_back({servo.owner + s.name, s.unit});
  for (std::size_t i = 0; i < l.inputs.size(); ++i)
    m.inputs[static_cast<std::size_t>(servo.input) + i] = {servo.owner + l.inputs[i].name, l.inputs[i].unit};
}

double servo_stiffness(const device::UnitConfig& unit, const Plant& plant, double preset) {
  System m;
  m.a = state_matrix(plant);
  m.b = input_matrix(plant);
  m.inputs.resize(static_cast<std::size_t>(m.b.cols()));
  close(m, alone(servo_loop(unit, plant, preset, Firmware::averaged), plant));
  const Eigen::FullPivLU<MatrixXd> lu(m.a);
  if (!lu.isInvertible()) return 0;
  return 1.0 / lu.solve(MatrixXd(-m.b.col(0)))(0, 0);
}

}  // namespace vsa::linear
