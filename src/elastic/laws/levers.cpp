// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A lever between springs and output, whose arms motor 2 changes: at rest the springs are at ease, so stiffening costs no work
// there (∂H/∂x₁ = 0 at δ = 0).
//
//   H = A(p) sin² δ,   δ = q − x₀,   p = p₀ + h x₁,   σ at rest = 2 A,   largest torque A, at |δ| = π/4
//   lever_pivot   the pivot moves (AwAS-II, CompAct):         A = K ((L/r) p/(L − p))²   p = 0: no stiffness; p → L: rigid
//   lever_spring  the springs' place moves (AwAS):            A = k p²                   two springs, each stretched by p sin δ
//   lever_cardan  the pivot moves by Cardan gears (vsaUT-II): A = k d² tan⁴ φ/2,  φ = φ₀ + g x₁
//
// lever_cardan: springs at one end of a lever, at the other a pin of the output, d from its axis, which moves d sin δ across it.
// A planet that rolls inside a ring of twice its size moves the pivot along the whole lever, in a straight line though everything
// turns: from the springs' end it is at p = (1 − cos φ) half lengths, so that the springs' end moves p/(L − p) = tan² φ/2 times
// the pin. φ = 0: no stiffness, φ → π: rigid; beyond 0 the pivot comes back. The springs are linear, and so is the torque within
// 5 % up to |δ| = 0.27.
//
// Beyond the pivot's stop (p > s, |φ| > φ_s) A goes on by its second-order expansion there. Softening beyond |δ| = π/4; use below.
//
// Sources: the public NMMI/ROS-Gazebo-compliant-actuators-plugin (2021) for the pivot: τ = −2K ((L/r) p/(L − p))² sin δ cos δ,
// which leaves out the pivot's own load and divides by zero at p = L; A. Jafari, N. G. Tsagarakis, D. G. Caldwell, IROS 2010 and
// ICRA 2011, for the mechanisms; S. Groothuis and others, The variable stiffness actuator vsaUT-II, IEEE/ASME Transactions on
// Mechatronics 19 (2014) 589, whose abstract has the lever, the moved pivot and the planetary gears: its equations here are ours.
// So are the potentials, and with them the loads of motor 2.
#include <algorithm>
#include <cmath>

#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kPivot[] = {
    {"spring_Nm", "N·m", 1e-6, 1e6, "the springs' torque scale at the lever, K"},
    {"length_m", "m", 1e-4, 10, "way from no stiffness to a rigid joint, L"},
    {"radius_m", "m", 1e-4, 10, "the springs' place, r"},
    {"start_m", "m", 0, 10, "where the pivot is at preset 0, p₀; 0: a joint without stiffness"},
    {"screw_m_per_rad", "m/rad", 1e-6, 1, "the pivot's travel a radian of motor 2, h"},
    {"stop_m", "m", 1e-5, 10, "end of the pivot's travel, s, short of L"},
};
constexpr LawParameter kSpring[] = {
    {"spring_N_per_m", "N/m", 1e-3, 1e8, "rate of each of the two springs, k"},
    {"start_m", "m", 0, 10, "where the springs are at preset 0, p₀; 0: a joint without stiffness"},
    {"screw_m_per_rad", "m/rad", 1e-6, 1, "the springs' travel a radian of motor 2, h"},
};
constexpr LawParameter kCardan[] = {
    {"spring_N_per_m", "N/m", 1e-3, 1e8, "rate of each of the two springs, k"},
    {"pin_m", "m", 1e-4, 10, "distance of the output's pin from its axis, d"},
    {"start_rad", "rad", 0, 2.9, "angle of the gears at preset 0, φ₀; 0: a joint without stiffness"},
    {"gear", "1", 1e-3, 1e3, "how far the gears turn a radian of motor 2, g"},
    {"stop_rad", "rad", 0.01, 2.9, "end of the gears' way, φ_s, short of π"},
};

/// A and its derivatives by x₁.
struct Arm {
  double value, slope, bend;
};
/// A goes on for `beyond` from where it is this.
[[nodiscard]] Arm expanded(const Arm& a, double beyond) noexcept {
  return {a.value + beyond * (a.slope + 0.5 * beyond * a.bend), a.slope + beyond * a.bend, a.bend};
}
[[nodiscard]] Potential turned(const Arm& a, double d) noexcept {
  const double s = std::sin(d), twice = std::sin(2 * d);
  return {a.value * s * s, a.value * twice, a.slope * s * s, 2 * a.value * std::cos(2 * d), a.slope * twice, a.bend * s * s};
}

