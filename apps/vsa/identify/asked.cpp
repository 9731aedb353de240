// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "identify/signal_watch.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/output_files.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/hash.hpp"
#include "vsa/output_file.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

constexpr int kDigits = 5;  // of the estimates: more than any interval is narrow

/// Each has points, and all together more than there are numbers to be found: as many fit them all and tell nothing of their scatter.
void check_enough(const identify::Task& task) {
  std::size_t points = 0;
  Problems problems;
  for (const identify::Observation& o : task.observations) {
    const std::size_t before = points;
    for (const auto* branch : {&o.data.rising_rad, &o.data.falling_rad})
      points += static_cast<std::size_t>(std::count_if(branch->begin(), branch->end(), [](double v) { return std::isfinite(v); }));
    if (points == before) problems.add({o.name, "", "", "holds no branch of a load cycle", "a sweep of more than half a cycle"});
  }
  problems.throw_if_any();
  if (points > task.parameters.size()) return;
  throw InputError({"", "--parameters", fmt::format("{} of them", task.parameters.size()),
                    fmt::format("the recordings have {} points, which say nothing of the values' scatter", points),
                    "more points than parameters"});
}

identify::Task read_task(const IdentifyOptions& o, const config::ActuatorType& type) {
  Problems problems;
  identify::Task task;
  const auto collect = [&](const auto& step) {
    try {
      step();
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  };
  collect([&] { task.parameters = identify::parse_parameters(o.parameters, type); });
  for (const std::string& file : o.recordings) {
    collect([&] { task.observations.push_back(identify::read_observation(file, type, o.load_kg)); });
  }
  identify::check_each_once(task.observations, problems);
  problems.throw_if_any();
  if (o.weights == "scatter") identify::weigh_by_scatter(task.observations);
  check_enough(task);
  return task;
}

void check_numbers(const IdentifyOptions& o) {
  Problems problems;
  const auto require = [&](double value, const char* flag, double least, double most, const char* unit) {
    if (value >= least && value <= most) return;
    problems.add({"", flag, fmt::format("{}", value), "out of range", fmt::format("{} … {} {}", least, most, unit)});
  };
  require(o.period_s, "--period-s", 1, 3600, "s");
  if (o.amplitude_rad) require(*o.amplitude_rad, "--amplitude-rad", 0.01, 3, "rad");
  require(o.load_kg, "--load-kg", 1e-3, 1e3, "kg");
  require(o.cycles, "--cycles", 1.5, 100, "cycles");
  require(o.starts, "--starts", 1, 100, "starts");
  require(o.seed, "--seed", 0, 1e9, "");
  require(o.iterations, "--iterations", 1, 1000, "iterations");
  require(o.profile, "--profile", 0, 101, "points");
  require(o.bootstrap, "--bootstrap", 0, 100000, "draws");
  if (o.bootstrap == 1) problems.add({"", "--bootstrap", "1", "one draw has no scatter", "0, or 2 … 100000 draws"});
  if (o.name.empty() ||
      o.name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") != std::string::npos) {
    problems.add({"", "--name", o.name, "isn't a type's name", "letters, digits, _ and -"});
  }
  problems.throw_if_any();
}

/// What has no default, where there is no file of hypotheses that says it.
void check_given(const IdentifyOptions& o) {
  Problems problems;
  if (o.recordings.empty()) problems.add({"", "RECORDING", "", "is missing", "CSV files, or --compare FILE"});
  if (o.type.empty()) problems.add({"", "--type", "", "is missing", "an actuator type, see vsa actuators"});
  if (o.parameters.empty()) problems.add({"", "--parameters", "", "is missing", "keys, see vsa actuators NAME"});
  problems.throw_if_any();
}

int write_results(const Asked& asked, Identification r, Console& console) {
  r.command = asked.command();
  r.name = asked.options().name;
  r.type = asked.type();
  r.period_s = asked.options().period_s;
  const fs::path out = asked.out();
  const bool determined = !r.found.uncertainty.deficient();
  const std::string type = determined ? identified_type(r, asked.specimen().library) : "";
  write_whole(out / "results.json", results_json(r));
  if (determined) write_whole(out / (r.name + ".toml"), type);
  report::write_report(identification_report(r), out / "report.html");
  console.wipe();
  for (const std::string& w : warnings(r)) console.line("warning: " + w);
  for (const std::string& w : asked.off_the_grid()) console.line("warning: " + w);
  std::cout << identification_text(r) << "written: " << (out / "report.html").string() << ", results.json";
  std::cout << (determined ? ", " + r.name + ".toml\n" : "; no type, as the data don't determine it\n");
  return determined ? kDone : kFailed;
}

}  // namespace

