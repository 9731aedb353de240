// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

TEST(Markdown, OfATableHasARuleAsWideAsItsHeadAndTheCaptionBelow) {
  EXPECT_EQ(to_markdown({"not shown", {"a", "b"}, {{"1", "2"}, {"3", ""}}, "What it is."}),
            "| a | b |\n|---|---|\n| 1 | 2 |\n| 3 |  |\n\nWhat it is.\n\n");
  EXPECT_EQ(to_markdown({"", {"a"}, {}, ""}), "| a |\n|---|\n\n");
  EXPECT_EQ(to_markdown({"", {"mean |w|"}, {}, ""}), "| mean \\|w\\| |\n|---|\n\n") << "one cell";
}

}  // namespace
}  // namespace vsa::report
