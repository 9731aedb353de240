// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The commands' end by signals.
#include "terminal/interrupt.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

namespace vsa::app {
namespace {

/// How a process ends, as waitpid tells, that catches interrupts and does this.
int end_of(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    catch_interrupts();
    _exit(work());
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

/// As timeout(1) sends it: to its child, and to its group.
TEST(Interrupt, SignalsThatComeTogetherAreOneWish) {
  for (const int second : {SIGTERM, SIGINT, SIGHUP}) {
    const auto together = [second] {
      raise(SIGTERM);
      for (int k = 0; k < 100; ++k) raise(second);
      return interrupted() == SIGTERM ? 7 : 1;
    };
    int status = end_of(together);
    // A machine that stands still in between makes two wishes of it, but not five times running.
    for (int more = 0; more < 4 && !WIFEXITED(status); ++more) status = end_of(together);
    EXPECT_TRUE(WIFEXITED(status)) << second;
    EXPECT_EQ(WEXITSTATUS(status), 7) << second;
  }
}

TEST(Interrupt, ALaterOneEndsTheProcess) {
  const int status = end_of([] {
    raise(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    raise(SIGINT);
    return 1;
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
}

}  // namespace
}  // namespace vsa::app
