// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "serial/port_link.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>

#include "serial/refuse.hpp"
#include "vsa/errors.hpp"

namespace vsa::serial {
namespace {

constexpr const char* kPseudoTerminals = "/dev/pts/";

/// Where a symbolic link points; empty: no such file, or none.
std::string link_target(const std::string& path) {
  std::array<char, PATH_MAX> text{};
  const ssize_t n = readlink(path.c_str(), text.data(), text.size());
  return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : std::string();
}

/// The path itself.
const std::string& has_name(const std::string& path) {
  if (std::filesystem::path(path).filename().empty()) refuse(path, "names no file", "a path such as /tmp/vsa-arm");
  return path;
}

}  // namespace

PortLink::PortLink(const std::string& path) : path_(has_name(path)), lock_(path, "another program serves this port") {
  struct stat there {};
  if (lstat(path_.c_str(), &there) != 0) return;
  // Ours that was killed left its lock file behind; another program's link has none, and is in use unless it points nowhere.
  const bool points_to_terminal = S_ISLNK(there.st_mode) && link_target(path_).rfind(kPseudoTerminals, 0) == 0;
  if (points_to_terminal && (!lock_.is_new() || access(path_.c_str(), F_OK) != 0)) return;
  refuse(path_, "something else is in its place; it is left alone", "another path");
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
}

}  // namespace vsa::serial
