// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "serial/port_link.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>

#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::serial {
namespace {

constexpr const char* kPseudoTerminals = "/dev/pts/";

[[noreturn]] void refuse(const std::string& path, const std::string& why, const std::string& allowed) {
  throw InputError({"", "serial port", path, why, allowed});
}

/// Where a symbolic link points; empty: no such file, or none.
std::string link_target(const std::string& path) {
  std::array<char, PATH_MAX> text{};
  const ssize_t n = readlink(path.c_str(), text.data(), text.size());
  return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : std::string();
}

bool same_file(int fd, const std::string& path) {
  struct stat open_one {};
  struct stat named {};
  return fstat(fd, &open_one) == 0 && lstat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

std::string owner_in(int lock) {
  std::array<char, 24> text{};
  const ssize_t n = pread(lock, text.data(), text.size() - 1, 0);
  return n > 0 ? " (process " + std::string(text.data(), static_cast<std::size_t>(n)) + ")" : "";
}

void sign(int lock) {
  const std::string pid = std::to_string(getpid());
  // Only for the message to whom we refuse: nothing depends on it.
  if (ftruncate(lock, 0) != 0 || pwrite(lock, pid.data(), pid.size(), 0) < 0) return;
}

}  // namespace

PortLink::PortLink(const std::string& path) : path_(path) {
  const std::filesystem::path p(path);
  if (p.filename().empty()) refuse(path, "names no file", "a path such as /tmp/vsa-arm");
  lock_path_ = lock_path(path);
  take_lock();
  struct stat there {};
  if (lstat(path_.c_str(), &there) != 0) return;
  // Ours that was killed left its lock file behind; another program's link has none, and is in use unless it points nowhere.
  const bool points_to_terminal = S_ISLNK(there.st_mode) && link_target(path_).rfind(kPseudoTerminals, 0) == 0;
  if (points_to_terminal && (!lock_is_new_ || access(path_.c_str(), F_OK) != 0)) return;
  unlink(lock_path_.c_str());
  refuse(path_, "something else is in its place; it is left alone", "another path");
}

void PortLink::take_lock() {
  while (true) {
    constexpr int kFlags = O_CLOEXEC | O_NOFOLLOW | O_NOCTTY;
    Descriptor lock(open(lock_path_.c_str(), O_RDWR | O_CREAT | O_EXCL | kFlags, 0644));
    lock_is_new_ = static_cast<bool>(lock);
    if (!lock) lock = Descriptor(open(lock_path_.c_str(), O_RDWR | kFlags));
    if (!lock) lock = Descriptor(open(lock_path_.c_str(), O_RDONLY | kFlags));  // another user's: enough for a lock
    if (!lock && errno == ENOENT) continue;                                     // gone meanwhile
    if (!lock) {
      const std::string why = std::strerror(errno);
      refuse(path_, "its lock " + lock_path_ + " can't be made: " + why, "a directory for locks that can be written");
    }
    if (flock(lock.get(), LOCK_EX | LOCK_NB) != 0) {
      refuse(path_, "another program serves this port" + owner_in(lock.get()), "another path, or end that program first");
    }
    // An owner that ended between our two calls has removed the file that we locked.
    if (!same_file(lock.get(), lock_path_)) continue;
    sign(lock.get());
    lock_ = std::move(lock);
    return;
  }
}

void PortLink::point_to(const std::string& target) {
  // Beside it under a name that holds nothing of the port's, by which programs for the hardware find theirs.
  struct stat lock {};
  fstat(lock_.get(), &lock);
  const std::string name = ".vsa-" + std::to_string(getpid()) + "-" + std::to_string(lock.st_ino);
  const std::string fresh = (std::filesystem::path(path_).parent_path() / name).string();
  unlink(fresh.c_str());
  if (symlink(target.c_str(), fresh.c_str()) != 0 || rename(fresh.c_str(), path_.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    unlink(fresh.c_str());
    refuse(path_, "can't be made: " + why, "a path in a directory that can be written");
  }
  target_ = target;
}

PortLink::~PortLink() {
  if (!target_.empty() && link_target(path_) == target_) unlink(path_.c_str());
  unlink(lock_path_.c_str());
  // A child that was forked and has not called exec holds the same lock.
  flock(lock_.get(), LOCK_UN);
}

}  // namespace vsa::serial
