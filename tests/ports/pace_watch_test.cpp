// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/ports/pace_watch.hpp"

#include <gtest/gtest.h>

namespace {

using std::chrono::milliseconds;
using vsa::ports::PaceWatch;

/// Steps of 1 ms, each `wall_ms` of wall time, for so many seconds of it. How often it was told.
struct Host {
  int run(double wall_ms, double seconds) {
    int told = 0;
    for (const auto end = wall + std::chrono::duration<double>(seconds); wall < end;) {
      wall += std::chrono::duration_cast<PaceWatch::Clock::duration>(std::chrono::duration<double, std::milli>(wall_ms));
      sim_ns += 1'000'000;
      told += watch.fell_behind(wall, sim_ns) ? 1 : 0;
    }
    return told;
  }
  PaceWatch watch;
  PaceWatch::Clock::time_point wall{};
  std::int64_t sim_ns = 0;
};

TEST(PaceWatch, TellsOnceThatTheHostIsSlow) {
  Host host;
  EXPECT_EQ(host.run(1.0, 5), 0) << "in real time";
  EXPECT_EQ(host.run(0.1, 5), 0) << "faster";
  EXPECT_EQ(host.run(1.5, 5), 1);
  EXPECT_EQ(host.run(1.5, 5), 0) << "once";
}

TEST(PaceWatch, AHostThatStoodIsntSlow) {
  Host host;
  EXPECT_EQ(host.run(1.0, 0.5), 0);
  host.watch.stood();
  host.wall += std::chrono::hours(1);
  EXPECT_EQ(host.run(1.0, 5), 0);
}

TEST(PaceWatch, OneSlowStepInAGoodSecondIsForgiven) {
  Host host;
  EXPECT_EQ(host.run(1.0, 1.5), 0);
  host.wall += milliseconds(50);
  EXPECT_EQ(host.run(1.0, 5), 0);
}

}  // namespace
