// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "vsa/config/csv_table.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/output_file.hpp"

namespace vsa::experiment {

using config::at_line, config::CsvTable, config::FewProblems, config::read_csv, config::require_increasing;

namespace {

constexpr double kForceLimit_N = 1e6, kTorqueLimit_Nm = 1e4;
constexpr double kDeflectionLimit = 6.3;  // a turn: no spring of an actuator gives way further
constexpr std::string_view kNameMark = "preset_";

void require_samples(std::size_t count, const std::filesystem::path& file) {
  if (count >= 2) return;
  throw InputError({file.string(), "", fmt::format("{} sample{}", count, count == 1 ? "" : "s"), "too few samples", "two or more"});
}

void require_within(const CsvTable& table, std::size_t column, std::string_view name, double limit,
                    const std::filesystem::path& file, FewProblems& problems) {
  const std::vector<double>& values = table.columns[column];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(std::abs(values[i]) > limit)) continue;  // an empty cell is NaN
    problems.add({at_line(file, table.lines[i]), std::string(name), config::number_text(values[i]), "out of range",
                  config::range_text(-limit, limit)});
  }
}

/// Branches are compared on a grid of one spacing; numbers that were rounded may miss it a little.
void require_even(const CsvTable& table, const Branches& branches, const std::filesystem::path& file, FewProblems& problems) {
  constexpr double kRounding = 0.05;  // of the spacing
  const std::vector<double>& values = branches.torque_Nm;
  const double spacing = branches.spacing_Nm();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double rows = (values[i] - values[i - 1]) / spacing;
    if (std::abs(rows - std::round(rows)) <= kRounding) continue;
    problems.add({at_line(file, table.lines[i]), "load_torque_Nm", config::number_text(values[i]),
                  "isn't on one grid with the others", "steps of whole multiples of the least, " + config::number_text(spacing)});
    return;
  }
}

void require_scatter(const CsvTable& table, std::size_t column, std::string_view name, const std::filesystem::path& file,
                     FewProblems& problems) {
  const std::vector<double>& values = table.columns[column];
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] < 0) && !(values[i] > kDeflectionLimit)) continue;
    problems.add({at_line(file, table.lines[i]), std::string(name), config::number_text(values[i]), "out of range",
                  config::range_text(0, kDeflectionLimit)});
  }
}

/// Digits, one point, an exponent is not for names.
std::size_t number_length(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && (std::isdigit(static_cast<unsigned char>(text[n])) != 0 || text[n] == '.')) ++n;
  while (n > 0 && text[n - 1] == '.') --n;
  return n;
}

std::size_t letters_length(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && std::isalpha(static_cast<unsigned char>(text[n])) != 0) ++n;
  return n;
}

}  // namespace

NamedPreset preset_of_name(const std::filesystem::path& csv) {
  const std::string name = csv.stem().string();
  const auto fail = [&](const char* what) {
    throw InputError({csv.string(), "file name", name, what, "stiffness_preset_0.6903rad….csv: the commanded preset and its unit"});
  };
  const std::size_t mark = name.find(kNameMark);
  if (mark == std::string::npos) fail("the name doesn't tell the preset");
  std::string_view rest = std::string_view(name).substr(mark + kNameMark.size());
  const std::size_t digits = number_length(rest);
  const auto value = config::parse_number(rest.substr(0, digits));
  if (!value) fail("the name doesn't tell the preset");
  rest.remove_prefix(digits);
  const std::string unit(rest.substr(0, letters_length(rest)));
  if (unit.empty()) fail("the preset in the name has no unit");
  if (unit == "deg" || unit == "pct") fail("the preset in the name is in a unit that isn't used here");
  return {*value, unit};
}

