// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/bench_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "vsa/errors.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/identify/quasi_static.hpp"
#include "vsa/units.hpp"

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
  std::vector<std::vector<double>> points;  ///< of an observation at rest, its torques; else none
  std::map<double, double> amplitude_rad;   ///< of each preset

  [[nodiscard]] experiment::Specimen with(const std::vector<double>& values) const {
    experiment::Specimen out = specimen;
    out.overrides = overrides(parameters, values, specimen.overrides);
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
  options.load_share = sweep.load_share;
  return experiment::as_recording(experiment::run_stiffness(specimen, options, watch), preset);
}

/// Where the unloaded law's shaft goes under each load, with the pulleys where they were commanded to be.
experiment::Branches at_rest(const experiment::Specimen& specimen, double preset, const std::vector<double>& loads_Nm) {
  const device::UnitConfig unit = specimen.library.load(specimen.type, specimen.overrides).unit;
  experiment::Branches out;
  for (const double load : loads_Nm) {
    out.torque_Nm.push_back(load);
    out.rising_rad.push_back(unit.actuator.shaft_zero_rad / unit.actuator.shaft_scale +
                             experiment::law_deflection(*unit.actuator.transmission, preset, load));
  }
  out.falling_rad = out.sd_rising_rad = out.sd_falling_rad = std::vector<double>(loads_Nm.size(), std::nan(""));
  return out;
}

/// A grid like the data's: its spacing and its reach.
experiment::BranchOptions grid_of(const experiment::Branches& data) {
  experiment::BranchOptions out;
  out.grid_Nm = data.spacing_Nm();
  out.max_Nm = std::max(std::abs(data.torque_Nm.front()), std::abs(data.torque_Nm.back()));
  return out;
}

bool any_swept(const Task& task) {
  return std::any_of(task.observations.begin(), task.observations.end(), [](const Observation& o) { return !o.points; });
}

/// A surrogate and what all its calls share: the units of the values asked for last, as building one costs as much as using it.
class Surrogate {
 public:
  Surrogate(const Task& task, const experiment::Specimen& specimen, const SweepOptions& sweep, experiment::Watch* watch)
      : specimen_(specimen),
        parameters_(task.parameters),
        watch_(watch),
        load_peak_Nm_(any_swept(task) ? sweep.load_share * experiment::bench_load_peak_Nm(specimen) : 0) {
    const device::UnitConfig unit = specimen.library.load(specimen.type, specimen.overrides).unit;
    const std::string_view preset_unit = unit.actuator.transmission->preset_unit();
    for (const Observation& o : task.observations) {
      presets_.push_back(o.preset);
      turns_.push_back({sweep.amplitude_rad ? kPi : experiment::sweep_target_rad(o.preset, preset_unit), sweep.amplitude_rad});
      torques_.push_back(every_other(o.data.torque_Nm));
      points_.push_back(o.points);
      loads_Nm_.push_back(o.points ? o.data.torque_Nm : std::vector<double>{});
    }
  }

  experiment::Branches branches(const std::vector<double>& values, std::size_t observation) {
    if (watch_ != nullptr && watch_->stop) throw experiment::Stopped();
    if (points_[observation]) {
      experiment::Specimen unit = specimen_;
      unit.overrides = overrides(parameters_, values, specimen_.overrides);
      return at_rest(unit, presets_[observation], loads_Nm_[observation]);
    }
    const std::shared_ptr<const Known> known = at(values);
    return known->model.branches(presets_[observation], torques_[observation], turns_[observation]);
  }

 private:
  struct Known {
    std::vector<double> values;
    QuasiStatic model;
  };

  /// The grid needn't be finer than the model is good: every second point, and the last.
  static std::vector<double> every_other(const std::vector<double>& grid) {
    std::vector<double> out;
    for (std::size_t i = 0; i < grid.size(); i += 2) out.push_back(grid[i]);
    if (grid.size() % 2 == 0) out.push_back(grid.back());
    return out;
  }

