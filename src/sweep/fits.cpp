// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/fits.hpp"

#include <chrono>
#include <exception>
#include <limits>
#include <memory>
#include <utility>

#include "sweep/stoppable.hpp"

namespace vsa::sweep {
namespace {

/// A run's outcome of what makes its numbers; what that throws is the outcome's error.
template <class Do>
std::optional<Outcome> outcome_of(std::size_t run, const std::function<bool()>& wanted, experiment::Watch& watch, Do&& numbers) {
  const auto began = std::chrono::steady_clock::now();
  Outcome out;
  out.run = run;
  try {
    auto made = stoppable(wanted, watch, std::forward<Do>(numbers));
    if (!made) return std::nullopt;
    out.values = std::move(*made);
  } catch (const std::exception& error) {
    out.error = error.what();
  }
  out.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  out.cpu_s = std::numeric_limits<double>::quiet_NaN();  // it works in a thread of its own
  return out;
}

}  // namespace

Series series_of(const MakeWatchedTask& make, const identify::FitOptions& options, std::size_t parameters,
                 std::vector<identify::Job> jobs) {
  const auto all = std::make_shared<const std::vector<identify::Job>>(std::move(jobs));
  return {0, "", all->size(), identify::result_size(parameters), [make, options, all]() -> MakeRun {
            const auto watch = std::make_shared<experiment::Watch>();
            const auto worker = std::make_shared<identify::Worker>(make(1, *watch), options);
            return [watch, worker, all](std::size_t run, const std::function<bool()>& wanted) {
              return outcome_of(run, wanted, *watch, [&] { return identify::numbers_of(worker->solve(all->at(run))); });
            };
          }};
}

identify::Done done_of(const Outcome& outcome, const identify::Job& job) {
  if (!outcome.error.empty()) return {std::nullopt, outcome.error};
  identify::Done out{identify::result_of(outcome.values), ""};
  out.result->from = job.from;
  return out;
}

Series series_of(const identify::Comparison& comparison, unsigned threads,
                 std::function<void(std::size_t run, identify::FitRecord record)> done) {
  const auto all = std::make_shared<const std::vector<identify::FitRequest>>(identify::requests(comparison));
  return {0, "", all->size(), 0, [&comparison, threads, done = std::move(done), all]() -> MakeRun {
            const auto watch = std::make_shared<experiment::Watch>();
            return [&comparison, threads, done, all, watch](std::size_t run, const std::function<bool()>& wanted) {
              return outcome_of(run, wanted, *watch, [&] {
                done(run, identify::run_fit(comparison, all->at(run), threads, watch.get()));
                return std::vector<double>{};
              });
            };
          }};
}

}  // namespace vsa::sweep
