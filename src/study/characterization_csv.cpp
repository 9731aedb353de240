// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>

#include "vsa/study/characterization.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

using experiment::BenchRun;
using experiment::BenchSample;

struct Column {
  std::string name;
  double (*value)(const BenchSample&);
};

std::vector<Column> columns_of(const BenchRun& run) {
  std::vector<Column> out{
      {"time_s", [](const BenchSample& s) { return s.time_s; }},
      {"load_torque_Nm", [](const BenchSample& s) { return s.measured_load_Nm; }},
      {"deflection_rad", [](const BenchSample& s) { return s.measured_deflection_rad; }},
      {"measured_shaft_rad", [](const BenchSample& s) { return s.measured_shaft_rad; }},
      {"equilibrium_command_rad", [](const BenchSample& s) { return s.equilibrium_command_rad; }},
      {"equilibrium_rad", [](const BenchSample& s) { return s.equilibrium_rad; }},
  };
  if (!run.preset_unit.empty()) {
    out.push_back({"preset_command_" + run.preset_unit, [](const BenchSample& s) { return s.preset_command; }});
    out.push_back({"preset_" + run.preset_unit, [](const BenchSample& s) { return s.preset; }});
  }
  out.push_back({"shaft_rad", [](const BenchSample& s) { return s.shaft_rad; }});
  out.push_back({"shaft_speed_rad_per_s", [](const BenchSample& s) { return s.shaft_speed_rad_per_s; }});
  out.push_back({"torque_Nm", [](const BenchSample& s) { return s.torque_Nm; }});
  out.push_back({"stiffness_Nm_per_rad", [](const BenchSample& s) { return s.stiffness_Nm_per_rad; }});
  out.push_back({"motor_1_rad", [](const BenchSample& s) { return s.motor_rad[0]; }});
  if (run.motors > 1) out.push_back({"motor_2_rad", [](const BenchSample& s) { return s.motor_rad[1]; }});
  out.push_back({"current_1_A", [](const BenchSample& s) { return s.current_A[0]; }});
  if (run.motors > 1) out.push_back({"current_2_A", [](const BenchSample& s) { return s.current_A[1]; }});
  return out;
}

std::string preset_part(const Characterization& c, double preset) {
  return c.preset_unit().empty() ? "" : fmt::format("_preset_{:.4f}{}", preset, c.preset_unit());
}

}  // namespace

std::string csv_text(const BenchRun& run, bool linear) {
  std::vector<Column> columns = columns_of(run);
  for (Column& c : columns)
    if (linear && c.name.rfind("motor_", 0) != 0 && c.name.rfind("preset", 0) != 0) c.name = sliding(c.name);
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  for (std::size_t i = 0; i < columns.size(); ++i) fmt::format_to(to, "{}{}", i == 0 ? "" : ",", columns[i].name);
  fmt::format_to(to, "\n");
  for (const BenchSample& s : run.samples) {
    for (std::size_t i = 0; i < columns.size(); ++i) fmt::format_to(to, "{}{:.10g}", i == 0 ? "" : ",", columns[i].value(s));
    fmt::format_to(to, "\n");
  }
  return fmt::to_string(out);
}

std::string csv_name(const Characterization& c, const StiffnessResult& r) {
  return "stiffness" + preset_part(c, r.options.preset) + ".csv";
}

std::string csv_name(const Characterization& c, const SpeedResult& r) {
  return "speed" + preset_part(c, r.options.preset) + ".csv";
}

std::string csv_name(const PresetStepResult& r) { return r.options.loaded ? "preset_step_loaded.csv" : "preset_step_unloaded.csv"; }

}  // namespace vsa::study
