// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sweep/optimize.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <utility>

#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"
#include "vsa/sweep/optimize.hpp"
#include "vsa/sweep/summary.hpp"

namespace vsa::app {
namespace {

constexpr const char* kOptimizeNotes =
    R"(The plan is one of vsa sweep's with axes that are searched, an algorithm and objectives (docs/reference/sweep-files.md). A generation's
runs are made at once; what comes next follows from the plan and the numbers so far alone, so that the same seed finds the same
whoever runs what. With --part every part of N runs its share of each generation and waits for the others', so all of them have to
run at once, over one folder.

Examples:
  vsa optimize examples/sweep/settle.toml --out out
  vsa optimize examples/sweep/settle.toml --out out --part 3/8
  mpirun -n 16 vsa-mpi optimize examples/sweep/settle.toml --out out

Exit codes: 0 done, 1 every candidate failed, 2 bad input, 130 interrupted; --resume goes on.)";

void write_findings(const sweep::Optimum& found, const SweepOptions& options, Console& console) {
  const std::filesystem::path folder = folder_of(options);
  write_whole(folder / "candidates.csv", sweep::candidates_csv(found));
  const auto tables = sweep::write_tables(folder, found.plan, sweep::read_logs(folder, found.plan));
  const bool page =
      write_page(sweep::optimum_page(found, "vsa optimize " + shell_word(options.plan)), folder / "page.html", console);
  console.wipe();
  const sweep::Search& search = *found.plan.search();
  std::cout << fmt::format("candidates          {} in {} generations by {}, {} runs\n", found.plan.candidates(),
                           (found.plan.candidates() + search.population - 1) / search.population, search.algorithm,
                           found.plan.runs())
            << fmt::format("not beaten          {}\n", found.best.size());
  if (!found.best.empty()) {
    const std::size_t first = found.best.front(), points = found.plan.points() / found.plan.candidates();
    const auto values = found.plan.values(first * points);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (found.plan.axes()[k].kind == sweep::Axis::Kind::searched)
        std::cout << fmt::format("  {:<18}{}\n", found.plan.axes()[k].name, sweep::value_text(values[k]));
    for (std::size_t o = 0; o < search.objectives.size(); ++o)
      std::cout << fmt::format("  {:<18}{:.6g}\n", found.plan.measures()[search.objectives[o].measure].name,
                               found.objectives[first][o]);
  }
  std::cout << fmt::format("tables              {}\n", (folder / "candidates.csv").string());
  for (const auto& table : tables) std::cout << fmt::format("{:<20}{}\n", "", table.string());
  if (page) std::cout << fmt::format("page                {}\n", (folder / "page.html").string());
  std::cout.flush();
  if (!std::cout) throw std::runtime_error("can't write the summary to standard output");
}

}  // namespace

void check_search(const sweep::Plan& plan, const SweepOptions& options) {
  if (!plan.search())
    throw InputError({options.plan, "vary", "", "nothing is searched", "an axis with search = [from, to]; vsa sweep"});
  if (!sweep::has_optimizer())
    throw InputError(
        {"", "vsa optimize", "", "this build has no optimiser", "one that was configured where pagmo is (libpagmo-dev)"});
  plan.check();
}

Generations generations_of(const sweep::Plan& plan, const SweepOptions& options, Console& console) {
  return {{folder_of(options), part_of(options.part), options.resume, options.retry_failed, options.wait_s}, plan, console};
}

int search(const sweep::Plan& plan, const SweepOptions& options, Generations& generations, Console& console, const MakeRuns& make) {
  std::size_t generation = 0;
  const sweep::Evaluate evaluate = [&](const sweep::Plan& with, std::size_t first) {
    console.status(fmt::format("generation {} of {}", generation++, plan.search()->generations));
    return generations.complete(with, first, with.runs(), [&](const Todo& runs) { return make(with, runs); });
  };
  try {
    const sweep::Optimum found = sweep::optimize(plan, evaluate);
    if (part_of(options.part).number == 1) write_findings(found, options, console);
    return found.best.empty() ? kFailed : kDone;
  } catch (const Interrupted&) {
    console.wipe();
    console.line("interrupted: --resume goes on");
    return kSignalled + std::max(1, interrupted());
  }
}

int run_optimize(const SweepOptions& options) {
  const sweep::Plan plan = sweep::Plan::load(options.plan);
  check_search(plan, options);
  check_wait(options.wait_s);
  Console console;
  catch_interrupts();
  Generations generations = generations_of(plan, options, console);
  sweep::Log log(folder_of(options), plan);
  return search(plan, options, generations, console, [&](const sweep::Plan& with, const Todo& runs) {
    static_cast<void>(make_here(with, runs, options.threads, log, console));
    return interrupted() == 0;
  });
}

void setup_optimize(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  options->command = "optimize";
  CLI::App* sub = app.add_subcommand("optimize", "The best values of a plan's searched axes");
  add_sweep_options(*sub, *options);
  sub->add_option("--part", options->part, "Run every Nth run, from the Ith on, beside the other parts: I/N");
  sub->add_option("--wait-s", options->wait_s, "How long a part waits without news of the others, s")
      ->check(number_given())
      ->capture_default_str()
      ->needs("--part");
  sub->footer(kOptimizeNotes);
  sub->callback([options, &exit_code] { exit_code = run_optimize(*options); });
}

}  // namespace vsa::app
