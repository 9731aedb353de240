// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/grouped.hpp"

#include <gtest/gtest.h>

namespace {

using Groups = std::vector<std::vector<std::size_t>>;

Groups of(std::vector<int> keys) { return vsa::grouped(keys); }

TEST(Grouped, ByTheKeyThatComesFirst) {
  EXPECT_EQ(of({7, 2, 7}), (Groups{{0, 2}, {1}}));
  EXPECT_EQ(of({}), Groups{});
  EXPECT_EQ(of({4}), (Groups{{0}}));
  EXPECT_EQ(of({-1, -1, 3, -1, 3}), (Groups{{0, 1, 3}, {2, 4}}));
}

}  // namespace
