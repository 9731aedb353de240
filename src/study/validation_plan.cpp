// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "study/recordings.hpp"
#include "study/series.hpp"
#include "vsa/errors.hpp"
#include "vsa/study/validation.hpp"

namespace vsa::study {
namespace {

namespace fs = std::filesystem;

constexpr double kPeriods_s[] = {38, 19, 76};  // the first is the one that is judged

fs::path data_directory() {
  const auto found = config::find_data("data");
  if (!found) throw InputError({"", "data", "", "the recordings are in no data directory", "set VSA_DATA_DIR"});
  return *found;
}

fs::path bounds_file(const ValidationOptions& o) {
  if (!o.bounds.empty()) return o.bounds;
  const auto found = config::find_data("data/bounds.toml");
  if (!found) throw InputError({"", "data/bounds.toml", "", "is in no data directory", "set VSA_DATA_DIR, or --bounds"});
  return *found;
}

/// The record of the type; none where none is kept and none was asked for.
std::optional<LeaveOneOut> find_record(const ValidationOptions& o) {
  if (!o.leave_one_out.empty()) return read_leave_one_out(o.leave_one_out);
  const fs::path name = record_name(o.specimen.type);
  const auto file = config::find_data(name);
  if (!file) return std::nullopt;
  LeaveOneOut out = read_leave_one_out(*file);
  out.file = name.generic_string();
  return out;
}

Characterization plan_runs(Characterization out, const std::vector<Recording>& recordings) {
  for (const double period : kPeriods_s) {
    for (const Recording& r : recordings) {
      experiment::StiffnessOptions o;
      o.preset = r.preset;
      o.period_s = period;
      o.lead_in_cycles = 0.5;  // as the recordings' branches leave it out
      o.cycles = period > 40 ? 1 : 2;
      out.stiffness.emplace_back().options = o;
    }
  }
  for (const int percent : kPercents) out.speed.emplace_back().options.preset = kFullPreset_rad * percent / 100;
  for (const bool loaded : {false, true}) {
    auto& o = out.preset_step.emplace_back().options;
    o.preset = kFullPreset_rad;
    o.loaded = loaded;
  }
  return out;
}

}  // namespace

ValidationPlan plan_validation(const ValidationOptions& o) {
  ValidationPlan out;
  out.bounds = experiment::read_bounds(bounds_file(o));
  out.left_out = find_record(o);
  out.runs.specimen = o.specimen;
  out.runs.actuator = o.specimen.library.load(o.specimen.type, o.specimen.overrides);
  if (o.specimen.overrides.empty()) experiment::check_kinds(out.bounds.bounds, out.runs.actuator.evidence);
  const fs::path data = data_directory();
  out.recordings = read_recordings(data, o.recordings, out.runs.actuator);
  out.plugin_2015 = data / "plugin_2015";
  out.step_command_s = edge_s(experiment::read_series(out.plugin_2015 / "step_reference.csv", "shaft_angle_rad"), 0);
  out.runs = plan_runs(std::move(out.runs), out.recordings);
  return out;
}

}  // namespace vsa::study
