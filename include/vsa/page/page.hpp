// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A page: one HTML file that needs nothing else, no network either. The template (web/, built into share/vsa/web) carries the
// program; the data go where its marker is, as JSON. Everything that came from a user's file is data to the page, never markup.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vsa::page {

inline constexpr std::string_view kMarker = "@VSA_PAGE_DATA@";  ///< where the data go

/// Reads the template and checks that it has the marker once. Throws InputError.
[[nodiscard]] std::string read_template(const std::filesystem::path& file);

/// The template with the data in it.
[[nodiscard]] std::string filled(std::string_view page_template, std::string_view json);

/// Writes template + data to `file`: beside it first, then renamed, so that there is never half a page. Throws OutputError.
void write(const std::filesystem::path& file, std::string_view page_template, std::string_view json);

}  // namespace vsa::page
