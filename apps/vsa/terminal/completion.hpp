// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a shell offers when the user presses Tab, worked out from the command line's own definition, so that it is never behind it.
// `vsa --complete WORD… LAST` prints it, one per line; vsa.bash asks for it.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace vsa::app {

/// How `LAST`, the last of the words behind "vsa", can go on: subcommands, options, values. Empty where only the shell can help,
/// with its file names.
[[nodiscard]] std::vector<std::string> complete(const CLI::App& app, std::vector<std::string> words);

}  // namespace vsa::app
