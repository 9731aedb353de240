// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/report/sliding.hpp"

#include "vsa/units.hpp"

namespace vsa::report {
namespace {

void all(std::vector<std::string>& words) {
  for (std::string& w : words) w = vsa::sliding(w);
}

}  // namespace

Table sliding(Table table) {
  all(table.head);
  for (std::vector<std::string>& row : table.rows) all(row);
  table.title = vsa::sliding(table.title);
  table.caption = vsa::sliding(table.caption);
  return table;
}

Chart sliding(Chart chart) {
  for (std::string* words : {&chart.title, &chart.x_label, &chart.y_label, &chart.caption}) *words = vsa::sliding(*words);
  for (Curve& curve : chart.curves) curve.name = vsa::sliding(curve.name), curve.group = vsa::sliding(curve.group);
  return chart;
}

std::vector<Figure> sliding(std::vector<Figure> figures) {
  for (Figure& f : figures)
    for (std::string* words : {&f.label, &f.value, &f.note}) *words = vsa::sliding(*words);
  return figures;
}

}  // namespace vsa::report