  std::shared_ptr<const Known> at(const std::vector<double>& values) {
    constexpr std::size_t kKept = 8;  // more than threads that are likely
    {
      const std::lock_guard lock(mutex_);
      for (const auto& k : known_) {
        if (k->values == values) return k;
      }
    }
    const device::UnitConfig unit =
        specimen_.library.load(specimen_.type, overrides(parameters_, values, specimen_.overrides)).unit;
    if (const auto why = unsupported(unit)) throw std::runtime_error(*why);
    auto made = std::make_shared<const Known>(Known{values, QuasiStatic(unit, load_peak_Nm_)});
    const std::lock_guard lock(mutex_);
    if (known_.size() == kKept) known_.erase(known_.begin());
    known_.push_back(made);
    return made;
  }

  experiment::Specimen specimen_;
  std::vector<Parameter> parameters_;
  experiment::Watch* watch_;
  double load_peak_Nm_;
  std::vector<double> presets_;
  std::vector<Turn> turns_;
  std::vector<std::vector<double>> torques_;  ///< of each observation
  std::vector<bool> points_;
  std::vector<std::vector<double>> loads_Nm_;  ///< of those at rest
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Known>> known_;
};

void use_quasi_static(Task& task, const experiment::Specimen& specimen, const SweepOptions& sweep, experiment::Watch* watch) {
  const auto why = unsupported(specimen.library.load(specimen.type, specimen.overrides).unit);
  task.no_surrogate = why.value_or("");
  task.surrogate = nullptr;
  if (why) return;
  auto surrogate = std::make_shared<Surrogate>(task, specimen, sweep, watch);
  task.surrogate = [surrogate](const std::vector<double>& values, std::size_t o) { return surrogate->branches(values, o); };
}

}  // namespace

experiment::LoadRecording simulated_recording(const experiment::Specimen& specimen, double preset, const SweepOptions& sweep,
                                              experiment::Watch* watch) {
  return run(specimen, preset, sweep, sweep.amplitude_rad, watch);
}

void use_bench(Task& task, const experiment::Specimen& specimen, const SweepOptions& sweep, experiment::Watch* watch,
               unsigned threads) {
  if (!(sweep.cycles >= 1.5)) {
    throw InputError({"", "cycles", fmt::format("{}", sweep.cycles), "out of range", "1.5 or more: the first half is left out"});
  }
  auto shared = std::make_shared<Shared>(Shared{specimen, sweep, watch, task.parameters, {}, {}, {}, {}});
  const auto swept = [](const Observation& o) { return !o.points; };
  for (const Observation& o : task.observations) {
    shared->presets.push_back(o.preset);
    shared->grids.push_back(o.points ? experiment::BranchOptions{} : grid_of(o.data));
    shared->points.push_back(o.points ? o.data.torque_Nm : std::vector<double>{});
    experiment::check_preset(specimen, o.preset);
  }
  task.prepare = [shared, threads](const std::vector<double>& values) {
    if (shared->sweep.amplitude_rad) return;
    std::set<double> distinct;
    for (std::size_t o = 0; o < shared->presets.size(); ++o)
      if (shared->points[o].empty()) distinct.insert(shared->presets[o]);
    const std::vector<double> presets(distinct.begin(), distinct.end());
    std::vector<double> found(presets.size());
    const experiment::Specimen unit = shared->with(values);
    experiment::run_in_parallel(presets.size(), threads, [&](std::size_t i) {
      found[i] = experiment::sweep_amplitude(unit, presets[i], shared->sweep.period_s, shared->sweep.load_share).amplitude_rad;
    });
    for (std::size_t i = 0; i < presets.size(); ++i) shared->amplitude_rad[presets[i]] = found[i];
  };
  task.model = [shared](const std::vector<double>& values, std::size_t o) {
    const double preset = shared->presets[o];
    if (!shared->points[o].empty()) return at_rest(shared->with(values), preset, shared->points[o]);
    const auto found = shared->amplitude_rad.find(preset);
    const std::optional<double> amplitude =
        found == shared->amplitude_rad.end() ? shared->sweep.amplitude_rad : std::optional<double>(found->second);
    return experiment::branches(run(shared->with(values), preset, shared->sweep, amplitude, shared->watch), shared->grids[o]);
  };
  if (std::any_of(task.observations.begin(), task.observations.end(), swept)) {
    use_quasi_static(task, specimen, sweep, watch);
  } else {
    task.surrogate = task.model;  // it costs no more than a surrogate
    task.no_surrogate.clear();
  }
}

}  // namespace vsa::identify
