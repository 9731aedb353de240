// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "validate/output.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"

namespace vsa::app {
namespace {

std::size_t once(const std::string& text, const std::string& marker, const std::filesystem::path& file) {
  const std::size_t at = text.find(marker);
  if (at == std::string::npos || text.find(marker, at + 1) != std::string::npos) {
    throw InputError({file.string(), "--markdown", "", "this line isn't there exactly once", marker});
  }
  return at;
}

}  // namespace

std::string with_tables(const std::filesystem::path& file, const std::string& tables) {
  const std::string block = std::string(kMarkdownBegin) + "\n\n" + tables + kMarkdownEnd;
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return block + '\n';
  const auto text = read_file(file);
  if (!text) {
    throw InputError({file.string(), "--markdown", "", "isn't a file that can be read", "a Markdown file, or a new name"});
  }
  const std::size_t begin = once(*text, kMarkdownBegin, file), end = once(*text, kMarkdownEnd, file);
  if (end < begin) throw InputError({file.string(), "--markdown", "", "the markers are in the wrong order", kMarkdownBegin});
  return text->substr(0, begin) + block + text->substr(end + std::string_view(kMarkdownEnd).size());
}

}  // namespace vsa::app
