// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/bench_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "vsa/errors.hpp"
#include "vsa/experiment/parallel.hpp"

namespace vsa::identify {
namespace {

/// What the model needs, shared by the task's two functions. The amplitudes change between solutions only.
struct Shared {
  experiment::Specimen specimen;
  SweepOptions sweep;
  experiment::Watch* watch;
  std::vector<Parameter> parameters;
  std::vector<double> presets;  ///< of each observation
  std::vector<experiment::BranchOptions> grids;
  std::map<double, double> amplitude_rad;  ///< of each preset

  [[nodiscard]] experiment::Specimen with(const std::vector<double>& values) const {
    experiment::Specimen out = specimen;
    for (config::Override& o : overrides(parameters, values)) out.overrides.push_back(std::move(o));
    return out;
  }
};

experiment::LoadRecording run(const experiment::Specimen& specimen, double preset, const SweepOptions& sweep,
                              std::optional<double> amplitude_rad, experiment::Watch* watch) {
  experiment::StiffnessOptions options;
  options.preset = preset;
  options.period_s = sweep.period_s;
  options.amplitude_rad = amplitude_rad;
  options.lead_in_cycles = 0;
  options.cycles = sweep.cycles;
  options.sample_s = sweep.sample_s;
  return experiment::as_recording(experiment::run_stiffness(specimen, options, watch), preset);
}

/// A grid like the data's: its spacing and its reach.
experiment::BranchOptions grid_of(const experiment::Branches& data) {
  experiment::BranchOptions out;
  out.grid_Nm = data.torque_Nm[1] - data.torque_Nm[0];
  out.max_Nm = std::max(std::abs(data.torque_Nm.front()), std::abs(data.torque_Nm.back()));
  return out;
}

}  // namespace

experiment::LoadRecording simulated_recording(const experiment::Specimen& specimen, double preset, const SweepOptions& sweep,
                                              experiment::Watch* watch) {
  return run(specimen, preset, sweep, sweep.amplitude_rad, watch);
}

void use_bench(Task& task, const experiment::Specimen& specimen, const SweepOptions& sweep, experiment::Watch* watch) {
  if (!(sweep.cycles >= 1.5)) {
    throw InputError({"", "cycles", fmt::format("{}", sweep.cycles), "out of range", "1.5 or more: the first half is left out"});
  }
  auto shared = std::make_shared<Shared>(Shared{specimen, sweep, watch, task.parameters, {}, {}, {}});
  for (const Observation& o : task.observations) {
    shared->presets.push_back(o.preset);
    shared->grids.push_back(grid_of(o.data));
    experiment::check_preset(specimen, o.preset);
  }
  task.prepare = [shared](const std::vector<double>& values) {
    if (shared->sweep.amplitude_rad) return;
    const std::set<double> distinct(shared->presets.begin(), shared->presets.end());
    const std::vector<double> presets(distinct.begin(), distinct.end());
    std::vector<double> found(presets.size());
    const experiment::Specimen unit = shared->with(values);
    experiment::run_in_parallel(presets.size(), 0, [&](std::size_t i) {
      found[i] = experiment::sweep_amplitude(unit, presets[i], shared->sweep.period_s).amplitude_rad;
    });
    for (std::size_t i = 0; i < presets.size(); ++i) shared->amplitude_rad[presets[i]] = found[i];
  };
  task.model = [shared](const std::vector<double>& values, std::size_t o) {
    const double preset = shared->presets[o];
    const auto found = shared->amplitude_rad.find(preset);
    const std::optional<double> amplitude =
        found == shared->amplitude_rad.end() ? shared->sweep.amplitude_rad : std::optional<double>(found->second);
    return experiment::branches(run(shared->with(values), preset, shared->sweep, amplitude, shared->watch), shared->grids[o]);
  };
}

}  // namespace vsa::identify
