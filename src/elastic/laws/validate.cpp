// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <string>

#include "vsa/checks.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {

namespace {

/// Whether there are as many values as the law has parameters, and behind them whole rows of its file.
bool right_count(const Law& law, std::size_t count) noexcept {
  const std::size_t own = law.parameters.size();
  if (law.file == nullptr || count < own) return count == own;
  return (count - own) % law.file->columns.size() == 0;
}

void check_bounds(const Law& law, std::span<const double> values, Checks& check) {
  const std::size_t own = law.parameters.size();
  for (std::size_t i = 0; i < own; ++i)
    check.within(law.parameters[i].key, values[i], law.parameters[i].min, law.parameters[i].max);
  for (std::size_t i = own; i < values.size(); ++i) {
    const LawColumn& column = law.file->columns[(i - own) % law.file->columns.size()];
    check.within(column.name, values[i], column.min, column.max);
  }
}

}  // namespace

void validate(const Law& law, std::span<const double> values, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  if (!right_count(law, values.size())) {
    check.refuse(law.name, std::to_string(values.size()) + " values", "the law has other parameters",
                 std::to_string(law.parameters.size()) + " values" + (law.file != nullptr ? " and whole rows of its file" : ""));
    return;
  }
  const std::size_t before = problems.list().size();
  check_bounds(law, values, check);
  if (problems.list().size() != before || law.fault == nullptr) return;
  const auto fault = law.fault(values);
  if (!fault) return;
  std::string value;
  for (std::size_t i = 0; i < law.parameters.size(); ++i)
    if (law.parameters[i].key == fault->key) value = Checks::text(values[i]);
  check.refuse(fault->key, value, fault->message, fault->allowed);
}

}  // namespace vsa::elastic