LoadRecording read_load_recording(const std::filesystem::path& csv, double limit_Nm) {
  const CsvTable table = read_csv(csv, {{"load_torque_Nm"}, {"deflection_rad"}, {"time_s", false}, {"sample", false}});
  require_samples(table.lines.size(), csv);
  FewProblems problems;
  require_within(table, 0, "load_torque_Nm", limit_Nm, csv, problems);
  require_within(table, 1, "deflection_rad", kDeflectionLimit, csv, problems);
  require_increasing(table, 2, "time_s", csv, problems);
  require_increasing(table, 3, "sample", csv, problems);
  problems.throw_if_any();
  NamedPreset preset = preset_of_name(csv);
  return {preset.value, std::move(preset.unit), csv.string(), table.columns[2], table.columns[0], table.columns[1]};
}

Branches read_branches(const std::filesystem::path& csv) {
  const CsvTable table = read_csv(csv, {{"load_torque_Nm"},
                                        {"deflection_rising_rad", true, true},
                                        {"deflection_falling_rad", true, true},
                                        {"sd_rising_rad", true, true},
                                        {"sd_falling_rad", true, true}});
  require_samples(table.lines.size(), csv);
  FewProblems problems;
  require_within(table, 0, "load_torque_Nm", kTorqueLimit_Nm, csv, problems);
  require_within(table, 1, "deflection_rising_rad", kDeflectionLimit, csv, problems);
  require_within(table, 2, "deflection_falling_rad", kDeflectionLimit, csv, problems);
  require_scatter(table, 3, "sd_rising_rad", csv, problems);
  require_scatter(table, 4, "sd_falling_rad", csv, problems);
  require_increasing(table, 0, "load_torque_Nm", csv, problems);
  problems.throw_if_any();
  const auto& c = table.columns;
  Branches out{c[0], c[1], c[2], c[3], c[4]};
  require_even(table, out, csv, problems);
  problems.throw_if_any();
  return out;
}

Branches read_points(const std::filesystem::path& csv, bool linear, double limit_Nm) {
  const char *const load = linear ? "load_force_N" : "load_torque_Nm", *const way = linear ? "deflection_m" : "deflection_rad";
  const CsvTable table = read_csv(csv, {{load}, {way}});
  require_samples(table.lines.size(), csv);
  FewProblems problems;
  require_within(table, 0, load, linear ? kForceLimit_N : limit_Nm, csv, problems);
  require_within(table, 1, way, kDeflectionLimit, csv, problems);
  problems.throw_if_any();
  const auto& torque = table.columns[0];
  std::vector<std::size_t> order(torque.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return torque[a] < torque[b]; });
  Branches out;
  for (const std::size_t i : order) {
    out.torque_Nm.push_back(torque[i]);
    out.rising_rad.push_back(table.columns[1][i]);
  }
  out.falling_rad = out.sd_rising_rad = out.sd_falling_rad = std::vector<double>(order.size(), std::nan(""));
  return out;
}

TimeSeries read_series(const std::filesystem::path& csv, std::string_view column) {
  const CsvTable table = read_csv(csv, {{"time_s"}, {column}});
  require_samples(table.lines.size(), csv);
  FewProblems problems;
  require_increasing(table, 0, "time_s", csv, problems);
  problems.throw_if_any();
  return {table.columns[0], table.columns[1]};
}

void write_load_recording(const LoadRecording& recording, const std::filesystem::path& csv) {
  std::string text = recording.time_s.empty() ? "sample,load_torque_Nm,deflection_rad\n" : "time_s,load_torque_Nm,deflection_rad\n";
  for (std::size_t i = 0; i < recording.torque_Nm.size(); ++i) {
    text += recording.time_s.empty() ? std::to_string(i) : config::number_text(recording.time_s[i]);
    text += ',' + config::number_text(recording.torque_Nm[i]) + ',' + config::number_text(recording.deflection_rad[i]) + '\n';
  }
  try {
    write_whole(csv, text);
  } catch (const OutputError& error) {
    throw InputError({csv.string(), "", "", error.what(), "a place that can be written to"});
  }
}

}  // namespace vsa::experiment
