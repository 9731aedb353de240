// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A law whose inputs, or whose shaft, are travels, behind what makes travels of angles: a ball screw, a rack on a pinion, a winch.
//
//   q = ρ ψ,  x_i = h_i φ_i           ψ, φ angles, rad; q, x the law's own; ρ, h_i m/rad; 1 where nothing is between
//   H'(ψ, φ) = H(ρ ψ, h φ)            J
//   τ' = ρ τ,  load'_i = h_i load_i   N·m, where the law's own torque or load is a force, N
//   ∂²H'/∂ψ² = ρ² σ,                  ∂²H'/∂ψ∂φ_i = ρ h_i ∂²H/∂q∂x_i,     ∂²H'/∂φ_i∂φ_j = h_i h_j ∂²H/∂x_i∂x_j
//   φ_ref = x_ref / h,                equilibria: ψ = q / ρ
//
// Exact: a segment that is straight in ψ and φ is straight in q and x, so the law's own means hold. All else of an actuator stays at
// the pulley: inertia, friction, encoder counts, references and readings are those of a turning motor. The preset's unit stays the
// law's. Range: h, ρ > 0 and finite. What rubs in a screw is the gearbox's (drive/motor.hpp).
#pragma once

#include <memory>
#include <optional>

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

/// Lead of each input that is a travel, m/rad, and the radius of a pinion at a shaft that is one, m.
struct Leads {
  std::array<std::optional<double>, 2> input;  ///< of a pulley; none: the law's input is an angle
  std::optional<double> shaft;                 ///< of a pinion; none: the law's shaft turns, or its travel is the actuator's own
  bool operator==(const Leads&) const = default;
};

/// A law behind ball screws, racks or winches: H'(ψ, φ) = H(ρ ψ, h φ), so that what has a lead, or a pinion, turns as seen from
/// outside.
class Travel final : public Transmission {
 public:
  /// The leads as they are: validate() looks at them.
  Travel(std::shared_ptr<const Transmission> law, const Leads& leads) noexcept;

  /// The one behind, with its own units.
  [[nodiscard]] const std::shared_ptr<const Transmission>& law() const noexcept { return law_; }
  [[nodiscard]] const Leads& leads() const noexcept { return leads_; }  ///< as given

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override;  ///< in the angles ψ and φ, as all below
  [[nodiscard]] double energy(const Positions& at) const noexcept override;
  [[nodiscard]] SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept override;
  [[nodiscard]] Origin origin(const Positions& at) const noexcept override;
  [[nodiscard]] Origin moved(const Origin& from, const Positions& to) const noexcept override;  ///< by the law's own
  [[nodiscard]] SegmentMean mean_from(const Origin& from, const Positions& to, double ahead_rad) const noexcept override;
  /// σ at the joint; tensions of the springs that are left.
  [[nodiscard]] Tangent tangent_of(const Origin& here) const noexcept override;
  [[nodiscard]] double energy_of(const Origin& here) const noexcept override;
  /// Of the springs that are left.
  [[nodiscard]] std::array<double, 2> signed_energies_of(const Origin& here) const noexcept override;
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& command) const noexcept override;
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override;
  [[nodiscard]] std::optional<EquilibriumPreset> command_exactly(double q, double torque_Nm,
                                                                 double stiffness_Nm_per_rad) const noexcept override;
  [[nodiscard]] int motor_count() const noexcept override { return law_->motor_count(); }  ///< the law's
  /// None where one would lie behind a travel: it has no deflection q − φ.
  [[nodiscard]] int spring_count() const noexcept override;
  [[nodiscard]] std::array<double, 2> signed_energies(const Positions& at) const noexcept override;
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override;
  [[nodiscard]] std::string_view preset_unit() const noexcept override { return law_->preset_unit(); }
  [[nodiscard]] std::string_view input_unit(std::size_t input) const noexcept override;
  [[nodiscard]] std::string_view shaft_unit() const noexcept override { return leads_.shaft ? "rad" : law_->shaft_unit(); }
  void validate(std::string_view where, Problems& problems) const override;

 private:
  [[nodiscard]] Positions own(const Positions& at) const noexcept;
  [[nodiscard]] Origin own(const Origin& at) const noexcept;
  [[nodiscard]] Origin seen(Origin origin, const Positions& at) const noexcept;
  [[nodiscard]] std::array<double, 2> loads(const std::array<double, 2>& own) const noexcept;
  [[nodiscard]] Hessian curvature(Hessian own) const noexcept;

  std::shared_ptr<const Transmission> law_;
  Leads leads_;
  std::array<double, 2> h_;
  double rho_;
};

/// The law with this lead at one of its inputs, and those that it had at the others.
[[nodiscard]] std::shared_ptr<const Transmission> with_lead(const std::shared_ptr<const Transmission>& law, std::size_t input,
                                                            double lead_m_per_rad);

/// The law, whose shaft slides, behind a rack on a pinion of this radius: a law of a turning shaft.
[[nodiscard]] std::shared_ptr<const Transmission> with_pinion(const std::shared_ptr<const Transmission>& law, double radius_m);

/// How far the law's shaft goes with a radian of this pulley where both are joined by a spring alone, as in a series elastic unit: its
/// lead, over a pinion's radius; 1 where both turn.
[[nodiscard]] double shaft_per_pulley(const Transmission& law, std::size_t input) noexcept;

/// Of the law without any lead: "m" for a travel.
[[nodiscard]] std::string_view own_input_unit(const Transmission& law, std::size_t input) noexcept;

}  // namespace vsa::elastic
