// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Aligned columns of UTF-8 text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::app {

/// Columns that a text takes on a terminal: its code points (no text of ours has wide or combining ones).
[[nodiscard]] std::size_t display_width(std::string_view utf8);

/// Breaks at spaces; a word longer than `width` stays whole.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// The first row is the header. The last column is wrapped to `width` in total; where that leaves it less than 30 columns it moves
/// to lines of its own. Width 0: no wrapping, one line a row.
[[nodiscard]] std::string table_text(const std::vector<std::vector<std::string>>& rows, std::size_t width);

/// Columns of the terminal that standard output is; 0: it is none.
[[nodiscard]] std::size_t terminal_width();

}  // namespace vsa::app
