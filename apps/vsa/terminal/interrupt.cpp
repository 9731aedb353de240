// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/interrupt.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iostream>
#include <stdexcept>

namespace vsa::app {
namespace {

std::atomic<int> noted{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void vsa_note_signal(int signal) { noted.store(signal); }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = vsa_note_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
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
