// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/input_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "sdf/xml_place.hpp"
#include "vsa/errors.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

std::string key_of(const fs::path& file) {
  std::error_code ignored;
  return fs::weakly_canonical(file, ignored).string();
}

}  // namespace

void InputFiles::replace(const fs::path& file, const std::string& text) {
  if (!directory_) directory_.emplace();
  const fs::path copy = directory_->path() / fmt::format("{}_{}", copy_of_.size(), file.filename().string());
  std::ofstream out(copy, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw InputError(Problem{copy.string(), "", "", "can't be written", "a TMPDIR with space"});
  copy_of_[key_of(file)] = copy.string();
  original_of_[copy.string()] = file.string();
}

void InputFiles::call(const fs::path& file) { original_of_[fs::absolute(file).string()] = file.string(); }

void InputFiles::keep(const std::string& file, std::unique_ptr<const tinyxml2::XMLDocument> xml) {
  if (xml->RootElement() != nullptr && is(*xml->RootElement(), "sdf")) sdfs.push_back({file, std::move(xml)});
}

fs::path InputFiles::stand_in(const fs::path& file) const {
  const auto it = copy_of_.find(key_of(file));
  return it == copy_of_.end() ? file : fs::path(it->second);
}

std::string InputFiles::original(const std::string& path) const {
  const auto it = original_of_.find(path);
  return it == original_of_.end() ? path : it->second;
}

bool InputFiles::is_urdf(const std::string& file) const {
  return std::any_of(urdfs.begin(), urdfs.end(), [&](const Urdf& urdf) { return urdf.file == file; });
}

std::string InputFiles::with_originals(std::string text) const {
  for (const auto& [copy, file] : original_of_) {
    if (file.empty() || copy.find(file) != std::string::npos) continue;
    for (std::size_t at = text.find(copy); at != std::string::npos; at = text.find(copy, at + file.size()))
      text.replace(at, copy.size(), file);
  }
  return text;
}

}  // namespace vsa::reader
