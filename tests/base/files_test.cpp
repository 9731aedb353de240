// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>

namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "vsa_files_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(Files, AShellTakesAWordAsTheTextItWas) {
  for (const std::string text :
       {"", " ", "/tmp/a b", "it's", "''", "$HOME", "`x`", "a\nb", "~", "*", "\\", "a;b", "#", "é ü", "!x", "\"q\""}) {
    const fs::path out = folder / "word";
    const std::string command = "printf %s " + vsa::shell_word(text) + " > " + vsa::shell_word(out.string());
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    EXPECT_EQ(vsa::read_file(out), text) << command;
  }
}

TEST_F(Files, AWordThatAShellTakesAsItIsHasNoQuotes) {
  for (const std::string text : {"/dev/ttyUSB0", "vsa-qbmove_maker_pro_6_1", "drive.supply_V=24", "é", "a:1,2@%+"})
    EXPECT_EQ(vsa::shell_word(text), text);
  EXPECT_EQ(vsa::shell_word("/tmp/a b"), "'/tmp/a b'");
}

TEST_F(Files, AreReadByteForByte) {
  const std::string bytes = std::string("a\0\r\n\xff", 5) + ", no line's end";
  std::ofstream(folder / "some", std::ios::binary) << bytes;
  std::ofstream(folder / "empty").close();
  EXPECT_EQ(vsa::read_file(folder / "some"), bytes);
  EXPECT_EQ(vsa::read_file(folder / "empty"), "");
}

TEST_F(Files, WhatIsNoFileOrCannotBeReadIsNoneAndErrnoSaysWhy) {
  EXPECT_FALSE(vsa::read_file(folder / "absent"));
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(vsa::read_file(folder)) << "an open directory reads like an empty file";
  EXPECT_EQ(errno, EISDIR);
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(vsa::read_file(folder / "pipe")) << "nobody would ever write to it";
  std::ofstream(folder / "secret") << "text";
  fs::permissions(folder / "secret", fs::perms::none);
  if (geteuid() != 0) {
    EXPECT_FALSE(vsa::read_file(folder / "secret"));
  }
}

}  // namespace
