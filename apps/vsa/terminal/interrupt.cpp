// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <iostream>
#include <stdexcept>

namespace vsa::app {
namespace {

/// timeout(1) sends its signal to its child and then to all of its group, which the child is in, too.
constexpr std::int64_t kSameWish_ns = 500'000'000;

std::atomic<int> noted{0};
std::atomic<std::int64_t> noted_at_ns{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

extern "C" void vsa_note_signal(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  std::int64_t first_ns = 0;
  if (noted_at_ns.compare_exchange_strong(first_ns, now_ns)) return noted.store(signal);
  if (now_ns - first_ns < kSameWish_ns) return;
  std::signal(signal, SIG_DFL);
  raise(signal);  // and ends the process when this returns
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = vsa_note_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);  // a script that began this with & had it ignored, and may send it all the same
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction was {};
  sigaction(SIGHUP, nullptr, &was);
  if (was.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // as nohup wants it
}

void fill_closed_standard_files() {
  // open() takes the lowest number that is free, and those below are taken.
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd)
    if (::fcntl(fd, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDONLY));
}

void survive_broken_pipes() {
  // A reader that went away, or a file at its size limit, is then an error of that write, not the end of the run.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void see_all_written() {
  if (!std::cout.flush()) throw std::runtime_error("can't write to standard output");
}

int interrupted() noexcept { return noted.load(std::memory_order_relaxed); }

}  // namespace vsa::app
