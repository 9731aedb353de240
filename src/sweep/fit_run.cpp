// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sweep/fit_run.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "sweep/plan_parts.hpp"
#include "sweep/stoppable.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/fit.hpp"

namespace vsa::sweep {
namespace {

namespace fs = std::filesystem;
using config::TomlSection;

std::map<std::string, double> read_values(TomlSection& s, const char* key, const fs::path& file, Problems& problems) {
  std::map<std::string, double> out;
  const toml::table* table = s.table(key);
  if (table == nullptr) return out;
  TomlSection values(table, file.string(), std::string("study.") + key + ".", problems);
  for (const auto& [name, node] : *table) {
    const std::string parameter(name.str());
    if (const auto value = values.number(parameter.c_str(), -kAny, kAny)) out[parameter] = *value;
  }
  return out;
}

std::vector<fs::path> read_files(TomlSection& s, const char* key, const fs::path& file) {
  std::vector<fs::path> out;
  for (const std::string& name : s.texts(key)) out.push_back(file.parent_path() / name);
  return out;
}

std::string file_of(const std::string& recording) { return fs::path(recording).filename(); }

struct Prepared {
  identify::Task fitted, judged;  ///< judged: on what was left out; no observations: nothing was
  std::vector<double> from;
  std::vector<bool> fixed;
};

std::size_t index_of(const std::vector<identify::Parameter>& parameters, const std::string& name, const char* key) {
  std::vector<std::string> known;
  for (const identify::Parameter& p : parameters) known.push_back(p.name);
  const auto at = std::find(known.begin(), known.end(), name);
  if (at == known.end())
    throw InputError({"", std::string("study.") + key, name, "isn't one of the parameters", config::join(known)});
  return static_cast<std::size_t>(at - known.begin());
}

double within(const identify::Parameter& p, double value, const char* key) {
  if (value >= p.min && value <= p.max) return value;
  throw InputError({"", std::string("study.") + key + "." + p.name, config::number_text(value), "out of range",
                    config::range_text(p.min, p.max)});
}

Prepared prepare(const FitTask& task, experiment::Watch* watch) {
  const config::ActuatorType type = task.specimen.library.load(task.specimen.type, task.specimen.overrides);
  Prepared out;
  out.fitted.parameters = out.judged.parameters = identify::parse_parameters(task.parameters, type);
  Problems problems;
  const auto read = [&](const std::vector<fs::path>& files, identify::Task& into) {
    for (const fs::path& file : files) {
      try {
        into.observations.push_back(identify::read_observation(file, type, task.bench.load_share));
      } catch (const InputError& error) {
        problems.add_all(error);
      }
    }
  };
  std::set<std::string> names;
  for (const auto* files : {&task.recordings, &task.left_out})
    for (const fs::path& file : *files)
      if (!names.insert(file.filename()).second)
        problems.add(
            {"", "study.recordings", file.string(), "has the file name of another", "recordings are told apart by theirs"});
  read(task.recordings, out.fitted);
  read(task.left_out, out.judged);
  problems.throw_if_any();
  if (task.by_scatter) identify::weigh_by_scatter(out.fitted.observations);
  for (const identify::Parameter& p : out.fitted.parameters) out.from.push_back(p.start);
  out.fixed.assign(out.from.size(), false);
  for (const auto& [name, value] : task.from) {
    const std::size_t k = index_of(out.fitted.parameters, name, "from");
    out.from[k] = within(out.fitted.parameters[k], value, "from");
  }
  for (const auto& [name, value] : task.hold) {
    const std::size_t k = index_of(out.fitted.parameters, name, "hold");
    out.from[k] = within(out.fitted.parameters[k], value, "hold");
    out.fixed[k] = true;
  }
  if (!out.fixed.empty() && std::all_of(out.fixed.begin(), out.fixed.end(), [](bool f) { return f; }))
    throw InputError({"", "study.hold", "", "nothing is left to fit", "fewer than all parameters"});
  identify::use_bench(out.fitted, task.specimen, task.bench, watch, 1);
  if (!out.judged.observations.empty()) identify::use_bench(out.judged, task.specimen, task.bench, watch, 1);
  return out;
}

std::map<std::string, double> solve(const Prepared& ready, int iterations) {
  const identify::Residuals residuals(ready.fitted, 1);
  const auto free = static_cast<std::size_t>(std::count(ready.fixed.begin(), ready.fixed.end(), false));
  if (residuals.points().size() <= free)
    throw InputError({"", "study.parameters", std::to_string(free) + " of them",
                      "the recordings have " + std::to_string(residuals.points().size()) + " points",
                      "more points than parameters"});
  identify::FitOptions options;
  options.iterations = iterations;
  const identify::StartResult found = identify::solve(residuals, ready.from, ready.fixed, options);
  std::map<std::string, double> out{{"cost", found.cost},
                                    {"rms_rad", found.rms_rad},
                                    {"iterations", found.iterations},
                                    {"converged", found.converged ? 1.0 : 0.0}};
  for (std::size_t k = 0; k < found.to.size(); ++k) out["value." + ready.fitted.parameters[k].name] = found.to[k];
  const auto judge = [&](const identify::Residuals& of, const char* head) {
    for (const identify::Misfit& m : identify::misfits(of, of.at(found.to))) out[head + file_of(m.name)] = m.rms.both_rad;
  };
  judge(residuals, "rms_rad.");
  if (!ready.judged.observations.empty()) {
    if (ready.judged.prepare) ready.judged.prepare(found.to);
    judge(identify::Residuals(ready.judged, 1), "left_out_rms_rad.");
  }
  return out;
}

}  // namespace

FitTask read_fit(TomlSection& s, const fs::path& file, experiment::Specimen specimen, Problems& problems) {
  FitTask out;
  out.specimen = std::move(specimen);
  s.need("parameters", "keys of the type, see vsa actuators").need("recordings", "CSV files");
  out.parameters = config::join(s.texts("parameters"), ",");
  out.recordings = read_files(s, "recordings", file);
  if (const auto left_out = s.text("leave_out")) {
    const auto at = std::find(out.recordings.begin(), out.recordings.end(), file.parent_path() / *left_out);
    if (*left_out != "none" && (at == out.recordings.end() || out.recordings.size() < 2)) {
      s.add("leave_out", *left_out, "isn't one of several recordings", "one of recordings, as written there; none");
    } else if (*left_out != "none") {
      out.left_out.push_back(*at);
      out.recordings.erase(at);
    }
  }
  out.from = read_values(s, "from", file, problems);
  out.hold = read_values(s, "hold", file, problems);
  out.bench.period_s = s.number("period_s", 1, 3600).value_or(38);
  out.bench.amplitude_rad = s.number("amplitude_rad", 0.01, 3);
  out.bench.cycles = s.number("cycles", 1.5, 100).value_or(1.5);
  out.bench.load_share = s.number("load_kg", 1e-3, 1e3).value_or(1);  // of 1 kg
  out.iterations = static_cast<int>(s.whole("iterations", 1, 1000).value_or(20));
  out.by_scatter = s.word("weights", {"scatter", "equal"}).value_or("scatter") == "scatter";
  return out;
}

std::vector<std::string> fit_numbers(const FitTask& task) {
  const Prepared ready = prepare(task, nullptr);
  std::vector<std::string> out{"cost", "rms_rad", "iterations", "converged"};
  for (const identify::Parameter& p : ready.fitted.parameters) out.push_back("value." + p.name);
  // What is left out differs from run to run: every recording may be either, and the other number is none.
  for (const identify::Task* part : {&ready.fitted, &ready.judged}) {
    for (const identify::Observation& o : part->observations) {
      out.push_back("rms_rad." + file_of(o.name));
      out.push_back("left_out_rms_rad." + file_of(o.name));
    }
  }
  return out;
}

std::optional<std::map<std::string, double>> run_fit(const FitTask& task, const std::function<bool()>& wanted) {
  experiment::Watch watch;
  return stoppable(wanted, watch, [&] { return solve(prepare(task, &watch), task.iterations); });
}

}  // namespace vsa::sweep
