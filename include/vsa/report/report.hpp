// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A report: one self-contained HTML page with headings, text, tables and interactive curves, that needs no network and prints well.
// The template (web/, built into share/vsa/web/report.html) carries the program; the data go where its marker is, as JSON. What
// came from a user's file is data to the page, never markup.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace vsa::report {

/// One curve of a chart: a line, markers, or a band.
struct Curve {
  /// How it is drawn; band: an area `error` to both sides.
  enum class Style { line, dashed, dotted, markers, band };
  std::string name;           ///< for the legend
  std::vector<double> x,      ///< as long as y
      y;                      ///< as long as x; what isn't finite is a gap
  std::vector<double> error;  ///< empty, or one a point: error bars (band: half width, needed)
  Style style = Style::line;  ///< how it is drawn
  int color = 0;      ///< index into the page's colour-blind-safe palette; equal index, equal colour; −1: grey, for references
  std::string group;  ///< curves of one group share a legend entry
};

/// Without error bars, and a group of its own.
[[nodiscard]] Curve curve(std::string name, std::vector<double> x, std::vector<double> y, Curve::Style style, int color);

/// A chart with its axes.
struct Chart {
  std::string title,                               ///< of the chart
      x_label,                                     ///< with its unit: "deflection [rad]"
      y_label;                                     ///< with its unit
  std::vector<Curve> curves;                       ///< in the order of the legend
  std::string caption;                             ///< a remark on it; empty: none
  bool y_log = false;                              ///< as x_log
  bool x_log = false;                              ///< as y_log: what isn't positive isn't drawn
  std::optional<std::array<double, 2>> x_range{},  ///< so that charts beside each other have equal axes; none: by the curves
      y_range{};                                   ///< likewise
};

/// A table of texts.
struct Table {
  std::string title;                           ///< heading; empty: none
  std::vector<std::string> head;               ///< column names
  std::vector<std::vector<std::string>> rows;  ///< each as many cells as `head`
  std::string caption;                         ///< a remark on it; empty: none
  std::vector<std::string> links{};            ///< empty, or one a row: the file beside this page that its first cell leads to
};

/// A paragraph.
struct Text {
  std::string text;  ///< a paragraph
};

/// A number that stands out: {"preset 0", "0.0087 rad", "bound 0.020 rad", good}.
struct Figure {
  std::string label,  ///< what it is
      value,          ///< the number with its unit
      note;           ///< a remark; empty: none
  /// In colour.
  enum class Verdict { none, good, bad } verdict = Verdict::none;  ///< what it is shown as
};
/// Some figures beside each other.
struct Figures {
  std::vector<Figure> figures;  ///< in their order
};

/// Horizontal bars from 0, one a row, in the order given: for few numbers of many things.
struct Bars {
  /// One row.
  struct Bar {
    std::string label;  ///< of the row
    double value = 0;   ///< not finite, or below 0: no bar
    std::string text;   ///< what stands at its end: "4.2 m"
    std::string note;   ///< a remark; empty: none
    std::string link;   ///< as Table's
  };
  std::string title;      ///< heading; empty: none
  std::vector<Bar> bars;  ///< in the order given
  std::string caption;    ///< a remark on it; empty: none
};

/// A gallery: a card each with a small picture, all with the same logarithmic axes, and a few numbers; it leads to a page of its own.
struct Cards {
  /// One card.
  struct Card {
    std::string title,                                ///< of the card
        subtitle,                                     ///< in the line below
        tag,                                          ///< a word before the subtitle
        link;                                         ///< the page that it leads to, relative to this one
    std::vector<double> x,                            ///< of the picture
        low,                                          ///< lower edge over x
        high;                                         ///< upper edge; equal ones are a line
    std::vector<std::array<std::string, 2>> figures;  ///< label, value with its unit
  };
  std::string x_label,      ///< with its unit, common to all pictures
      y_label;              ///< with its unit, common to all pictures
  std::vector<Card> cards;  ///< in the order given
  std::string caption;      ///< a remark on it; empty: none
};

using Block = std::variant<Text, Table, Chart, Figures, Bars, Cards>;  ///< one part of a section

/// A heading with what stands below it.
struct Section {
  std::string title;          ///< the heading
  std::vector<Block> blocks;  ///< charts of a section stand side by side where there is room
};

/// A report: one self-contained HTML page of sections with text, tables and interactive curves.
struct Report {
  std::string title,                                ///< of the page
      subtitle;                                     ///< below it; may be empty
  std::vector<Section> sections;                    ///< from top to bottom
  std::string footer;                               ///< the command that made it, versions
  bool one_page = false;                            ///< a data sheet: laid out to print on one A4 page
  std::vector<std::array<std::string, 2>> links{};  ///< other pages beside this one: text, file
};

/// The page's data. Throws std::invalid_argument where a curve's x, y and error differ in length.
[[nodiscard]] std::string to_json(const Report& report);

/// Head, rows and caption of a table for a Markdown document, and an empty line; its title is the document's to set.
[[nodiscard]] std::string to_markdown(const Table& table);

/// One chart as a picture without a page, for documents. Throws as to_json() does.
[[nodiscard]] std::string to_svg(const Chart& chart);

/// The page's program and looks, as the data directories have it. A run that ends in a report asks for it before it begins. Throws
/// InputError where there is none.
[[nodiscard]] std::string page_template();

/// Beside it first, then renamed, so that there is never half a page. Throws OutputError / InputError as page::write does.
void write_report(const Report& report, const std::filesystem::path& file);

}  // namespace vsa::report
