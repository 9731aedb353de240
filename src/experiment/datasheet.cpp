// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/datasheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vsa/not_a_number.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

constexpr int kEnergyPoints = 61;
constexpr int kBoundaryPoints = 81;
constexpr int kCurvePoints = 101;

OneWay one_way(const Workspace& workspace, double preset, int direction) {
  OneWay w;
  w.peak = workspace.reach(preset, 0, Task::move, direction);
  w.holding = workspace.reach(preset, 0, Task::hold, direction);
  w.unpowered = workspace.reach(preset, 0, Task::unpowered, direction);
  w.no_load_speed_rad_per_s = workspace.no_load_speed(preset, direction);
  w.half_load_Nm = w.peak.torque_Nm / 2;
  const double against_Nm = -direction * w.half_load_Nm;  // the load that such a torque carries
  w.stiffness_at_half_Nm_per_rad = workspace.stiffness_under(preset, against_Nm);
  w.held_at_half = workspace.holding(preset, against_Nm);
  w.boundary = workspace.boundary(preset, kBoundaryPoints, direction);
  w.power = best_power(w.boundary);
  return w;
}

PresetColumn column(const Workspace& workspace, double preset) {
  PresetColumn c;
  static_cast<OneWay&>(c) = one_way(workspace, preset, 1);
  c.back = one_way(workspace, preset, -1);
  c.preset = preset;
  c.stiffness_at_rest_Nm_per_rad = workspace.stiffness_at_rest(preset);
  c.energy_at_rest_J = workspace.energy_at_rest(preset);
  c.held_at_rest = workspace.holding(preset);
  c.curve = workspace.law_curve(preset, kCurvePoints);
  return c;
}

LoopErrors loop_errors(const device::UnitConfig& unit, std::size_t motor, const MotorLine& line) {
  if (unit.servo) return {kNaN, kNaN};                                     // it integrates, or has no position loop
  const double gain = std::abs(unit.memory.position.p) / 65536.0 / 100.0;  // of full output per raw tick
  LoopErrors e;
  e.full_rad = gain > 0 ? radians(Raw{1}) / gain : std::numeric_limits<double>::quiet_NaN();
  // The voltage grows with the output, so bisection finds where it is enough.
  const double share = line.stall_Nm > 0 ? line.friction_Nm / line.stall_Nm : 2.0;
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (standing_voltage(unit, motor, mid, line.full_duty) > share * line.voltage_V ? high : low) = mid;
  }
  e.moves_rad = share < 1 ? high * e.full_rad : std::numeric_limits<double>::quiet_NaN();
  return e;
}

}  // namespace

const OneWay& PresetColumn::weaker() const noexcept {
  constexpr double kAlike = 1e-9;
  return back.peak.torque_Nm < (1 - kAlike) * peak.torque_Nm ? back : *this;
}

DataSheet data_sheet(const config::ActuatorType& type) {
  const Workspace workspace(type.unit);
  DataSheet sheet;
  sheet.type = type;
  sheet.line = workspace.lines();
  const std::size_t last = type.unit.actuator.sides() - 1;
  sheet.errors = {loop_errors(type.unit, 0, sheet.line[0]), loop_errors(type.unit, last, sheet.line[1])};
  sheet.attainable_preset = workspace.attainable_preset();
  sheet.stiffest_Nm_per_rad = workspace.stiffness_at_rest(sheet.attainable_preset);
  const bool one = sheet.attainable_preset == 0;
  for (const double share : kPresetShares) {
    if (share == 0 || !one) sheet.columns.push_back(column(workspace, share * sheet.attainable_preset));
  }
  for (int i = 0; i < (one ? 1 : kEnergyPoints); ++i) {
    const double p = sheet.attainable_preset * i / (kEnergyPoints - 1);
    for (const double e :
         {workspace.reach(p, 0).energy_J, workspace.reach(p, 0, Task::move, -1).energy_J, workspace.energy_at_rest(p)}) {
      sheet.most_energy_J = std::fmax(sheet.most_energy_J, e);
    }
  }
  return sheet;
}

}  // namespace vsa::experiment
