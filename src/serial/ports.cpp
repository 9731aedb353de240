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

/// Its owner holds a lock on the file beside it.
bool alive(const fs::path& link) {
  const std::string lock = (link.parent_path() / ("." + link.filename().string() + ".lock")).string();
  const Descriptor fd(open(lock.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NOCTTY | O_NONBLOCK));
  return fd && flock(fd.get(), LOCK_SH | LOCK_NB) != 0;
}

std::vector<std::string> names_in(const fs::path& where, std::string_view prefix, bool links) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(where, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    std::error_code ignored;
    if (name.rfind(prefix, 0) != 0 || (links && !at->is_symlink(ignored))) continue;
    if (!links || alive(at->path())) names.push_back(at->path().string());
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
  list.virtual_ports = names_in(directory(), kPrefix, true);
  for (const char* prefix : {"ttyUSB", "ttyACM"}) {
    const auto found = names_in("/dev", prefix, false);
    list.devices.insert(list.devices.end(), found.begin(), found.end());
  }
  return list;
}

}  // namespace vsa::serial
