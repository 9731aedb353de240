// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa validate` leaves behind: report.html, results.json, and tables and pictures for a Markdown file. Everywhere what was
// predicted stands before what was calibrated, and the two are counted apart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terminal/markdown.hpp"
#include "vsa/report/report.hpp"
#include "vsa/study/validation.hpp"

namespace vsa::app {

struct ValidationTables {
  report::Table left_out, predictions, rms, loops, rms_2015, guards, periods, speeds, preset_steps;
  /// In that order, without those that have no row.
  [[nodiscard]] std::vector<report::Table> shown() const;
};
[[nodiscard]] ValidationTables validation_tables(const study::Validation& v);

/// Where the recordings come from; what the type was calibrated on; where its leave-one-out figures are, and whether they are
/// its.
[[nodiscard]] std::vector<std::string> statements(const study::Validation& v);
/// "Predictions held: 1 of 2; calibrated figures within their guard: 5 of 5."
[[nodiscard]] std::string counts_text(const study::Validation& v);

/// Two of each recording: the loops over each other, and what is between them.
[[nodiscard]] report::Chart loop_chart(const study::RecordingCheck& r, const std::string& kind);
[[nodiscard]] report::Chart residual_chart(const study::RecordingCheck& r);

[[nodiscard]] std::string validation_text(const study::Validation& v);
[[nodiscard]] report::Report validation_report(const study::Validation& v, const std::string& command);

/// The tables stand between these lines of the Markdown file.
inline constexpr Markers kMarkers{"<!-- vsa validate: tables -->", "<!-- vsa validate: end of tables -->"};

/// One row a version stands between these, where a document has them.
inline constexpr Markers kHistory{"<!-- vsa validate: history -->", "<!-- vsa validate: end of history -->"};

/// The document with the version's row made anew: for each name in the table's head that quantity. A quantity with a bound that has no
/// column yet gets one.
[[nodiscard]] std::string with_history(const study::Validation& v, const std::string& version, const std::string& document);

/// A chart in a file of its own; `file` as the Markdown file links to it.
struct Picture {
  std::string title, file, svg;
};
/// Two a recording: figures/STEM-stiffness-P.PPPP.svg and …-residuals-… beside a Markdown file STEM.md.
[[nodiscard]] std::vector<Picture> pictures(const study::Validation& v, const std::filesystem::path& markdown);

[[nodiscard]] std::string markdown_tables(const study::Validation& v, const std::vector<Picture>& pictures,
                                          const std::string& command);

}  // namespace vsa::app
