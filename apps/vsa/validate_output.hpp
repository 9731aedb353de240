// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa validate` leaves behind: report.html, results.json, and tables for a Markdown file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validate_runs.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {

[[nodiscard]] std::vector<report::Table> validation_tables(const Validation& v);
[[nodiscard]] std::string validation_text(const Validation& v);
[[nodiscard]] std::string results_json(const Validation& v);
[[nodiscard]] report::Report validation_report(const Validation& v);

/// The tables stand between these lines of the Markdown file.
inline constexpr const char* kMarkdownBegin = "<!-- vsa validate: tables -->";
inline constexpr const char* kMarkdownEnd = "<!-- vsa validate: end of tables -->";

/// The file's text with new tables; a file that isn't there yet has nothing else. Throws InputError where the markers aren't there,
/// each once, in order, or the file can't be read.
[[nodiscard]] std::string with_tables(const std::filesystem::path& file, const std::string& tables);
[[nodiscard]] std::string markdown_tables(const Validation& v);

}  // namespace vsa::app
