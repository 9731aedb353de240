// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsasim.identify: parameters from load-test recordings, by the functions that `vsa identify` uses.
#include <chrono>
#include <future>
#include <memory>

#include "arrays.hpp"
#include "gil.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/fit.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::python {
namespace {

namespace id = vsa::identify;

constexpr double kLeastLoad_kg = 1e-3, kMostLoad_kg = 1e3;

struct Options {
  std::string model, weights;
  id::SweepOptions sweep;
  id::FitOptions fit;
  unsigned threads = 0;
};

struct Outcome {
  std::vector<double> start;
  std::vector<id::Misfit> before, after;
  id::Fit fit;
  id::Uncertainty uncertainty;
  std::size_t evaluations = 0;
};

void check_word(const char* name, const std::string& word, const std::vector<std::string>& words) {
  for (const std::string& w : words)
    if (word == w) return;
  throw InputError({"", name, word, "unknown", config::join(words)});
}

void check_range(const char* name, double value, double min, double max) {
  if (!(value >= min && value <= max))
    throw InputError({"", name, config::number_text(value), "out of range", config::range_text(min, max)});
}

id::Task read_task(const std::vector<std::string>& recordings, const config::ActuatorType& type, const std::string& parameters,
                   const std::string& weights, double load_kg) {
  id::Task task;
  try {
    task.parameters = id::parse_parameters(parameters, type);
  } catch (const InputError& error) {
    rethrow_with_arguments(error, {{"--parameters", "parameters"}});
  }
  for (const std::string& file : recordings) task.observations.push_back(id::read_observation(file, type, load_kg));
  if (weights == "scatter") id::weigh_by_scatter(task.observations);
  return task;
}

/// The cheap model alone: nothing to prepare, and no surrogate of a surrogate.
void use_surrogate(id::Task& task) {
  if (!task.surrogate) throw InputError({"", "model", "quasi-static", task.no_surrogate, "bench"});
  task.model = task.surrogate;
  task.prepare = nullptr;
}

Outcome solve(id::Task& task, const Options& o) {
  const id::Residuals residuals(task, o.threads);
  Outcome out;
  for (const id::Parameter& p : task.parameters) out.start.push_back(p.start);
  if (task.prepare) task.prepare(out.start);
  out.before = id::misfits(residuals, residuals.at(out.start));
  out.fit = id::fit(residuals, o.fit);
  id::evaluate_at(out.fit, residuals, o.fit.interval_effect_rad);
  out.after = id::misfits(residuals, out.fit.residuals);
  out.uncertainty = id::uncertainty(residuals, out.fit);
  out.evaluations = residuals.evaluations();
  return out;
}

/// In another thread, so that signals can end it: Watch::stop does.
template <class Work>
auto interruptible(experiment::Watch& watch, OthersRun& others, const Work& work) {
  auto result = std::async(std::launch::async, work);
  while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    try {
      others.look();
    } catch (...) {
      watch.stop = true;
      result.wait();
      throw;
    }
  }
  return result.get();
}

py::list misfit_list(const std::vector<id::Misfit>& misfits) {
  py::list out;
  for (const id::Misfit& m : misfits) {
    out.append(py::dict(py::arg("recording") = m.name, py::arg("preset") = m.preset, py::arg("rms_rad") = m.rms.both_rad,
                        py::arg("rising_rad") = m.rms.rising_rad, py::arg("falling_rad") = m.rms.falling_rad));
  }
  return out;
}

py::dict outcome_dict(const id::Task& task, const Outcome& o) {
  py::dict parameters;
  for (std::size_t k = 0; k < task.parameters.size(); ++k) {
    const id::Parameter& p = task.parameters[k];
    parameters[py::str(p.name)] =
        py::dict(py::arg("value") = o.fit.values[k], py::arg("unit") = p.unit, py::arg("start") = p.start, py::arg("min") = p.min,
                 py::arg("max") = p.max, py::arg("at_bound") = static_cast<bool>(o.fit.at_bound[k]),
                 py::arg("standard_error") = o.uncertainty.standard_error[k], py::arg("low") = o.uncertainty.low[k],
                 py::arg("high") = o.uncertainty.high[k]);
  }
  py::dict set;
  for (const config::Override& s : id::overrides(task.parameters, o.fit.values)) set[py::str(s.key)] = s.value;
  py::dict out;
  out["parameters"] = parameters;
  out["set"] = set;
  out["rms_rad"] = o.fit.rms_rad;
  out["misfits_before"] = misfit_list(o.before);
  out["misfits"] = misfit_list(o.after);
  out["residuals_rad"] = copied(o.fit.residuals);
  out["correlation"] = py::array(py::cast(o.uncertainty.correlation));
  out["determined"] = !o.uncertainty.deficient();
  out["evaluations"] = o.evaluations;
  return out;
}

