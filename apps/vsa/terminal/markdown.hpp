// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Tables that a command keeps up to date in a Markdown file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vsa::app {

/// The lines between which a command's tables stand.
struct Markers {
  std::string_view begin, end;
};

/// The file's text with `tables` between the markers; a file that isn't there yet has nothing else. Throws InputError (--markdown)
/// where each marker isn't there once, in order, or the file can't be read.
[[nodiscard]] std::string with_tables(const std::filesystem::path& file, const Markers& markers, const std::string& tables);

}  // namespace vsa::app
