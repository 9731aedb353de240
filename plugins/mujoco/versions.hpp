// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where MuJoCo's versions differ in what the units need, from 2.2.2 on.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace vsa::mujoco {

static_assert(sizeof(mjtNum) == sizeof(double), "a MuJoCo of single precision has no room for a unit's state");

// Since 3.11 an actuator may have several controls and forces; of one that has one of each they needn't stand at its number.
inline int actuator_count(const mjModel& m) {
#if mjVERSION_HEADER >= 3011000
  return static_cast<int>(m.nactuator);
#else
  return static_cast<int>(m.nu);
#endif
}

inline int control_address(const mjModel& m, int actuator) {
#if mjVERSION_HEADER >= 3011000
  return m.actuator_ctrladr[actuator];
#else
  static_cast<void>(m);
  return actuator;
#endif
}

inline int force_address(const mjModel& m, int actuator) {
#if mjVERSION_HEADER >= 3011000
  return m.actuator_outadr[actuator];
#else
  static_cast<void>(m);
  return actuator;
#endif
}

/// As mj_fwdActuation sees it: late, where the model says so, and within its range.
inline double control(const mjModel& m, const mjData& d, int actuator) {
  const int at = control_address(m, actuator);
  double u = d.ctrl[at];
#if mjVERSION_HEADER >= 3005000
  if (m.actuator_delay[actuator] != 0) u = mj_readCtrl(&m, &d, actuator, d.time, m.actuator_history[2 * actuator + 1]);
#endif
  if (m.actuator_ctrllimited[at] && (m.opt.disableflags & mjDSBL_CLAMPCTRL) == 0)
    u = std::clamp(u, m.actuator_ctrlrange[2 * at], m.actuator_ctrlrange[2 * at + 1]);
  return u;
}

/// What mj_factorM() takes: M by the tree's chains, from 3.3.3 on by rows.
inline std::span<mjtNum> mass_numbers(const mjModel& m, mjData& d) {
#if mjVERSION_HEADER >= 333
  return {d.M, static_cast<std::size_t>(m.nC)};
#else
  return {d.qM, static_cast<std::size_t>(m.nM)};
#endif
}

/// Of it, the number on the diagonal.
inline mjtNum& mass_of_dof(const mjModel& m, mjData& d, int dof) {
#if mjVERSION_HEADER >= 333
  return d.M[m.M_rowadr[dof] + m.M_rownnz[dof] - 1];
#else
  return d.qM[m.dof_Madr[dof]];
#endif
}

/// Whether the integrator takes the joints' damping implicitly, v' = v + dt·(M + dt·D)⁻¹ f.
inline bool damps_implicitly(const mjModel& m) {
#if mjVERSION_HEADER >= 300
  if (m.opt.integrator == mjINT_EULER && (m.opt.disableflags & mjDSBL_EULERDAMP) != 0) return false;
#endif
#if mjVERSION_HEADER >= 336
  if ((m.opt.disableflags & mjDSBL_DAMPER) != 0) return false;
#endif
  return std::any_of(m.dof_damping, m.dof_damping + static_cast<std::ptrdiff_t>(m.nv), [](mjtNum b) { return b > 0; });
}

}  // namespace vsa::mujoco
