// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Series elastic actuators: one motor, one spring, no preset.
//
//   δ = q − x₀,   H = ½ k δ² + ¼ c δ⁴,   τ = −(k δ + c δ³),   load₀ = −τ,   σ = k + 3 c δ²
//
// In a linear actuator δ = q − x₀ is a travel, and so are both ends: series_travel, with c in N/m³.
//
// c = 0 is series_spring (vsa/elastic/series_spring.hpp), a class of its own as it is used most.
#include <cmath>

#include "vsa/elastic/law.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kLinear[] = {{"stiffness_Nm_per_rad", "N·m/rad", 1e-6, 1e7, "stiffness of the spring"}};
constexpr LawParameter kCubic[] = {
    {"stiffness_Nm_per_rad", "N·m/rad", 1e-6, 1e7, "stiffness at rest, k"},
    {"hardening_Nm_per_rad3", "N·m/rad³", 0, 1e9, "what the torque gains with the deflection's cube, c"},
};

constexpr LawParameter kTravel[] = {
    {"stiffness_N_per_m", "N/m", 1e-3, 1e9, "stiffness at rest, k"},
    {"hardening_N_per_m3", "N/m³", 0, 1e18, "what the force gains with the deflection's cube, c; 0: a linear spring"},
};

class SeriesHardening : public Transmission {
 public:
  SeriesHardening(double k, double c) noexcept : k_(k), c_(c) {}

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override {
    const double d = at.q - at.x[0], torque = (k_ + c_ * d * d) * d, stiffness = k_ + 3 * c_ * d * d;
    Response r{};
    r.energy = (0.5 * k_ + 0.25 * c_ * d * d) * d * d;
    r.torque = -torque;
    r.load[0] = torque;
    r.curvature.qq = r.curvature.xx[0] = stiffness;
    r.curvature.qx[0] = -stiffness;
    return r;
  }
  // Means: the quadrature of Transmission is exact for a cubic.
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium, 0.0};
  }
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override { return {x[0], 0.0}; }
  [[nodiscard]] int motor_count() const noexcept override { return 1; }
  [[nodiscard]] int spring_count() const noexcept override { return 1; }
  [[nodiscard]] std::array<double, 2> signed_energies(const Positions& at) const noexcept override {
    const double d = at.q - at.x[0];
    return {std::copysign((0.5 * k_ + 0.25 * c_ * d * d) * d * d, d), 0.0};
  }
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override {
    const auto* same = dynamic_cast<const SeriesHardening*>(&other);
    return same != nullptr && same->k_ == k_ && same->c_ == c_ && same->shaft_unit() == shaft_unit();
  }
  [[nodiscard]] std::string_view preset_unit() const noexcept override { return ""; }

 private:
  double k_, c_;
};

class SeriesTravel final : public SeriesHardening {
 public:
  using SeriesHardening::SeriesHardening;
  [[nodiscard]] std::string_view input_unit(std::size_t input) const noexcept override { return input == 0 ? "m" : "rad"; }
  [[nodiscard]] std::string_view shaft_unit() const noexcept override { return "m"; }
};

}  // namespace

extern const Law kSeriesSpring{
    .name = "series_spring",
    .title = "series elastic, linear",
    .equation = "H = k δ²/2,  δ = q − x₀",
    .source = "G. A. Pratt, M. M. Williamson, Series elastic actuators, IROS 1995",
    .parameters = kLinear,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> { return std::make_shared<SeriesSpring>(v[0]); },
};

extern const Law kSeriesHardening{
    .name = "series_hardening",
    .title = "series elastic, hardening",
    .equation = "H = k δ²/2 + c δ⁴/4,  δ = q − x₀",
    .source = "this project: the first two terms of any even law",
    .parameters = kCubic,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SeriesHardening>(v[0], v[1]);
    },
};

extern const Law kSeriesTravel{
    .name = "series_travel",
    .title = "series elastic, a linear actuator",
    .equation = "H = k δ²/2 + c δ⁴/4,  δ = q − x₀ in m",
    .source = "G. A. Pratt, M. M. Williamson, Series elastic actuators, IROS 1995: the spring behind a ball screw",
    .parameters = kTravel,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SeriesTravel>(v[0], v[1]);
    },
};

}  // namespace vsa::elastic
