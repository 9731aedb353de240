// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The page of a data sheet: numbers with where each comes from, curves, one A4 page.
#pragma once

#include <optional>
#include <string>

#include "characterize/runs.hpp"
#include "vsa/experiment/datasheet.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {

/// What law and drive tell, and what the benches showed: the same runs and measures as `vsa characterize`.
struct SheetData {
  experiment::DataSheet computed;
  Characterization simulated;

  [[nodiscard]] std::string preset_unit() const { return simulated.preset_unit(); }
  [[nodiscard]] bool has_preset() const { return !preset_unit().empty() && computed.columns.size() > 1; }
  /// M g r of the load bench; none where nothing ran on it.
  [[nodiscard]] std::optional<double> nominal_load_Nm() const;
};

[[nodiscard]] std::vector<report::Figure> key_figures(const SheetData& d);
[[nodiscard]] report::Table mechanical_table(const SheetData& d);
[[nodiscard]] report::Table electrical_table(const SheetData& d);
[[nodiscard]] report::Table preset_table(const SheetData& d);
[[nodiscard]] std::vector<report::Block> sheet_charts(const SheetData& d);

[[nodiscard]] report::Report data_sheet_report(const SheetData& d, const std::string& command);
/// The tables as text.
[[nodiscard]] std::string data_sheet_text(const SheetData& d);

/// "0.302": three digits that count; "–" where there is no number.
[[nodiscard]] std::string number(double value);

}  // namespace vsa::app
