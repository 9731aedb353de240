// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/path_lock.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "serial/descriptor.hpp"
#include "serial/refuse.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::serial {
namespace {

namespace fs = std::filesystem;
constexpr int kFlags = O_CLOEXEC | O_NOFOLLOW | O_NOCTTY | O_NONBLOCK;

bool same_file(int fd, const std::string& path) {
  struct stat open_one {};
  struct stat named {};
  return fstat(fd, &open_one) == 0 && lstat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

std::string text_of(int fd) {
  std::array<char, PATH_MAX + 24> text{};
  const ssize_t n = pread(fd, text.data(), text.size(), 0);
  return {text.data(), n > 0 ? static_cast<std::size_t>(n) : 0};
}

std::string owner_in(int fd) {
  const std::string text = text_of(fd);
  return text.empty() ? "" : " (process " + text.substr(0, text.find('\n')) + ")";
}

/// For the message to those whom we refuse, and for the one who tidies up after us.
void sign(int fd, const std::string& path) {
  std::error_code none;
  const std::string text = std::to_string(getpid()) + '\n' + fs::absolute(path, none).string();
  fchmod(fd, 0644);  // readable for others, whose lock it must keep out, whatever the umask
  if (ftruncate(fd, 0) != 0 || pwrite(fd, text.data(), text.size(), 0) < 0) return;  // another user's: as it was
}

/// A killed owner's lock goes when its link has gone, with its directory as a rule. While the link is there, the file tells that it
/// is ours to replace.
void tidy(const fs::path& lock) {
  const Descriptor fd(open(lock.c_str(), O_RDONLY | kFlags));
  if (!fd || flock(fd.get(), LOCK_SH | LOCK_NB) != 0 || !same_file(fd.get(), lock)) return;
  const std::string text = text_of(fd.get());
  const std::size_t line = text.find('\n');
  if (line == std::string::npos) return;
  struct stat there {};
  if (lstat(text.c_str() + line + 1, &there) != 0 && (errno == ENOENT || errno == ENOTDIR)) unlink(lock.c_str());
}

void tidy_directory(const fs::path& locks, const fs::path& own) {
  std::error_code error;
  for (fs::directory_iterator at(locks, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.rfind("vsa-", 0) == 0 && at->path().extension() == ".lock" && at->path() != own) tidy(at->path());
  }
}

/// Owners lock for themselves alone, for life; who only looks (ports.cpp, `tidy`) shares, for a moment. So as long as we could share
/// there is no owner. False: there is.
bool lock(int fd) {
  constexpr int kTries = 5000, kPause_ms = 1;
  for (int i = 0; i < kTries; ++i) {
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
    if (flock(fd, LOCK_SH | LOCK_NB) != 0) return false;
    flock(fd, LOCK_UN);
    poll(nullptr, 0, kPause_ms);
  }
  return false;
}

}  // namespace

PathLock::PathLock(const std::string& path, const std::string& taken) : lock_(lock_path(path)) {
  take(path, taken);
  tidy_directory(fs::path(lock_).parent_path(), lock_);
}

void PathLock::take(const std::string& path, const std::string& taken) {
  while (true) {
    Descriptor file(open(lock_.c_str(), O_RDWR | O_CREAT | O_EXCL | kFlags, 0644));
    is_new_ = static_cast<bool>(file);
    if (!file) file = Descriptor(open(lock_.c_str(), O_RDWR | kFlags));
    if (!file) file = Descriptor(open(lock_.c_str(), O_RDONLY | kFlags));                 // another user's: enough for a lock
    if (!file && errno == ENOENT && fs::exists(fs::path(lock_).parent_path())) continue;  // gone meanwhile
    if (!file) {
      const std::string why = std::strerror(errno);
      refuse(path, "its lock " + lock_ + " can't be made: " + why, "a directory for locks that can be written");
    }
    if (!lock(file.get())) {
      refuse(path, taken + owner_in(file.get()), "another path, or end that program first");
    }
    // An owner that ended between our two calls has removed the file that we locked.
    if (!same_file(file.get(), lock_)) continue;
    sign(file.get(), path);
    fd_ = file.release();
    return;
  }
}

PathLock::~PathLock() {
  unlink(lock_.c_str());
  // A child that was forked and has not called exec holds the same lock.
  flock(fd_, LOCK_UN);
  close(fd_);
}

}  // namespace vsa::serial
