// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A series elastic actuator: one motor, one linear spring.
//
//   H = ½ k (q − x₀)²,   τ = −k (q − x₀),   load₀ = +k (q − x₀),   σ = k
//
// There is no preset: the command's preset is ignored, and the law says so by an empty preset unit. Valid for any δ.
#pragma once

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

/// A series elastic actuator's law, one motor and one linear spring: H = ½ k (q − x₀)², J; σ = k, N·m/rad, at every preset.
class SeriesSpring final : public Transmission {
 public:
  explicit SeriesSpring(double stiffness_Nm_per_rad) noexcept : stiffness_(stiffness_Nm_per_rad) {}  ///< k > 0

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override;  ///< input 1's load and slopes are 0
  [[nodiscard]] SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept override;
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& command) const noexcept override;
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override;
  [[nodiscard]] int motor_count() const noexcept override { return 1; }  ///< input 1 isn't there
  [[nodiscard]] int spring_count() const noexcept override { return 1; }
  [[nodiscard]] std::array<double, 2> signed_energies(const Positions& at) const noexcept override;
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override;
  void validate(std::string_view where, Problems& problems) const override;
  [[nodiscard]] std::string_view preset_unit() const noexcept override { return ""; }

 private:
  double stiffness_;
};

}  // namespace vsa::elastic
