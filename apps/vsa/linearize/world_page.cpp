// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "linearize/page.hpp"
#include "linearize/tables.hpp"

namespace vsa::app {
namespace {

using report::Curve;
using report::Table;

template <class Value>
std::vector<Curve> of_joints(const study::WorldLinearization& l, Value value) {
  std::vector<Curve> out;
  const auto& joints = l.world.model.bodies.joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    out.push_back(report::curve(joints[j].name, {}, {}, Curve::Style::line, static_cast<int>(j)));
    for (const linear::RobotResponse& r : l.responses) {
      out.back().x.push_back(r.frequency_Hz);
      out.back().y.push_back(value(r.driving_point[static_cast<Eigen::Index>(j)]));
    }
  }
  return out;
}

std::vector<report::Block> charts(const study::WorldLinearization& l) {
  const auto size = [](std::complex<double> z) { return std::abs(z); };
  return {
      bode("Impedance", "|Z| [N·m·s/rad]", true, of_joints(l, size),
           "What a torque at one joint feels there, over its speed; the other joints yield."),
      bode("Phase of the impedance", "arg Z [°]", false, of_joints(l, degrees), "−90°: a spring; 0°: a damper; 90°: an inertia.")};
}

Table joint_table(const study::WorldLinearization& l) {
  Table out{"Joints",
            {"joint", "angle [rad]", "weight asks for [N·m]", "given from outside [N·m]", "inertia [kg·m²]",
             "stiffness, pulleys held [N·m/rad]", "stiffness at rest [N·m/rad]", "gravity's part [N·m/rad]"},
            {},
            ""};
  const linear::RobotModel& m = l.world.model;
  for (std::size_t j = 0; j < m.bodies.joints.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    // Differences of the engine's numbers: what is below is theirs.
    const auto small = [](double v) { return digits(std::abs(v) < 1e-9 ? 0.0 : v); };
    out.rows.push_back({m.bodies.joints[j].name, small(m.bodies.joints[j].angle), small(l.world.gravity_torque[j]),
                        small(l.world.outside_torque[j]), digits(m.bodies.mass(k, k)), small(m.held_stiffness(k, k)),
                        small(m.static_stiffness(k, k)), small(m.bodies.gravity_stiffness(k, k))});
  }
  out.caption =
      "With the other joints held. A prismatic joint has m, N, kg and N/m. At rest the motors yield as the firmware lets them; "
      "frozen "
      "and without dry friction they hold nothing.";
  return out;
}

}  // namespace

report::Report linearization_report(const study::WorldLinearization& l, const std::string& command) {
  report::Report out;
  out.title = l.name + ", linearised";
  out.subtitle = fmt::format("Firmware {}, dry friction {}", study::word(l.firmware), study::word(l.friction));
  const linear::RobotModel& m = l.world.model;
  report::Section point{"Point and poles", {}};
  for (const std::string& notice : m.notices) point.blocks.emplace_back(report::Text{notice});
  point.blocks.emplace_back(joint_table(l));
  point.blocks.emplace_back(pole_table(l.poles, m.period_s, l.moves));
  out.sections = {std::move(point), {"Frequency response", charts(l)}, {"Matrices", matrix_tables(m)}};
  out.footer = command + " · vsa " VSA_VERSION;
  return out;
}

std::string linearization_text(const study::WorldLinearization& l) {
  return fmt::format("{}, firmware {}, dry friction {}\n", l.name, study::word(l.firmware), study::word(l.friction)) +
         table_lines(joint_table(l)) + table_lines(pole_table(l.poles, l.world.model.period_s, l.moves)) + '\n';
}

}  // namespace vsa::app
