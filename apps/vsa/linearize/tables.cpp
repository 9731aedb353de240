// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linearize/tables.hpp"

#include <fmt/format.h>

#include <cmath>

#include "terminal/table.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using report::Table;

Table matrix_table(const char* name, const Eigen::MatrixXd& m, const std::vector<linear::Signal>& rows,
                   const std::vector<linear::Signal>& columns) {
  Table out{name, {""}, {}, ""};
  for (const auto& c : columns) out.head.push_back(fmt::format("{} [{}]", c.name, c.unit));
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    auto& row = out.rows.emplace_back(std::vector<std::string>{rows[static_cast<std::size_t>(i)].name});
    for (Eigen::Index j = 0; j < m.cols(); ++j) row.push_back(digits(m(i, j)));
  }
  return out;
}

}  // namespace

std::string digits(double value) {
  if (std::abs(value) < 1e-12) value = 0;
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "–";
}

double degrees(std::complex<double> z) { return std::arg(z) * 180 / kPi; }

report::Chart bode(const char* title, const char* y_label, bool y_log, std::vector<report::Curve> curves, const char* caption) {
  return {title, "frequency [Hz]", y_label, std::move(curves), caption, y_log, true};
}

Table pole_table(const std::vector<linear::Pole>& poles, double period_s, const std::vector<std::string>& moves) {
  Table out{"Poles", {"frequency [Hz]", "damping ratio", "real part [1/s]", "imaginary part [1/s]"}, {}, ""};
  if (!moves.empty()) out.head.emplace_back("swings farthest");
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const linear::Pole& p = poles[i];
    const bool at_zero = p.s == 0.0;
    out.rows.push_back({digits(p.frequency_Hz), at_zero ? "–" : digits(p.damping_ratio), digits(p.s.real()),
                        p.s.imag() != 0 ? "±" + digits(p.s.imag()) : "0"});
    if (!moves.empty()) out.rows.back().push_back(moves[i]);
  }
  out.caption = "Frequency: |s|/2π; damping ratio: −Re s/|s|, negative where a motion grows. 0: a motor that nothing brings back.";
  if (period_s > 0) out.caption += fmt::format(" s = ln(z)/T, T = {:g} ms.", period_s * 1e3);
  return out;
}

std::vector<report::Block> matrix_tables(const linear::System& m) {
  const char* next = m.period_s > 0 ? "A: a state from loop to loop" : "A: a state's rate";
  return {matrix_table(next, m.a, m.states, m.states), matrix_table("B", m.b, m.states, m.inputs),
          matrix_table("C (D is 0)", m.c, m.outputs, m.states)};
}

std::string table_lines(const Table& t) {
  std::vector<std::vector<std::string>> rows{t.head};
  rows.insert(rows.end(), t.rows.begin(), t.rows.end());
  return '\n' + t.title + '\n' + table_text(rows, 0);
}

}  // namespace vsa::app
