// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "actuators/laws.hpp"

#include <iostream>

#include "terminal/exit_codes.hpp"
#include "terminal/markdown.hpp"
#include "terminal/table.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/output_file.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {
namespace {

constexpr Markers kMarkers{"<!-- vsa actuators --laws: tables -->", "<!-- vsa actuators --laws: end of tables -->"};

using Laws = std::vector<const elastic::Law*>;

report::Table law_table(const Laws& laws) {
  report::Table out{"", {"law", "what", "energy", "source"}, {}, ""};
  for (const elastic::Law* law : laws)
    out.rows.push_back({std::string(law->name), std::string(law->title), std::string(law->equation), std::string(law->source)});
  return out;
}

report::Table key_table(const Laws& laws) {
  report::Table out{"", {"law", "key", "unit", "allowed", "meaning"}, {}, ""};
  for (const elastic::Law* law : laws) {
    const auto add = [&](std::string_view key, std::string_view unit, const std::string& allowed, std::string_view meaning) {
      out.rows.push_back({std::string(law->name), "elastic." + std::string(key), std::string(unit), allowed, std::string(meaning)});
    };
    for (const elastic::LawParameter& p : law->parameters) add(p.key, p.unit, config::range_text(p.min, p.max), p.meaning);
    if (law->file != nullptr) add(law->file->key, "", "a file", law->file->meaning);
  }
  return out;
}

/// Its first columns are names in a file: Markdown shows them as code.
std::string markdown_text(report::Table table, std::size_t names) {
  for (auto& row : table.rows)
    for (std::size_t k = 0; k < names; ++k) row[k] = '`' + row[k] + '`';
  return report::to_markdown(table);
}

std::string terminal_text(const report::Table& table) {
  std::vector<std::vector<std::string>> rows{table.head};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  return table_text(rows, terminal_width());
}

}  // namespace

int run_laws(const std::string& markdown) {
  const Laws laws = config::standard_laws();
  if (!markdown.empty()) {
    write_whole(markdown, with_tables(markdown, kMarkers, markdown_text(law_table(laws), 1) + markdown_text(key_table(laws), 2)));
    return kDone;
  }
  std::cout << terminal_text(law_table(laws)) << '\n' << terminal_text(key_table(laws));
  return kDone;
}

}  // namespace vsa::app
