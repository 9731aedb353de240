// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "study/linear_shaft.hpp"

#include <fmt/format.h>

#include <initializer_list>

namespace vsa::study {
namespace {

using experiment::BenchSample;
using experiment::StepMeasures;

struct Scale {
  double length, force, stiffness;  // m/rad, N/(N·m), (N/m)/(N·m/rad)
};

template <class T>
void times(double factor, T& object, std::initializer_list<double T::*> fields) {
  for (const auto field : fields) object.*field *= factor;
}
void times(double factor, std::vector<double>& values) {
  for (double& v : values) v *= factor;
}
void times(double factor, Range& range) { times(factor, range, {&Range::least, &Range::most}); }

void tell(experiment::BenchRun& run, const Scale& s) {
  for (BenchSample& sample : run.samples) {
    times(s.length, sample,
          {&BenchSample::equilibrium_command_rad, &BenchSample::equilibrium_rad, &BenchSample::shaft_rad,
           &BenchSample::shaft_speed_rad_per_s, &BenchSample::measured_shaft_rad, &BenchSample::measured_deflection_rad});
    times(s.force, sample, {&BenchSample::torque_Nm, &BenchSample::mean_torque_Nm, &BenchSample::measured_load_Nm});
    times(s.stiffness, sample, {&BenchSample::stiffness_Nm_per_rad});
  }
  run.load_peak_Nm *= s.force;
  run.amplitude_rad *= s.length;
}

/// Their times and ratios stay.
void tell(StepMeasures& m, const Scale& s) {
  times(s.length, m,
        {&StepMeasures::mean_speed, &StepMeasures::peak_slope, &StepMeasures::steady_error, &StepMeasures::final_value});
}

void tell(Edge& e, const Scale& s) {
  times(s.length, e, {&Edge::from_rad, &Edge::to_rad});
  tell(e.shaft, s);
  tell(e.pulleys, s);
}

void tell(StiffnessResult& r, const Scale& s) {
  tell(r.run, s);
  if (r.options.amplitude_rad) *r.options.amplitude_rad *= s.length;
  experiment::Branches& b = r.branches;
  times(s.force, b.torque_Nm);
  for (auto* column : {&b.rising_rad, &b.falling_rad, &b.sd_rising_rad, &b.sd_falling_rad}) times(s.length, *column);
  using experiment::Loop;
  times(s.length, r.loop,
        {&Loop::mean_width_rad, &Loop::mean_abs_width_rad, &Loop::largest_width_rad, &Loop::smallest_width_rad,
         &Loop::peak_rising_rad, &Loop::peak_falling_rad});  // the area is an energy
  for (experiment::StiffnessPoint& p : r.curve) {
    p.deflection_rad *= s.length;
    p.torque_Nm *= s.force;
    p.stiffness_Nm_per_rad *= s.stiffness;
    p.standard_error_Nm_per_rad *= s.stiffness;
  }
  times(s.length, r.shaft_rad);
  times(s.length, r.deflection_rad);
  times(s.force, r.load_Nm);
}

}  // namespace

void mount(Characterization& plan) {
  if (!plan.actuator.unit.actuator.linear()) return;
  plan.specimen.overrides.push_back({"shaft.pinion_m", fmt::format("{}", kBenchPinion_m)});
  plan.actuator = plan.specimen.library.load(plan.specimen.type, plan.specimen.overrides);
  plan.load_scale = 1 / kBenchPinion_m;
}

void tell_of_output(Characterization& c) {
  if (!c.linear()) return;
  auto own = c.specimen.overrides;
  own.pop_back();  // mount()'s
  c.actuator = c.specimen.library.load(c.specimen.type, own);
  const Scale s{kBenchPinion_m, 1 / kBenchPinion_m, 1 / (kBenchPinion_m * kBenchPinion_m)};
  for (StiffnessResult& r : c.stiffness) tell(r, s);
  for (SpeedResult& r : c.speed) {
    tell(r.run, s);
    r.options.step_rad *= s.length;
    for (Edge& e : r.edges) tell(e, s);
    tell(r.mean, s);
  }
  for (PresetStepResult& r : c.preset_step) {
    tell(r.run, s);
    times(s.force, r.load_Nm);
  }
}

}  // namespace vsa::study
