// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Data sheets of many types: a gallery that leads to each (index.html), and a page that compares them (comparison.html).
#pragma once

#include <string>
#include <vector>

#include "vsa/report/report.hpp"
#include "vsa/study/data_sheet.hpp"

namespace vsa::app {

inline constexpr const char* kGalleryFile = "index.html";
inline constexpr const char* kComparisonFile = "comparison.html";
/// Of a type's data sheet beside them.
[[nodiscard]] std::string sheet_file(const study::DataSheet& d);

/// Linear actuators as the benches have them, on a pinion, so that all are in N·m and rad.
[[nodiscard]] std::vector<study::DataSheet> comparable(std::vector<study::DataSheet> sheets);

/// A card a type: its stiffness against load from softest to stiffest, on axes that all cards share.
[[nodiscard]] report::Report gallery_page(const std::vector<study::DataSheet>& sheets, const std::string& command);

/// What a user chooses by (experiment/datasheet.hpp), a row a type in the order given; of comparable() sheets.
[[nodiscard]] report::Table strength_table(const std::vector<study::DataSheet>& sheets);
[[nodiscard]] report::Table stiffness_range_table(const std::vector<study::DataSheet>& sheets);
[[nodiscard]] report::Table holding_table(const std::vector<study::DataSheet>& sheets);
[[nodiscard]] report::Report comparison_page(const std::vector<study::DataSheet>& sheets, const std::string& command);

/// "0.3 … 30"; one number where both read the same.
[[nodiscard]] std::string span_text(double low, double high);
/// σ at rest: at preset 0, and at the largest preset that the motors wind to.
[[nodiscard]] std::array<double, 2> stiffness_at_rest(const study::DataSheet& d);

}  // namespace vsa::app
