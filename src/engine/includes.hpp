// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A look at the files before libsdformat reads them. It follows circular includes until memory ends, and throws a bare
// std::exception at a version that isn't a number.
#pragma once

#include "read_context.hpp"
#include "sdf_world.hpp"

namespace vsa::engine {

/// Adds a problem for a circle of <include>s and for an SDF version that this program can't read; true where there is none.
[[nodiscard]] bool check_includes(const SdfSource& source, ReadContext& context);

}  // namespace vsa::engine
