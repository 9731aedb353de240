// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The qbmove's agonist–antagonist transmission: two hardening springs, one to each driving pulley.
//
//   δ_i = q − x_i
//   H   = Σ_i (k_i/a_i) (cosh(a_i δ_i) − 1) + ½ c_i δ_i²         J
//   τ   = −Σ_i T_i,   load_i = T_i = k_i sinh(a_i δ_i) + c_i δ_i  N·m
//   σ   =  Σ_i a_i k_i cosh(a_i δ_i) + c_i                       N·m/rad
//
// Symmetric pair, x = θ_eq ± p, c = 0: τ = −2k cosh(a p) sinh(a (q − θ_eq)): the equilibrium doesn't depend on the preset p, the
// stiffness at rest is 2 (a k cosh(a p) + c). The linear part c is none of the paper's: the recordings of the hardware ask for it
// (docs/validation.md); the data sheet's extra 0.5 N·m/rad near zero points the same way. Beyond |δ_i| = d each spring goes on
// along its tangent, T(d) + T'(d)(|δ_i| − d): nobody measured there, and tendons and mounts in series end the hardening.
// Range: |a δ| < 700 (beyond it cosh overflows; a real spring breaks long before).
//
// Source: the paper's eq. (1), which writes the external torque that balances the spring, the opposite sign of τ here. The
// paper calls the preset "the difference q1 − q2"; its own references and the hardware data say half the difference.
#pragma once

#include <cstddef>
#include <limits>

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

/// Two hardening springs: T_i(δ) = k_i sinh(a_i δ) + c_i δ, N·m, and beyond d along its tangent.
struct TwoSinhParams {
  std::array<double, 2> k_Nm{};                                        ///< torque scale of each spring, > 0
  std::array<double, 2> a_per_rad{};                                   ///< hardening rate of each spring, > 0
  std::array<double, 2> c_Nm_per_rad{};                                ///< linear part of each spring, ≥ 0
  double linear_beyond_rad = std::numeric_limits<double>::infinity();  ///< d: beyond |δ_i| = d the torque follows its tangent, > 0
  bool operator==(const TwoSinhParams&) const = default;
};
/// Keys as files have them: "k1_Nm".
void validate(const TwoSinhParams& params, std::string_view where, Problems& problems);

/// The qbmove's law, one hardening spring to each driving pulley: H = Σ_i (k_i/a_i) (cosh(a_i δ_i) − 1) + ½ c_i δ_i², δ_i = q −
/// x_i. All in closed form; for a symmetric pair command_exactly() too.
class TwoSinh final : public Transmission {
 public:
  explicit TwoSinh(const TwoSinhParams& params) noexcept;  ///< unchecked: validate() is the caller's

  /// By exp_less_1(), so the same bits on every machine.
  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override;
  [[nodiscard]] double energy(const Positions& at) const noexcept override;
  /// Closed form: the mean of k sinh(a δ) from δ₀ to δ₁ is k sinh(a m) sinhc(a Δ/2), m = (δ₀+δ₁)/2, Δ = δ₁−δ₀.
  [[nodiscard]] SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept override;
  /// Kept: sinh of both a_i δ_i, then cosh − 1. From there the addition theorems give a segment's means and the next origin by short
  /// series, without exp, as long as no a_i δ_i moves by more than 0.1; every 64th origin is worked out anew.
  [[nodiscard]] Origin origin(const Positions& at) const noexcept override;
  /// By addition theorems, see origin().
  [[nodiscard]] Origin moved(const Origin& from, const Positions& to) const noexcept override;
  [[nodiscard]] SegmentMean mean_from(const Origin& from, const Positions& to, double ahead_rad) const noexcept override;
  [[nodiscard]] Tangent tangent_of(const Origin& here) const noexcept override;  ///< in closed form
  [[nodiscard]] double energy_of(const Origin& here) const noexcept override;
  [[nodiscard]] std::array<double, 2> signed_energies_of(const Origin& here) const noexcept override;  ///< in closed form
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& command) const noexcept override;
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override;

  [[nodiscard]] std::optional<EquilibriumPreset> command_exactly(double q, double torque_Nm,
                                                                 double stiffness_Nm_per_rad) const noexcept override;

  [[nodiscard]] int spring_count() const noexcept override { return 2; }
  [[nodiscard]] std::array<double, 2> signed_energies(const Positions& at) const noexcept override;

  /// The same for units side by side; defined where lanes are (vsa/elastic/two_sinh_lanes.hpp). What is rare goes lane by lane.
  /// As moved(), in place; lanes that went far are worked out anew, one by one.
  template <class T>
  void move_lanes(OriginOf<T>& origin, const PositionsOf<T>& to) const noexcept;
  /// As mean_from(), into `mean`.
  template <class T>
  void mean_lanes(const OriginOf<T>& from, const PositionsOf<T>& to, T ahead_rad, SegmentMeanOf<T>& mean) const noexcept;
  /// As tangent_of().
  template <class T>
  [[nodiscard]] TangentOf<T> tangent_lanes(const OriginOf<T>& here) const noexcept;
  /// As signed_energies_of().
  template <class T>
  [[nodiscard]] std::array<T, 2> signed_energies_lanes(const OriginOf<T>& here) const noexcept;

  [[nodiscard]] bool equals(const Transmission& other) const noexcept override;
  void validate(std::string_view where, Problems& problems) const override;
  [[nodiscard]] const TwoSinhParams& params() const noexcept { return params_; }  ///< as given

 private:
  struct Spring {
    double energy = 0, torque = 0, stiffness = 0;
  };
  template <class T>
  struct MeanOf {
    T torque, slope;  // over a straight segment; the slope is for the segment's end
  };
  using Mean = MeanOf<double>;
  [[nodiscard]] Spring inside(std::size_t i, double deflection) const noexcept;
  [[nodiscard]] Spring spring(std::size_t i, double deflection) const noexcept;
  [[nodiscard]] Mean mean_inside(std::size_t i, double begin, double end) const noexcept;
  [[nodiscard]] Mean mean(std::size_t i, double begin, double end) const noexcept;
  template <class T, class Side>
  [[nodiscard]] auto mean_near(const Side& side, const OriginOf<T>& from, typename Side::Number begin, typename Side::Number move,
                               T ahead) const noexcept -> MeanOf<typename Side::Number>;
  template <class Side, class Mask, class T>
  void mean_far(const Side& side, Mask close, typename Side::Number begin, typename Side::Number end, T ahead,
                MeanOf<typename Side::Number>& mean) const noexcept;
  template <class T>
  static void sum(SegmentMeanOf<T>& mean) noexcept;
  template <class Side, class T>
  [[nodiscard]] auto energy_near(const Side& side, const OriginOf<T>& here) const noexcept;
  template <class Side>
  [[nodiscard]] auto near(const Side& side, typename Side::Number begin, typename Side::Number move) const noexcept;

  TwoSinhParams params_;
  std::array<Spring, 2> edge_{};  // at δ = d
};

}  // namespace vsa::elastic
