// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/markdown.hpp"

#include "vsa/errors.hpp"
#include "vsa/files.hpp"

namespace vsa::app {
namespace {

std::size_t once(const std::string& text, std::string_view marker, const std::filesystem::path& file) {
  const std::size_t at = text.find(marker);
  if (at == std::string::npos || text.find(marker, at + 1) != std::string::npos) {
    throw InputError({file.string(), "--markdown", "", "this line isn't there exactly once", std::string(marker)});
  }
  return at;
}

}  // namespace

std::string with_tables(const std::filesystem::path& file, const Markers& markers, const std::string& tables) {
  const std::string block = std::string(markers.begin) + "\n\n" + tables + std::string(markers.end);
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return block + '\n';
  const auto text = read_file(file);
  if (!text) {
    throw InputError({file.string(), "--markdown", "", "isn't a file that can be read", "a Markdown file, or a new name"});
  }
  const std::size_t begin = once(*text, markers.begin, file), end = once(*text, markers.end, file);
  if (end < begin)
    throw InputError({file.string(), "--markdown", "", "the markers are in the wrong order", std::string(markers.begin)});
  return text->substr(0, begin) + block + text->substr(end + markers.end.size());
}

}  // namespace vsa::app
