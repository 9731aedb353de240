// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Reports for the tests.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "vsa/report/report.hpp"

namespace vsa::report::samples {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Every kind of block; curves of every style, with gaps.
inline Report full() {
  Chart loop{
      "Torque against deflection", "deflection [rad]", "load torque [N·m]", {}, "The loop's area is what a cycle loses.", false};
  Chart log{"Stiffness", "load torque [N·m]", "stiffness [N·m/rad]", {}, "", true};
  const auto style = [](const char* name, Curve::Style s, int color, const char* group) {
    Curve c;
    c.name = name;
    c.style = s;
    c.color = color;
    c.group = group;
    return c;
  };
  std::vector<Curve> all{style("hardware, rising", Curve::Style::line, 0, "hardware"),
                         style("scatter", Curve::Style::band, 0, "hardware"), style("simulation", Curve::Style::dashed, 1, ""),
                         style("2015", Curve::Style::dotted, 2, ""), style("points", Curve::Style::markers, 3, "")};
  for (Curve& c : all) {
    for (int i = -20; i <= 20; ++i) {
      const double x = i * 0.03, shift = 0.01 * c.color;
      c.x.push_back(x);
      c.y.push_back(i == 7 ? kNaN : 0.3 * std::sinh(6.85 * (x - shift)) / std::sinh(6.85 * 0.6) * 5);
      if (c.style == Curve::Style::band || c.style == Curve::Style::markers) c.error.push_back(0.08);
    }
  }
  loop.curves = all;
  Curve stiff = style("preset 0", Curve::Style::line, 4, "");
  for (int i = 0; i <= 20; ++i) {
    stiff.x.push_back(i * 0.075);
    stiff.y.push_back(0.3 * std::exp(0.2 * i));
  }
  log.curves = {stiff};
  const Table table{
      "RMS of deflection",
      {"preset", "ours", "2015 simulation", "bound"},
      {{"0 rad", "0.0087", "0.247", "0.020"}, {"0.6903 rad", "0.0046", "0.0336", "0.009"}, {"mean", "0.0067", "–", ""}},
      "Both branches, |τ| ≤ 1.4 N·m."};
  const Figures figures{{{"preset 0", "0.0087 rad", "bound 0.020 rad", Figure::Verdict::good},
                         {"preset 0.6903 rad", "0.0146 rad", "bound 0.009 rad", Figure::Verdict::bad},
                         {"recordings", "2", "qbmove maker pro", Figure::Verdict::none}}};
  Report r;
  r.title = "Validation of qbmove_maker_pro_6_1";
  r.subtitle = "simulation against every recording";
  r.sections = {{"Summary", {Text{"What agrees, by how much, and what doesn't."}, figures, table}},
                {"Curves", {loop, log}},
                {"Notes", {Text{"Nothing else."}}}};
  r.footer = "vsa validate · vsasim 0.1.0";
  return r;
}

/// What leads to other pages: cards, bars and a table with links.
inline Report gallery(const std::string& text = "soft & stiff") {
  Report r;
  r.title = "Gallery";
  r.links = {{text, "comparison.html"}};
  Cards cards;
  cards.x_label = "load [N·m]";
  cards.y_label = "stiffness [N·m/rad]";
  cards.cards = {
      {text, "law", "measured", "one.html", {0.02, 0.2, 2}, {0.5, 0.6, 4}, {30, 31, 60}, {{{"torque", "2 N·m"}}}},
      {"a line", "law", "symbolic", "two.html", {0.1, 1, 10}, {160, 160, 160}, {160, 160, 160}, {{{"torque", "10 N·m"}}}},
      {"nothing", "", "", "", {}, {}, {}, {}}};
  cards.caption = "equal axes";
  Bars bars{
      "Farthest", {{text, 4, "4 m", "preset 0", "one.html"}, {"half", 2, "2 m", "", ""}, {"none", kNaN, "–", "", ""}}, "caption"};
  Table table{"Table", {"type", "torque"}, {{text, "2"}, {"plain", "3"}}, "", {"one & only.html", ""}};
  Chart left{"Left", "x [1]", "y [1]", {curve("a", {1, 10}, {1, 2}, Curve::Style::line, 0)}, "", false, true};
  left.x_range = {1, 100};
  left.y_range = {0, 5};
  r.sections = {{"Cards", {cards}}, {"Bars", {bars, bars}}, {"Numbers", {table, left}}};
  return r;
}

/// As dense as a data sheet gets; `lines` rows in each of two tables.
inline Report sheet(int lines) {
  Report r = full();
  r.one_page = true;
  const Chart chart = std::get<Chart>(r.sections[1].blocks[0]);
  Table table{"Operating data", {"quantity", "value", "unit", "from"}, {}, ""};
  for (int i = 0; i < lines; ++i) table.rows.push_back({"quantity " + std::to_string(i), std::to_string(i) + ".5", "N·m", "law"});
  r.sections = {{"", {r.sections[0].blocks[1]}}, {"Curves", {chart, chart, chart, chart}}, {"Data", {table, table}}};
  return r;
}

}  // namespace vsa::report::samples
