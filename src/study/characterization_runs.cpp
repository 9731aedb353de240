// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>

#include "study/linear_shaft.hpp"
#include "study/watched_runs.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::study {
namespace {

using experiment::BenchRun;
using experiment::BenchSample;
using experiment::StepMeasures;

constexpr double kWindow_Nm = 0.4;  // of the stiffness curve, on the bench as it ships

Range range_of(const BenchRun& run, double BenchSample::*field) {
  const auto less = [field](const BenchSample& a, const BenchSample& b) { return a.*field < b.*field; };
  const auto [low, high] = std::minmax_element(run.samples.begin(), run.samples.end(), less);
  return {(*low).*field, (*high).*field};
}

/// The step that is commanded at `command_s` and held for `hold_s`. `from`: where it starts; none: the sample at its command.
StepMeasures measure_step(const BenchRun& run, double BenchSample::*field, double command_s, double hold_s,
                          std::optional<double> from, double to) {
  std::vector<double> time_s, value;
  const double slack_s = 0.5 * run.step_s;
  for (const BenchSample& s : run.samples) {
    if (s.time_s < command_s - slack_s || s.time_s > command_s + hold_s + slack_s) continue;
    time_s.push_back(s.time_s);
    value.push_back(s.*field);
  }
  const double start = from.value_or(value.front());
  return experiment::step_measures(time_s, value, start, to);
}

double mean_finite(const std::vector<double>& values) {
  double sum = 0, count = 0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    sum += v;
    count += 1;
  }
  return count > 0 ? sum / count : kNaN;
}

/// A mean that keeps what some edges don't have (ringing, a damping ratio) to those that have it.
StepMeasures mean_of(const std::vector<Edge>& edges, StepMeasures Edge::*part) {
  const auto mean = [&](double StepMeasures::*field) {
    std::vector<double> values;
    values.reserve(edges.size());
    for (const Edge& e : edges) values.push_back(e.*part.*field);
    return mean_finite(values);
  };
  StepMeasures out;
  for (const auto field : {&StepMeasures::rise_s, &StepMeasures::mean_speed, &StepMeasures::peak_slope,
                           &StepMeasures::overshoot_pct, &StepMeasures::ringing_Hz, &StepMeasures::damping_ratio}) {
    out.*field = mean(field);
  }
  std::vector<double> error;
  for (const Edge& e : edges) error.push_back((e.*part).steady_error * (e.to_rad < e.from_rad ? -1 : 1));
  out.steady_error = mean_finite(error);
  out.final_value = out.rise_start_s = kNaN;  // of no meaning over ups and downs
  return out;
}

}  // namespace

StiffnessResult measure(const experiment::StiffnessOptions& options, BenchRun run, const std::string& preset_unit) {
  StiffnessResult out{options, std::move(run), {}, {}, {}, {}, {}, {}, {}};
  experiment::LoadRecording recording = experiment::as_recording(out.run, options.preset);
  recording.preset_unit = preset_unit;
  experiment::BranchOptions grid{.skip_cycles = 0};
  grid.grid_Nm *= options.load_share;
  grid.max_Nm *= options.load_share;
  out.branches = experiment::branches(recording, grid);
  out.loop = experiment::loop(out.branches);
  out.curve = experiment::stiffness_curve(out.branches, kWindow_Nm * options.load_share);
  out.shaft_rad = range_of(out.run, &BenchSample::measured_shaft_rad);
  out.load_Nm = range_of(out.run, &BenchSample::measured_load_Nm);
  out.deflection_rad = range_of(out.run, &BenchSample::measured_deflection_rad);
  out.preset = range_of(out.run, &BenchSample::preset);
  return out;
}

SpeedResult measure(const experiment::SpeedOptions& options, BenchRun run) {
  SpeedResult out{options, std::move(run), {}, {}};
  for (int k = 0; k < options.steps; ++k) {
    Edge e;
    e.command_s = k * options.hold_s;
    e.from_rad = k % 2 == 0 ? 0 : options.step_rad;
    e.to_rad = options.step_rad - e.from_rad;
    const auto before = [&](StepMeasures Edge::*part) {
      return out.edges.empty() ? std::nullopt : std::optional((out.edges.back().*part).final_value);
    };
    e.shaft = measure_step(out.run, &BenchSample::shaft_rad, e.command_s, options.hold_s, before(&Edge::shaft), e.to_rad);
    e.pulleys = measure_step(out.run, &BenchSample::equilibrium_rad, e.command_s, options.hold_s, before(&Edge::pulleys), e.to_rad);
    out.edges.push_back(e);
  }
  out.mean = {0, 0, options.step_rad, mean_of(out.edges, &Edge::shaft), mean_of(out.edges, &Edge::pulleys)};
  return out;
}

PresetStepResult measure(const experiment::PresetStepOptions& options, BenchRun run) {
  PresetStepResult out{options, std::move(run), {}, {}, {}};
  const double hold = options.hold_s;
  out.up = measure_step(out.run, &BenchSample::preset, 0, hold, std::nullopt, options.preset);
  out.down = measure_step(out.run, &BenchSample::preset, hold, hold, out.up.final_value, options.from);
  out.load_Nm = range_of(out.run, &BenchSample::measured_load_Nm);
  return out;
}

std::optional<Characterization> run(Characterization plan, const OnProgress& on_progress, unsigned threads) {
  experiment::Watch watch;
  std::vector<std::function<void()>> jobs;
  double total_s = 0;
  const auto add = [&](auto& results, auto job) {
    for (auto& r : results) {
      total_s += experiment::simulated_s(r.options);
      jobs.emplace_back([&r, job] { r = job(r.options); });
    }
  };
  // The longest first, so that the threads end together.
  add(plan.stiffness, [&](const experiment::StiffnessOptions& o) {
    return measure(o, experiment::run_stiffness(plan.specimen, o, &watch), plan.preset_unit());
  });
  add(plan.preset_step,
      [&](const experiment::PresetStepOptions& o) { return measure(o, experiment::run_preset_step(plan.specimen, o, &watch)); });
  add(plan.speed, [&](const experiment::SpeedOptions& o) { return measure(o, experiment::run_speed(plan.specimen, o, &watch)); });
  if (!run_watched(jobs, watch, total_s, on_progress, threads)) return std::nullopt;
  tell_of_output(plan);
  return plan;
}

}  // namespace vsa::study
