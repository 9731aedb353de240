// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::config {

/// The program was linked to an installation whose data lie there: data_directories() ends with it.
/// Called before main() by a file that the CMake package adds to whoever links it. `directory` is kept as it is: a literal.
void installed_in(const char* directory) noexcept;

/// The same of a library that another's program loads, as Python does a module: the data lie there, and what lies beside that
/// program isn't ours. Null: no longer.
void loaded_with(const char* directory) noexcept;

}  // namespace vsa::config
