// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sweep/generations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "terminal/interrupt.hpp"
#include "vsa/errors.hpp"
#include "vsa/sweep/pool.hpp"

namespace vsa::app {

Generations::Generations(GenerationOptions options, const sweep::Series& series, Console& console)
    : options_(std::move(options)), console_(console) {
  lock_ = claim_folder(options_.folder, series, options_.part);
  const sweep::Results there = sweep::read_logs(options_.folder, series);
  const bool any =
      std::any_of(there.outcomes.begin(), there.outcomes.end(), [&](const sweep::Outcome& o) { return options_.part.has(o.run); });
  if (any && !options_.resume)
    throw InputError({"", "--out", options_.folder.string(), "has results already", "--resume, which goes on; or another folder"});
  if (!options_.retry_failed) return;
  for (const sweep::Outcome& o : there.outcomes)
    if (!o.error.empty()) again_.insert(o.run);
}

std::vector<sweep::Outcome> Generations::complete(const sweep::Series& series, std::size_t first, std::size_t end,
                                                  const std::function<bool(const Todo&)>& make) {
  std::vector<bool> known(end, false);
  for (const sweep::Outcome& o : sweep::read_logs(options_.folder, series).outcomes)
    if (o.run < end) known[o.run] = again_.erase(o.run) == 0;
  Todo todo;
  for (std::size_t run = first; run < end; ++run)
    if (!known[run] && options_.part.has(run)) todo.add(run);
  if (todo.count > 0 && !make(todo)) throw Interrupted{};
  // Of a job whose runs are all made nothing more can come than what a network's disk holds back.
  constexpr std::chrono::seconds kLatest{120};
  const auto made = std::chrono::steady_clock::now();
  OthersRuns others(options_.part, options_.wait_s, console_);
  for (;;) {
    sweep::Results all = sweep::read_logs(options_.folder, series);
    std::erase_if(all.outcomes, [&](const sweep::Outcome& o) { return o.run >= end; });
    if (all.outcomes.size() == end) return std::move(all.outcomes);
    std::vector<bool> there(end, false);
    for (const sweep::Outcome& o : all.outcomes) there[o.run] = true;
    std::vector<std::size_t> missing;
    for (std::size_t run = 0; run < end; ++run)
      if (!there[run]) missing.push_back(run);
    if (interrupted() != 0) throw Interrupted{};
    if (options_.part.of == 1 && std::chrono::steady_clock::now() - made > kLatest)
      throw std::runtime_error(fmt::format("{}: {} runs that were made are in no log there; is it a folder that all nodes share?",
                                           options_.folder.string(), missing.size()));
    others.wait_for(missing, "runs");
  }
}

sweep::Account make_here(const sweep::Series& series, const Todo& runs, unsigned threads, sweep::Log& log, Console& console) {
  Dealer dealer(runs);
  const RunProgress progress(runs.count);
  std::mutex lock;
  std::size_t done = 0, failed = 0;
  sweep::Work work;
  work.next = [&] { return dealer.next(); };
  work.done = [&](const sweep::Outcome& outcome) {
    log.add(outcome);
    const std::scoped_lock guard(lock);
    failed += outcome.error.empty() ? 0 : 1;
    console.status(progress.text(++done, failed));
  };
  work.wanted = [] { return interrupted() == 0; };
  return sweep::run_pool(series, threads, work);
}

}  // namespace vsa::app
