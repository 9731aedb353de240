// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A measured grid T(δ_i, p_j) of the torque that holds a deflection, made a potential.
//
//   T(δ, p) = Σ_j w_j(p) T_j(δ) + v_j(p) D_j(δ),   H = ∫₀ T dδ = Σ w_j ∫T_j + v_j ∫D_j,   ∂H/∂p = Σ w_j' ∫T_j + v_j' ∫D_j
//
//   T_j  a preset's row: cubics between its points, which never fall where these don't (F. N. Fritsch, R. E. Carlson, SIAM J. Numer.
//        Anal. 17 (1980) 238): slopes of three-point parabolas, at most twice the lesser neighbouring secant; tangents beyond its ends
//   D_j  the rows' slope by p, of the neighbouring rows: a three-point parabola's, scaled so that the rows' ranges of torque go as
//        monotonously as they were measured, and then so that no stiffness falls below 0 (below)
//   w, v cubic Hermite polynomials between presets; beyond the first and last the slope fades to 0 within ⅔ of an interval
//
// Torque and loads have continuous derivatives but the loads' by p, which jumps at presets. The law goes through every point. In p
// and in δ σ = ∂T/∂δ is a polynomial on each half of a cell whose Bernstein coefficients are those of the rows T_j and T_j ± D_j h/3,
// and D_j is scaled until none of these is negative: σ ≥ 0 everywhere, so H ≥ 0 where T(0, p) = 0. Ours.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "elastic/laws/shapes.hpp"

namespace vsa::elastic {

class TorqueGrid {
 public:
  /// At least two deflections, with 0 among or between them, and one preset, both rising; a row of torques each preset, which don't
  /// fall.
  TorqueGrid(std::vector<double> deflections, std::vector<double> presets, const std::vector<std::vector<double>>& torques);

  /// δ and p; every row's torque at δ = 0 is taken off.
  [[nodiscard]] Potential at(double deflection, double preset) const noexcept;
  /// Where the polynomials change, rising.
  [[nodiscard]] std::span<const double> deflection_knots() const noexcept { return deflections_; }
  [[nodiscard]] std::span<const double> preset_knots() const noexcept { return knots_; }
  [[nodiscard]] bool has_preset() const noexcept { return presets_.size() > 1; }
  bool operator==(const TorqueGrid&) const = default;

 private:
  struct Node {
    double torque = 0, stiffness = 0, energy = 0;
    bool operator==(const Node&) const = default;
  };
  using Row = std::vector<Node>;
  struct Value {
    double energy, torque, stiffness;
  };
  /// What a row counts for at a preset, and that by p.
  struct Weight {
    double value = 0, slope = 0, bend = 0;
  };
  struct Place {
    std::size_t cell;  ///< between the deflections `cell` and the next
    double into;       ///< δ − the first of them; negative before the first of all, beyond the cell after the last
  };

  void integrate(Row& row) const;
  void add_preset_slopes();
  [[nodiscard]] double interval(std::size_t j) const noexcept { return presets_[j + 1] - presets_[j]; }
  [[nodiscard]] double most_slope(std::size_t j) const noexcept;
  [[nodiscard]] std::array<double, 5> coefficients(const Row& row, std::size_t cell) const noexcept;
  [[nodiscard]] Place place(double deflection) const noexcept;
  [[nodiscard]] Value value(const Row& row, const Place& at) const noexcept;
  void add(Potential& to, const Row& row, const Place& at, const Weight& w) const noexcept;

  std::vector<double> deflections_, presets_, knots_;
  std::vector<Row> rows_, slopes_;  ///< T_j and D_j
};

}  // namespace vsa::elastic
