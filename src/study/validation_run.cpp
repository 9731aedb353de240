// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "study/series.hpp"
#include "vsa/study/validation.hpp"

namespace vsa::study {
namespace {

namespace fs = std::filesystem;
using experiment::BenchSample;
using experiment::StepMeasures;
using experiment::TimeSeries;

constexpr double kMaxTorque_Nm = 1.4;

TimeSeries ours(const experiment::BenchRun& run, double BenchSample::*field, double span_s) {
  TimeSeries all;
  for (const BenchSample& s : run.samples) {
    all.time_s.push_back(s.time_s);
    all.value.push_back(s.*field);
  }
  return cut(all, 0, span_s);
}

SpeedCheck check_speed(const SpeedResult& r, int percent, const ValidationPlan& plan) {
  SpeedCheck out;
  out.preset = r.options.preset;
  out.percent = percent;
  out.shaft = r.mean.shaft;
  out.pulleys = r.mean.pulleys;
  const TimeSeries all =
      experiment::read_series(plan.plugin_2015 / fmt::format("step_preset_{:03d}pct.csv", percent), "shaft_angle_rad");
  out.theirs = cut(all, plan.step_command_s, all.time_s.back());
  out.shaft_2015 = experiment::step_measures(out.theirs.time_s, out.theirs.value, 0, r.options.step_rad);
  out.ours = ours(r.run, &BenchSample::shaft_rad, out.theirs.time_s.back());
  return out;
}

PresetStepCheck check_preset_step(const PresetStepResult& r, const fs::path& plugin) {
  PresetStepCheck out;
  out.loaded = r.options.loaded;
  out.up = r.up;
  out.down = r.down;
  const std::string stem = r.options.loaded ? "preset_step_loaded" : "preset_step_no_load";
  const TimeSeries reference = experiment::read_series(plugin / (stem + "_reference.csv"), "preset_rad");
  const TimeSeries all = experiment::read_series(plugin / (stem + ".csv"), "preset_rad");
  const double up_s = edge_s(reference, 0), down_s = edge_s(reference, 1);
  const TimeSeries up = cut(all, up_s, down_s - up_s), down = cut(all, down_s, all.time_s.back());
  out.up_2015 = experiment::step_measures(up.time_s, up.value, 0, r.options.preset);
  out.down_2015 = experiment::step_measures(down.time_s, down.value, out.up_2015.final_value, 0);
  out.theirs = cut(all, up_s, all.time_s.back());
  out.ours = ours(r.run, &BenchSample::preset, out.theirs.time_s.back());
  return out;
}

std::optional<experiment::Published> published_of(const std::vector<experiment::Published>& all, double preset) {
  constexpr double kSame = 5e-5;  // presets are named by four decimals
  for (const experiment::Published& p : all) {
    if (std::abs(p.preset - preset) < kSame) return p;
  }
  return std::nullopt;
}

/// Both within the torques that are judged.
experiment::Branches within(const experiment::Branches& b) {
  experiment::Branches out;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) {
    if (std::abs(b.torque_Nm[i]) > kMaxTorque_Nm + 1e-9) continue;
    out.torque_Nm.push_back(b.torque_Nm[i]);
    out.rising_rad.push_back(b.rising_rad[i]);
    out.falling_rad.push_back(b.falling_rad[i]);
    out.sd_rising_rad.push_back(b.sd_rising_rad[i]);
    out.sd_falling_rad.push_back(b.sd_falling_rad[i]);
  }
  return out;
}

void compare_stiffness(Validation& v, const Characterization& done, const std::vector<Recording>& recordings,
                       const std::vector<experiment::Published>& published) {
  for (std::size_t i = 0; i < done.stiffness.size(); ++i) {
    const StiffnessResult& r = done.stiffness[i];
    const Recording& recording = recordings[i % recordings.size()];
    const experiment::Branches data = within(recording.data);
    const experiment::Difference rms = experiment::difference(r.branches, data);
    const auto [our_loop, data_loop] = experiment::loops(r.branches, data);
    v.periods.push_back({recording.preset, r.options.period_s, rms, our_loop});
    if (i >= recordings.size()) continue;
    RecordingCheck& check = v.recordings.emplace_back();
    check.file = recording.file;
    check.origin = recording.origin;
    check.preset = recording.preset;
    check.kind = experiment::kind_of(v.evidence, config::experiment_name("stiffness", recording.preset));
    check.data = data;
    check.ours = r.branches;
    check.data_loop = data_loop;
    check.our_loop = our_loop;
    check.rms = rms;
    check.torque = experiment::torque_difference(r.branches, data);
    check.published = published_of(published, recording.preset);
  }
}

void put(std::map<std::string, double>& out, const std::string& stem, const StepMeasures& m, const std::string& unit) {
  out[stem + "rise_s"] = m.rise_s;
  out[stem + "mean_" + unit + "_per_s"] = m.mean_speed;
  out[stem + "overshoot_pct"] = m.overshoot_pct;
  out[stem + "ringing_Hz"] = m.ringing_Hz;
  out[stem + "steady_error_" + unit] = m.steady_error;
}

}  // namespace

