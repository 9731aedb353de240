// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A spring pressed by rollers on cams of parabolic profile, z = c δ².
//
//   cam_roller  one cam; motor 2 presses the spring by a screw (DLR's VS-Joint):   e = c δ² + h x₁ + e₀
//               at rest σ = 2 κ c (h x₁ + e₀); stiffening works against the spring even there
//   two_cams    two cams against each other, turned apart by motor 2 (DLR's FSJ):  e = c (δ − x₁)² + c (δ + x₁)² = 2c (δ² + x₁²)
//               at rest σ = 8 κ c² x₁², and from there 8 κ c² δ more a radian
//   H = ½ κ max(e, 0)²,  δ = q − x₀;  preset: x₁, rad
//
// Sources: S. Wolf, G. Hirzinger, A new variable stiffness design, ICRA 2008; S. Wolf, O. Eiberger, G. Hirzinger, The DLR FSJ, ICRA 2011:
// the mechanisms. The parabola stands for profiles that aren't published.
#include "elastic/laws/shapes.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr LawParameter kOne[] = {
    {"spring_N_per_m", "N/m", 1e-3, 1e8, "spring rate, κ"},
    {"lift_m_per_rad2", "m/rad²", 1e-6, 10, "the cam's lift per square of the deflection, c"},
    {"screw_m_per_rad", "m/rad", 1e-6, 1, "how far motor 2 presses the spring, a radian, h"},
    {"pretension_m", "m", 0, 1, "how far it is pressed at preset 0, e₀"},
};
constexpr LawParameter kTwo[] = {
    {"spring_N_per_m", "N/m", 1e-3, 1e8, "spring rate, κ"},
    {"lift_m_per_rad2", "m/rad²", 1e-6, 10, "each cam's lift per square of its deflection, c"},
};

struct OneCam {
  double rate, lift, screw, before;
  bool operator==(const OneCam&) const = default;
  [[nodiscard]] Potential at(double d, double mover) const noexcept {
    return pulled(rate, {lift * d * d + screw * mover + before, 2 * lift * d, screw, 2 * lift, 0, 0});
  }
};
struct TwoCams {
  double rate, lift;
  bool operator==(const TwoCams&) const = default;
  [[nodiscard]] Potential at(double d, double apart) const noexcept {
    return pulled(rate, {2 * lift * (d * d + apart * apart), 4 * lift * d, 4 * lift * apart, 4 * lift, 0, 4 * lift});
  }
};

}  // namespace

extern const Law kCamRoller{
    .name = "cam_roller",
    .title = "roller on a cam, its spring pressed by motor 2",
    .equation = "H = κ/2 max(c δ² + h x₁ + e₀, 0)²",
    .source = "S. Wolf, G. Hirzinger, ICRA 2008 (VS-Joint); the profile: a parabola",
    .parameters = kOne,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<OneCam>>(OneCam{v[0], v[1], v[2], v[3]});
    },
};

extern const Law kTwoCams{
    .name = "two_cams",
    .title = "two cams turned apart, a spring between",
    .equation = "H = κ/2 (2c (δ² + x₁²))²",
    .source = "S. Wolf, O. Eiberger, G. Hirzinger, ICRA 2011 (FSJ); the profile: a parabola",
    .parameters = kTwo,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<SpringAndMover<TwoCams>>(TwoCams{v[0], v[1]});
    },
};

}  // namespace vsa::elastic
