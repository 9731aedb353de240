// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vsa::record {

/// Length of the well-formed UTF-8 sequence at `at`, 0 if it is none (overlong, surrogate, cut short, beyond U+10FFFF).
[[nodiscard]] std::size_t utf8_length(std::string_view text, std::size_t at);

/// The text with every byte that isn't UTF-8 replaced by U+FFFD.
[[nodiscard]] std::string well_formed(std::string_view text);

}  // namespace vsa::record
