// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "batch/crew.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "vsa/errors.hpp"

namespace vsa::batch {

struct Crew::Team {
  explicit Team(std::size_t count) try {
    for (std::size_t k = 1; k < count; ++k)
      threads.emplace_back([this, k](const std::stop_token& stop) { wait_and_work(stop, k); });
  } catch (const std::system_error& refused) {
    throw InputError(
        Problem{"", "threads", std::to_string(count), "the system doesn't start as many: " + refused.code().message(), "fewer"});
  }
  ~Team() {
    for (std::jthread& t : threads) t.request_stop();
    begin.notify_all();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  void start(std::size_t count, const std::function<void(std::size_t, std::size_t)>& what) {
    {
      const std::lock_guard lock(mutex);
      work = &what;
      items = count;
      next.store(0, std::memory_order_relaxed);
      // A few at a time, so that the last ones don't wait for one that has many left.
      chunk = std::clamp<std::size_t>(items / (32 * (threads.size() + 1)), 1, 64);
      busy = threads.size();
      ++round;
    }
    begin.notify_all();
  }

  void take(std::size_t worker) noexcept {
    try {
      for (;;) {
        const std::size_t first = next.fetch_add(chunk, std::memory_order_relaxed);
        if (first >= items) return;
        for (std::size_t i = first; i < std::min(first + chunk, items); ++i) (*work)(worker, i);
      }
    } catch (...) {
      next.store(items, std::memory_order_relaxed);
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  }

  std::exception_ptr wait_for_all() {
    std::unique_lock lock(mutex);
    done.wait(lock, [this] { return busy == 0; });
    work = nullptr;
    return std::exchange(error, nullptr);
  }

  void wait_and_work(const std::stop_token& stop, std::size_t worker) {
    for (std::size_t seen = 0;;) {
      {
        std::unique_lock lock(mutex);
        if (!begin.wait(lock, stop, [&] { return round != seen; })) return;
        seen = round;
      }
      take(worker);
      const std::lock_guard lock(mutex);
      if (--busy == 0) done.notify_one();
    }
  }

  Team* left_before = nullptr;
  std::mutex mutex;
  std::condition_variable_any begin, done;
  const std::function<void(std::size_t, std::size_t)>* work = nullptr;
  std::size_t items = 0, chunk = 1, busy = 0, round = 0;
  std::exception_ptr error;
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> threads;  // last: they end before the rest goes

  static inline std::atomic<Team*> left{nullptr};  // by forked children; kept in sight, so that nobody takes them for leaks
};

Crew::Crew(std::size_t count) : count_(count), process_(getpid()), team_(std::make_unique<Team>(count)) {}

Crew::~Crew() {
  if (getpid() != process_) leave();
}

void Crew::leave() noexcept {
  if (Team* const team = team_.release()) team->left_before = Team::left.exchange(team);
}

void Crew::run(std::size_t items, const std::function<void(std::size_t, std::size_t)>& work) {
  if (getpid() != process_) {
    auto own = std::make_unique<Team>(count_);
    leave();
    team_ = std::move(own);
    process_ = getpid();
  }
  team_->start(items, work);
  team_->take(0);
  if (const std::exception_ptr error = team_->wait_for_all()) std::rethrow_exception(error);
}

}  // namespace vsa::batch
