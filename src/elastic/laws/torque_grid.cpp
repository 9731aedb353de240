// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "elastic/laws/torque_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vsa::elastic {
namespace {

constexpr double kFade = 2.0 / 3.0;  // of the outermost interval, so that what is added comes to D h/3 in all

/// The nearest to `wanted` that goes the secants' way, and no more than twice as steep as either; 0 where they disagree.
double limited(double wanted, double before, double after) noexcept {
  if (before * after <= 0) return 0;
  const double most = 2 * std::min(std::abs(before), std::abs(after)), way = before > 0 ? 1 : -1;
  return way * std::clamp(way * wanted, 0.0, most);
}

/// Of the parabola through three points, in the middle and at its first: h and s are the intervals and their secants.
double middle_slope(double h0, double h1, double s0, double s1) noexcept { return (h1 * s0 + h0 * s1) / (h0 + h1); }
double first_slope(double h0, double h1, double s0, double s1) noexcept { return s0 + (s0 - s1) * h0 / (h0 + h1); }

/// Monotone slopes at the points x, y.
std::vector<double> slopes_of(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t cells = x.size() - 1;
  std::vector<double> h(cells), s(cells), out(x.size());
  for (std::size_t i = 0; i < cells; ++i) {
    h[i] = x[i + 1] - x[i];
    s[i] = (y[i + 1] - y[i]) / h[i];
  }
  if (cells == 1) return {s[0], s[0]};
  for (std::size_t i = 1; i < cells; ++i) out[i] = limited(middle_slope(h[i - 1], h[i], s[i - 1], s[i]), s[i - 1], s[i]);
  out[0] = limited(first_slope(h[0], h[1], s[0], s[1]), s[0], s[0]);
  out[cells] = limited(first_slope(h[cells - 1], h[cells - 2], s[cells - 1], s[cells - 2]), s[cells - 1], s[cells - 1]);
  return out;
}

}  // namespace

TorqueGrid::TorqueGrid(std::vector<double> deflections, std::vector<double> presets,
                       const std::vector<std::vector<double>>& torques)
    : deflections_(std::move(deflections)), presets_(std::move(presets)), knots_(presets_) {
  for (const std::vector<double>& torque : torques) {
    const std::vector<double> slope = slopes_of(deflections_, torque);
    Row row(torque.size());
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = {torque[i], slope[i], 0};
    const double at_rest = value(row, place(0)).torque;
    for (Node& n : row) n.torque -= at_rest;
    integrate(row);
    rows_.push_back(std::move(row));
  }
  if (has_preset()) add_preset_slopes();
}

/// The energies at the points, 0 at δ = 0.
void TorqueGrid::integrate(Row& row) const {
  for (std::size_t i = 1; i < row.size(); ++i) {
    const Node &a = row[i - 1], &b = row[i];
    const double h = deflections_[i] - deflections_[i - 1];
    row[i].energy = a.energy + 0.5 * h * (a.torque + b.torque) + h * h / 12 * (a.stiffness - b.stiffness);
  }
  const double at_rest = value(row, place(0)).energy;
  for (Node& n : row) n.energy -= at_rest;
}

void TorqueGrid::add_preset_slopes() {
  const std::size_t last = presets_.size() - 1;
  std::vector<double> range;
  for (const Row& row : rows_) range.push_back(row.back().torque - row.front().torque);
  const std::vector<double> wanted = slopes_of(presets_, range);
  for (std::size_t j = 0; j <= last; ++j) {
    const std::size_t before = j == 0 ? 0 : j - 1, after = std::min(j, last - 1);
    // D_j = b s_before + a s_after, s: the secants of rows, so that the range's slope is the wanted one.
    const double h0 = interval(before), h1 = interval(after), s0 = (range[before + 1] - range[before]) / h0;
    const double s1 = (range[after + 1] - range[after]) / h1, mixed = middle_slope(h0, h1, s0, s1);
    const double scale = wanted[j] == 0 ? 0 : wanted[j] / mixed, b = scale * h1 / (h0 + h1), a = scale * h0 / (h0 + h1);
    Row row(deflections_.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto mix = [&](double Node::*of) {
        return b * (rows_[before + 1][i].*of - rows_[before][i].*of) / h0 +
               a * (rows_[after + 1][i].*of - rows_[after][i].*of) / h1;
      };
      row[i] = {mix(&Node::torque), mix(&Node::stiffness), mix(&Node::energy)};
    }
    slopes_.push_back(std::move(row));
  }
  for (std::size_t j = 0; j <= last; ++j) {
    const double part = most_slope(j);
    for (Node& n : slopes_[j]) n = {part * n.torque, part * n.stiffness, part * n.energy};
  }
  knots_.insert(knots_.begin(), presets_.front() - kFade * interval(0));
  knots_.push_back(presets_.back() + kFade * interval(last - 1));
}

