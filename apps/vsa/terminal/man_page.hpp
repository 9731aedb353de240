// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa(1), worked out from the command line's own definition: `vsa --man` prints it when the project is built.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace vsa::app {

/// In roff, for man and groff; ASCII only, other characters as escapes.
[[nodiscard]] std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace vsa::app
