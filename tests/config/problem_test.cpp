// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "vsa/errors.hpp"

namespace vsa {
namespace {

TEST(Problem, NamesFileKeyValueAndWhatIsAllowed) {
  EXPECT_EQ((Problem{"a.toml", "motor/inertia", "-1", "too small", "> 0"}).text(),
            "a.toml: motor/inertia = -1: too small (allowed: > 0)");
  EXPECT_EQ((Problem{"", "", "-1", "too small", ""}).text(), "-1: too small");
}

TEST(Problem, WhatSomebodyGaveIsShownOnOneLineAndSteersNoTerminal) {
  const Problem problem{"a\nb.toml", "key\x1b[31m", "va\tlue\x7f", "no such key", ""};
  EXPECT_EQ(problem.text(), "a\\x0ab.toml: key\\x1b[31m = va\\x09lue\\x7f: no such key");
  EXPECT_EQ((Problem{"",
                     "a\xC2\x9B"
                     "2J\xC2\xB5",
                     "", "no such key", ""})
                .text(),
            "a\\xc2\\x9b2Jµ: no such key");  // CSI; micro
  EXPECT_EQ((Problem{"", "Größe", "", "no such key", ""}).text(), "Größe: no such key");
}

TEST(Problem, AVeryLongValueIsCutBetweenCharacters) {
  std::string value;
  for (int i = 0; i < 1000; ++i) value += "ö";
  const std::string text = Problem{"", "key", value, "too long", ""}.text();
  EXPECT_LT(text.size(), 400u);
  EXPECT_NE(text.find("ö… (2000 bytes): too long"), std::string::npos) << text;
}

TEST(Problem, BytesThatAreNoTextAreCutTooButAFilesNameIsNot) {
  const std::string bytes(5000, '\x80'), path(500, 'd');
  EXPECT_LT((Problem{"", "key", bytes, "no number", ""}).text().size(), 4 * 300u + 100);  // each byte as \xNN
  EXPECT_EQ((Problem{path + "/a.toml", "", "", "missing", ""}).text().find(path + "/a.toml"), 0u);
}

}  // namespace
}  // namespace vsa
