// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/description/world.hpp"

#include <algorithm>

namespace vsa::description {

double Heightmap::highest() const { return heights.empty() ? 0.0 : *std::max_element(heights.begin(), heights.end()); }

double Coupling::at(double q) const { return offset + q * (multiplier + q * (higher[0] + q * (higher[1] + q * higher[2]))); }

double Coupling::slope(double q) const { return multiplier + q * (2 * higher[0] + q * (3 * higher[1] + q * 4 * higher[2])); }

}  // namespace vsa::description
