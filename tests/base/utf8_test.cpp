// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/utf8.hpp"

#include <gtest/gtest.h>

#include "vsa/errors.hpp"

namespace vsa {
namespace {

TEST(Utf8, IsWhatTheRfcSays) {
  for (const char* good : {"", "a", "\x7f", "Σ", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80",
                           "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf", "a\U0001F40Db"})
    EXPECT_TRUE(is_utf8(good)) << good;
  for (const char* bad : {"\xff", "\x80", "\xc0\xaf", "\xc1\xbf", "\xc2", "\xc2z", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xe2\x82",
                          "\xe2\x82z", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "ab\xe9"})
    EXPECT_FALSE(is_utf8(bad)) << InputError({"", bad, "", "", ""}).what();
}

TEST(Problem, IsUtf8WhateverTheNamesAre) {
  const std::string text = InputError({"f\xe9.sdf", "link[\xff]", "Σ", "no", ""}).what();
  EXPECT_EQ(text, "f\\xe9.sdf: link[\\xff] = Σ: no");
}

}  // namespace
}  // namespace vsa
