// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa actuators --laws`: the elastic laws that types may name, and their keys.
#pragma once

#include <string>

namespace vsa::app {

/// Prints both tables, or writes them between the lines "<!-- vsa actuators --laws: tables -->" and "…: end of tables -->" of the
/// file `markdown`. The exit code; throws InputError for a file without the lines, std::runtime_error for one that can't be written.
int run_laws(const std::string& markdown);

}  // namespace vsa::app
