// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A ball on a cord falls against Frank's hanging right hand (world frank_ball), at one stiffness preset of shoulder and elbow.
//
//   L = I q̇, I = m(l² + ⅖r²)         the ball's angular momentum about the pivot
//   dL/dt = −m g l sin φ + T_contact   φ from straight down; T from the contact's forces: what a test compares
//
// An encounter is over when ball and hand have been apart for 0.2 s. Later ones, when the ball swings back, count for nothing.
#pragma once

#include <vector>

namespace vsa::stiffness_uses {

struct ImpactTrace {
  std::vector<double> time_s, force_N, shoulder_deg;  ///< from the release on
};

struct ImpactRun {
  double preset_rad = 0;            ///< commanded to shoulder and elbow
  double attained_rad = 0;          ///< the shoulder's just before the hit
  double stiffness_Nm_per_rad = 0;  ///< the shoulder's, at rest
  double ball_speed_m_per_s = 0;    ///< just before the hit
  double ball_after_m_per_s = 0;    ///< just after the encounter, along the same direction
  double peak_N = 0;                ///< largest contact force
  double push_N = 0;                ///< largest of the contact force's means over 50 ms
  double contact_s = 0;             ///< first to last touch of the encounter
  double impulse_Ns = 0;            ///< of the contact, at the ball's centre
  double momentum_Ns = 0;           ///< the ball's change of momentum less gravity's part: what the impulse must be
  double absorbed_J = 0;            ///< what the ball lost, kinetic and gravitational
  double shoulder_deg = 0;          ///< farthest that it gave way
  double settle_s = 0;              ///< from the hit until the shoulder stays within 1° of its rest
  ImpactTrace trace;
};

[[nodiscard]] ImpactRun run_impact(double preset_rad, double duration_s = 10.0);

}  // namespace vsa::stiffness_uses
