// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vsa {

/// All bytes of a file. None: it isn't there, is no regular file (a directory, a pipe), may not be read or can't be to its end; errno
/// says which.
[[nodiscard]] std::optional<std::string> read_file(const std::filesystem::path& file);

/// A text as one word for a POSIX shell, for commands that are shown to be copied: as it is where a shell takes it so, else in single
/// quotes.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace vsa
