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

/// text(way) of a column's two directions: once where both read the same, else "5.04 (+q) / 3.84 (−q)".
template <class Text>
std::string ways(const experiment::PresetColumn& c, const Text& text) {
  const std::string to = text(c), fro = text(c.back);
  return to == fro ? to : to + " (+q) / " + fro + " (−q)";
}

/// Whether it can tell +q from −q: of unequal springs or motors.
[[nodiscard]] bool lopsided(const study::DataSheet& d);

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
