// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A sweep's table as a page: each measure by each axis, maps over two axes, and all of them at once as parallel coordinates.
#pragma once

#include <string>
#include <vector>

#include "vsa/report/report.hpp"
#include "vsa/sweep/folder.hpp"

namespace vsa::sweep {

/// Quartiles, interpolated; NaN of nothing. What isn't finite doesn't count.
struct Quartiles {
  std::size_t count = 0;  ///< that are finite
  double low = 0,         ///< a quarter lies below
      median = 0,         ///< half of them lie below
      high = 0;           ///< a quarter lies above
};
[[nodiscard]] Quartiles quartiles(std::vector<double> values);  ///< of the finite ones

/// The results of a sweep as a page: each measure by each axis, maps, and all at once.
[[nodiscard]] report::Report summary(const Plan& plan, const Results& results, const std::string& command);

}  // namespace vsa::sweep
