// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// poll() in the place of the system's, for all of this program, without its header, which says that it reads nothing.
#include "blind_poll.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>

namespace vsa::serial::test {

std::atomic<int> blind_polls{0};

}  // namespace vsa::serial::test

namespace {

struct Asked {
  int fd;
  short events, revents;
};

}  // namespace

extern "C" int poll(Asked* asked, unsigned long count, int timeout_ms) {
  using vsa::serial::test::blind_polls;
  if (count == 1 && asked->events == 0 && blind_polls > 0) {
    --blind_polls;
    asked->revents = 0;
    return 0;
  }
  timespec timeout{timeout_ms / 1000, timeout_ms % 1000 * 1'000'000L};
  return static_cast<int>(syscall(SYS_ppoll, asked, count, timeout_ms < 0 ? nullptr : &timeout, nullptr, 0));
}
