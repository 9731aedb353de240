// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <set>
#include <string>

#include "vsa/files.hpp"
#include "vsa/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::write_all_whole;
using vsa::write_whole;

struct WriteWhole : testing::Test {
  vsa::TemporaryFolder folder;
  fs::path file = folder.path() / "file.txt";

  std::set<std::string> names() const {
    std::set<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder.path())) out.insert(entry.path().filename());
    return out;
  }
  static void put(const fs::path& at, const std::string& text) { std::ofstream(at) << text; }
  static std::string text(const fs::path& at) { return vsa::read_file(at).value_or("no file"); }
  static mode_t mode(const fs::path& at) {
    struct stat there {};
    return ::stat(at.c_str(), &there) == 0 ? there.st_mode & 07777 : 0;
  }
  static std::string message_of(const std::function<void()>& act) {
    try {
      act();
    } catch (const vsa::OutputError& error) {
      return error.what();
    }
    return "nothing was thrown";
  }
};

TEST_F(WriteWhole, ANewFileHasThePermissionsThatTheProcessGives) {
  const mode_t before = ::umask(027);
  write_whole(file, "new");
  ::umask(before);
  EXPECT_EQ(text(file), "new");
  EXPECT_EQ(mode(file), 0640U);
  EXPECT_EQ(names(), (std::set<std::string>{"file.txt"}));
}

TEST_F(WriteWhole, AFileThatIsThereKeepsItsPermissions) {
  for (const mode_t mode_before : {0600U, 0664U, 0444U}) {
    put(file, "old");
    ASSERT_EQ(::chmod(file.c_str(), mode_before), 0);
    mode_t meanwhile = 0;
    write_whole(file, [&](const fs::path& beside) {
      put(beside, "new");
      meanwhile = mode(beside);
    });
    EXPECT_EQ(text(file), "new");
    EXPECT_EQ(mode(file), mode_before);
    EXPECT_EQ(meanwhile & ~(mode_before | S_IWUSR), 0U) << "readable by others while it was written";
    fs::remove(file);
  }
}

TEST_F(WriteWhole, AFileThatIsThereKeepsItsOwnerWhereRootWritesIt) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give files away";
  write_whole(file, "old");
  ASSERT_EQ(::chown(file.c_str(), 1234, 2345), 0);
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  write_whole(file, "new");
  struct stat now {};
  ASSERT_EQ(::stat(file.c_str(), &now), 0);
  EXPECT_EQ(now.st_uid, 1234U);
  EXPECT_EQ(now.st_gid, 2345U);
  EXPECT_EQ(now.st_mode & 0777U, 0640U);
  EXPECT_EQ(text(file), "new");
}

/// Lets user 1234 read and write. As the kernel has it: version 2, then tag, permissions and id of owner, that user, group, mask and
/// others.
struct AccessList {
  static constexpr std::uint32_t kNobody = 0xFFFFFFFF;
  struct Entry {
    std::uint16_t tag, permissions;
    std::uint32_t id;
  };
  std::uint32_t version = 2;
  std::array<Entry, 5> entries{{{1, 6, kNobody}, {2, 6, 1234}, {4, 4, kNobody}, {16, 6, kNobody}, {32, 0, kNobody}}};
};
constexpr const char* kAccess = "system.posix_acl_access";
constexpr const char* kDefault = "system.posix_acl_default";  // a directory's: what new files in it begin with

/// False: this file system has none.
bool give(const fs::path& at, const char* name, const AccessList& list) {
  return ::setxattr(at.c_str(), name, &list, sizeof list, 0) == 0 || errno != ENOTSUP;
}

bool has_access_list(const fs::path& at) { return ::getxattr(at.c_str(), kAccess, nullptr, 0) > 0; }

TEST_F(WriteWhole, AFileThatIsThereKeepsItsAccessList) {
  write_whole(file, "old");
  const AccessList list;
  if (!give(file, kAccess, list)) GTEST_SKIP() << "this file system has no access lists";
  write_whole(file, "new");
  std::array<char, 256> now{};
  ASSERT_EQ(::getxattr(file.c_str(), kAccess, now.data(), now.size()), static_cast<ssize_t>(sizeof list));
  EXPECT_EQ(std::memcmp(now.data(), &list, sizeof list), 0);
}