Asked::Asked(const IdentifyOptions& options) : options_(options) {
  check_given(options);
  check_numbers(options);
  (void)report::page_template();  // told before the work, not after it
  (void)part_of(options.part);
  specimen_.type = options.type;
  specimen_.overrides = config::parse_overrides(options.set, "--set");
  type_ = specimen_.library.load(options.type, specimen_.overrides);
  sweep_.period_s = options.period_s;
  sweep_.amplitude_rad = options.amplitude_rad;
  sweep_.cycles = options.cycles;
  sweep_.load_share = options.load_kg;  // of 1 kg
  bare_ = read_task(options, type_);
  (void)task(1, nullptr);  // what the bench can't do with these recordings is told here
}

fs::path Asked::out() const { return options_.out.empty() ? fs::path("identify_" + options_.type) : fs::path(options_.out); }
fs::path Asked::folder() const { return out() / "jobs"; }

identify::Task Asked::task(unsigned threads, experiment::Watch* watch) const {
  identify::Task out = bare_;
  identify::use_bench(out, specimen_, sweep_, watch, threads);
  return out;
}

std::vector<std::string> Asked::off_the_grid() const {
  constexpr double kFew = 0.01;     // a hand's last push
  constexpr double kLittle = 0.25;  // of the grid: the simulated load swings over all of it
  const double most_Nm = experiment::BranchOptions{}.max_Nm * options_.load_kg;
  const std::string load = fmt::format("±{:.3g} N·m, what a load of {} kg gives", most_Nm, options_.load_kg);
  std::vector<std::string> out;
  for (const identify::Observation& o : bare_.observations) {
    if (o.beyond > kFew)
      out.push_back(fmt::format("{}: {:.0f} % of its samples lie beyond {}, and count for nothing: --load-kg tells of another",
                                o.name, 100 * o.beyond, load));
    double reached_Nm = 0;
    int points = 0;
    for (std::size_t i = 0; i < o.data.torque_Nm.size(); ++i) {
      const int here = (std::isfinite(o.data.rising_rad[i]) ? 1 : 0) + (std::isfinite(o.data.falling_rad[i]) ? 1 : 0);
      points += here;
      if (here > 0) reached_Nm = std::max(reached_Nm, std::abs(o.data.torque_Nm[i]));
    }
    if (!o.points && reached_Nm < kLittle * most_Nm)
      out.push_back(fmt::format("{}: it reaches {:.3g} N·m of {}, so {} points of it count: --load-kg tells of another", o.name,
                                reached_Nm, load, points));
  }
  return out;
}

identify::IdentificationOptions Asked::settings() const {
  identify::IdentificationOptions out;
  out.fit.starts = options_.starts;
  out.fit.iterations = options_.iterations;
  out.fit.global = !options_.no_global;
  out.fit.seed = static_cast<unsigned>(options_.seed);
  if (type_.unit.actuator.linear()) {  // travels of a size that turns the benches' pinion by those angles
    out.fit.effect_rad *= study::kBenchPinion_m;
    out.fit.interval_effect_rad *= study::kBenchPinion_m;
  }
  out.digits = kDigits;
  out.cross_validation = !options_.no_cross_validation;
  out.profile = options_.profile;
  out.draws = options_.bootstrap;
  return out;
}

sweep::Series Asked::series(std::vector<identify::Job> jobs) const {
  constexpr std::size_t kMostJobs = 10'000'000;
  const auto make = [this](unsigned threads, experiment::Watch& watch) { return task(threads, &watch); };
  sweep::Series out = sweep::series_of(make, settings().fit, bare_.parameters.size(), std::move(jobs));
  out.fingerprint = fingerprint();
  out.text = "# The fits of: " + command() + '\n';
  out.most_runs = kMostJobs;  // later generations' are in the logs too
  return out;
}

