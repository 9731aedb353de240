// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One row a version, in a Markdown file: the quantities that the table's head names.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "validate/output.hpp"

namespace vsa::app {
namespace {

using Row = std::vector<std::string>;

constexpr const char* kFirst = "version";
constexpr const char* kNone = "–";

Row cells(std::string_view line) {
  Row out;
  for (std::size_t begin = line.find('|') + 1, end = 0; (end = line.find('|', begin)) != std::string_view::npos; begin = end + 1) {
    const std::string_view cell = line.substr(begin, end - begin);
    const std::size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
    out.emplace_back(from == std::string_view::npos ? "" : cell.substr(from, to - from + 1));
  }
  return out;
}

/// Head and rows of the only table in `text`.
report::Table read_table(const std::string& text) {
  report::Table out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind('|', 0) != 0 || line.rfind("|--", 0) == 0) continue;
    if (out.head.empty())
      out.head = cells(line);
    else
      out.rows.push_back(cells(line));
  }
  return out;
}

}  // namespace

std::string with_history(const study::Validation& v, const std::string& version, const std::string& document) {
  const std::size_t begin = document.find(kHistory.begin), end = document.find(kHistory.end);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return document;
  const std::size_t inside = begin + kHistory.begin.size();
  report::Table table = read_table(document.substr(inside, end - inside));
  if (table.head.empty()) table.head = {kFirst};
  for (const experiment::Verdict& d : v.verdicts) {
    if (std::find(table.head.begin(), table.head.end(), d.bound.quantity) == table.head.end())
      table.head.push_back(d.bound.quantity);
  }
  const std::map<std::string, double> known = study::quantities(v);
  Row row{version};
  for (auto name = table.head.begin() + 1; name != table.head.end(); ++name) {
    const auto found = known.find(*name);
    row.push_back(found == known.end() ? kNone : fmt::format("{:.4g}", found->second));
  }
  std::erase_if(table.rows, [&](const Row& r) { return !r.empty() && r[0] == version; });
  table.rows.insert(table.rows.begin(), std::move(row));
  for (Row& r : table.rows) r.resize(table.head.size(), kNone);
  return document.substr(0, inside) + "\n\n" + report::to_markdown(table) + document.substr(end);
}

}  // namespace vsa::app
