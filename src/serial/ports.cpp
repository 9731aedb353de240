// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/ports.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "serial/descriptor.hpp"

namespace vsa::serial {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kPrefix = "vsa-";

fs::path directory() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  return runtime != nullptr && fs::is_directory(runtime, none) ? fs::path(runtime) : fs::path("/tmp");
}

enum class Which { all, served, left_behind };

/// Its owner holds a lock on the file beside it; one that was killed leaves that file.
bool is(const fs::path& link, Which which) {
  const std::string lock = (link.parent_path() / ("." + link.filename().string() + ".lock")).string();
  const Descriptor fd(open(lock.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NOCTTY | O_NONBLOCK));
  return fd && (flock(fd.get(), LOCK_SH | LOCK_NB) != 0) == (which == Which::served);
}

std::vector<std::string> names_in(const fs::path& where, std::string_view prefix, Which which) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(where, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    std::error_code ignored;
    if (name.rfind(prefix, 0) != 0 || (which != Which::all && !at->is_symlink(ignored))) continue;
    if (which == Which::all || is(at->path(), which)) names.push_back(at->path().string());
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

PortList find_ports() {
  PortList list;
  list.virtual_ports = names_in(directory(), kPrefix, Which::served);
  list.left_behind = names_in(directory(), kPrefix, Which::left_behind);
  for (const char* prefix : {"ttyUSB", "ttyACM"}) {
    const auto found = names_in("/dev", prefix, Which::all);
    list.devices.insert(list.devices.end(), found.begin(), found.end());
  }
  return list;
}

}  // namespace vsa::serial
