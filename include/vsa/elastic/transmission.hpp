// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An elastic transmission is one potential.
//
//   H(q, x) ≥ 0                    stored energy                               J
//   τ      = −∂H/∂q                torque on the shaft                         N·m
//   load_i = −∂H/∂x_i              torque on input i (driving pulley, pivot)   N·m
//   σ      =  ∂²H/∂q²              stiffness, what a user means by it          N·m/rad
//
// q is the output shaft, x the motor-side inputs after their gearboxes (rad; metres for a prismatic input). Where the shaft itself
// slides (shaft_unit()), q is in m, τ in N and σ in N/m. Losses are separate, passive terms and have no place here: a law that can
// be written as H can't create energy.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "vsa/lanes.hpp"

namespace vsa {
class Problems;
}

namespace vsa::elastic {

/// Where the transmission is: shaft and the two inputs. A law with one motor ignores x[1].
template <class T>
struct PositionsOf {
  T q = 0;               ///< rad (m where it slides)
  std::array<T, 2> x{};  ///< rad (m where it is a travel)
  static auto fields(auto& s, auto&& visit) { return visit("q", "rad", s.q, "x", "rad", s.x); }
};
using Positions = PositionsOf<double>;  ///< of one unit

/// Second derivatives of H (or of its mean over a segment; see SegmentMean).
template <class T>
struct HessianOf {
  T qq = 0;               ///< σ
  std::array<T, 2> qx{};  ///< ∂²H/∂q∂x_i, N·m/rad
  std::array<T, 2> xx{};  ///< ∂²H/∂x_i², N·m/rad; side by side, as one unit's sides take them
  T x0x1 = 0;             ///< ∂²H/∂x₀∂x₁, N·m/rad
  static auto fields(auto& s, auto&& visit) {
    return visit("qq", "N·m/rad", s.qq, "qx", "N·m/rad", s.qx, "xx", "N·m/rad", s.xx, "x0x1", "N·m/rad", s.x0x1);
  }
};
using Hessian = HessianOf<double>;  ///< of one unit

/// Everything a law says at one place.
struct Response {
  double energy = 0;           ///< H, J
  double torque = 0;           ///< τ = −∂H/∂q, N·m
  std::array<double, 2> load;  ///< load_i = −∂H/∂x_i, N·m
  Hessian curvature;           ///< ∂²H; curvature.qq is the stiffness σ
};

/// The mean torque and loads over the straight segment from → to:
///   τ̄ = −∫₀¹ ∂H/∂q (z₀ + s Δz) ds, likewise the loads, so that τ̄ Δq + Σ load̄_i Δx_i = −ΔH.
/// `slope` is the derivative of the mean gradient with respect to the segment's END, ∫₀¹ s ∂²H ds.
/// Midpoint-rule integrators that use these means conserve energy exactly, however stiff the law.
template <class T>
struct SegmentMeanOf {
  T torque = 0;             ///< τ̄, N·m
  std::array<T, 2> load{};  ///< likewise load̄, N·m
  HessianOf<T> slope;       ///< for the segment's end, N·m/rad
  static auto fields(auto& s, auto&& visit) {
    return visit("torque", "N·m", s.torque, "load", "N·m", s.load, "slope", "", s.slope);
  }
};
using SegmentMean = SegmentMeanOf<double>;  ///< of one unit

/// A place, and what the law keeps of it, so that means over segments that begin there and places close to it cost little. What is
/// kept means nothing to anyone else; a law may keep nothing.
template <class T>
struct OriginOf {
  PositionsOf<T> at;          ///< shaft and inputs there
  std::array<T, 2> kept{},    ///< of the law's own making: a number of each side
      kept_too{};             ///< and another
  lanes::Count<T> moves = 0;  ///< since it was worked out from `at` alone
  static auto fields(auto& s, auto&& visit) {
    return visit("at", "", s.at, "kept", "", s.kept, "kept_too", "", s.kept_too, "moves", "", s.moves);
  }
};
using Origin = OriginOf<double>;  ///< of one unit

/// The spring's own slope and tensions at a place: what tells how fast the swing on it is.
template <class T>
struct TangentOf {
  T stiffness = 0;             ///< σ = ∂²H/∂q², N·m/rad
  std::array<T, 2> tension{};  ///< |T_i| of the springs that the law names, N·m
};
using Tangent = TangentOf<double>;  ///< of one unit

/// What a user commands. The preset's unit belongs to the law (see Transmission::preset_unit).
struct EquilibriumPreset {
  double equilibrium = 0;  ///< rad
  double preset = 0;       ///< p, in the law's unit
};

/// An elastic transmission: one potential H(q, x) between motors and shaft, from which torque, loads and stiffness follow.
/// Immutable, so that units and threads share one; everything is pure, allocates nothing and throws nothing. An override is called
/// millions of times a second.
class Transmission {
 public:
  virtual ~Transmission() = default;
  Transmission(const Transmission&) = delete;
  Transmission& operator=(const Transmission&) = delete;

