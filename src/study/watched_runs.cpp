// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "study/watched_runs.hpp"

#include <chrono>
#include <future>

#include "vsa/experiment/parallel.hpp"

namespace vsa::study {
namespace {

/// Lets go of the runs whichever way the watcher leaves.
struct StopAtEnd {
  experiment::Watch& watch;
  ~StopAtEnd() { watch.stop = true; }
};

}  // namespace

bool run_watched(const std::vector<std::function<void()>>& jobs, experiment::Watch& watch, double total_s,
                 const OnProgress& on_progress, unsigned threads) {
  const auto begun = std::chrono::steady_clock::now();
  auto done =
      std::async(std::launch::async, [&] { experiment::run_in_parallel(jobs.size(), threads, [&](std::size_t i) { jobs[i](); }); });
  {
    const StopAtEnd stop{watch};
    do {
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun;
      if (on_progress && !on_progress({static_cast<double>(watch.simulated_ns.load()) * 1e-9, total_s, wall.count()})) break;
    } while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready);
  }
  try {
    done.get();
  } catch (const experiment::Stopped&) {
    return false;
  }
  return true;
}

}  // namespace vsa::study