struct Pivot {
  double rate, length, radius, start, screw, stop;
  bool operator==(const Pivot&) const = default;
  [[nodiscard]] Potential at(double d, double mover) const noexcept {
    // u = p/(L − p), u' = L/(L − p)², u'' = 2L/(L − p)³
    const double p = start + screw * mover, inside = std::min(p, stop), left = length - inside, u = inside / left;
    const double u1 = length / (left * left), u2 = 2 * u1 / left, a = rate * length * length / (radius * radius);
    const Arm arm = expanded({a * u * u, 2 * a * u * u1, 2 * a * (u1 * u1 + u * u2)}, p - inside);
    return turned({arm.value, screw * arm.slope, screw * screw * arm.bend}, d);
  }
};
struct Place {
  double rate, start, screw;
  bool operator==(const Place&) const = default;
  [[nodiscard]] Potential at(double d, double mover) const noexcept {
    const double p = start + screw * mover;
    return turned({rate * p * p, 2 * rate * p * screw, 2 * rate * screw * screw}, d);
  }
};
struct Cardan {
  double rate, pin, start, gear, stop;
  bool operator==(const Cardan&) const = default;
  [[nodiscard]] Potential at(double d, double mover) const noexcept {
    // t = tan φ/2, t' = (1 + t²)/2: (t⁴)' = 2 t³ (1 + t²), (t⁴)'' = t² (1 + t²) (3 + 5 t²)
    const double angle = start + gear * mover, inside = std::clamp(angle, -stop, stop), t = std::tan(0.5 * inside);
    const double s = t * t, a = rate * pin * pin;
    const Arm arm = expanded({a * s * s, 2 * a * s * t * (1 + s), a * s * (1 + s) * (3 + 5 * s)}, angle - inside);
    return turned({arm.value, gear * arm.slope, gear * gear * arm.bend}, d);
  }
};

}  // namespace

extern const Law kLeverCardan{
    .name = "lever_cardan",
    .title = "lever whose pivot is moved by Cardan gears",
    .equation = "H = k d² tan⁴(φ/2) sin² δ,  φ = φ₀ + g x₁",
    .source = "S. Groothuis and others, IEEE/ASME T-Mechatronics 19 (2014) 589 (vsaUT-II): the mechanism; the law: derived here",
    .parameters = kCardan,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<Cardan>>(Cardan{v[0], v[1], v[2], v[3], v[4]});
    },
    .fault = [](std::span<const double> v) -> std::optional<LawFault> {
      if (v[2] < v[4]) return std::nullopt;
      return LawFault{"start_rad", "is beyond the end of the gears' way", "below elastic.stop_rad"};
    },
};

extern const Law kLeverPivot{
    .name = "lever_pivot",
    .title = "lever whose pivot moves",
    .equation = "H = K ((L/r) p/(L − p))² sin² δ,  p = p₀ + h x₁",
    .source = "NMMI/ROS-Gazebo-compliant-actuators-plugin, 2021 (AwAS-II); the pivot's load: derived here",
    .parameters = kPivot,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<Pivot>>(Pivot{v[0], v[1], v[2], v[3], v[4], v[5]});
    },
    .fault = [](std::span<const double> v) -> std::optional<LawFault> {
      if (v[5] >= v[1]) return LawFault{"stop_m", "the joint is rigid there", "below elastic.length_m"};
      if (v[3] >= v[5]) return LawFault{"start_m", "is beyond the end of the travel", "below elastic.stop_m"};
      return std::nullopt;
    },
};

extern const Law kLeverSpring{
    .name = "lever_spring",
    .title = "lever along which the springs move",
    .equation = "H = k p² sin² δ,  p = p₀ + h x₁",
    .source = "A. Jafari and others, IROS 2010 (AwAS): the mechanism; the law: derived here",
    .parameters = kSpring,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<Place>>(Place{v[0], v[1], v[2]});
    },
};

}  // namespace vsa::elastic
