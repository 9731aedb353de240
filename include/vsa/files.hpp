// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace vsa {

/// All bytes of a file. None: it isn't there, is no regular file (a directory, a pipe), may not be read or can't be to its end; errno
/// says which.
[[nodiscard]] std::optional<std::string> read_file(const std::filesystem::path& file);

}  // namespace vsa