std::string Asked::command() const {
  const IdentifyOptions& o = options_;
  const IdentifyOptions usual;
  std::string out = "vsa identify";
  for (const auto& r : o.recordings) out += ' ' + shell_word(r);
  out += " --type " + shell_word(o.type) + " --parameters " + shell_word(o.parameters);
  for (const auto& s : o.set) out += " --set " + shell_word(s);
  if (o.name != usual.name) out += " --name " + shell_word(o.name);
  if (o.period_s != usual.period_s) out += fmt::format(" --period-s {}", o.period_s);
  if (o.amplitude_rad) out += fmt::format(" --amplitude-rad {}", *o.amplitude_rad);
  if (o.load_kg != usual.load_kg) out += fmt::format(" --load-kg {}", o.load_kg);
  if (o.cycles != usual.cycles) out += fmt::format(" --cycles {}", o.cycles);
  if (o.starts != usual.starts) out += fmt::format(" --starts {}", o.starts);
  if (o.seed != usual.seed) out += fmt::format(" --seed {}", o.seed);
  if (o.no_global) out += " --no-global";
  if (o.iterations != usual.iterations) out += fmt::format(" --iterations {}", o.iterations);
  if (o.profile != usual.profile) out += fmt::format(" --profile {}", o.profile);
  if (o.bootstrap != usual.bootstrap) out += fmt::format(" --bootstrap {}", o.bootstrap);
  if (o.weights != usual.weights) out += " --weights " + shell_word(o.weights);
  if (o.no_cross_validation) out += " --no-cross-validation";
  return out;
}

std::uint64_t Asked::fingerprint() const {
  std::string text = "vsasim identify 1\n" + command() + '\n' + type_.law + '\n';
  for (const config::Entry& e : type_.entries) text += e.key + " = " + e.value + '\n';
  const auto add = [&](const std::vector<double>& values) {
    for (const double v : values) text += config::number_text(v) + ' ';
    text += '\n';
  };
  for (const identify::Observation& r : bare_.observations) {
    add({r.preset, r.weight});
    for (const auto* column : {&r.data.torque_Nm, &r.data.rising_rad, &r.data.falling_rad}) add(*column);
  }
  return fnv1a(text);
}

Generations generations_of(const Asked& asked, Console& console) {
  make_directory(asked.out(), "--out");
  const IdentifyOptions& o = asked.options();
  check_wait(o.wait_s);
  return {{asked.folder(), part_of(o.part), o.resume, o.retry_failed, o.wait_s}, asked.series({}), console};
}

int identify_with(const Asked& asked, Generations& generations, Console& console, const MakeJobs& make) {
  experiment::Watch watch;
  const SignalWatch signals(watch);
  identify::IdentificationOptions settings = asked.settings();
  settings.fit.progress = [&](const std::string& text) { console.line(text); };
  std::vector<identify::Job> all;
  const identify::DoJobs do_jobs = [&](const std::vector<identify::Job>& jobs) {
    const std::size_t first = all.size();
    all.insert(all.end(), jobs.begin(), jobs.end());
    const auto outcomes =
        generations.complete(asked.series({}), first, all.size(), [&](const Todo& runs) { return make(all, runs); });
    std::vector<identify::Done> out;
    for (std::size_t i = first; i < all.size(); ++i) out.push_back(sweep::done_of(outcomes[i], all[i]));
    console.wipe();
    console.line(all.size() == 1 ? "1 fit is done" : fmt::format("{} fits are done", all.size()));
    return out;
  };
  try {
    Identification r;
    r.found = identify::identify([&](unsigned threads) { return asked.task(threads, &watch); }, settings, do_jobs);
    const Part part = part_of(asked.options().part);
    const int code = part.number == 1 ? write_results(asked, std::move(r), console) : kDone;
    std::error_code none;  // what is left is asked for --resume, nothing worse
    if (part.of == 1) fs::remove_all(asked.folder(), none);
    return code;
  } catch (const experiment::Stopped&) {
  } catch (const Interrupted&) {
  }
  console.wipe();
  console.line("interrupted: --resume goes on");
  return kSignalled + std::max(1, interrupted());
}

}  // namespace vsa::app
