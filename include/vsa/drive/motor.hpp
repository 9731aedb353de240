// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// DC motor behind a gearbox, seen at the driving pulley.
//
//   J ω̇ = K_τ I − b ω + T          J inertia, b viscous friction, T all other torque on the pulley (spring, friction)
//   L İ = V − R I − K_b ω          with inductance
//   I   = (V − K_b ω)/R            without (the paper's eq. 6; a unit's L/R is far below 1 ms)
//   θ = n q,  τ_motor = T/n        gearbox (eq. 4–5): J, b scale with n², K_τ, K_b, and the loss torque with n
//
// For constant V and T over a step the system is linear; its step is exact (matrix exponential, prepared once per step length),
// and so are the integrals that the energy ledger needs: ∫I², ∫ω², ∫Iω, ∫I, ∫ω.
// Where K_τ ≠ K_b (SI, same shaft) energy is not conserved between the electrical and the mechanical side; the ledger
// carries (K_b − K_τ)∫Iω as its own entry.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "vsa/drive/friction.hpp"

namespace vsa::drive {

inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();  ///< a number that somebody forgot

/// At the motor's own shaft; forgotten numbers stay NaN, which device::Unit refuses by name.
struct MotorParams {
  double inertia_kgm2 = kMissing;              ///< J
  double viscous_Nms_per_rad = kMissing;       ///< b
  double torque_constant_Nm_per_A = kMissing;  ///< K_τ
  double back_emf_Vs_per_rad = kMissing;       ///< K_b
  double resistance_Ohm = kMissing;            ///< R of the winding
  std::optional<double> inductance_H;          ///< none: I follows V and ω at once
  bool operator==(const MotorParams&) const = default;
};
/// Numbers that aren't finite, J or R that isn't above 0, negative ones.
void validate(const MotorParams& params, std::string_view where, Problems& problems);

/// A gearbox between motor and pulley, θ = n q, and what rubs in it.
struct GearboxParams {
  double ratio = 1.0;         ///< n = motor turns per pulley turn, > 0
  FrictionParams friction{};  ///< loss torque at the motor's shaft (eq. 5) and its presliding at the PULLEY
  double load_loss = 0;       ///< λ ≥ 0: friction grows by λ·|load on the pulley|; a gear of efficiency η has λ = 1/η − 1
  std::optional<double> back_loss{};  ///< λ where the load drives the motor back, ≥ 0: 1 − η; none: as load_loss
  bool operator==(const GearboxParams&) const = default;
};
/// A ratio that isn't above 0, negative losses.
void validate(const GearboxParams& params, std::string_view where, Problems& problems);

/// eq. (4)–(5): everything at the pulley.
[[nodiscard]] MotorParams at_pulley(const MotorParams& motor, double ratio) noexcept;
/// Presliding is the pulley's already and stays.
[[nodiscard]] FrictionParams at_pulley(const FrictionParams& loss, double ratio) noexcept;

/// Where a motor is, told at its pulley: all that its step changes.
template <class T>
struct MotorStateOf {
  T angle = 0;    ///< pulley, rad
  T speed = 0;    ///< rad/s
  T current = 0;  ///< A; a state only where the motor has inductance
  static auto fields(auto& s, auto&& visit) {
    return visit("angle", "rad", s.angle, "speed", "rad/s", s.speed, "current", "A", s.current);
  }
};
using MotorState = MotorStateOf<double>;  ///< of one motor

/// What the electrical side offers in a step.
/// Driven: a voltage at the terminals; open: no current.
enum class Terminal { driven, open };
[[nodiscard]] constexpr int choices(Terminal) noexcept { return 2; }  ///< for the walk over states: values that a Terminal may have

/// Exact results of a step of length h with constant voltage and torque.
template <class T>
struct MotorStepOf {
  T displacement = 0;  ///< ∫ω
  T speed = 0;         ///< at the end
  T current = 0;       ///< at the end
  T charge = 0;        ///< ∫I
  T int_II = 0,        ///< ∫I² dt, A²·s
      int_ww = 0,      ///< ∫ω² dt, rad²/s
      int_Iw = 0;      ///< ∫Iω dt, A·rad
};
using MotorStep = MotorStepOf<double>;  ///< of one motor

/// The exact step of one motor for one step length: z = (ω, I, V, T) → results. Copyable, no allocation.
class MotorStepper {
 public:
  MotorStepper() = default;
  MotorStepper(const MotorParams& pulley_side, Terminal terminal, double h_s) noexcept;  ///< h > 0; open: without current all along

