// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What laws have in common.
//
//   two springs     spring i knows its own elongation alone, e₁ = x₀ − q, e₂ = q − x₁, H = V₁(e₁) + V₂(e₂); x = equilibrium ± preset
//   one and a mover H(δ, x₁), δ = q − x₀: motor 1 sets the equilibrium, motor 2 whatever stiffens; preset = x₁, rad
#pragma once

#include <array>
#include <cstddef>

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

/// Spring has V, T = V′ and S = V″ at an elongation, and the mean of T over a straight way with its derivative for the way's end:
///   struct { double energy, torque, stiffness; } at(double e);   struct { double torque, slope; } mean(double from, double to);
template <class Spring>
class TwoSprings : public Transmission {
 public:
  explicit TwoSprings(const std::array<Spring, 2>& springs) noexcept : springs_(springs) {}

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override {
    Response r{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto s = springs_[i].at(elongation(at, i));
      r.energy += s.energy;
      r.torque -= kWay[i] * s.torque;
      r.load[i] = kWay[i] * s.torque;
      r.curvature.qq += s.stiffness;
      r.curvature.qx[i] = -s.stiffness;
      r.curvature.xx[i] = s.stiffness;
    }
    return r;
  }
  [[nodiscard]] SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept override {
    SegmentMean m;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto s = springs_[i].mean(elongation(from, i), elongation(to, i));
      m.torque -= kWay[i] * s.torque;
      m.load[i] = kWay[i] * s.torque;
      m.slope.qq += s.slope;
      m.slope.qx[i] = -s.slope;
      m.slope.xx[i] = s.slope;
    }
    return m;
  }
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium + c.preset, c.equilibrium - c.preset};
  }
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return {0.5 * (x[0] + x[1]), 0.5 * (x[0] - x[1])};
  }
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override {
    const auto* same = dynamic_cast<const TwoSprings*>(&other);
    return same != nullptr && same->springs_ == springs_;
  }

 protected:
  std::array<Spring, 2> springs_;

 private:
  static constexpr std::array<double, 2> kWay{-1, 1};  // ∂e/∂q
  [[nodiscard]] static double elongation(const Positions& at, std::size_t i) noexcept { return kWay[i] * (at.q - at.x[i]); }
};

/// H(δ, p) and its derivatives at a place.
struct Potential {
  double energy = 0, d = 0, p = 0, dd = 0, dp = 0, pp = 0;
};

/// What a law with a mover says: δ = q − x₀, p = x₁.
[[nodiscard]] inline Response response_of(const Potential& h) noexcept {
  return {h.energy, -h.d, {h.d, -h.p}, {.qq = h.dd, .qx = {-h.dd, h.dp}, .xx = {h.dd, h.pp}, .x0x1 = -h.dp}};
}

/// H = ½ κ e² of a spring with elongation e(δ, p), which isn't pushed: 0 below e = 0. `e`: that and its derivatives.
[[nodiscard]] inline Potential pulled(double rate, const Potential& e) noexcept {
  if (e.energy <= 0) return {};
  const double f = rate * e.energy;
  return {0.5 * f * e.energy,         f * e.d, f * e.p, rate * e.d * e.d + f * e.dd, rate * e.d * e.p + f * e.dp,
          rate * e.p * e.p + f * e.pp};
}

/// Shape has `Potential at(double deflection, double mover)` and ==.
template <class Shape>
class SpringAndMover : public Transmission {
 public:
  explicit SpringAndMover(const Shape& shape) noexcept : shape_(shape) {}

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override {
    return response_of(shape_.at(at.q - at.x[0], at.x[1]));
  }
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium, c.preset};
  }
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override { return {x[0], x[1]}; }
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override {
    const auto* same = dynamic_cast<const SpringAndMover*>(&other);
    return same != nullptr && same->shape_ == shape_;
  }

 private:
  Shape shape_;
};

}  // namespace vsa::elastic
