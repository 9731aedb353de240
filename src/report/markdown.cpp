// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

std::string row(const std::vector<std::string>& cells) {
  std::string out = "|";
  for (const std::string& cell : cells) {
    out += ' ';
    for (const char c : cell) out += c == '|' ? "\\|" : std::string(1, c);  // a bar would begin another cell
    out += " |";
  }
  return out + '\n';
}

}  // namespace

std::string to_markdown(const Table& table) {
  std::string out = row(table.head) + '|';
  for (std::size_t i = 0; i < table.head.size(); ++i) out += "---|";
  out += '\n';
  for (const auto& cells : table.rows) out += row(cells);
  if (!table.caption.empty()) out += '\n' + table.caption + (table.caption.back() == '\n' ? "" : "\n");
  return out + '\n';
}

}  // namespace vsa::report
