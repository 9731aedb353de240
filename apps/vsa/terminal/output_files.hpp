// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::app {

/// Makes the directory where it is missing. Throws InputError naming `flag` where it can't.
void make_directory(const std::filesystem::path& directory, const std::string& flag);

}  // namespace vsa::app
