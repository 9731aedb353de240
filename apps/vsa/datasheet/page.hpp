// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The page of a data sheet: numbers with where each comes from, curves, one A4 page.
#pragma once

#include <string>
#include <vector>

#include "vsa/report/report.hpp"
#include "vsa/study/data_sheet.hpp"

namespace vsa::app {

[[nodiscard]] std::vector<report::Figure> key_figures(const study::DataSheet& d);
[[nodiscard]] report::Table mechanical_table(const study::DataSheet& d);
[[nodiscard]] report::Table electrical_table(const study::DataSheet& d);
[[nodiscard]] report::Table preset_table(const study::DataSheet& d);
[[nodiscard]] std::vector<report::Block> sheet_charts(const study::DataSheet& d);

[[nodiscard]] report::Report data_sheet_report(const study::DataSheet& d, const std::string& command);
/// The tables as text.
[[nodiscard]] std::string data_sheet_text(const study::DataSheet& d);

/// Whether a stiffness is worth a place on a logarithmic axis beside the largest of its curve: where a law gives way it falls to 0.
[[nodiscard]] bool shown(double stiffness, double largest);

/// "0.302": three digits that count; "–" where there is no number.
[[nodiscard]] std::string number(double value);

/// A value of each motor or encoder: once where all are alike, else one after the other, as "0.8, 0.5".
template <class Values, class Text>
std::string of_each(const Values& values, const Text& text) {
  std::string all;
  bool alike = true;
  for (const auto& v : values) {
    alike = alike && text(v) == text(values[0]);
    all += (all.empty() ? "" : ", ") + text(v);
  }
  return alike ? text(values[0]) : all;
}

}  // namespace vsa::app
