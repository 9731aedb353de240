// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The short version of tests/identify_long: five recordings, on the model without dynamics.
#include "identify/coverage.hpp"

#include <gtest/gtest.h>

namespace vsa::identify {
namespace {

TEST(Coverage, OfFiveRecordingsLosesFewIntervals) {
  int held = 0;
  for (const int of_one : test::intervals_that_hold(test::coverage_task(true), 5, 0.7)) held += of_one;
  EXPECT_GE(held, 16);  // of 20 at 95 %: fewer happens in 0.3 % of such trials if they were independent
}

TEST(Coverage, WithoutErrorsEveryParameterIsFound) {
  const Task task = test::coverage_task(true);
  const Residuals residuals(task, 1);
  FitOptions o;
  o.starts = 1;
  o.tolerance = 1e-9;
  const Fit exact = fit(residuals, o);
  for (std::size_t k = 0; k < exact.values.size(); ++k)
    EXPECT_NEAR(exact.values[k], test::kCoverageTruth[k], 0.02 * test::kCoverageTruth[k]) << task.parameters[k].name;
}

}  // namespace
}  // namespace vsa::identify