/// The largest part of D_j, up to 1, with which no coefficient of T_j ± D_j h/3 is negative.
double TorqueGrid::most_slope(std::size_t j) const noexcept {
  const std::size_t last = presets_.size() - 1;
  const double before = interval(j == 0 ? 0 : j - 1), after = interval(std::min(j, last - 1));
  double part = 1, steepest = 0;
  for (const Node& n : rows_[j]) steepest = std::max(steepest, n.stiffness);
  for (std::size_t i = 0; i + 1 < deflections_.size(); ++i) {
    const auto t = coefficients(rows_[j], i), d = coefficients(slopes_[j], i);
    for (std::size_t c = 0; c < t.size(); ++c) {
      constexpr double kRounding = 1e-12;
      const double falls = std::max(d[c] * before, -d[c] * after) / 3, has = std::max(t[c], 0.0);
      if (falls > has && falls > kRounding * steepest) part = std::min(part, has / falls);
    }
  }
  return part;
}

/// Bernstein coefficients of the stiffness on both halves of a cell, the middle one being both's.
std::array<double, 5> TorqueGrid::coefficients(const Row& row, std::size_t cell) const noexcept {
  const Node &a = row[cell], &b = row[cell + 1];
  const double secant = (b.torque - a.torque) / (deflections_[cell + 1] - deflections_[cell]);
  const double inner = 3 * secant - a.stiffness - b.stiffness, left = 0.5 * (a.stiffness + inner),
               right = 0.5 * (inner + b.stiffness);
  return {a.stiffness, left, 0.5 * (left + right), right, b.stiffness};
}

TorqueGrid::Place TorqueGrid::place(double deflection) const noexcept {
  const auto above = std::upper_bound(deflections_.begin() + 1, deflections_.end() - 1, deflection);
  const auto cell = static_cast<std::size_t>(above - deflections_.begin()) - 1;
  return {cell, deflection - deflections_[cell]};
}

TorqueGrid::Value TorqueGrid::value(const Row& row, const Place& at) const noexcept {
  const Node &a = row[at.cell], &b = row[at.cell + 1];
  const double h = deflections_[at.cell + 1] - deflections_[at.cell], x = at.into;
  if (x < 0 || x > h) {
    const Node& end = x < 0 ? a : b;
    const double out = x < 0 ? x : x - h;
    return {end.energy + out * (end.torque + 0.5 * out * end.stiffness), end.torque + out * end.stiffness, end.stiffness};
  }
  const double secant = (b.torque - a.torque) / h;
  const double square = (3 * secant - 2 * a.stiffness - b.stiffness) / h, cube = (a.stiffness + b.stiffness - 2 * secant) / (h * h);
  return {a.energy + x * (a.torque + x * (a.stiffness / 2 + x * (square / 3 + x * cube / 4))),
          a.torque + x * (a.stiffness + x * (square + x * cube)), a.stiffness + x * (2 * square + x * 3 * cube)};
}

void TorqueGrid::add(Potential& to, const Row& row, const Place& at, const Weight& w) const noexcept {
  const Value v = value(row, at);
  to.energy += w.value * v.energy;
  to.d += w.value * v.torque;
  to.dd += w.value * v.stiffness;
  to.p += w.slope * v.energy;
  to.dp += w.slope * v.torque;
  to.pp += w.bend * v.energy;
}

Potential TorqueGrid::at(double deflection, double preset) const noexcept {
  Potential out;
  const Place here = place(deflection);
  const std::size_t last = presets_.size() - 1;
  if (!has_preset()) {
    add(out, rows_[0], here, {1, 0, 0});
  } else if (preset < presets_.front() || preset > presets_.back()) {
    const bool below = preset < presets_.front();
    const std::size_t end = below ? 0 : last;
    const double over = preset - presets_[end], way = kFade * interval(below ? 0 : last - 1);
    const double t = std::min(std::abs(over) / way, 1.0);
    add(out, rows_[end], here, {1, 0, 0});
    add(out, slopes_[end], here,
        {std::copysign(way * t * (1 - 0.5 * t), over), 1 - t, t < 1 ? -std::copysign(1 / way, over) : 0.0});
  } else {
    const auto above = std::upper_bound(presets_.begin() + 1, presets_.end() - 1, preset);
    const auto j = static_cast<std::size_t>(above - presets_.begin()) - 1;
    const double h = interval(j), t = (preset - presets_[j]) / h, u = 1 - t;
    const Weight next{t * t * (3 - 2 * t), 6 * t * u / h, 6 * (u - t) / (h * h)};
    add(out, rows_[j], here, {1 - next.value, -next.slope, -next.bend});
    add(out, rows_[j + 1], here, next);
    add(out, slopes_[j], here, {h * t * u * u, u * (u - 2 * t), (6 * t - 4) / h});
    add(out, slopes_[j + 1], here, {-h * t * t * u, t * (3 * t - 2), (6 * t - 2) / h});
  }
  return out;
}

}  // namespace vsa::elastic
