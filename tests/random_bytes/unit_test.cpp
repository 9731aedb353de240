// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The whole-unit fuzzing harness (tests/fuzz/unit_fuzz.cpp) fed with seeded chance instead of libFuzzer. A broken invariant ends
// the program.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer calls it so
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void feed(unsigned seed, int inputs, unsigned spread) {
  std::mt19937 rng(seed);
  for (int n = 0; n < inputs; ++n) {
    std::vector<std::uint8_t> bytes(2 + rng() % 600);
    for (auto& b : bytes) b = static_cast<std::uint8_t>(rng() % spread);
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

TEST(RandomBytes, LeaveWholeUnitsAndTheirLineInOrder) { feed(1, 8000, 256); }
TEST(RandomBytes, InQuickSuccessionLeaveThemInOrder) { feed(2, 3000, 60); }

}  // namespace
