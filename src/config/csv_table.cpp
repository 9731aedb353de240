// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "vsa/config/text.hpp"
#include "vsa/files.hpp"
#include "vsa/not_a_number.hpp"

namespace vsa::config {
namespace {

constexpr std::uintmax_t kLargestFile = 512u << 20;
constexpr std::size_t kLongestLine = 4096, kShown = 40;

constexpr std::array<std::string_view, 16> kUnits = {"s", "rad", "Nm", "A", "V", "W",   "J",   "Hz",
                                                     "m", "kg",  "N",  "K", "1", "pct", "raw", "Ohm"};

/// Text from a file as a message may show it: short, without control characters or bytes that aren't ASCII.
std::string shown(std::string_view text) {
  std::string out;
  for (signed char c : text.substr(0, kShown)) out += c < 0x20 || c == 0x7f ? '?' : c;
  return text.size() > kShown ? out + "…" : out;
}

bool ends_in_unit(std::string_view name) {
  const std::size_t bar = name.rfind('_');
  if (bar == std::string_view::npos || bar == 0) return false;
  const bool known = std::find(kUnits.begin(), kUnits.end(), name.substr(bar + 1)) != kUnits.end();
  return known;
}

/// "load_torque_Nm" → "load_torque"
std::string_view without_unit(std::string_view name) { return name.substr(0, name.rfind('_')); }

std::string text_of_table(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const auto fail = [&](std::string what) { throw InputError({file.string(), "", "", std::move(what), "a CSV file"}); };
  if (!std::filesystem::exists(status)) fail("there is no such file");
  if (std::filesystem::is_directory(status)) fail("this is a directory");
  if (!std::filesystem::is_regular_file(status)) fail("this isn't a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) fail("can't be read: " + error.message());
  if (size > kLargestFile) fail(fmt::format("too large, {} bytes", size));
  std::string text = read_file(file).value_or("");
  if (text.size() != size) fail("can't be read");
  if (text.find('\0') != std::string::npos) fail("this isn't text");
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
  return text;
}

struct Line {
  std::size_t number;
  std::string_view text;
};

std::vector<Line> split_lines(std::string_view text, const std::filesystem::path& file) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.size() > kLongestLine) {
      throw InputError({at_line(file, number), "", shown(line), fmt::format("a line of {} characters", line.size()),
                        fmt::format("up to {}", kLongestLine)});
    }
    if (!trim(line).empty()) lines.push_back({number, line});
  }
  return lines;
}

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  for (;;) {
    const std::size_t comma = line.find(',');
    out.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return out;
    line.remove_prefix(comma + 1);
  }
}

/// A name in the header that isn't wanted as it stands: why it is wrong, or nothing where it may be ignored.
std::optional<Problem> judge(std::string_view name, const std::vector<WantedColumn>& wanted, const std::string& place) {
  for (const WantedColumn& w : wanted) {
    const std::string_view bare = without_unit(w.name);
    if (bare.size() == w.name.size() || (name != bare && without_unit(name) != bare)) continue;
    const char* what = name == bare ? "the column's name has no unit" : "the column's unit isn't the expected one";
    return Problem{place, "column", shown(name), what, std::string(w.name)};
  }
  if (name == "sample" || ends_in_unit(name)) return std::nullopt;
  return Problem{place, "column", shown(name), "unknown column; a column's name ends in its unit", "…_rad, …_Nm, …_s"};
}

/// Where each wanted column stands in the header; npos: absent.
std::vector<std::size_t> find_columns(const std::vector<std::string_view>& head, const std::vector<WantedColumn>& wanted,
                                      const std::string& place, FewProblems& problems) {
  std::vector<std::size_t> where(wanted.size(), std::string::npos);
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (std::find(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(i), head[i]) !=
        head.begin() + static_cast<std::ptrdiff_t>(i)) {
      problems.add({place, "column", shown(head[i]), "this column is there twice", ""});
      continue;
    }
    const auto it = std::find_if(wanted.begin(), wanted.end(), [&](const WantedColumn& w) { return w.name == head[i]; });
    if (it != wanted.end()) {
      where[static_cast<std::size_t>(it - wanted.begin())] = i;
    } else if (auto problem = judge(head[i], wanted, place)) {
      problems.add(std::move(*problem));
    }
  }
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (where[k] == std::string::npos && wanted[k].required) {
      problems.add({place, "column", "", "a column is missing", std::string(wanted[k].name)});
    }
  }
  return where;
}

double read_cell(std::string_view cell, const WantedColumn& column, const std::string& place, FewProblems& problems) {
  if (cell.empty() && column.empty_allowed) return kNaN;
  if (const auto number = parse_number(cell)) return *number;
  problems.add({place, std::string(column.name), shown(cell), cell.empty() ? "an empty cell" : "not a number", "a finite number"});
  return kNaN;
}

}  // namespace

void FewProblems::add(Problem problem) {
  if (!full()) problems_.add(std::move(problem));
}

std::string at_line(const std::filesystem::path& file, std::size_t line) { return fmt::format("{}:{}", file.string(), line); }

CsvTable read_csv(const std::filesystem::path& file, const std::vector<WantedColumn>& wanted) {
  const std::string text = text_of_table(file);
  const std::vector<Line> lines = split_lines(text, file);
  if (lines.empty()) throw InputError({file.string(), "", "", "the file is empty", "a header line and samples"});
  FewProblems problems;
  const std::vector<std::string_view> head = cells(lines.front().text);
  const auto where = find_columns(head, wanted, at_line(file, lines.front().number), problems);
  problems.throw_if_any();
  CsvTable table;
  table.columns.resize(wanted.size());
  for (std::size_t row = 1; row < lines.size() && !problems.full(); ++row) {
    const std::string place = at_line(file, lines[row].number);
    const auto values = cells(lines[row].text);
    if (values.size() != head.size()) {
      problems.add({place, "", shown(lines[row].text), fmt::format("{} cells", values.size()),
                    fmt::format("{}, as the header has", head.size())});
      continue;
    }
    table.lines.push_back(lines[row].number);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (where[k] != std::string::npos) table.columns[k].push_back(read_cell(values[where[k]], wanted[k], place, problems));
    }
  }
  problems.throw_if_any();
  return table;
}

void require_increasing(const CsvTable& table, std::size_t column, std::string_view name, const std::filesystem::path& file,
                        FewProblems& problems) {
  const std::vector<double>& values = table.columns[column];
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[i - 1]) continue;
    problems.add({at_line(file, table.lines[i]), std::string(name), number_text(values[i]), "doesn't increase",
                  "more than " + number_text(values[i - 1])});
  }
}

}  // namespace vsa::config
