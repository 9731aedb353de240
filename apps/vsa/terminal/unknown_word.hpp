// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Words of a command line that mean nothing: named, with the nearest that does.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace vsa::app {

/// Throws InputError where the first word is no command; `left_out`: those that there are, but not in this build.
void refuse_unknown_command(const CLI::App& app, const std::vector<std::string>& arguments,
                            const std::vector<std::string>& left_out);

/// After a parse that failed for words nobody expected (CLI::ExtrasError): throws InputError for the first option among them, else
/// for the first word; returns where there is none.
void refuse_unexpected(const CLI::App& app);

/// After a parse that failed for a value that is none of its option's kind: throws InputError with option, value and what is allowed;
/// returns where the error is another.
void refuse_unreadable(const CLI::App& app, const CLI::ConversionError& error);

}  // namespace vsa::app
