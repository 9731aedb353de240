// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <set>

#include "config/build.hpp"
#include "vsa/config/preset.hpp"
#include "vsa/config/text.hpp"
#include "vsa/files.hpp"

namespace vsa::config {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kEnding = ".toml";

std::vector<fs::path> standard_directories() {
  std::vector<fs::path> directories;
  if (const char* path = std::getenv("VSA_PRESET_PATH")) {
    for (const std::string& part : split(path, ':')) {
      if (!part.empty()) directories.emplace_back(part);
    }
  }
  for (const fs::path& data : data_directories()) directories.push_back(data / "presets");
  return directories;
}

std::string read_text(const fs::path& file) {
  auto text = read_file(file);
  if (!text) throw InputError(Problem{file.string(), "", "", "can't be read: no such file, or no permission", ""});
  return std::move(*text);
}

std::string searched_text(const std::vector<std::string>& names, const std::vector<fs::path>& directories) {
  std::string text = names.empty() ? "none found" : join(names);
  for (const fs::path& d : directories) text += (d == directories.front() ? "; searched " : ", ") + d.string();
  return text;
}

}  // namespace

PresetLibrary::PresetLibrary(std::vector<fs::path> directories, LawRegistry laws)
    : directories_(directories.empty() ? standard_directories() : std::move(directories)), laws_(std::move(laws)) {}

std::vector<std::string> PresetLibrary::names() const {
  std::set<std::string> names;
  for (const fs::path& directory : directories_) {
    std::error_code error;
    for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
      if (it->path().extension() == kEnding) names.insert(it->path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

Preset PresetLibrary::load(std::string_view name, const std::vector<Override>& overrides) const {
  // Only names of files in the directories are presets: "../x" is none, wherever it may lead.
  const std::vector<std::string> known = names();
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    for (const fs::path& directory : directories_) {
      const fs::path file = directory / (std::string(name) + std::string(kEnding));
      std::error_code error;
      if (fs::exists(file, error)) return load_file(file, overrides);
    }
  }
  throw InputError(Problem{"", "preset", '"' + std::string(name) + '"', "unknown preset", searched_text(known, directories_)});
}

Preset PresetLibrary::load_file(const fs::path& file, const std::vector<Override>& overrides) const {
  return load_text(read_text(file), file, overrides);
}

Preset PresetLibrary::load_text(std::string_view text, const fs::path& file, const std::vector<Override>& overrides) const {
  Problems problems;
  const Document document = read_document(text, file.string(), problems);
  if (!document.readable) problems.throw_if_any();
  Preset preset = build_preset(document, overrides, laws_, problems);
  if (!document.name.empty() && document.name != file.stem().string()) {
    problems.add({file.string(), "preset.name", '"' + document.name + '"', "differs from the file's name", file.stem().string()});
  }
  problems.throw_if_any();
  return preset;
}

}  // namespace vsa::config
