// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What is told of a shaft, as a linear actuator has it: in m and N (vsa::sliding). Numbers are as they were.
#pragma once

#include <vector>

#include "vsa/report/report.hpp"

namespace vsa::report {

[[nodiscard]] Table sliding(Table table);                                ///< title, head, rows and caption
[[nodiscard]] Chart sliding(Chart chart);                                ///< title, labels, curves and caption
[[nodiscard]] std::vector<Figure> sliding(std::vector<Figure> figures);  ///< labels, values and notes

}  // namespace vsa::report
