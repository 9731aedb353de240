// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/linear/robot.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "linear/loops.hpp"
#include "linear/servo_loop.hpp"

namespace vsa::linear {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A unit's plant on an inertia of 1, whose row of accelerations so is one of torques.
struct Mounted {
  const MountedUnit* of = nullptr;
  Plant plant;
  Loops loops;
  Index joint = 0, first_state = 0, first_input = 0, first_output = 0;  ///< its motors', voltages, torque

  [[nodiscard]] Index motor_states() const { return plant.states() - 2; }
};

Mounted mounted(const MountedUnit& u, Firmware firmware, DryFriction friction, std::vector<std::string>& notices) {
  Mounted out;
  out.of = &u;
  out.joint = static_cast<Index>(u.joint);
  OperatingPoint point = u.point;
  point.inertia_kgm2 = 1;
  point.damping_Nms_per_rad = 0;
  out.plant = find_plant(u.unit, point, friction);
  std::vector<std::string> own = out.plant.notices;
  if (firmware != Firmware::frozen) out.loops = find_loops(u.unit, out.plant, own);
  for (const std::string& n : own) notices.push_back(u.name + ": " + n);
  return out;
}

void check_parts(const Bodies& b, const std::vector<MountedUnit>& units, Firmware firmware, Problems& problems) {
  const auto n = static_cast<Index>(b.joints.size());
  const auto square = [&](const char* key, const MatrixXd& m) {
    if (m.rows() != n || m.cols() != n || !m.allFinite())
      problems.add({"", key, std::to_string(m.rows()) + " × " + std::to_string(m.cols()), "isn't a matrix of the joints",
                    "finite numbers, " + std::to_string(n) + " × " + std::to_string(n)});
  };
  square("mass", b.mass);
  square("gravity_stiffness", b.gravity_stiffness);
  if (problems.empty() && (n == 0 || MatrixXd(b.mass).llt().info() != Eigen::Success))
    problems.add({"", "mass", "", "isn't positive definite", "the mass matrix of joints that all move something"});
  if (firmware == Firmware::sampled && units.empty())
    problems.add({"", "units", "none", "no program gives a period to sample with", "a unit at least, or another firmware"});
  std::vector<bool> taken(b.joints.size());
  for (const MountedUnit& u : units) {
    if (u.joint >= b.joints.size() || taken[u.joint]) {
      problems.add({"", u.name, std::to_string(u.joint), "isn't a joint without a unit", "one unit a joint"});
    } else {
      taken[u.joint] = true;
    }
  }
}

std::vector<Mounted> mount(const std::vector<MountedUnit>& units, Firmware firmware, DryFriction friction, RobotModel& m) {
  std::vector<Mounted> out;
  Problems problems;
  for (const MountedUnit& u : units) {
    try {
      out.push_back(mounted(u, firmware, friction, m.notices));
    } catch (const InputError& error) {
      for (Problem p : error.problems()) {
        p.key = u.name + ": " + p.key;
        problems.add(std::move(p));
      }
    }
  }
  problems.throw_if_any();
  const auto joints = static_cast<Index>(m.bodies.joints.size());
  Index state = 2 * joints, input = joints, output = 2 * joints;
  for (Mounted& u : out) {
    u.first_state = state;
    u.first_input = input;
    u.first_output = output;
    state += u.motor_states();
    input += u.plant.motors;
    output += 1 + u.plant.motors;
    for (MotorLoop& l : u.loops.motors) {
      l.angle += u.first_state - 2;
      l.input += u.first_input - 1;
    }
  }
  m.a = MatrixXd::Zero(state, state);
  m.b = MatrixXd::Zero(state, input);
  m.c = MatrixXd::Zero(output, state);
  return out;
}

/// Torques in the rows of the speeds; divide_by_mass() makes accelerations of them.
void put_joints(RobotModel& m) {
  const Bodies& b = m.bodies;
  for (Index j = 0; j < m.torques; ++j) {
    const BodyJoint& joint = b.joints[static_cast<std::size_t>(j)];
    m.a(2 * j, 2 * j + 1) = 1;
    for (Index k = 0; k < m.torques; ++k) m.a(2 * j + 1, 2 * k) -= b.gravity_stiffness(j, k);
    m.a(2 * j + 1, 2 * j) -= joint.stiffness;
    m.a(2 * j + 1, 2 * j + 1) -= joint.damping;
    m.b(2 * j + 1, j) = 1;
    m.c(2 * j, 2 * j) = m.c(2 * j + 1, 2 * j + 1) = 1;
    m.states.push_back({joint.name + " angle", joint.prismatic ? "m" : "rad"});
    m.states.push_back({joint.name + " speed", joint.prismatic ? "m/s" : "rad/s"});
    m.inputs.push_back({joint.name + " load torque", joint.prismatic ? "N" : "N·m"});
  }
  m.outputs = m.states;
}

void put_unit(RobotModel& m, const Mounted& u) {
  const Index j = 2 * u.joint, n = u.motor_states();
  const MatrixXd a = state_matrix(u.plant), b = input_matrix(u.plant), c = output_matrix(u.plant, 2 + n);
  m.a.block(j + 1, j, 1, 2) += a.block(1, 0, 1, 2);
  m.a.block(j + 1, u.first_state, 1, n) = a.block(1, 2, 1, n);
  m.a.block(u.first_state, j, n, 2) = a.block(2, 0, n, 2);
  m.a.block(u.first_state, u.first_state, n, n) = a.block(2, 2, n, n);
  m.b.block(u.first_state, u.first_input, n, u.plant.motors) = b.block(2, 1, n, u.plant.motors);
  const Index outputs = 1 + u.plant.motors;
  m.c.block(u.first_output, j, outputs, 2) = c.block(2, 0, outputs, 2);
  m.c.block(u.first_output, u.first_state, outputs, n) = c.block(2, 2, outputs, n);
  const std::string unit = u.of->name + ' ';
  const bool slides = u.of->unit.actuator.linear();
  m.outputs.push_back({unit + (slides ? "spring force" : "spring torque"), slides ? "N" : "N·m"});
  for (int i = 0; i < u.plant.motors; ++i) {
    const bool frozen = u.loops.motors.empty();
    m.states.push_back({unit + motor_signal(i, "angle"), "rad"});
    m.states.push_back({unit + motor_signal(i, "speed"), "rad/s"});
    if (u.plant.slopes[i].lag_s) m.states.push_back({unit + motor_signal(i, "current"), "A"});
    m.inputs.push_back({unit + motor_signal(i, frozen ? "voltage" : "reference"), frozen ? "V" : "rad"});
    m.outputs.push_back({unit + motor_signal(i, "angle"), "rad"});
  }
}

void divide_by_mass(RobotModel& m) {
  const Eigen::LLT<MatrixXd> mass(m.bodies.mass);
  const auto rows = Eigen::seqN(Index{1}, m.torques, Index{2});
  const MatrixXd torques_a = m.a(rows, Eigen::all), torques_b = m.b(rows, Eigen::all);
  const MatrixXd a = mass.solve(torques_a), b = mass.solve(torques_b);  // solved into a view of rows, Eigen 3.4.0 never ends
  m.a(rows, Eigen::all) = a;
  m.b(rows, Eigen::all) = b;
}

/// All units' loops as one.
Loops together(const std::vector<Mounted>& units, Firmware firmware) {
  Loops out;
  for (const Mounted& u : units) {
    if (out.period_s == 0) out.period_s = u.loops.period_s;
    if (firmware == Firmware::sampled && u.loops.period_s != out.period_s)
      throw InputError({"", u.of->name, std::to_string(std::lround(u.loops.period_s * 1e6)) + " µs",
                        "its loop has another period than that of " + units.front().of->name,
                        "units with the same period, or the firmware averaged"});
    out.motors.insert(out.motors.end(), u.loops.motors.begin(), u.loops.motors.end());
  }
  return out;
}

/// Each unit's own period: a damper is D times it.
void average_all(RobotModel& m, const std::vector<Mounted>& units) {
  for (const Mounted& u : units) average(m, u.loops);
  m.firmware = Firmware::averaged;
}

/// The servos' loops, behind the others.
void close_servos(RobotModel& m, const std::vector<Mounted>& units, Firmware firmware) {
  for (const Mounted& u : units) {
    if (!u.of->unit.servo) continue;
    PlacedServo servo{servo_loop(u.of->unit, u.plant, u.of->point.preset, firmware),
                      {2 * u.joint, 2 * u.joint + 1},
                      u.first_input,
                      u.of->name + ' '};
    for (Index k = 0; k < u.motor_states(); ++k) servo.states.push_back(u.first_state + k);
    close(m, servo);
  }
}

void tell_stiffness(RobotModel& m, const std::vector<Mounted>& units, Firmware firmware) {
  m.held_stiffness = m.bodies.gravity_stiffness;
  for (Index j = 0; j < m.torques; ++j) m.held_stiffness(j, j) += m.bodies.joints[static_cast<std::size_t>(j)].stiffness;
  m.static_stiffness = m.held_stiffness;
  for (const Mounted& u : units) {
    const bool servo = u.of->unit.servo && firmware != Firmware::frozen;
    const double yielding = servo ? servo_stiffness(u.of->unit, u.plant, u.of->point.preset) : static_stiffness(u.plant, u.loops);
    m.units.push_back({u.of->name, u.of->joint, u.plant.motors, u.plant.rest, held_stiffness(u.plant), yielding});
    m.held_stiffness(u.joint, u.joint) += m.units.back().held_stiffness_Nm_per_rad;
    m.static_stiffness(u.joint, u.joint) += m.units.back().static_stiffness_Nm_per_rad;
  }
}

}  // namespace

