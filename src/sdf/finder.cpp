// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sdf/finder.hpp"

#include <algorithm>
#include <cstdlib>

#include "vsa/config/actuator_type.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

void add_from_environment(const char* variable, std::vector<fs::path>& out) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t colon = rest.find(':');
    const std::string_view one = rest.substr(0, colon);
    if (!one.empty()) out.emplace_back(one);
    rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
  }
}

bool take_prefix(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

SearchPath::SearchPath(const std::vector<fs::path>& more) {
  for (const char* name : {"SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"})
    add_from_environment(name, directories);
  add_from_environment("GAZEBO_RESOURCE_PATH", resources);
  directories.insert(directories.end(), resources.begin(), resources.end());
  for (const char* name : {"AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"}) add_from_environment(name, prefixes);
  add_from_environment("ROS_PACKAGE_PATH", packages);
  // A world that brings all its own is read without them.
  if (const auto models = config::find_data("models")) {
    directories.push_back(*models);
    last.push_back(*models / "stand_ins");
  }
  directories.insert(directories.end(), more.begin(), more.end());
}

/// A package of this name below `root`: a folder with a package.xml.
fs::path Finder::package_below(const fs::path& root, const fs::path& name, int depth) const {
  std::error_code error;
  seen_.reads(root);
  for (fs::directory_iterator it(root, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (!it->is_directory(ignored)) continue;
    const fs::path& folder = it->path();
    if (folder.filename() == name && seen_.asks(folder / "package.xml")) return folder;
    if (depth <= 1) continue;
    if (fs::path found = package_below(folder, name, depth - 1); !found.empty()) return found;
  }
  return {};
}

fs::path Finder::in_package(std::string_view name_and_rest) const {
  for (const fs::path& directory : path_.directories) {
    if (fs::path path = directory / name_and_rest; seen_.asks(path)) return path;
  }
  const std::size_t slash = name_and_rest.find('/');
  const fs::path name = name_and_rest.substr(0, slash);
  const fs::path rest = slash == std::string_view::npos ? fs::path() : fs::path(name_and_rest.substr(slash + 1));
  for (const fs::path& prefix : path_.prefixes) {
    for (const fs::path& share : {prefix / "share", prefix / name / "share"}) {
      if (fs::path path = share / name_and_rest; seen_.asks(path)) return path;
    }
  }
  for (const fs::path& directory : path_.packages) {
    constexpr int kFolders = 3;
    const bool itself = directory.filename() == name;
    for (const fs::path& folder : {itself ? directory : directory / name, package_below(directory, name, kFolders)}) {
      if (!folder.empty() && seen_.asks(folder) && seen_.asks(folder / rest)) return rest.empty() ? folder : folder / rest;
    }
  }
  for (const fs::path& directory : path_.last) {
    if (fs::path path = directory / name_and_rest; seen_.asks(path)) return path;
  }
  return {};
}

fs::path Finder::find(std::string_view uri, const fs::path& base) const {
  if (take_prefix(uri, "model://") || take_prefix(uri, "package://")) return in_package(uri);
  take_prefix(uri, "file://");
  if (const fs::path path(uri); path.is_absolute()) return seen_.asks(path) ? path : fs::path{};
  if (fs::path path = base / uri; seen_.asks(path)) return path;
  for (const auto* places : {&path_.resources, &path_.directories}) {
    for (const fs::path& directory : *places) {
      if (fs::path path = directory / uri; seen_.asks(path)) return path;
    }
  }
  return {};
}

std::string Finder::searched(std::string_view uri, const fs::path& base) const {
  if (uri.find("://") != std::string_view::npos && uri.substr(0, 7) != "file://" && uri.substr(0, 8) != "model://" &&
      uri.substr(0, 10) != "package://")
    return "a file of this machine: nothing is downloaded";
  const bool plain = uri.find("://") == std::string_view::npos || uri.substr(0, 7) == "file://";
  std::string text;
  std::vector<std::string> told;  // several variables may name one directory
  const auto add = [&](const std::vector<fs::path>& paths, const char* more) {
    for (const fs::path& path : paths) {
      const std::string place = path.string() + more;
      if (std::find(told.begin(), told.end(), place) != told.end()) continue;
      told.push_back(place);
      text += (text.empty() ? "a file in: " : ", ") + place;
    }
  };
  if (plain) {
    add({base}, "");
    add(path_.resources, "");
    add(path_.directories, "");
    return text;
  }
  add(path_.directories, "");
  add(path_.prefixes, "/share");
  add(path_.packages, "");
  return text;
}

}  // namespace vsa::reader
