// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/find_file.hpp"

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "vsa/config/preset.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

std::string built_in_names(const fs::path& folder, const std::string& extension) {
  std::string list;
  for (const auto& name : built_in_files(folder, extension)) list += ", " + name;
  return list;
}

}  // namespace

std::vector<std::string> built_in_files(const fs::path& folder, const std::string& extension) {
  std::vector<std::string> names;
  const auto directory = config::find_data(folder);
  if (!directory) return names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(*directory, none)) {
    if (entry.path().extension() == extension) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path find_file(const std::string& given, const std::string& what, const fs::path& folder, const std::string& extension) {
  std::error_code none;
  if (fs::is_regular_file(given, none)) return given;
  const bool plain_name = !given.empty() && fs::path(given).filename() == given;
  for (const auto& name : {given, given + extension}) {
    const auto found = plain_name ? config::find_data(folder / name) : std::nullopt;
    if (found && fs::is_regular_file(*found, none)) return *found;
  }
  throw InputError({"", what, given, fs::is_directory(given, none) ? "is a directory" : "no such file",
                    "a file" + built_in_names(folder, extension)});
}

}  // namespace vsa::app
