// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The qbmove's agonist–antagonist transmission: two hardening springs, one to each driving pulley.
//
//   δ_i = q − x_i
//   H   = Σ_i (k_i/a_i) (cosh(a_i δ_i) − 1)                    J
//   τ   = −Σ_i k_i sinh(a_i δ_i),   load_i = k_i sinh(a_i δ_i)  N·m
//   σ   =  Σ_i a_i k_i cosh(a_i δ_i)                            N·m/rad
//
// Symmetric pair, x = θ_eq ± p: τ = −2k cosh(a p) sinh(a (q − θ_eq)): the equilibrium doesn't depend on the preset p, the
// stiffness at rest is 2 a k cosh(a p). Range: |a δ| < 700 (beyond it cosh overflows; a real spring breaks long before).
//
// Source: the paper's eq. (1), which writes the external torque that balances the spring, the opposite sign of τ here. The
// paper calls the preset "the difference q1 − q2"; its own references and the hardware data say half the difference.
#pragma once

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

struct TwoSinhParams {
  std::array<double, 2> k_Nm{};       ///< torque scale of each spring, > 0
  std::array<double, 2> a_per_rad{};  ///< hardening rate of each spring, > 0
};

class TwoSinh final : public Transmission {
 public:
  explicit TwoSinh(const TwoSinhParams& params) noexcept;

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override;
  [[nodiscard]] double energy(const Positions& at) const noexcept override;
  /// Closed form: the mean of k sinh(a δ) from δ₀ to δ₁ is k sinh(a m) sinhc(a Δ/2), m = (δ₀+δ₁)/2, Δ = δ₁−δ₀.
  [[nodiscard]] SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept override;
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& command) const noexcept override;
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override;

  [[nodiscard]] const TwoSinhParams& params() const noexcept { return params_; }

 private:
  TwoSinhParams params_;
};

}  // namespace vsa::elastic
