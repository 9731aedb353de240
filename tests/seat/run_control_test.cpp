// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/seat/run_control.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace {

using vsa::seat::ControlRequest;
using vsa::seat::RunControl;
using Next = RunControl::Next;

int steps_until_wait(RunControl& control, int limit = 1000) {
  int steps = 0;
  while (steps < limit && control.next(0) == Next::step) ++steps;
  return steps;
}

TEST(RunControl, RunsFromTheStartUnlessPaused) {
  RunControl running, paused(true);
  EXPECT_EQ(running.next(0), Next::step);
  EXPECT_EQ(paused.next(0), Next::wait);
  EXPECT_TRUE(paused.paused());
}

TEST(RunControl, StepsWhatIsOwedAndThenWaits) {
  RunControl control(true);
  control.request({false, true, 5, std::nullopt});
  EXPECT_FALSE(control.paused());
  EXPECT_EQ(steps_until_wait(control), 5);
  EXPECT_TRUE(control.paused());
}

TEST(RunControl, AddsStepsToThoseNotYetDone) {
  RunControl control(true);
  control.request({false, true, 5, std::nullopt});
  EXPECT_EQ(control.next(0), Next::step);
  control.request({false, true, 3, std::nullopt});
  EXPECT_EQ(steps_until_wait(control), 7);
}

TEST(RunControl, PausesWithinOneStepAndDropsStepsOwed) {
  RunControl control;
  control.request({false, true, 0, std::nullopt});
  EXPECT_EQ(control.next(0), Next::wait);
  control.request({false, true, 100, std::nullopt});
  control.request({false, true, 0, std::nullopt});
  EXPECT_EQ(control.next(0), Next::wait);
}

TEST(RunControl, GoesOnWhenUnpaused) {
  RunControl control(true);
  control.request({});
  EXPECT_EQ(steps_until_wait(control, 50), 50);
}

TEST(RunControl, ResetsBeforeTheRestOfTheSameRequest) {
  RunControl control;
  control.request({true, true, 2, std::nullopt});
  EXPECT_EQ(control.next(5), Next::reset);
  EXPECT_EQ(steps_until_wait(control), 2);
}

TEST(RunControl, AResetDropsStepsOwed) {
  RunControl control(true);
  control.request({false, true, 100, std::nullopt});
  EXPECT_EQ(control.next(0), Next::step);
  control.request({true, true, 0, std::nullopt});
  EXPECT_EQ(control.next(0), Next::reset);
  EXPECT_EQ(control.next(0), Next::wait);
}

TEST(RunControl, AResetThatAsksForStepsMakesTheseAndNoneOfThoseOwedBefore) {
  RunControl control(true);
  control.request({false, true, 100, std::nullopt});
  control.request({true, true, 2, std::nullopt});
  EXPECT_EQ(control.next(0), Next::reset);
  EXPECT_EQ(steps_until_wait(control), 2);
}

TEST(RunControl, SaysPausedInTheMidstOfAResetThatPauses) {
  RunControl control(true);
  control.request({true, std::nullopt, 0, std::nullopt});
  EXPECT_TRUE(control.paused());
  EXPECT_EQ(control.next(5), Next::reset);
  EXPECT_TRUE(control.paused()) << "what is shown of the reset world mustn't look like running";
  EXPECT_EQ(control.next(0), Next::wait);
}

TEST(RunControl, SaysWhatTheRequestsThatWaitWillComeTo) {
  RunControl control;
  control.request({false, true, 0, std::nullopt});
  EXPECT_TRUE(control.paused());
  control.request({false, true, 3, std::nullopt});
  EXPECT_FALSE(control.paused()) << "three steps are owed";
  control.request({true, std::nullopt, 0, std::nullopt});
  EXPECT_TRUE(control.paused()) << "the reset drops them";
  control.request({});
  EXPECT_FALSE(control.paused());
}

TEST(RunControl, AResetThatSaysNothingOfPausingLeavesTheStateThatItsTurnFinds) {
  RunControl control;
  control.request({false, true, 1, std::nullopt});
  control.request({true, std::nullopt, 0, std::nullopt});  // behind a step that is owed: paused all the same
  EXPECT_EQ(control.next(0), Next::reset);
  EXPECT_EQ(control.next(0), Next::wait);
  control.request({});
  control.request({true, std::nullopt, 0, std::nullopt});
  EXPECT_EQ(control.next(0), Next::reset);
  EXPECT_EQ(control.next(0), Next::step) << "and a running one runs on";
}

TEST(RunControl, RunsToATimeAndPausesThere) {
  RunControl control(true);
  control.request({false, false, 0, 3'000'000});
  EXPECT_EQ(control.next(1'000'000), Next::step);
  EXPECT_EQ(control.next(2'000'000), Next::step);
  EXPECT_EQ(control.next(3'000'000), Next::wait);
  EXPECT_TRUE(control.paused());
}

TEST(RunControl, APausedOneThatIsToRunToATimeRuns) {
  RunControl control(true);
  control.request({false, std::nullopt, 0, 3'000'000});
  EXPECT_FALSE(control.paused());
  EXPECT_EQ(control.next(1'000'000), Next::step);
  EXPECT_EQ(control.next(3'000'000), Next::wait);
}

TEST(RunControl, JudgesTheTimeToRunToAfterTheResetOfTheSameRequest) {
  RunControl control;
  control.request({true, false, 0, 3'000'000});
  EXPECT_EQ(control.next(9'000'000), Next::reset);
  EXPECT_EQ(control.next(0), Next::step);
}

TEST(RunControl, WakesALoopThatWaits) {
  RunControl control(true);
  std::thread other([&control] { control.request({false, true, 1, std::nullopt}); });
  const auto start = std::chrono::steady_clock::now();
  control.wait(std::chrono::seconds(20));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_EQ(control.next(0), Next::step);
  other.join();
}

TEST(RunControl, TakesRequestsFromManyThreadsWithoutLosingAStep) {
  RunControl control(true);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&control] {
      for (int k = 0; k < 100; ++k) control.request({false, true, 1, std::nullopt});
    });
  }
  int steps = 0;
  for (auto& thread : threads) {
    steps += steps_until_wait(control, 1000000);
    thread.join();
  }
  steps += steps_until_wait(control, 1000000);
  EXPECT_EQ(steps, 400);
}

TEST(RunControl, WhoIsWokenDoesntWaitOutTheLimit) {
  RunControl control(true);
  control.wake();
  const auto start = std::chrono::steady_clock::now();
  control.wait(std::chrono::hours(1));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(1));
  EXPECT_EQ(control.next(0), Next::wait);
}

}  // namespace
