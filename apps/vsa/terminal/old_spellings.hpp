// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Old spellings of types, robots and their directories: told by every command, wherever it reads them.
#pragma once

#include <string>

namespace vsa::app {

/// From now on each is a line on standard error, once: "vsa: [preset] is called [type] now: …".
void tell_old_spellings(const std::string& program);

}  // namespace vsa::app
