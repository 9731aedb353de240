// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the pages of a type's linearisation and of a world's share.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "vsa/linear/linear.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {

/// Four digits; "–" where it isn't finite.
[[nodiscard]] std::string digits(double value);
[[nodiscard]] double degrees(std::complex<double> z);
/// Over the frequency, in decades.
[[nodiscard]] report::Chart bode(const char* title, const char* y_label, bool y_log, std::vector<report::Curve> curves,
                                 const char* caption);
/// `moves`: of each pole, in a column of its own; may be empty.
[[nodiscard]] report::Table pole_table(const std::vector<linear::Pole>& poles, double period_s,
                                       const std::vector<std::string>& moves);
/// A, B and C.
[[nodiscard]] std::vector<report::Block> matrix_tables(const linear::System& system);
/// A blank line, the title and the rows.
[[nodiscard]] std::string table_lines(const report::Table& table);

}  // namespace vsa::app
