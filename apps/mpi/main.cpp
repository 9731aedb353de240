// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// mpirun -n N vsa-mpi sweep PLAN.toml …: vsa sweep on all ranks of a job; optimize and identify too. Exit codes as vsa's.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "identify/asked.hpp"
#include "identify/compare.hpp"
#include "ranks.hpp"
#include "sweep/optimize.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/old_spellings.hpp"
#include "vsa/errors.hpp"

namespace {

using namespace vsa::app;
using vsa::InputError;
namespace sweep = vsa::sweep;

/// Each problem in a line of its own. `rank`: "", or "rank N: ".
void tell(const InputError& error, const std::string& rank = "") {
  for (const auto& problem : error.problems()) std::cerr << "vsa-mpi: " << rank << problem.text() << '\n';
}

/// Does what only rank 0 has to, and what comes of it holds for all: the same code, once told.
template <class Do>
int first_does(const Job& job, Do&& what) {
  int code = kDone;
  if (job.rank() == 0) {
    try {
      what();
    } catch (const InputError& error) {
      tell(error);
      code = kBadInput;
    }
  }
  return job.from_first(code);
}

/// What every rank reads for itself, if all read the same: else nobody begins. `what`: for the message.
template <class Asks, class Read>
std::optional<Asks> agreed(const Job& job, const std::string& what, Read&& read) {
  std::optional<Asks> out;
  std::optional<InputError> problem;
  try {
    read(out);
  } catch (const InputError& error) {
    problem = error;
  }
  const bool first_lacks = job.from_first(out ? 0 : 1) != 0;
  if (problem && (job.rank() == 0 || !first_lacks))
    tell(*problem, job.rank() == 0 ? "" : "rank " + std::to_string(job.rank()) + ": ");
  if (job.any(!out)) return std::nullopt;
  if (const int apart = job.first_apart(out->fingerprint()); apart >= 0) {
    if (job.rank() == 0)
      std::cerr << "vsa-mpi: " << what << ": rank " << apart
                << " reads something else than rank 0, here or in files that it names\n";
    return std::nullopt;
  }
  return out;
}

/// What every rank does with its share of the runs.
/// 0: as many as the machine runs.
unsigned threads_of(unsigned asked) { return asked != 0 ? asked : std::max(1U, std::thread::hardware_concurrency()); }

RankWork rank_work(unsigned threads, sweep::Log& log) {
  RankWork work;
  work.threads = threads_of(threads);
  work.done = [&log](const sweep::Outcome& outcome) { log.add(outcome); };
  work.wanted = [] { return interrupted() == 0; };
  return work;
}

int run_sweep_job(const Job& job, const SweepOptions& options, const sweep::Plan& plan, Console& console) {
  std::optional<Dealer> dealer;
  vsa::DirectoryLock lock;
  int code = first_does(job, [&] {
    refuse_search(plan, options);
    plan.check();
    lock = claim_folder(folder_of(options), plan, {});
    dealer.emplace(what_is_left(plan, options));
    tell_plan(plan, console);
  });
  if (code != kDone) return code;
  sweep::claim(folder_of(options), plan);  // where nodes share none, each has its own
  if (job.from_first(dealer && dealer->left() > 0 ? 1 : 0) != 0) {
    sweep::Log log(folder_of(options), plan);
    RankWork work = rank_work(options.threads, log);
    const RunProgress progress(dealer ? dealer->left() : 0);
    if (job.rank() == 0) work.progress = [&](std::size_t dealt) { console.status("dealt " + progress.text(dealt, 0)); };
    const sweep::Account account = job.gathered(run_ranks(job, plan, dealer ? &*dealer : nullptr, work));
    console.wipe();
    if (job.rank() == 0) console.line(account_text(account, static_cast<std::size_t>(job.size())));
  }
  if (job.any(interrupted() != 0)) {
    if (job.rank() == 0) console.line("interrupted: --resume goes on");
    return kSignalled + std::max(1, interrupted());
  }
  code = kDone;
  if (job.rank() == 0) code = merge(plan, options, console);
  return job.from_first(code);
}

/// What follows rank 0 by generations: it tells all the numbers that a generation is made of, and all make its runs. No numbers: over.
class Led {
 public:
  Led(const Job& job, const RankWork& work) : job_(job), work_(work) {}
  /// Rank 0. False: a signal came.
  bool make(std::vector<double> generation, const sweep::Series& series, const Todo& runs) {
    job_.share(generation);
    Dealer dealer(runs);
    static_cast<void>(run_ranks(job_, series, &dealer, work_));
    others_wait_ = !job_.any(interrupted() != 0);
    return others_wait_;
  }
  void end() {
    std::vector<double> over;
    if (others_wait_) job_.share(over);
  }
  /// The other ranks; their exit code.
  int follow(const std::function<sweep::Series(const std::vector<double>&)>& series_of) {
    for (std::vector<double> generation;;) {
      job_.share(generation);
      if (generation.empty()) return kDone;
      static_cast<void>(run_ranks(job_, series_of(generation), nullptr, work_));
      if (job_.any(interrupted() != 0)) return kSignalled + std::max(1, interrupted());
    }
  }