RobotModel linearize(const Bodies& bodies, const std::vector<MountedUnit>& units, Firmware firmware, DryFriction friction) {
  Problems problems;
  check_parts(bodies, units, firmware, problems);
  problems.throw_if_any();
  RobotModel m;
  m.bodies = bodies;
  m.torques = static_cast<Index>(bodies.joints.size());
  const std::vector<Mounted> mounted = mount(units, firmware, friction, m);
  put_joints(m);
  for (const Mounted& u : mounted) put_unit(m, u);
  divide_by_mass(m);
  if (firmware == Firmware::averaged) average_all(m, mounted);
  if (firmware == Firmware::sampled) sample(m, together(mounted, firmware));
  if (firmware != Firmware::frozen) close_servos(m, mounted, firmware);
  const Index states = m.a.rows(), known = m.c.cols();
  m.c.conservativeResize(Eigen::NoChange, states);
  m.c.rightCols(states - known).setZero();
  m.d = MatrixXd::Zero(m.c.rows(), m.b.cols());
  tell_stiffness(m, mounted, firmware);
  if (firmware == Firmware::averaged) tell_of_averaging(m, m.notices);
  return m;
}

RobotResponse response(const RobotModel& m, double frequency_Hz) {
  const Eigen::MatrixXcd x = answers(m, frequency_Hz);
  RobotResponse out;
  out.frequency_Hz = frequency_Hz;
  out.compliance = x(Eigen::seqN(Index{0}, m.torques, Index{2}), Eigen::all);
  const Eigen::MatrixXcd mobility = x(Eigen::seqN(Index{1}, m.torques, Index{2}), Eigen::all);
  out.impedance = mobility.inverse();
  out.driving_point = mobility.diagonal().cwiseInverse();
  return out;
}

}  // namespace vsa::linear
