// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/centered_bias.hpp"

#include <algorithm>
#include <cmath>

#include "physics/mujoco/versions.hpp"

namespace vsa::physics {
namespace {

constexpr double kMost = 0.1;  ///< of the speeds: beyond it dt is too long for what moves there, and more blows up

/// Of speeds, √ Σ M_ii x_i².
double size(const mjModel& m, mjData& d, const mjtNum* x) {
  double sum = 0;
  for (int i = 0; i < m.nv; ++i) sum += mass_of_dof(m, d, i) * x[i] * x[i];
  return std::sqrt(sum);
}

}  // namespace

CenteredBias::CenteredBias(const mjModel& model, Coriolis coriolis)
    : left_(coriolis == Coriolis::as_in_mj_step || bias_has_more(model)),
      before_(static_cast<std::size_t>(model.nv)),
      speeds_(before_) {}

void CenteredBias::set(const mjModel& m, mjData& d, const mjtNum* pushed) {
  if (left_) return;
  mjtNum* const speeds = speeds_.data();
  if (d.ne > 0) {
    mju_copy(speeds, d.qacc_warmstart, m.nv);
  } else {
    mju_sub(speeds, d.qfrc_passive, d.qfrc_bias, m.nv);
    mju_addTo(speeds, pushed, m.nv);
    mj_solveM(&m, &d, speeds, speeds, 1);
  }
  const double half_s = 0.5 * m.opt.timestep, change = half_s * size(m, d, speeds), most = kMost * size(m, d, d.qvel);
  mju_copy(before_.data(), d.qvel, m.nv);
  mju_addToScl(d.qvel, speeds, change > most ? half_s * most / change : half_s, m.nv);
  mj_comVel(&m, &d);
  mj_rne(&m, &d, 0, d.qfrc_bias);
  mju_copy(d.qvel, before_.data(), m.nv);
}

}  // namespace vsa::physics
