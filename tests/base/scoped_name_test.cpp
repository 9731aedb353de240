// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scoped_name.hpp"

#include <gtest/gtest.h>

namespace vsa {
namespace {

TEST(ScopedName, IsPutTogetherAndTakenApart) {
  EXPECT_EQ(scoped_name("lab::arm", "shaft"), "lab::arm::shaft");
  EXPECT_EQ(scoped_name("", "shaft"), "shaft");
  EXPECT_EQ(scope_of("lab::arm::shaft"), "lab::arm");
  EXPECT_EQ(scope_of("shaft"), "");
  EXPECT_EQ(name_within("lab::arm::shaft"), "shaft");
  EXPECT_EQ(name_within("shaft"), "shaft");
  EXPECT_EQ(outermost("lab::arm::shaft"), "lab");
  EXPECT_EQ(outermost("shaft"), "shaft");
}

TEST(ScopedName, IsBelowItsScopesAndNothingElse) {
  EXPECT_EQ(relative_to("lab", "lab::arm::shaft"), "arm::shaft");
  EXPECT_EQ(relative_to("lab::arm", "lab::arm::shaft"), "shaft");
  for (const char* other : {"la", "lab::arm::shaft", "lab::ar", "arm", "lab:"})
    EXPECT_FALSE(is_below("lab::arm::shaft", other)) << other;
}

TEST(ScopedName, IsSpelledWithAnySeparator) {
  EXPECT_EQ(joined_by("a::b_1::c:d", "/"), "a/b_1/c:d");
  EXPECT_EQ(joined_by("a::::b", "."), "a..b");
  EXPECT_EQ(joined_by("a::", "::"), "a::");
  EXPECT_EQ(joined_by("plain", "/"), "plain");
}

}  // namespace
}  // namespace vsa