 private:
  const Job& job_;
  const RankWork& work_;
  bool others_wait_ = true;
};

/// Equal rows one behind the other, and back.
std::vector<double> flat_of(const std::vector<std::vector<double>>& rows) {
  std::vector<double> out;
  for (const auto& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}
std::vector<std::vector<double>> rows_of(const std::vector<double>& flat, std::size_t each) {
  std::vector<std::vector<double>> out;
  const auto size = static_cast<std::ptrdiff_t>(each);
  for (auto at = flat.begin(); at != flat.end(); at += size) out.emplace_back(at, at + size);
  return out;
}

int run_optimize_job(const Job& job, const SweepOptions& options, const sweep::Plan& plan, Console& console) {
  std::optional<Generations> generations;
  const int code = first_does(job, [&] {
    check_search(plan, options);
    generations.emplace(generations_of(plan, options, console));
  });
  if (code != kDone) return code;
  sweep::claim(folder_of(options), plan);
  sweep::Log log(folder_of(options), plan);
  const RankWork work = rank_work(options.threads, log);
  Led led(job, work);
  if (generations) {
    const int done = search(plan, options, *generations, console, [&](const sweep::Plan& with, const Todo& runs) {
      return led.make(flat_of(with.candidate_list()), with, runs);
    });
    led.end();
    return done;
  }
  const auto is_searched = [](const sweep::Axis& a) { return a.kind == sweep::Axis::Kind::searched; };
  const auto dimensions = static_cast<std::size_t>(std::count_if(plan.axes().begin(), plan.axes().end(), is_searched));
  return led.follow([&](const std::vector<double>& flat) -> sweep::Series { return plan.with(rows_of(flat, dimensions)); });
}

int run_identify_job(const Job& job, const IdentifyOptions& options) {
  const auto asked = agreed<Asked>(job, "identify", [&](auto& out) { out.emplace(options); });
  if (!asked) return kBadInput;
  catch_interrupts();
  Console console;
  std::optional<Generations> generations;
  const int code = first_does(job, [&] { generations.emplace(generations_of(*asked, console)); });
  if (code != kDone) return code;
  sweep::claim(asked->folder(), asked->series({}));
  sweep::Log log(asked->folder(), asked->series({}));
  const RankWork work = rank_work(static_cast<unsigned>(options.threads.value_or(1)), log);
  Led led(job, work);
  if (generations) {
    const int done =
        identify_with(*asked, *generations, console, [&](const std::vector<vsa::identify::Job>& jobs, const Todo& runs) {
          std::vector<double> flat;
          for (const auto& one : jobs) {
            const std::vector<double> numbers = vsa::identify::numbers_of(one);
            flat.insert(flat.end(), numbers.begin(), numbers.end());
          }
          return led.make(flat, asked->series(jobs), runs);
        });
    led.end();
    return done;
  }
  return led.follow([&](const std::vector<double>& flat) {
    std::vector<vsa::identify::Job> jobs;
    for (const auto& row : rows_of(flat, vsa::identify::job_size(asked->parameters()))) jobs.push_back(vsa::identify::job_of(row));
    return asked->series(std::move(jobs));
  });
}

int run_compare_job(const Job& job, const CompareOptions& options) {
  catch_interrupts();
  const auto what = agreed<Comparing>(job, options.file, [&](auto& out) { out.emplace(options); });
  if (!what) return kBadInput;
  Console console;
  RankWork work;
  work.threads = threads_of(static_cast<unsigned>(options.threads.value_or(1)));
  work.done = [&](const sweep::Outcome& outcome) { tell_failed(*what, outcome, console); };
  work.wanted = [] { return interrupted() == 0; };
  Led led(job, work);
  sweep::Series series = what->series(1, console);
  if (job.rank() != 0) return led.follow([&](const std::vector<double>&) { return series; });
  const int code = compare_with(*what, console, [&](const Todo& fits) { return led.make({1.0}, series, fits); });
  led.end();
  return code;
}

int run(const Job& job, const SweepOptions& options) {
  const auto plan = agreed<sweep::Plan>(job, options.plan, [&](auto& out) { out.emplace(sweep::Plan::load(options.plan)); });
  if (!plan) return kBadInput;
  catch_interrupts();
  Console console;
  return options.command == "optimize" ? run_optimize_job(job, options, *plan, console)
                                       : run_sweep_job(job, options, *plan, console);
}

}  // namespace

int main(int argc, char** argv) {
  fill_closed_standard_files();
  survive_broken_pipes();
  std::optional<Job> job;
  try {
    job.emplace(argc, argv);
    CLI::App app(
        "vsa sweep, vsa optimize and vsa identify on all ranks of an MPI job: mpirun -n N vsa-mpi sweep PLAN.toml --out DIR",
        "vsa-mpi");
    app.set_version_flag("--version", "vsa-mpi " VSA_VERSION);
    app.require_subcommand(1);
    SweepOptions options;
    options.threads = 1;
    SweepOptions to_search = options;
    to_search.command = "optimize";
    add_sweep_options(*app.add_subcommand("sweep", "Many runs of a plan, and their table"), options);
    const CLI::App* searches = app.add_subcommand("optimize", "The best values of a plan's searched axes");
    add_sweep_options(*app.get_subcommand("optimize"), to_search);
    const auto to_identify = std::make_shared<IdentifyOptions>();
    CLI::App* identifies = app.add_subcommand("identify", "Parameters of an actuator type from load-test recordings");
    const auto check_mixture = add_identify_options(*identifies, to_identify);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (job->rank() != 0) return error.get_exit_code() == 0 ? kDone : kBadInput;
      return app.exit(error) == 0 ? kDone : kBadInput;
    }
    if (job->rank() == 0) tell_old_spellings("vsa-mpi");  // every rank reads the same
    if (!identifies->parsed()) return run(*job, searches->parsed() ? to_search : options);
    if (first_does(*job, check_mixture) != kDone) return kBadInput;
    check_mixture();
    const bool compares = !to_identify->compare.file.empty();
    const int code = compares ? run_compare_job(*job, to_identify->compare) : run_identify_job(*job, *to_identify);
    see_all_written();
    return code;
  } catch (const std::exception& error) {
    std::cerr << "vsa-mpi: " << (job ? "rank " + std::to_string(job->rank()) + ": " : "") << error.what() << '\n';
    if (job && job->size() > 1) job->abort();
    return dynamic_cast<const InputError*>(&error) != nullptr ? kBadInput : kFailed;
  }
}
