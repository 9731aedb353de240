// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/description/world.hpp"

#include <algorithm>

namespace vsa::description {

double Heightmap::highest() const { return heights.empty() ? 0.0 : *std::max_element(heights.begin(), heights.end()); }

}  // namespace vsa::description
