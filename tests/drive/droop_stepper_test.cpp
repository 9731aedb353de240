// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/droop_stepper.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace vsa::drive;

MotorParams motor(double resistance) { return {0.001, 0.01, 0.8, 0.9, resistance, std::nullopt}; }

TEST(DroopStepper, IsTheMotorOnAVoltageBehindAResistance) {
  for (const double h : {1e-5, 1e-3, 5e-2})
    for (const double R : {0.05, 2.3, 60.0, 5e3}) {
      const MotorParams m = motor(R);
      const DroopStepper droop(m, m.back_emf_Vs_per_rad / R, h);
      const MotorStepper exact(m, Terminal::driven, h);
      const MotorState s{0, 1.7, 0};
      const double V = 5.0, T = -0.6;
      const MotorStep a = droop.step(s.speed, V / R, T), b = exact.step(s, V, T);
      const auto near = [&](double x, double y, const char* what) {
        EXPECT_NEAR(x, y, 1e-11 * (std::abs(y) + h)) << what << ", R " << R << ", h " << h;
      };
      near(a.displacement, b.displacement, "displacement");
      near(a.charge, b.charge, "charge");
      near(a.int_ww, b.int_ww, "∫ω²");
      near(a.int_Iw, b.int_Iw, "∫Iω");
      near(a.int_II, b.int_II, "∫I²");
      EXPECT_NEAR(a.speed, b.speed, 1e-10 * (1 + std::abs(b.speed)));
      EXPECT_NEAR(a.current, b.current, 1e-10 * (1 + std::abs(b.current)));
      near(droop.free_displacement(s.speed, V / R) + droop.compliance() * T, a.displacement, "as the solver takes it");
      near(droop.spread(s.speed, V / R, T), b.int_ww - b.displacement * b.displacement / h, "∫(ω − ω̄)²");
    }
}

TEST(DroopStepper, WithoutDroopAndFrictionItThrowsTheMotorAlongAParabola) {
  MotorParams m = motor(1);
  m.viscous_Nms_per_rad = 0;
  const DroopStepper droop(m, 0, 0.01);
  const double a = (0.8 * 0.5 + 0.1) / 0.001;
  const MotorStep s = droop.step(2.0, 0.5, 0.1);
  EXPECT_NEAR(s.displacement, 2.0 * 0.01 + 0.5 * a * 1e-4, 1e-14);
  EXPECT_NEAR(s.speed, 2.0 + a * 0.01, 1e-13);
  EXPECT_NEAR(droop.spread(2.0, 0.5, 0.1), a * a * 1e-6 / 12, 1e-12);
}

}  // namespace
