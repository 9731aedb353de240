// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vsa::config {

/// What a user names: a file, or the stem of a built-in one (`folder`/NAME`extension` in a data directory). A file wins.
/// A relative file is looked for in `beside`. Throws InputError with the built-in names there are. `what`: "world", "gait".
[[nodiscard]] std::filesystem::path find_file(const std::string& given, const std::string& what,
                                              const std::filesystem::path& folder, const std::string& extension,
                                              const std::filesystem::path& beside = {});

/// The stems of the built-in files, sorted.
[[nodiscard]] std::vector<std::string> built_in_files(const std::filesystem::path& folder, const std::string& extension);

}  // namespace vsa::config
