// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/pool.hpp"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace vsa::sweep {

std::size_t guided_chunk(std::size_t left, std::size_t takers) noexcept {
  return std::max<std::size_t>(1, left / (kShare * std::max<std::size_t>(1, takers)));
}

namespace {

double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double Account::waited() const noexcept {
  const double offered = span_s * static_cast<double>(threads);
  return offered > 0 ? std::max(0.0, 1 - run_wall_s / offered) : 0.0;
}

Account& Account::operator+=(const Account& other) noexcept {
  runs += other.runs;
  failed += other.failed;
  threads += other.threads;
  span_s = std::max(span_s, other.span_s);
  run_wall_s += other.run_wall_s;
  run_cpu_s += other.run_cpu_s;
  all_cpu_s += other.all_cpu_s;
  return *this;
}

Account run_pool(const Series& series, unsigned threads, const Work& work) {
  std::atomic<bool> stopped{false};
  std::mutex lock;
  std::exception_ptr failure;
  Account account;
  account.threads = threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  const auto began = std::chrono::steady_clock::now();
  const double cpu_began = process_cpu_s();
  const auto book = [&](const Outcome& o) {
    const std::scoped_lock guard(lock);
    ++account.runs;
    account.failed += o.error.empty() ? 0 : 1;
    account.run_wall_s += o.wall_s;
    account.run_cpu_s += o.cpu_s;
    account.span_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    account.all_cpu_s = process_cpu_s() - cpu_began;
  };
  const auto wanted = [&] { return !stopped.load(std::memory_order_relaxed) && (!work.wanted || work.wanted()); };
  const auto serve = [&] {
    try {
      const MakeRun make = series.maker();
      while (wanted()) {
        const auto run = work.next();
        if (!run) return;
        const auto outcome = make(*run, wanted);
        if (!outcome) return;
        work.done(*outcome);
        book(*outcome);
      }
    } catch (...) {
      const std::scoped_lock guard(lock);
      if (!failure) failure = std::current_exception();
      stopped = true;
    }
  };
  std::vector<std::thread> others;
  try {
    for (std::size_t i = 1; i < account.threads; ++i) others.emplace_back(serve);
  } catch (const std::system_error&) {  // no more threads to be had: those that there are do it
    account.threads = others.size() + 1;
  }
  serve();
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
  return account;
}

}  // namespace vsa::sweep
