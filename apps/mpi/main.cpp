// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// mpirun -n N vsa-mpi sweep PLAN.toml …: vsa sweep on all ranks of a job. Exit codes as vsa's.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ranks.hpp"
#include "sweep/optimize.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "vsa/errors.hpp"

namespace {

using namespace vsa::app;
using vsa::InputError;
namespace sweep = vsa::sweep;

/// Does what only rank 0 has to, and what comes of it holds for all: the same code, once told.
template <class Do>
int first_does(const Job& job, Do&& what) {
  int code = kDone;
  if (job.rank() == 0) {
    try {
      what();
    } catch (const InputError& error) {
      std::cerr << error.what() << '\n';
      code = kBadInput;
    }
  }
  return job.from_first(code);
}

/// The plan as every rank reads it: all the same, or nobody begins.
std::optional<sweep::Plan> agreed_plan(const Job& job, const std::string& file) {
  std::optional<sweep::Plan> plan;
  std::string problem;
  try {
    plan = sweep::Plan::load(file);
  } catch (const InputError& error) {
    problem = error.what();
  }
  const bool first_lacks = job.from_first(plan ? 0 : 1) != 0;
  if (!plan && (job.rank() == 0 || !first_lacks))
    std::cerr << (job.rank() == 0 ? "" : "rank " + std::to_string(job.rank()) + ": ") << problem << '\n';
  if (job.any(!plan)) return std::nullopt;
  if (const int apart = job.first_apart(plan->fingerprint()); apart >= 0) {
    if (job.rank() == 0)
      std::cerr << file << ": rank " << apart << " reads another plan, or other files that it names, than rank 0\n";
    return std::nullopt;
  }
  return plan;
}

/// What every rank does with its share of a plan's runs.
RankWork rank_work(const SweepOptions& options, sweep::Log& log) {
  RankWork work;
  work.threads = std::max(1U, options.threads);
  work.done = [&log](const sweep::Outcome& outcome) { log.add(outcome); };
  work.wanted = [] { return interrupted() == 0; };
  return work;
}

int run_sweep_job(const Job& job, const SweepOptions& options, const sweep::Plan& plan, Console& console) {
  std::optional<Dealer> dealer;
  int code = first_does(job, [&] {
    refuse_search(plan, options);
    plan.check();
    dealer.emplace(what_is_left(plan, options));
    tell_plan(plan, console);
  });
  if (code != kDone) return code;
  sweep::claim(folder_of(options), plan);  // where nodes share none, each has its own
  if (job.from_first(dealer && dealer->left() > 0 ? 1 : 0) != 0) {
    sweep::Log log(folder_of(options), plan);
    RankWork work = rank_work(options, log);
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

/// Rank 0 searches; all make the runs of each generation, for which it tells them the candidates. None: the search is over.
int run_optimize_job(const Job& job, const SweepOptions& options, const sweep::Plan& plan, Console& console) {
  int code = first_does(job, [&] {
    begin_search(plan, options);
    plan.check();
  });
  if (code != kDone) return code;
  sweep::claim(folder_of(options), plan);
  sweep::Log log(folder_of(options), plan);
  const RankWork work = rank_work(options, log);
  if (job.rank() == 0) {
    bool others_wait = true;
    code = search(plan, options, console, [&](const sweep::Plan& with, const Todo& runs) {
      std::vector<double> flat;
      for (const auto& candidate : with.candidate_list()) flat.insert(flat.end(), candidate.begin(), candidate.end());
      job.share(flat);
      Dealer dealer(runs);
      static_cast<void>(run_ranks(job, with, &dealer, work));
      others_wait = !job.any(interrupted() != 0);
      return others_wait;
    });
    std::vector<double> over;
    if (others_wait) job.share(over);
    return code;
  }
  const auto is_searched = [](const sweep::Axis& a) { return a.kind == sweep::Axis::Kind::searched; };
  const auto dimensions = std::count_if(plan.axes().begin(), plan.axes().end(), is_searched);
  for (std::vector<double> flat;;) {
    job.share(flat);
    if (flat.empty()) return kDone;
    std::vector<std::vector<double>> candidates;
    for (auto at = flat.begin(); at != flat.end(); at += dimensions) candidates.emplace_back(at, at + dimensions);
    static_cast<void>(run_ranks(job, plan.with(std::move(candidates)), nullptr, work));
    if (job.any(interrupted() != 0)) return kSignalled + std::max(1, interrupted());
  }
}

int run(const Job& job, const SweepOptions& options) {
  const auto plan = agreed_plan(job, options.plan);
  if (!plan) return kBadInput;
  catch_interrupts();
  Console console;
  return options.command == "optimize" ? run_optimize_job(job, options, *plan, console)
                                       : run_sweep_job(job, options, *plan, console);
}

}  // namespace

int main(int argc, char** argv) {
  survive_broken_pipes();
  std::optional<Job> job;
  try {
    job.emplace(argc, argv);
    CLI::App app("vsa sweep and vsa optimize on all ranks of an MPI job: mpirun -n N vsa-mpi sweep PLAN.toml --out DIR", "vsa-mpi");
    app.set_version_flag("--version", "vsa-mpi " VSA_VERSION);
    app.require_subcommand(1);
    SweepOptions options;
    options.threads = 1;
    SweepOptions to_search = options;
    to_search.command = "optimize";
    add_sweep_options(*app.add_subcommand("sweep", "Many runs of a plan, and their table"), options);
    const CLI::App* searches = app.add_subcommand("optimize", "The best values of a plan's searched axes");
    add_sweep_options(*app.get_subcommand("optimize"), to_search);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (job->rank() != 0) return error.get_exit_code() == 0 ? kDone : kBadInput;
      return app.exit(error) == 0 ? kDone : kBadInput;
    }
    return run(*job, searches->parsed() ? to_search : options);
  } catch (const std::exception& error) {
    std::cerr << "vsa-mpi: " << (job ? "rank " + std::to_string(job->rank()) + ": " : "") << error.what() << '\n';
    if (job && job->size() > 1) job->abort();
    return dynamic_cast<const InputError*>(&error) != nullptr ? kBadInput : kFailed;
  }
}
