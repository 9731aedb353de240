// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace vsa::app {
namespace {

constexpr int kAsk = 1, kChunk = 2;  // tags
enum Question : std::uint64_t { more = 0, leaving = 1 };
constexpr std::chrono::microseconds kSoon{200}, kLate{2000};  // between two looks: where something came, where nothing does

/// Runs that this process has and nobody has begun.
class Reserve {
 public:
  std::optional<std::size_t> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || !runs_.empty(); });
    if (runs_.empty()) return std::nullopt;
    const std::size_t run = runs_.front();
    runs_.pop_front();
    if (runs_.empty()) changed_.notify_all();
    return run;
  }
  template <class Runs>
  void put(const Runs& runs) {
    const std::scoped_lock lock(mutex_);
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    changed_.notify_all();
  }
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  [[nodiscard]] bool empty() {
    const std::scoped_lock lock(mutex_);
    return runs_.empty();
  }
  /// Until it is, or for a while.
  void wait_empty() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(20), [&] { return runs_.empty(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::size_t> runs_;
  bool closed_ = false;
};

/// The threads that run, beside the one that talks.
class Crew {
 public:
  Crew(const sweep::Series& series, const RankWork& work)
      : thread_([this, &series, &work] {
          try {
            account_ = sweep::run_pool(series, work.threads, {[this] { return reserve.take(); }, work.done, work.wanted});
          } catch (...) {
            failure_ = std::current_exception();
          }
          ended_ = true;
        }) {}
  ~Crew() {
    if (!thread_.joinable()) return;
    reserve.close();
    thread_.join();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  [[nodiscard]] bool ended() const noexcept { return ended_; }
  sweep::Account account() {
    reserve.close();
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
    return account_;
  }
  Reserve reserve;

 private:
  sweep::Account account_;
  std::exception_ptr failure_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

bool waits(int from, int tag, MPI_Status& status) {
  int there = 0;
  MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, &status);
  return there != 0;
}

void send(int to, int tag, const std::vector<std::uint64_t>& numbers) {
  MPI_Send(numbers.data(), static_cast<int>(numbers.size()), MPI_UINT64_T, to, tag, MPI_COMM_WORLD);
}
std::vector<std::uint64_t> receive(const MPI_Status& from) {
  int count = 0;
  MPI_Get_count(&from, MPI_UINT64_T, &count);
  std::vector<std::uint64_t> out(static_cast<std::size_t>(count));
  MPI_Recv(out.data(), count, MPI_UINT64_T, from.MPI_SOURCE, from.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return out;
}

/// A chunk as a message holds it.
std::vector<std::uint64_t> chunk(Dealer& dealer, std::size_t takers) {
  constexpr std::size_t kMost = 1 << 20;
  const auto runs = dealer.deal(std::min(kMost, sweep::guided_chunk(dealer.left(), takers)));
  return {runs.begin(), runs.end()};
}

void lead(const Job& job, Dealer& dealer, std::size_t takers, const RankWork& work, Crew& crew) {
  const std::size_t total = dealer.left();
  std::size_t told = 0;
  auto pause = kSoon;
  while (told + 1 < static_cast<std::size_t>(job.size()) || !crew.ended()) {
    if (!work.wanted()) static_cast<void>(dealer.deal(dealer.left()));
    if (crew.reserve.empty() && !crew.ended()) {
      const auto own = chunk(dealer, takers);
      own.empty() ? crew.reserve.close() : crew.reserve.put(own);
    }
    pause = std::min(2 * pause, kLate);
    for (MPI_Status from; waits(MPI_ANY_SOURCE, kAsk, from); pause = kSoon) {
      if (receive(from).at(0) == leaving) {
        ++told;
        continue;
      }
      const auto next = chunk(dealer, takers);
      told += next.empty() ? 1 : 0;
      send(from.MPI_SOURCE, kChunk, next);
    }
    if (work.progress) work.progress(total - dealer.left());
    std::this_thread::sleep_for(pause);
  }
}

void follow(Crew& crew) {
  bool asked = false, over = false;
  while (!over || !crew.ended()) {
    MPI_Status from;
    if (asked && waits(0, kChunk, from)) {
      const auto runs = receive(from);
      over = runs.empty();
      runs.empty() ? crew.reserve.close() : crew.reserve.put(runs);
      asked = false;
    }
    if (!over && !asked && crew.ended()) {  // a signal, or a disk that is full
      send(0, kAsk, {leaving});
      return;
    }
    if (!over && !asked && crew.reserve.empty()) {
      send(0, kAsk, {more});
      asked = true;
    }
    if (asked || over) {
      std::this_thread::sleep_for(kSoon);
    } else {
      crew.reserve.wait_empty();
    }
  }
}

}  // namespace

Job::Job(int& argc, char**& argv) {
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (level < MPI_THREAD_FUNNELED) throw std::runtime_error("this MPI knows no threads (MPI_THREAD_FUNNELED)");
}
Job::~Job() { MPI_Finalize(); }

void Job::meet() const {
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &all);
  for (int here = 0; MPI_Test(&all, &here, MPI_STATUS_IGNORE) == MPI_SUCCESS && here == 0;) std::this_thread::sleep_for(kSoon);
}

int Job::from_first(int value) const {
  meet();
  MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return value;
}
std::size_t Job::total(std::size_t value) const {
  meet();
  const std::uint64_t own = value;
  std::uint64_t all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return all;
}
void Job::share(std::vector<double>& numbers) const {
  meet();
  std::uint64_t size = numbers.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  numbers.resize(size);
  MPI_Bcast(numbers.data(), static_cast<int>(size), MPI_DOUBLE, 0, MPI_COMM_WORLD);
}
bool Job::any(bool value) const { return total(value ? 1 : 0) > 0; }
int Job::first_apart(std::uint64_t value) const {
  meet();
  std::uint64_t first = value;
  MPI_Bcast(&first, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  const int own = first == value ? std::numeric_limits<int>::max() : rank_;
  int least = own;
  MPI_Allreduce(&own, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return least == std::numeric_limits<int>::max() ? -1 : least;
}
sweep::Account Job::gathered(const sweep::Account& own) const {
  meet();
  const double mine[] = {static_cast<double>(own.runs),
                         static_cast<double>(own.failed),
                         static_cast<double>(own.threads),
                         own.span_s,
                         own.run_wall_s,
                         own.run_cpu_s,
                         own.all_cpu_s};
  constexpr int kCount = 7;
  std::vector<double> all(kCount * static_cast<std::size_t>(size_));
  MPI_Gather(mine, kCount, MPI_DOUBLE, all.data(), kCount, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  std::vector<sweep::Account> each;
  sweep::Account out;
  for (auto a = all.begin(); rank_ == 0 && a != all.end(); a += kCount) {
    each.push_back(
        {static_cast<std::size_t>(a[0]), static_cast<std::size_t>(a[1]), static_cast<std::size_t>(a[2]), a[3], a[4], a[5], a[6]});
    out += each.back();
  }
  for (sweep::Account& one : each) {
    one.span_s = out.span_s;  // who was done early waited for the others
    out.most_waited = std::max(out.most_waited, one.waited());
  }
  return out;
}
void Job::abort() const {
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

sweep::Account run_ranks(const Job& job, const sweep::Series& series, Dealer* dealer, const RankWork& work) {
  const std::size_t takers = job.total(work.threads);
  Crew crew(series, work);
  dealer != nullptr ? lead(job, *dealer, takers, work, crew) : follow(crew);
  return crew.account();
}

}  // namespace vsa::app
