// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::app {

/// Makes the directory where it is missing. Throws InputError naming `flag` where it can't.
void make_directory(const std::filesystem::path& directory, const std::string& flag);

/// Beside it first, then renamed, so that there is never half a file. Throws std::runtime_error with the path and the reason.
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace vsa::app
