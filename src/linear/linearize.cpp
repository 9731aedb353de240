// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One unit by itself on an inertia.
#include "linear/loops.hpp"
#include "linear/servo_loop.hpp"

namespace vsa::linear {
namespace {

void name_signals(Model& m, const Plant& plant, bool slides) {
  m.states = {{"shaft angle", "rad"}, {"shaft speed", "rad/s"}};
  m.inputs = {{"load torque", "N·m"}};
  m.outputs = {{"shaft angle", "rad"}, {"shaft speed", "rad/s"}, {"spring torque", "N·m"}};
  for (int i = 0; i < plant.motors; ++i) {
    m.states.push_back({motor_signal(i, "angle"), "rad"});
    m.states.push_back({motor_signal(i, "speed"), "rad/s"});
    if (plant.slopes[i].lag_s) m.states.push_back({motor_signal(i, "current"), "A"});
    m.inputs.push_back(m.firmware == Firmware::frozen ? Signal{motor_signal(i, "voltage"), "V"}
                                                      : Signal{motor_signal(i, "reference"), "rad"});
    m.outputs.push_back({motor_signal(i, "angle"), "rad"});
  }
  if (slides)
    for (auto* signals : {&m.states, &m.inputs, &m.outputs}) slide(*signals);
}

}  // namespace

Model linearize(const device::UnitConfig& unit, const OperatingPoint& point, Firmware firmware, DryFriction friction) {
  const Plant plant = find_plant(unit, point, friction);
  Model m;
  m.firmware = firmware;
  m.rest = plant.rest;
  m.notices = plant.notices;
  m.inertia_kgm2 = plant.inertia;
  m.damping_Nms_per_rad = plant.damping;
  m.a = state_matrix(plant);
  m.b = input_matrix(plant);
  name_signals(m, plant, unit.actuator.linear());
  Loops loops;
  if (firmware != Firmware::frozen) loops = find_loops(unit, plant, m.notices);
  if (firmware == Firmware::averaged) average(m, loops);
  if (firmware == Firmware::sampled) sample(m, loops);
  const bool servo = unit.servo && firmware != Firmware::frozen;
  if (servo) close(m, alone(servo_loop(unit, plant, point.preset, firmware), plant));
  m.c = output_matrix(plant, m.a.rows());
  m.d = Eigen::MatrixXd::Zero(m.c.rows(), m.b.cols());
  if (firmware == Firmware::averaged) tell_of_averaging(m, m.notices);
  m.held_stiffness_Nm_per_rad = held_stiffness(plant);
  m.static_stiffness_Nm_per_rad = servo ? servo_stiffness(unit, plant, point.preset) : static_stiffness(plant, loops);
  return m;
}

}  // namespace vsa::linear
