// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A hundred synthetic recordings of the whole bench: a quarter of an hour.
#include "identify/coverage.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace vsa {
namespace {

TEST(Coverage, OfIntervalsIsThatOfA95PercentIntervalOnTheSimulatedBench) {
  constexpr int kRecordings = 100;
  const identify::Task task = test::coverage_task(false);
  const std::vector<int> held = test::intervals_that_hold(task, kRecordings, 0.7);
  for (std::size_t k = 0; k < held.size(); ++k) {
    std::cout << task.parameters[k].name << ": " << held[k] << " of " << kRecordings << '\n';
    EXPECT_GE(held[k], 90) << task.parameters[k].name;
    EXPECT_LE(held[k], 98) << task.parameters[k].name;
  }
}

}  // namespace
}  // namespace vsa
