// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A CSV file of numbers, read strictly: the columns asked for, each with its unit in its name, every cell a finite number.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/errors.hpp"

namespace vsa::config {

/// A column that a reader asks for.
struct WantedColumn {
  std::string_view name;       ///< as the header has it, with its unit
  bool required = true;        ///< false: a file may lack it
  bool empty_allowed = false;  ///< an empty cell reads as NaN
};

/// A CSV file of numbers, column by column; every row has a number in each that is there.
struct CsvTable {
  std::vector<std::vector<double>> columns;  ///< in the order they were wanted; empty for an optional one that is absent
  std::vector<std::size_t> lines;            ///< line number of each row
};

/// Throws InputError: not a regular file, not text, a line too long, an empty file, unknown or doubled columns, bad cells.
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& file, const std::vector<WantedColumn>& wanted);

/// Collects at most `kMost` problems, so that a file of garbage gives a page and not a book.
class FewProblems {
 public:
  static constexpr std::size_t kMost = 20;  ///< problems told
  void add(Problem problem);                ///< the first kMost; further ones are dropped
  [[nodiscard]] bool full() const noexcept { return problems_.list().size() >= kMost; }  ///< whether a reader may stop
  void throw_if_any() const { problems_.throw_if_any(); }                                ///< InputError

 private:
  Problems problems_;
};

/// Adds a problem where a column of numbers doesn't increase from row to row.
void require_increasing(const CsvTable& table, std::size_t column, std::string_view name, const std::filesystem::path& file,
                        FewProblems& problems);

/// "file:line"
[[nodiscard]] std::string at_line(const std::filesystem::path& file, std::size_t line);

}  // namespace vsa::config