  /// ∫ω for T = 0: the displacement without load.
  template <class T = double>
  [[nodiscard]] T free_displacement(const MotorStateOf<T>& s, std::type_identity_t<T> voltage) const noexcept {
    return displacement_[0] * s.speed + displacement_[1] * s.current + displacement_[2] * voltage;
  }
  /// ∂(∫ω)/∂T, rad/(N·m).
  [[nodiscard]] double compliance() const noexcept { return displacement_[3]; }
  /// Several lanes: without inductance only.
  template <class T = double>
  [[nodiscard]] MotorStepOf<T> step(const MotorStateOf<T>& s, std::type_identity_t<T> voltage,
                                    std::type_identity_t<T> torque) const noexcept {
    if constexpr (lanes::kScalar<T>) {
      if (inductance_) return with_inductance(s, voltage, torque);
    }
    return without_inductance<T>([&](auto&& number) { return number(*this); }, s.speed, voltage, torque);
  }
  /// Of two motors without inductance side by side, each by its own.
  [[nodiscard]] static MotorStepOf<lanes::Both> both(const MotorStepper& first, const MotorStepper& second, lanes::Both speed,
                                                     lanes::Both voltage, lanes::Both torque) noexcept {
    const auto of = [&](auto&& number) { return lanes::BothSides{}(number(first), number(second)); };
    return without_inductance<lanes::Both>(of, speed, voltage, torque);
  }
  [[nodiscard]] double h_s() const noexcept { return h_; }  ///< the step length that it was made for

 private:
  using Row = std::array<double, 4>;
  using Form = std::array<double, 10>;  // symmetric 4×4, upper triangle by rows
  [[nodiscard]] MotorStep with_inductance(const MotorState& s, double voltage, double torque) const noexcept;
  /// I = (V − K_b ω)/R at every instant: ∫ω and ∫ω² tell the other integrals. `of`: a number of this stepper, or of both.
  template <class T, class Of>
  [[nodiscard]] static MotorStepOf<T> without_inductance(Of&& of, T w, T v, T t) noexcept {
    using M = MotorStepper;
    const auto at = [&](Row M::*row, std::size_t i) { return of([=](const M& m) { return (m.*row)[i]; }); };
    const auto ww = [&](std::size_t i) { return of([=](const M& m) { return m.ww_[i]; }); };
    const auto back_emf = of([](const M& m) { return m.back_emf_; });
    const auto conductance = of([](const M& m) { return m.conductance_; });
    const auto h = of([](const M& m) { return m.h_; });
    MotorStepOf<T> out;
    out.displacement = at(&M::displacement_, 0) * w + at(&M::displacement_, 2) * v + at(&M::displacement_, 3) * t;
    out.speed = at(&M::speed_, 0) * w + at(&M::speed_, 2) * v + at(&M::speed_, 3) * t;
    out.int_ww = w * (ww(0) * w + ww(2) * v + ww(3) * t) + v * (ww(7) * v + ww(8) * t) + ww(9) * t * t;
    const T emf = back_emf * out.displacement, emf_w = back_emf * out.int_ww;
    const T forced = v * out.displacement - emf_w;  // ∫(V − K_b ω)ω
    out.current = conductance * (v - back_emf * out.speed);
    out.charge = conductance * (v * h - emf);
    out.int_Iw = conductance * forced;
    out.int_II = lanes::max(conductance * (v * out.charge - back_emf * out.int_Iw), 0.0);
    return out;
  }

  double h_ = 0;
  bool inductance_ = false;
  double conductance_ = 0, back_emf_ = 0;  // 1/R and K_b where there is no inductance; 0 if open
  Row displacement_{}, speed_{}, current_{}, charge_{};
  Form ii_{}, ww_{}, iw_{};
};

/// Current for a state at terminal voltage V, A.
[[nodiscard]] double current(const MotorParams& pulley_side, Terminal terminal, const MotorState& s, double voltage) noexcept;

}  // namespace vsa::drive
