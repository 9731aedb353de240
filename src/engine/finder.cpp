// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "finder.hpp"

#include <cstdlib>

#include "vsa/config/preset.hpp"

namespace vsa::engine {
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

bool there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

}  // namespace

Finder::Finder(const std::vector<fs::path>& more) {
  add_from_environment("SDF_PATH", directories_);
  add_from_environment("IGN_GAZEBO_RESOURCE_PATH", directories_);
  const fs::path data = config::data_directory();
  if (!data.empty()) directories_.push_back(data / "models");
  directories_.insert(directories_.end(), more.begin(), more.end());
}

fs::path Finder::find(std::string_view uri, const fs::path& base) const {
  if (take_prefix(uri, "model://")) {
    for (const fs::path& directory : directories_) {
      if (const fs::path path = directory / uri; there(path)) return path;
    }
    return {};
  }
  take_prefix(uri, "file://");
  const fs::path path = fs::path(uri).is_absolute() ? fs::path(uri) : base / uri;
  return there(path) ? path : fs::path{};
}

std::string Finder::searched() const {
  std::string text;
  for (const fs::path& directory : directories_) text += (text.empty() ? "" : ", ") + directory.string();
  return text;
}

}  // namespace vsa::engine
