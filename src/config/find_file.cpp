// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/find_file.hpp"

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::vector<std::string> built_in_files(const fs::path& folder, const std::string& extension) {
  std::vector<std::string> names;
  const auto directory = find_data(folder);
  if (!directory) return names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(*directory, none)) {
    if (entry.path().extension() == extension) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path find_file(const std::string& given, const std::string& what, const fs::path& folder, const std::string& extension,
                   const fs::path& beside) {
  std::error_code none;
  if (fs::is_regular_file(beside / given, none)) return beside / given;
  const bool plain_name = !given.empty() && fs::path(given).filename() == given;
  for (const auto& name : {given, given + extension}) {
    const auto found = plain_name ? find_data(folder / name) : std::nullopt;
    if (found && fs::is_regular_file(*found, none)) return *found;
  }
  std::vector<std::string> known = built_in_files(folder, extension);
  const bool directory = fs::is_directory(beside / given, none);
  std::string why = directory ? "is a directory" : "no such file" + did_you_mean(given, known);
  if (known.empty() && !find_data(folder)) {  // a name of ours, perhaps, that was looked for in the wrong place
    std::vector<std::string> places;
    for (const fs::path& place : data_directories()) places.push_back((place / folder).string());
    why += ", and no data directory in which built-in ones would be: looked for " + join(places) +
           " (VSA_DATA_DIR says where; vsa doctor tells more)";
  }
  known.insert(known.begin(), "a file");
  throw InputError({"", what, given, why, join(known)});
}

}  // namespace vsa::config
