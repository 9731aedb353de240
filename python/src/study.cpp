// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsasim.study: an actuator measured as the paper measured its hardware.
#include <cstddef>
#include <memory>

#include "arrays.hpp"
#include "gil.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::python {
namespace {

using experiment::BenchSample;
using study::Characterization;

py::dtype sample_dtype() {
#define FIELD(name) \
  { #name, offsetof(BenchSample, name) }
  return record_dtype({FIELD(time_s),
                       FIELD(equilibrium_command_rad),
                       FIELD(preset_command),
                       FIELD(equilibrium_rad),
                       FIELD(preset),
                       FIELD(shaft_rad),
                       FIELD(shaft_speed_rad_per_s),
                       FIELD(torque_Nm),
                       FIELD(mean_torque_Nm),
                       FIELD(stiffness_Nm_per_rad),
                       FIELD(measured_shaft_rad),
                       FIELD(measured_deflection_rad),
                       FIELD(measured_load_Nm),
                       {"motor_rad", offsetof(BenchSample, motor_rad), 2},
                       {"current_A", offsetof(BenchSample, current_A), 2}},
                      sizeof(BenchSample));
#undef FIELD
}

study::Experiment experiment_named(const std::string& name) {
  using study::Experiment;
  std::vector<std::string> words;
  for (const Experiment e : {Experiment::stiffness, Experiment::speed, Experiment::preset_step}) {
    if (name == study::word(e)) return e;
    words.emplace_back(study::word(e));
  }
  throw InputError({"", "experiments", name, "unknown", config::join(words)});
}

/// Python's function is asked, if there is one, and its signal handlers run: what they raise ends the study.
study::OnProgress asking(const py::object& progress, OthersRun& others) {
  return [&progress, &others](const study::Progress& p) {
    const OthersRun::Pause others_wait(others);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress.is_none()) return true;
    const py::tuple told = py::make_tuple(p.simulated_s, p.total_s, p.wall_s);
    PyObject* answered = or_stay([&] { return PyObject_CallObject(progress.ptr(), told.ptr()); });
    if (answered == nullptr) throw py::error_already_set();
    const auto answer = py::reinterpret_steal<py::object>(answered);
    return answer.is_none() || py::cast<bool>(answer);
  };
}

template <class Result>
void add_samples(const py::object& entries, const std::vector<Result>& results, const std::shared_ptr<Characterization>& owner) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    const experiment::BenchRun& run = results[i].run;
    const py::object entry = entries[py::int_(i)];
    entry["samples"] = view(sample_dtype(), {static_cast<py::ssize_t>(run.samples.size())}, run.samples.data(), owner);
    entry["notices"] = run.notices;
  }
}

py::object result_dict(const std::shared_ptr<Characterization>& c) {
  py::object out = py::module_::import("json").attr("loads")(study::to_json(*c, "vsasim.study.characterize"));
  if (!c->stiffness.empty()) add_samples(out["stiffness"], c->stiffness, c);
  if (!c->speed.empty()) add_samples(out["speed"], c->speed, c);
  if (!c->preset_step.empty()) add_samples(out["preset_step"], c->preset_step, c);
  return out;
}

Characterization planned(const study::CharacterizationOptions& options) {
  try {
    return study::plan_characterization(options);
  } catch (const InputError& error) {
    rethrow_with_arguments(error, {{"--experiment", "experiments"},
                                   {"--preset-rad", "presets"},
                                   {"--period-s", "period_s"},
                                   {"--amplitude-rad", "amplitude_rad"},
                                   {"--cycles", "cycles"}});
  }
}

py::object characterize(const std::string& type, const std::vector<std::string>& experiments, const py::object& presets,
                        std::optional<double> period_s, std::optional<double> amplitude_rad, std::optional<int> cycles,
                        const py::object& set, std::optional<double> step_s, const py::object& progress,
                        const py::object& given_threads) {
  const auto threads = whole_number<unsigned>(given_threads, "threads");
  study::CharacterizationOptions options;
  options.specimen.type = type;
  options.specimen.overrides = settings(set);
  options.specimen.step_s = step_s;
  for (const std::string& name : experiments) options.experiments.push_back(experiment_named(name));
  if (!presets.is_none()) options.preset = numbers(presets, "presets");
  options.period_s = period_s;
  options.amplitude_rad = amplitude_rad;
  options.cycles = cycles;
  std::shared_ptr<Characterization> done;
  {
    OthersRun others;
    auto found = study::run(planned(options), asking(progress, others), threads);
    if (found) done = std::make_shared<Characterization>(std::move(*found));
  }
  return done ? result_dict(done) : py::none();
}

constexpr const char* kCharacterize =
    "Measures an actuator type as `vsa characterize` does. experiments: of \"stiffness\", \"speed\", \"preset-step\"; empty: all "
    "that it\n"
    "has. presets: (n,) in the law's unit; default: the paper's. period_s, amplitude_rad, cycles: of the stiffness sweep. set: "
    "dict of\n"
    "parameters to replace. step_s: the bench's step. progress(simulated_s, total_s, wall_s): called as it begins and about 20 "
    "times a\n"
    "second, in this thread; returns False to stop. threads: 0: all that the machine has.\n"
    "Returns what results.json holds, as a dict, with `samples` and `notices` in each entry of \"stiffness\", \"speed\" and\n"
    "\"preset_step\": samples is a read-only structured ndarray, a view of the run's memory, which it keeps alive; of a linear "
    "actuator its\n"
    "fields hold m and N whatever their names say. None: stopped.\n"
    "Other threads of Python run meanwhile; Ctrl-C ends it. InputError, SimulationError.";

}  // namespace

void bind_study(py::module_& m) {
  py::module_ s = m.def_submodule("study", "Experiments on an actuator.");
  s.def("characterize", &characterize, py::arg("type"), py::kw_only(), py::arg("experiments") = std::vector<std::string>{},
        py::arg("presets") = py::none(), py::arg("period_s") = py::none(), py::arg("amplitude_rad") = py::none(),
        py::arg("cycles") = py::none(), py::arg("set") = py::none(), py::arg("step_s") = py::none(),
        py::arg("progress") = py::none(), py::arg("threads") = 0, kCharacterize);
}

}  // namespace vsa::python
