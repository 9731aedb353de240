// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Synthetic recordings by the hundred: half an hour of a processor on the whole bench, a minute on the model without dynamics.
#include "identify/coverage.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace vsa {
namespace {

/// Each parameter's count, printed, is within least … most. Each recording's distance from the truth is printed in half intervals as it
/// ends: an hour without a word helps nobody.
void expect_coverage(const identify::Task& task, int recordings, double correlation, int least, int most) {
  const std::vector<int> held =
      test::intervals_that_hold(task, recordings, correlation, [](std::size_t number, const test::Trial& t) {
        std::cout << "recording " << number << ':';
        for (std::size_t k = 0; k < t.value.size(); ++k)
          std::cout << ' ' << (t.value[k] - test::kCoverageTruth[k]) / (0.5 * (t.high[k] - t.low[k]));
        std::cout << std::endl;
      });
  for (std::size_t k = 0; k < held.size(); ++k) {
    std::cout << task.parameters[k].name << ": " << held[k] << " of " << recordings << '\n';
    EXPECT_GE(held[k], least) << task.parameters[k].name;
    EXPECT_LE(held[k], most) << task.parameters[k].name;
  }
}

// Of 100 a 95 % interval holds 95 ± 2.2; 90 to 98 are asked for.
TEST(Coverage, IsThatOfA95PercentIntervalOnTheSimulatedBench) { expect_coverage(test::coverage_task(false), 100, 0.7, 90, 98); }

// Of 500, 475 ± 4.9.
TEST(Coverage, IsThatOfA95PercentIntervalWithoutDynamicsWithIndependentErrors) {
  expect_coverage(test::coverage_task(true), 500, 0.0, 460, 490);
}

TEST(Coverage, IsThatOfA95PercentIntervalWithoutDynamicsWithCorrelatedErrors) {
  expect_coverage(test::coverage_task(true), 500, 0.7, 460, 490);
}

}  // namespace
}  // namespace vsa
