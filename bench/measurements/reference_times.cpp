// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// When each of 12 units on one bus has the references of one command, against the wire model
// (docs/explanation/6-bus-and-device.md). One curve a time of the command within the master's cycle; the robot is stepped by a
// byte's time.
//
//   reference_times PAGE.html
#include <fmt/format.h>

#include <iostream>
#include <vector>

#include "vsa/bus/master.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/report/report.hpp"

namespace {

constexpr std::size_t kUnits = 12;
constexpr std::int64_t kByteNs = 5'000;  // ten bits at 2 Mbaud

vsa::host::RobotConfig chain() {
  vsa::host::RobotConfig config;
  config.buses.push_back({"spine", 2e6, std::nullopt});
  const auto unit = vsa::config::TypeLibrary().load("qbmove_maker_pro_6_1").unit;
  for (std::size_t i = 0; i < kUnits; ++i) {
    vsa::host::ActuatorConfig a;
    a.name = a.joint = fmt::format("unit_{}", i + 1);
    a.unit = unit;
    a.id = static_cast<int>(i) + 1;
    config.actuators.push_back(a);
  }
  return config;
}

/// Nanoseconds from a command at `command_ns` to each unit's new references, with shafts held.
std::vector<std::int64_t> measure(std::int64_t command_ns) {
  vsa::host::Robot robot(chain());
  const std::vector<vsa::host::JointIn> in(kUnits, {0, 0, 0});
  std::vector<double> out(kUnits);
  std::int64_t t_ns = 0;
  const auto step = [&] {
    robot.advance(t_ns, kByteNs, in, out);
    t_ns += kByteNs;
  };
  while (t_ns < command_ns) step();
  std::vector<std::array<vsa::Ticks, 2>> before(kUnits);
  for (std::size_t i = 0; i < kUnits; ++i) {
    before[i] = robot.received_inputs(i);
    robot.command(i, 0.3, std::nullopt);
  }
  std::vector<std::int64_t> arrived(kUnits, 0);
  for (std::size_t missing = kUnits; missing > 0;) {
    step();
    for (std::size_t i = 0; i < kUnits; ++i) {
      if (arrived[i] != 0 || robot.received_inputs(i) == before[i]) continue;
      arrived[i] = t_ns - command_ns;
      --missing;
    }
  }
  return arrived;
}

/// The same by the wire model: the first of unit k's frames that sets out after the command.
std::int64_t modelled(const vsa::bus::Schedule& schedule, std::int64_t command_ns, int k) {
  const std::int64_t frame_ns = schedule.inputs_at_ns(0, 0);
  std::int64_t cycle_ns = command_ns / schedule.cycle_ns * schedule.cycle_ns;
  if (schedule.inputs_at_ns(cycle_ns, k) - frame_ns < command_ns) cycle_ns += schedule.cycle_ns;
  return schedule.inputs_at_ns(cycle_ns, k) - command_ns;
}

int run(const std::string& file) {
  const vsa::bus::Schedule schedule = vsa::bus::make_schedule(kUnits, 2e6, std::nullopt);
  vsa::report::Chart chart{"From a command to each unit's new reference",
                           "unit on the bus",
                           "time [ms]",
                           {},
                           "Markers: the simulated bus, stepped by 5 µs. Lines: the wire model."};
  std::int64_t worst_ns = 0;
  int color = 0;
  for (const std::int64_t offset_ns : {500'000, 1'000'000, 6'000'000, 11'000'000}) {
    const std::int64_t command_ns = 2 * schedule.cycle_ns + offset_ns;
    const auto arrived = measure(command_ns);
    const auto group = fmt::format("command {} ms after the cycle's begin", static_cast<double>(offset_ns) * 1e-6);
    vsa::report::Curve seen{group, {}, {}, {}, vsa::report::Curve::Style::markers, color, group};
    vsa::report::Curve model{group, {}, {}, {}, vsa::report::Curve::Style::line, color++, group};
    for (std::size_t i = 0; i < kUnits; ++i) {
      const std::int64_t expected_ns = modelled(schedule, command_ns, static_cast<int>(i));
      worst_ns = std::max(worst_ns, std::abs(arrived[i] - expected_ns));
      for (auto* curve : {&seen, &model}) curve->x.push_back(static_cast<double>(i + 1));
      seen.y.push_back(static_cast<double>(arrived[i]) * 1e-6);
      model.y.push_back(static_cast<double>(expected_ns) * 1e-6);
    }
    chart.curves.push_back(seen);
    chart.curves.push_back(model);
  }
  const std::string worst =
      fmt::format("largest difference {:.1f} µs; a byte takes {} µs", static_cast<double>(worst_ns) * 1e-3, kByteNs / 1000);
  std::cout << worst << '\n';
  vsa::report::write_report({"Reference times on a bus of 12", worst, {{"", {chart}}}, "reference_times"}, file);
  return worst_ns <= kByteNs ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string page = argc == 2 ? argv[1] : "";
    if (page.empty() || page.front() == '-') {
      std::cerr << "usage: reference_times PAGE.html\n";
      return page == "--help" ? 0 : 2;
    }
    return run(page);
  } catch (const vsa::InputError& error) {
    std::cerr << "reference_times: " << error.what() << '\n';
    return 2;
  }
}
