// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/ports.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "serial/descriptor.hpp"
#include "vsa/hash.hpp"

namespace vsa::serial {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kPrefix = "vsa-";

fs::path directory() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  return runtime != nullptr && fs::is_directory(runtime, none) ? fs::path(runtime) : fs::path("/tmp");
}

fs::path lock_directory() {
  constexpr const char* kLocks = "/run/lock";  // Filesystem Hierarchy Standard 3.0
  std::error_code none;
  return fs::is_directory(kLocks, none) && access(kLocks, W_OK | X_OK) == 0 ? fs::path(kLocks) : directory();
}

/// In hex.
std::string hash_of(const std::string& text) {
  std::array<char, 17> hex{};
  std::snprintf(hex.data(), hex.size(), "%016llx", static_cast<unsigned long long>(fnv1a(text)));
  return hex.data();
}

enum class Served { yes, no, never };  // no: not any more

/// Its owner holds a lock; one that was killed leaves its lock's file, or at least a link to a terminal that is gone.
Served served(const fs::path& link) {
  std::error_code none;
  const Descriptor fd(open(lock_path(link.string()).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NOCTTY | O_NONBLOCK));
  if (fd && flock(fd.get(), LOCK_SH | LOCK_NB) != 0) return Served::yes;
  const bool to_terminal = fs::read_symlink(link, none).string().rfind("/dev/pts/", 0) == 0;
  return fd || (to_terminal && !fs::exists(link, none)) ? Served::no : Served::never;
}

bool is_link(const fs::path& path) {
  std::error_code none;
  return fs::is_symlink(fs::symlink_status(path, none));
}

std::vector<std::string> names_in(const fs::path& where, std::string_view prefix) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(where, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.rfind(prefix, 0) == 0) names.push_back(at->path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::string port_path(std::string_view name) {
  if (name.find('/') != std::string_view::npos) return std::string(name);
  const std::string prefix(name.rfind(kPrefix, 0) == 0 ? std::string_view() : kPrefix);
  return (directory() / (prefix + std::string(name))).string();
}

std::string lock_path(std::string_view port) {
  constexpr std::size_t kMostOfName = 100;
  std::error_code none;
  const fs::path path = fs::absolute(fs::path(port), none);
  const fs::path place = fs::weakly_canonical(path.parent_path(), none) / path.filename();
  const std::string name = place.filename().string().substr(0, kMostOfName);
  return (lock_directory() / (std::string(kPrefix) + name + "-" + hash_of(place.string()) + ".lock")).string();
}

bool is_left_behind(const std::string& port) { return is_link(port) && served(port) == Served::no; }

PortList find_ports() {
  PortList list;
  for (const std::string& name : names_in(directory(), kPrefix)) {
    if (!is_link(name)) continue;
    const Served state = served(name);
    if (state != Served::never) (state == Served::yes ? list.virtual_ports : list.left_behind).push_back(name);
  }
  for (const char* prefix : {"ttyUSB", "ttyACM"}) {
    const auto found = names_in("/dev", prefix);
    list.devices.insert(list.devices.end(), found.begin(), found.end());
  }
  return list;
}

}  // namespace vsa::serial
