// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An elastic law in a shared library of your own, for vsa, the Gazebos and Python: VSA_LAW_PATH names its directory.
//
// Two cubic springs against each other, one to each motor.
//
//   e_i = q − x_i,   H = Σ ½ k e_i² + ¼ c e_i⁴,   τ = −Σ (k e_i + c e_i³),   load_i = k e_i + c e_i³
//
// x = equilibrium ± preset, rad; at rest σ = 2 (k + 3 c p²). Any deflection.
//
// Source: made up, to copy.
#include <memory>

#include "vsa/elastic/law_module.hpp"

namespace {

using namespace vsa::elastic;

class Cubic final : public Transmission {
 public:
  Cubic(double linear, double cubic) noexcept : linear_(linear), cubic_(cubic) {}

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override {
    Response r{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double e = at.q - at.x[i], torque = (linear_ + cubic_ * e * e) * e, stiffness = linear_ + 3 * cubic_ * e * e;
      r.energy += (0.5 * linear_ + 0.25 * cubic_ * e * e) * e * e;
      r.torque -= torque;
      r.load[i] = torque;
      r.curvature.qq += stiffness;
      r.curvature.qx[i] = -stiffness;
      r.curvature.xx[i] = stiffness;
    }
    return r;
  }
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium + c.preset, c.equilibrium - c.preset};
  }
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return {0.5 * (x[0] + x[1]), 0.5 * (x[0] - x[1])};
  }
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override {
    const auto* same = dynamic_cast<const Cubic*>(&other);
    return same != nullptr && same->linear_ == linear_ && same->cubic_ == cubic_;
  }

 private:
  double linear_, cubic_;
};

constexpr LawParameter kParameters[] = {
    {"linear_Nm_per_rad", "N·m/rad", 1e-6, 1e4, "linear part of each spring, k"},
    {"cubic_Nm_per_rad3", "N·m/rad³", 0, 1e6, "hardening of each spring, c"},
};

const Law kCubic{
    .name = "cubic",
    .title = "two cubic springs against each other",
    .equation = "H = Σ k e²/2 + c e⁴/4,  e = q − x",
    .source = "made up",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> { return std::make_shared<Cubic>(v[0], v[1]); },
};

}  // namespace

VSA_EXPORT_LAWS(&kCubic)
