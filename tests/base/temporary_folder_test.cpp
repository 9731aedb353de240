// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "vsa/errors.hpp"

namespace {

namespace fs = std::filesystem;

/// Sets TMPDIR for a while.
class ForAWhile {
 public:
  explicit ForAWhile(const char* value) {
    if (const char* now = std::getenv("TMPDIR")) before_ = now;
    setenv("TMPDIR", value, 1);
  }
  ~ForAWhile() { before_ ? setenv("TMPDIR", before_->c_str(), 1) : unsetenv("TMPDIR"); }
  ForAWhile(const ForAWhile&) = delete;
  ForAWhile& operator=(const ForAWhile&) = delete;

 private:
  std::optional<std::string> before_;
};

TEST(TemporaryFolder, IsItsOwnAndGoesWithAllInIt) {
  fs::path first;
  {
    const vsa::TemporaryFolder a, b;
    EXPECT_NE(a.path(), b.path());
    EXPECT_TRUE(fs::is_empty(a.path()));
    first = a.path();
    fs::create_directory(first / "more");
    std::ofstream(first / "more" / "file") << "text";
  }
  EXPECT_FALSE(fs::exists(first));
}

TEST(TemporaryFolder, SaysWhereThereCanBeNone) {
  const ForAWhile nowhere("/nowhere/at/all");
  try {
    const vsa::TemporaryFolder folder;
    FAIL() << folder.path();
  } catch (const vsa::InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"TMPDIR", "/nowhere/at/all", "a folder that can be written"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