  /// H, its gradient and its second derivatives at one place.
  [[nodiscard]] virtual Response evaluate(const Positions& at) const noexcept = 0;

  /// H alone; override where it is cheaper than evaluate().
  [[nodiscard]] virtual double energy(const Positions& at) const noexcept { return evaluate(at).energy; }

  /// Default: three-point Gauss–Legendre quadrature of evaluate() along the segment, whose means are set right to do the work of the
  /// energies' difference. Laws with a closed form override it.
  [[nodiscard]] virtual SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept;

  /// The three together: where many segments follow each other, as in a simulation. They give what the functions of Positions do,
  /// but for rounding, which moved() doesn't let grow. Defaults keep nothing and call those.
  [[nodiscard]] virtual Origin origin(const Positions& at) const noexcept { return {at}; }
  /// The origin at `to`, worked out from one close by.
  [[nodiscard]] virtual Origin moved(const Origin&, const Positions& to) const noexcept { return origin(to); }
  /// The mean over from → to with the shaft (not the inputs) moved ahead by `ahead_rad` at both ends.
  [[nodiscard]] virtual SegmentMean mean_from(const Origin& from, const Positions& to, double ahead_rad) const noexcept {
    return mean_over({from.at.q + ahead_rad, from.at.x}, {to.q + ahead_rad, to.x});
  }
  /// σ and |T_i| at an origin. Default: of evaluate(), |load_i| for the tensions.
  [[nodiscard]] virtual Tangent tangent_of(const Origin& here) const noexcept;
  /// H and w (below) at an origin.
  [[nodiscard]] virtual double energy_of(const Origin& here) const noexcept { return energy(here.at); }
  /// w_i at an origin.
  [[nodiscard]] virtual std::array<double, 2> signed_energies_of(const Origin& here) const noexcept {
    return signed_energies(here.at);
  }

  /// Motor references x_ref for a commanded (equilibrium, preset).
  [[nodiscard]] virtual std::array<double, 2> references(const EquilibriumPreset& command) const noexcept = 0;
  /// The inverse: which command the inputs amount to. Springs that are alike rest there unloaded; unequal ones, of which it is the
  /// pulleys' mean, where rest_under() says (inverse.hpp).
  [[nodiscard]] virtual EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept = 0;

  /// The smallest preset ≥ 0 and its equilibrium that give this torque and stiffness at q, where the law has a closed form for it;
  /// none: it hasn't, or there is no such command. See inverse.hpp.
  [[nodiscard]] virtual std::optional<EquilibriumPreset> command_exactly(double /*q*/, double /*torque_Nm*/,
                                                                         double /*stiffness_Nm_per_rad*/) const noexcept {
    return std::nullopt;
  }

  /// 1 or 2; with 1 all of x[1], load[1] and their slopes count for nothing.
  [[nodiscard]] virtual int motor_count() const noexcept { return 2; }
  /// Springs whose tension a loss can be proportional to (actuator/actuator.hpp): spring i lies between input i and the shaft, with
  /// deflection δ_i = q − x_i. 0: the law names none, and such a loss is refused.
  [[nodiscard]] virtual int spring_count() const noexcept { return 0; }
  /// w_i = sign(δ_i)·H_i: the energy of spring i with the sign of its deflection, J. ∂w_i/∂q = |T_i|, its tension's magnitude, N·m.
  /// A law that names springs keeps all its energy in them: Σ|w_i| = H.
  [[nodiscard]] virtual std::array<double, 2> signed_energies(const Positions&) const noexcept { return {}; }
  /// Whether the other law gives the same everywhere. A law that doesn't say so is equal to itself only.
  [[nodiscard]] virtual bool equals(const Transmission& other) const noexcept { return this == &other; }
  /// Of input i: "rad" or, where it is a travel, "m". Motors turn pulleys: a travel needs elastic/travel.hpp between.
  [[nodiscard]] virtual std::string_view input_unit(std::size_t /*input*/) const noexcept { return "rad"; }
  /// Of q: "rad" or, for a linear actuator, "m"; torques are forces then.
  [[nodiscard]] virtual std::string_view shaft_unit() const noexcept { return "rad"; }
  /// Adds what is wrong with the law's own parameters, by their keys in files; a law that was made of checked ones has nothing to say.
  virtual void validate(std::string_view /*where*/, Problems& /*problems*/) const {}
  /// "rad" for the qbmove's half difference; "" where the law has no preset.
  [[nodiscard]] virtual std::string_view preset_unit() const noexcept { return "rad"; }

 protected:
  Transmission() = default;
};

}  // namespace vsa::elastic
