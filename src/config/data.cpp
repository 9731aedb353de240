// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "vsa/config/actuator_type.hpp"
#include "vsa/config/installed.hpp"
#include "vsa/config/text.hpp"

namespace vsa::config {
namespace fs = std::filesystem;
namespace {

constinit std::atomic<const char*> installed_data{nullptr}, module_data{nullptr};

}  // namespace

void installed_in(const char* directory) noexcept { installed_data.store(directory); }
void loaded_with(const char* directory) noexcept { module_data.store(directory); }

std::vector<fs::path> data_directories() {
  const char* set = std::getenv("VSA_DATA_DIR");
  if (set != nullptr && *set != '\0') return {fs::path(set)};
  if (const char* own = module_data.load()) return {fs::path(own)};
  std::vector<fs::path> directories;
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) directories.push_back((executable.parent_path() / ".." / "share" / "vsa").lexically_normal());
  if (const char* installed = installed_data.load()) directories.emplace_back(installed);
  return directories;
}

std::optional<fs::path> find_data(const fs::path& relative) {
  for (const fs::path& directory : data_directories()) {
    std::error_code error;
    if (fs::exists(directory / relative, error)) return directory / relative;
  }
  return std::nullopt;
}

fs::path data_directory() {
  for (const char* name : {"actuators", "presets"}) {  // presets: as it was called before, for one more release
    if (const auto types = find_data(name)) return types->parent_path();
  }
  std::vector<std::string> places;
  for (const fs::path& directory : data_directories()) places.push_back(directory.string());
  const char* set = std::getenv("VSA_DATA_DIR");
  throw InputError(Problem{set != nullptr ? "VSA_DATA_DIR" : "", "data directory", join(places), "has no actuators/",
                           "a directory with actuators/ and models/; set VSA_DATA_DIR"});
}

}  // namespace vsa::config
