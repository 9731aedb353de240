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

#include "ranks.hpp"
#include "sweep/steps.hpp"
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

int run(const Job& job, const SweepOptions& options) {
  const auto plan = agreed_plan(job, options.plan);
  if (!plan) return kBadInput;
  Console console;
  std::optional<Dealer> dealer;
  int code = first_does(job, [&] {
    plan->check();
    dealer.emplace(what_is_left(*plan, options));
    tell_plan(*plan, console);
  });
  if (code != kDone) return code;
  sweep::claim(folder_of(options), *plan);  // where nodes share none, each has its own
  catch_interrupts();
  if (job.from_first(dealer && dealer->left() > 0 ? 1 : 0) != 0) {
    sweep::Log log(folder_of(options), *plan);
    RankWork work;
    work.threads = std::max(1U, options.threads);
    work.done = [&](const sweep::Outcome& outcome) { log.add(outcome); };
    work.wanted = [] { return interrupted() == 0; };
    const RunProgress progress(dealer ? dealer->left() : 0);
    if (job.rank() == 0) work.progress = [&](std::size_t dealt) { console.status("dealt " + progress.text(dealt, 0)); };
    const sweep::Account account = job.gathered(run_ranks(job, *plan, dealer ? &*dealer : nullptr, work));
    console.wipe();
    if (job.rank() == 0) console.line(account_text(account, static_cast<std::size_t>(job.size())));
  }
  if (job.any(interrupted() != 0)) {
    if (job.rank() == 0) console.line("interrupted: --resume goes on");
    return kSignalled + std::max(1, interrupted());
  }
  code = kDone;
  if (job.rank() == 0) code = merge(*plan, options, console);
  return job.from_first(code);
}

}  // namespace

int main(int argc, char** argv) {
  survive_broken_pipes();
  std::optional<Job> job;
  try {
    job.emplace(argc, argv);
    CLI::App app("vsa sweep on all ranks of an MPI job: mpirun -n N vsa-mpi sweep PLAN.toml --out DIR", "vsa-mpi");
    app.set_version_flag("--version", "vsa-mpi " VSA_VERSION);
    app.require_subcommand(1);
    SweepOptions options;
    options.threads = 1;
    CLI::App* sub = app.add_subcommand("sweep", "Many runs of a plan, and their table");
    add_sweep_options(*sub, options);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (job->rank() != 0) return error.get_exit_code() == 0 ? kDone : kBadInput;
      return app.exit(error) == 0 ? kDone : kBadInput;
    }
    return run(*job, options);
  } catch (const std::exception& error) {
    std::cerr << "vsa-mpi: " << (job ? "rank " + std::to_string(job->rank()) + ": " : "") << error.what() << '\n';
    if (job && job->size() > 1) job->abort();
    return dynamic_cast<const InputError*>(&error) != nullptr ? kBadInput : kFailed;
  }
}