std::map<std::string, double> quantities(const Validation& v) {
  std::map<std::string, double> out;
  for (const RecordingCheck& r : v.recordings) {
    const std::string stem = config::experiment_name("stiffness", r.preset) + '.';
    out[stem + "rms_Nm"] = r.torque.both_Nm;
    out[stem + "rms_rising_Nm"] = r.torque.rising_Nm;
    out[stem + "rms_falling_Nm"] = r.torque.falling_Nm;
    out[stem + "rms_rad"] = r.rms.both_rad;
    out[stem + "rms_rising_rad"] = r.rms.rising_rad;
    out[stem + "rms_falling_rad"] = r.rms.falling_rad;
    out[stem + "loop_area_Nm_rad"] = r.our_loop.area_Nm_rad;
    out[stem + "loop_area_ratio"] = r.our_loop.area_Nm_rad / r.data_loop.area_Nm_rad;
    out[stem + "mean_width_rad"] = r.our_loop.mean_width_rad;
    out[stem + "mean_width_ratio"] = r.our_loop.mean_width_rad / r.data_loop.mean_width_rad;
  }
  for (const SpeedCheck& s : v.speeds) {
    const std::string stem = config::experiment_name("speed", s.preset) + '.';
    put(out, stem, s.shaft, "rad");
    out[stem + "mean_pulley_rad_per_s"] = s.pulleys.mean_speed;
  }
  for (const PresetStepCheck& p : v.preset_steps) {
    const std::string stem = p.loaded ? "preset_step.loaded." : "preset_step.no_load.";
    put(out, stem + "up.", p.up, "rad");
    put(out, stem + "down.", p.down, "rad");
    out[stem + "attained_rad"] = p.up.final_value;
    out[stem + "resting_rad"] = p.down.final_value;
  }
  return out;
}

std::string recording_kind(const Validation& v, const RecordingCheck& r) {
  return v.evidence ? experiment::kind_text(r.kind) : "not stated";
}

std::optional<Validation> run(ValidationPlan plan, const OnProgress& on_progress, unsigned threads) {
  const auto begun = std::chrono::steady_clock::now();
  const auto done = run(std::move(plan.runs), on_progress, threads);
  if (!done) return std::nullopt;
  Validation v;
  v.actuator = done->actuator;
  v.overrides = done->specimen.overrides;
  if (v.overrides.empty()) v.evidence = v.actuator.evidence;
  v.left_out = std::move(plan.left_out);
  compare_stiffness(v, *done, plan.recordings, plan.bounds.published);
  const auto predicted = [](const RecordingCheck& r) { return r.kind == experiment::Kind::predicted; };
  std::stable_partition(v.recordings.begin(), v.recordings.end(), predicted);
  for (std::size_t i = 0; i < done->speed.size(); ++i) v.speeds.push_back(check_speed(done->speed[i], kPercents[i], plan));
  for (const PresetStepResult& r : done->preset_step) v.preset_steps.push_back(check_preset_step(r, plan.plugin_2015));
  v.verdicts = experiment::judge(plan.bounds.bounds, quantities(v), v.evidence);
  v.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return v;
}

}  // namespace vsa::study
