// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "sweep/generations.hpp"
#include "sweep/steps.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

constexpr const char* kSweepNotes =
    R"(A plan names a scenario, what varies in it, how often each point is repeated from another start, and what is measured
(docs/reference/sweep-files.md). It is checked before anything runs. Each process appends to a log of its own in DIR/log, so
whatever dies, nothing is lost and --resume goes on; the table is the same bytes whoever ran what, in which order.

Examples:
  vsa sweep examples/sweep/preset.toml --check
  vsa sweep examples/sweep/preset.toml --out out
  vsa sweep examples/sweep/preset.toml --out out --part 3/8        one job of an array of eight
  vsa sweep examples/sweep/preset.toml --out out --merge           after all of them
  mpirun -n 16 vsa-mpi sweep examples/sweep/preset.toml --out out
  vsa sweep examples/sweep/preset.toml --run 17                    one run, to see it

Exit codes: 0 all runs are there, 1 some failed or are missing, 2 bad input, 130 interrupted.)";

unsigned threads_of(const SweepOptions& options) {
  return options.threads != 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
}

int show_check(const sweep::Plan& plan, const SweepOptions& options) {
  constexpr double kProbe_s = 1.0;
  sweep::Runner runner(plan);
  double both_s = 0;
  for (const std::size_t run : {std::size_t{0}, plan.runs() - 1}) {
    if (interrupted() == 0) both_s += runner.estimate_s(run, kProbe_s, [] { return interrupted() == 0; });
  }
  if (interrupted() != 0) return kSignalled + interrupted();
  const double run_s = 0.5 * both_s;
  const unsigned threads = threads_of(options);
  std::cout << fmt::format("runs                {} ({} points × {} repetitions)\n", plan.runs(), plan.points(), plan.repetitions())
            << fmt::format("estimate            {:.3g} s a run by the first and the last; {:.3g} h on {} thread{}\n", run_s,
                           run_s * static_cast<double>(plan.runs()) / 3600 / threads, threads, threads == 1 ? "" : "s");
  if (!std::cout.flush()) throw std::runtime_error("can't write to standard output");
  return kDone;
}

int show_run(const sweep::Plan& plan, const SweepOptions& options) {
  if (options.run >= static_cast<long long>(plan.runs()))
    throw InputError(
        {"", "--run", std::to_string(options.run), "the plan hasn't so many", "0 … " + std::to_string(plan.runs() - 1)});
  const auto run = static_cast<std::size_t>(options.run);
  const auto outcome = sweep::Runner(plan).run(run, [] { return interrupted() == 0; });
  if (!outcome) return kSignalled + interrupted();
  std::cout << plan.scenario_text(run) << '\n';
  for (std::size_t m = 0; m < outcome->values.size(); ++m)
    std::cout << fmt::format("{:<20}{}\n", plan.measures()[m].name, config::number_text(outcome->values[m]));
  if (!outcome->notice.empty()) std::cout << "notice              " << outcome->notice << '\n';
  if (!outcome->error.empty()) std::cout << "error               " << outcome->error << '\n';
  if (!std::cout.flush()) throw std::runtime_error("can't write to standard output");
  return outcome->error.empty() ? kDone : kFailed;
}

int run_here(const sweep::Plan& plan, const SweepOptions& options, Console& console) {
  const Part part = part_of(options.part);
  const DirectoryLock lock = claim_folder(folder_of(options), plan, part);
  const Todo todo = what_is_left(plan, options);
  if (todo.count > 0) {
    sweep::Log log(folder_of(options), plan);
    const sweep::Account account = make_here(plan, todo, threads_of(options), log, console);
    console.wipe();
    console.line(account_text(account, 1));
    if (interrupted() != 0) {
      console.line(fmt::format("interrupted: {} runs are left; --resume goes on", todo.count - account.runs));
      return kSignalled + interrupted();
    }
  }
  if (options.part.empty()) return merge(plan, options, console);
  const std::vector<sweep::Outcome> all = sweep::read_logs(folder_of(options), plan).outcomes;
  const auto failed = std::count_if(all.begin(), all.end(), [&](const auto& o) { return part.has(o.run) && !o.error.empty(); });
  if (failed > 0) console.line(fmt::format("{} runs of this part failed; --merge tells why", failed));
  return failed > 0 ? kFailed : kDone;
}

}  // namespace

int run_sweep(const SweepOptions& options) {
  const sweep::Plan plan = sweep::Plan::load(options.plan);
  refuse_search(plan, options);
  Console console;
  catch_interrupts();
  if (options.merge) {
    if (!std::filesystem::is_directory(folder_of(options) / "log"))
      throw InputError({"", "--out", folder_of(options).string(), "holds no sweep", "a sweep's folder"});
    sweep::claim(folder_of(options), plan);
    return merge(plan, options, console);
  }
  if (options.run >= 0) return show_run(plan, options);
  plan.check();
  if (options.check) return show_check(plan, options);
  tell_plan(plan, console);
  return run_here(plan, options, console);
}

void add_sweep_options(CLI::App& sub, SweepOptions& options) {
  sub.add_option("PLAN", options.plan, "The plan: a TOML file")->required();
  sub.add_option("--out", options.out, "Folder for logs and tables; default: " + options.command + "_PLAN");
  sub.add_option("--threads", options.threads, "Runs at once in each process")->check(between(1, 4096));
  sub.add_flag("--resume", options.resume, "Go on where a folder's runs ended");
  sub.add_flag("--retry-failed", options.retry_failed, "And run again what failed")->needs("--resume");
}

void setup_sweep(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* sub = app.add_subcommand("sweep", "Many runs of a plan, and their table");
  add_sweep_options(*sub, *options);
  const auto given = [sub](const char* name) { return sub->get_option(name); };
  sub->add_option("--part", options->part, "Only every Nth run, from the Ith on: I/N; for job arrays");
  sub->add_flag("--merge", options->merge, "Run nothing; make the tables of all logs");
  sub->add_flag("--check", options->check,
                "Keep nothing; check the plan, make its first and its last run, say how long all of it takes");
  sub->add_option("--run", options->run, "Only this run: its scenario and its numbers")->check(between(0, sweep::Plan::kMostRuns));
  // What one of them wouldn't look at isn't taken.
  for (const char* other : {"--part", "--threads", "--resume", "--check", "--run"}) given("--merge")->excludes(given(other));
  for (const char* other : {"--part", "--out", "--resume", "--run"}) given("--check")->excludes(given(other));
  for (const char* other : {"--part", "--out", "--threads", "--resume"}) given("--run")->excludes(given(other));
  sub->footer(kSweepNotes);
  sub->callback([options, &exit_code] { exit_code = run_sweep(*options); });
}

}  // namespace vsa::app