py::dict fit(const std::vector<std::string>& recordings, const std::string& type, const std::string& parameters,
             const py::object& set, Options o) {
  check_word("model", o.model, {"bench", "quasi-static"});
  check_word("weights", o.weights, {"scatter", "equal"});
  check_range("starts", o.fit.starts, 1, 100);
  check_range("iterations", o.fit.iterations, 1, 1000);
  check_range("period_s", o.sweep.period_s, 1, 3600);
  if (o.sweep.amplitude_rad) check_range("amplitude_rad", *o.sweep.amplitude_rad, 0.01, 3);
  check_range("load_kg", o.sweep.load_share, kLeastLoad_kg, kMostLoad_kg);
  if (recordings.empty()) throw InputError({"", "recordings", "", "there is none", "one or more files"});
  experiment::Specimen specimen;
  specimen.type = type;
  specimen.overrides = settings(set);
  experiment::Watch watch;
  id::Task task;
  std::optional<Outcome> outcome;
  {
    OthersRun others;
    outcome = interruptible(watch, others, [&] {
      task = read_task(recordings, specimen.library.load(type, specimen.overrides), parameters, o.weights, o.sweep.load_share);
      id::use_bench(task, specimen, o.sweep, &watch, o.threads);
      if (o.model == "quasi-static") use_surrogate(task);
      return solve(task, o);
    });
  }
  return outcome_dict(task, *outcome);
}

py::dict branch_dict(const experiment::Branches& b) {
  return py::dict(py::arg("torque_Nm") = copied(b.torque_Nm), py::arg("rising_rad") = copied(b.rising_rad),
                  py::arg("falling_rad") = copied(b.falling_rad), py::arg("sd_rising_rad") = copied(b.sd_rising_rad),
                  py::arg("sd_falling_rad") = copied(b.sd_falling_rad));
}

py::dict read_recording(const std::string& file, const std::string& type, double load_kg) {
  check_range("load_kg", load_kg, kLeastLoad_kg, kMostLoad_kg);
  const id::Observation o = id::read_observation(file, config::TypeLibrary().load(type), load_kg);
  return py::dict(py::arg("name") = o.name, py::arg("preset") = o.preset, py::arg("branches") = branch_dict(o.data));
}

constexpr const char* kFit =
    "Fits parameters of an actuator type to load-test recordings by least squares over both branches, as `vsa identify` does.\n"
    "recordings: CSV files (load_torque_Nm, deflection_rad, the preset in the name) or branch means; parameters: keys of the "
    "type,\n"
    "comma-separated, key=key gives both one value; set: dict of parameters held elsewhere, or started there. model: \"bench\", "
    "the\n"
    "simulated load test with full dynamics (minutes), or \"quasi-static\", the same without dynamics (seconds; 2 to 5 mrad off).\n"
    "weights: \"scatter\" or \"equal\". starts, seed, iterations, global_search: as the command's options. period_s, "
    "amplitude_rad,\n"
    "cycles, load_kg: the sweep and what the bench carries. threads: 0: all that the machine has.\n"
    "Returns a dict: parameters (name to dict of value, unit, start, min, max, at_bound, standard_error, low, high: a 95 % "
    "interval),\n"
    "set (for World.load and ActuatorType.load), rms_rad, misfits_before and misfits (a dict each recording), residuals_rad (n,),\n"
    "correlation (p, p), determined (False: the data don't separate the parameters) and evaluations. Ctrl-C ends it. InputError.";

void bind_fit(py::module_& m) {
  m.def(
      "fit",
      [](const std::vector<std::string>& recordings, const std::string& type, const std::string& parameters, const py::object& set,
         const std::string& model, const std::string& weights, int starts, const py::object& seed, int iterations,
         bool global_search, double period_s, std::optional<double> amplitude_rad, double cycles, const py::object& threads,
         double load_kg) {
        Options o{model, weights, {period_s, amplitude_rad, cycles}, {}, whole_number<unsigned>(threads, "threads")};
        o.sweep.load_share = load_kg;  // of 1 kg
        o.fit.starts = starts;
        o.fit.seed = whole_number<unsigned>(seed, "seed");
        o.fit.iterations = iterations;
        o.fit.global = global_search;
        return fit(recordings, type, parameters, set, std::move(o));
      },
      py::arg("recordings"), py::arg("type"), py::arg("parameters"), py::kw_only(), py::arg("set") = py::none(),
      py::arg("model") = "bench", py::arg("weights") = "scatter", py::arg("starts") = 3, py::arg("seed") = 1,
      py::arg("iterations") = 20, py::arg("global_search") = true, py::arg("period_s") = 38.0,
      py::arg("amplitude_rad") = py::none(), py::arg("cycles") = 1.5, py::arg("threads") = 0, py::arg("load_kg") = 1.0, kFit);
}

}  // namespace

void bind_identify(py::module_& m) {
  py::module_ s = m.def_submodule("identify", "Parameters from recordings.");
  bind_fit(s);
  s.def("read_recording", &read_recording, py::arg("file"), py::arg("type"), py::arg("load_kg") = 1.0,
        "A load-test recording as fit() with that load_kg sees it: dict of name, preset and branches, a dict of ndarrays (n,):\n"
        "torque_Nm, rising_rad, falling_rad (deflections; NaN without samples) and their scatters sd_rising_rad, sd_falling_rad.\n"
        "InputError.");
}

}  // namespace vsa::python
