// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/droop_stepper.hpp"

#include <cmath>

namespace vsa::drive {
namespace {

constexpr double kSmall = 0.03;  // below it the closed forms lose digits and these series have twelve

double phi2_series(double x) noexcept {
  return 1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x * (1.0 / 720 - x / 5040))));
}

double psi_series(double x) noexcept {
  return 1.0 / 12 - x * (1.0 / 12 - x * (17.0 / 360 - x * (7.0 / 360 - x * (43.0 / 6720 - x * 107.0 / 60480))));
}

}  // namespace

DroopStepper::DroopStepper(const MotorParams& p, double droop_As_per_rad, double h_s) noexcept
    : h_(h_s),
      inertia_(p.inertia_kgm2),
      torque_constant_(p.torque_constant_Nm_per_A),
      droop_(droop_As_per_rad),
      decay_((p.viscous_Nms_per_rad + torque_constant_ * droop_) / inertia_) {
  const double x = decay_ * h_;
  if (x < kSmall) {
    phi2_ = phi2_series(x);
    phi1_ = 1.0 - x * phi2_;
    psi_ = psi_series(x);
    return;
  }
  const double rest = std::exp(-x);
  phi1_ = (1.0 - rest) / x;
  phi2_ = (1.0 - phi1_) / x;
  psi_ = phi1_ * (0.5 * (1.0 + rest) - phi1_) / (x * x);
}

MotorStep DroopStepper::step(double speed, double current_at_rest, double torque) const noexcept {
  const double slope = start_slope(speed, current_at_rest, torque);
  MotorStep out;
  out.displacement = h_ * (speed + h_ * phi2_ * slope);
  out.speed = speed + h_ * phi1_ * slope;
  out.current = current_at_rest - droop_ * out.speed;
  const double mean = out.displacement / h_, mean_current = current_at_rest - droop_ * mean;
  const double apart = spread(speed, current_at_rest, torque);
  out.charge = h_ * mean_current;
  out.int_ww = h_ * mean * mean + apart;
  out.int_Iw = h_ * mean_current * mean - droop_ * apart;
  out.int_II = h_ * mean_current * mean_current + droop_ * droop_ * apart;
  return out;
}

}  // namespace vsa::drive