TEST_F(WriteWhole, AFileThatIsThereWithoutAnAccessListGetsNoneFromItsDirectory) {
  write_whole(file, "old");
  ASSERT_EQ(::chmod(file.c_str(), 0660), 0);
  if (!give(folder.path(), kDefault, {})) GTEST_SKIP() << "this file system has no access lists";
  put(folder.path() / "another.txt", "");
  ASSERT_TRUE(has_access_list(folder.path() / "another.txt"));
  bool meanwhile = true;
  write_whole(file, [&](const fs::path& beside) {
    put(beside, "new");
    meanwhile = has_access_list(beside);
  });
  EXPECT_EQ(text(file), "new");
  EXPECT_FALSE(has_access_list(file));
  EXPECT_FALSE(meanwhile) << "readable by others while it was written";
  EXPECT_EQ(mode(file), 0660U);
}

TEST_F(WriteWhole, OtherHardLinksKeepWhatWas) {
  const fs::path other = folder.path() / "other";
  write_whole(file, "old");
  fs::create_hard_link(file, other);
  write_whole(file, "new");
  EXPECT_EQ(text(file), "new");
  EXPECT_EQ(text(other), "old");
}

TEST_F(WriteWhole, LinksStayAndWhatTheyLeadToIsWritten) {
  fs::create_directory(folder.path() / "there");
  fs::create_symlink("there/real.txt", folder.path() / "second.txt");
  fs::create_symlink("second.txt", file);
  write_whole(file, "first");  // leads to nothing yet
  EXPECT_EQ(text(folder.path() / "there/real.txt"), "first");
  write_whole(file, "then");
  EXPECT_EQ(text(folder.path() / "there/real.txt"), "then");
  EXPECT_TRUE(fs::is_symlink(file));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "second.txt"));
  fs::create_symlink("circle", folder.path() / "circle");
  EXPECT_NE(message_of([&] { write_whole(folder.path() / "circle", ""); }).find("symbolic links"), std::string::npos);
}

TEST_F(WriteWhole, APipeIsWrittenNotReplaced) {
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  const int reader = ::open(file.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write_whole(file, "through");
  char got[16] = {};
  EXPECT_EQ(::read(reader, got, sizeof got), 7);
  ::close(reader);
  EXPECT_STREQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(file));
  EXPECT_EQ(names(), (std::set<std::string>{"file.txt"}));
}

TEST_F(WriteWhole, ADeviceThatIsFullIsAFailureAndStaysADevice) {
  fs::create_symlink("/dev/full", file);  // root, too, would replace the link only
  EXPECT_EQ(message_of([&] { write_whole(file, "x"); }), file.string() + ": can't write: No space left on device");
  EXPECT_TRUE(fs::is_symlink(file));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WriteWhole, OthersFilesBesideItAreNotTouched) {
  put(folder.path() / "file.txt.part", "mine");
  const std::string next = "file.txt.part-" + std::to_string(::getpid()) + "-0";
  put(folder.path() / next, "mine, too");
  write_whole(file, "new");
  EXPECT_EQ(text(folder.path() / "file.txt.part"), "mine");
  EXPECT_EQ(text(folder.path() / next), "mine, too");
  EXPECT_EQ(text(file), "new");
}

TEST_F(WriteWhole, AFailureLeavesTheFileAndNothingBesideIt) {
  put(file, "old");
  EXPECT_THROW(write_whole(file,
                           [](const fs::path& beside) {
                             put(beside, "half");
                             throw std::runtime_error("no more");
                           }),
               std::runtime_error);
  EXPECT_EQ(text(file), "old");
  EXPECT_EQ(names(), (std::set<std::string>{"file.txt"}));
  fs::create_directory(folder.path() / "d");
  EXPECT_EQ(message_of([&] { write_whole(folder.path() / "d", ""); }),
            (folder.path() / "d").string() + ": can't open for writing: Is a directory");
  EXPECT_EQ(message_of([&] { write_whole(folder.path() / "none/x", ""); }),
            (folder.path() / "none/x").string() + ": can't open for writing: No such file or directory");
}

TEST_F(WriteWhole, OfSeveralNoneIsReplacedBeforeAllAreWritten) {
  put(file, "old");
  EXPECT_EQ(message_of([&] {
              write_all_whole({{file, "new"}, {folder.path() / "none/x", "new"}});
            }),
            (folder.path() / "none/x").string() + ": can't open for writing: No such file or directory; 0 of 2 files written");
  EXPECT_EQ(text(file), "old");
  EXPECT_EQ(names(), (std::set<std::string>{"file.txt"}));
  write_all_whole({{file, "new"}, {folder.path() / "other.txt", "newer"}});
  EXPECT_EQ(text(file), "new");
  EXPECT_EQ(text(folder.path() / "other.txt"), "newer");
}

}  // namespace
