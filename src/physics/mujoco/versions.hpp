// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where MuJoCo's versions differ in what the engine needs: 2.2.2, as Debian has it, and those from 3.2 on.
//   mass matrix   qM by the tree's chains; later M by rows (CSR), and mj_factorM() takes that
//   memory        rows, contacts and stack by number; later one arena
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace vsa::physics {

#if mjVERSION_HEADER >= 333
#define VSA_MUJOCO_M_BY_ROWS
#endif

/// What mj_factorM() takes.
inline std::span<mjtNum> mass_numbers(const mjModel& m, mjData& d) {
#ifdef VSA_MUJOCO_M_BY_ROWS
  return {d.M, static_cast<std::size_t>(m.nC)};
#else
  return {d.qM, static_cast<std::size_t>(m.nM)};
#endif
}

/// Of it, the number on the diagonal.
inline mjtNum& mass_of_dof(const mjModel& m, mjData& d, int dof) {
#ifdef VSA_MUJOCO_M_BY_ROWS
  return d.M[m.M_rowadr[dof] + m.M_rownnz[dof] - 1];
#else
  return d.qM[m.dof_Madr[dof]];
#endif
}

/// M at the positions that `d` has, from mj_comPos() on; and the same, nv × nv.
inline void make_mass(const mjModel& m, mjData& d) {
#ifdef VSA_MUJOCO_M_BY_ROWS
  mj_makeM(&m, &d);
#else
  mj_crb(&m, &d);
#endif
}
inline void full_mass(const mjModel& m, const mjData& d, mjtNum* out) {
#if mjVERSION_HEADER >= 3010000
  mj_fullM(&m, &d, out);
#else
  mj_fullM(&m, out, d.qM);
#endif
}

/// What mj_factorM() takes, nv × nv.
inline void dense_mass(const mjModel& m, const mjData& d, mjtNum* out) {
#ifdef VSA_MUJOCO_M_BY_ROWS
  mju_zero(out, m.nv * m.nv);
  for (int i = 0; i < m.nv; ++i) {
    for (int k = m.M_rowadr[i]; k < m.M_rowadr[i] + m.M_rownnz[i]; ++k)
      out[i * m.nv + m.M_colind[k]] = out[m.M_colind[k] * m.nv + i] = d.M[k];
  }
#else
  mj_fullM(&m, out, d.qM);
#endif
}

/// Whether qfrc_bias is more than mj_rne() tells: what tendons with an armature add.
inline bool bias_has_more([[maybe_unused]] const mjModel& m) {
#if mjVERSION_HEADER >= 327
  return std::any_of(m.tendon_armature, m.tendon_armature + m.ntendon, [](mjtNum a) { return a > 0; });
#else
  return false;
#endif
}

/// Whether an equality holds from the start.
inline bool starts_active(const mjModel& m, int equality) {
#if mjVERSION_HEADER >= 300
  return m.eq_active0[equality] != 0;
#else
  return m.eq_active[equality] != 0;
#endif
}

/// Of a weld or a connect, whose sides may be sites. Templates, so that what only later versions have can be asked for.
template <class Model>
bool holds_sites(const Model& m, int equality) {
  if constexpr (requires { m.eq_objtype; }) return m.eq_objtype[equality] == mjOBJ_SITE;
  return false;
}
template <class Model>
int body_held(const Model& m, int equality, int object) {
  return holds_sites(m, equality) ? m.site_bodyid[object] : object;
}

/// What `<option><flag>` switches off, by MuJoCo's words: where its versions have several for one thing, all of them.
inline bool switched_off(const mjModel& m, std::initializer_list<std::string_view> words) {
  for (int bit = 0; bit < mjNDISABLE; ++bit)
    if ((m.opt.disableflags & (1 << bit)) != 0 && std::find(words.begin(), words.end(), mjDISABLESTRING[bit]) != words.end())
      return true;
  return false;
}
inline bool without_equalities(const mjModel& m) { return switched_off(m, {"Constraint", "Equality"}); }
inline bool without_springs(const mjModel& m) { return switched_off(m, {"Passive", "Spring"}); }
inline bool without_dampers(const mjModel& m) { return switched_off(m, {"Passive", "Damper"}); }

/// Between which lengths a tendon's spring rests.
inline std::array<mjtNum, 2> rest_of_tendon(const mjModel& m, int tendon) {
#if mjVERSION_HEADER >= 300
  return {m.tendon_lengthspring[2 * tendon], m.tendon_lengthspring[2 * tendon + 1]};
#else
  return {m.tendon_lengthspring[tendon], m.tendon_lengthspring[tendon]};
#endif
}

/// matᵀ vec
inline void turned_back(mjtNum* out, const mjtNum* vec, const mjtNum* mat) {
#if mjVERSION_HEADER >= 300
  mju_mulMatTVec3(out, mat, vec);
#else
  mju_rotVecMatT(out, vec, mat);
#endif
}

/// Room for a number for each row of constraints: 2.2.2 tells how many there may ever be.
inline std::size_t row_room([[maybe_unused]] const mjModel& m, [[maybe_unused]] const mjData& d) {
#if mjVERSION_HEADER >= 300
  return static_cast<std::size_t>(d.nefc);
#else
  return static_cast<std::size_t>(m.njmax);
#endif
}

/// Room for more contacts. False: the model has as much as it may have.
inline bool grow_contacts(mjModel& m) {
#if mjVERSION_HEADER >= 300
  constexpr auto kMost = std::size_t{1} << 32;
  if (static_cast<std::size_t>(m.narena) >= kMost) return false;
  m.narena *= 4;
  return true;
#else
  constexpr int kMostContacts = 1 << 17;  // of half a kilobyte each
  if (m.nconmax * 2 > kMostContacts) return false;
  m.nconmax *= 2;
  return true;
#endif
}

/// More room for contacts and their rows, or where rows have as much as they may have for contacts alone, if `contacts_only` are
/// missing. False: the model has as much as it may have.
inline bool grow_memory(mjModel& m, [[maybe_unused]] bool contacts_only) {
#if mjVERSION_HEADER >= 300
  constexpr auto kMost = std::size_t{1} << 32;  // bytes, touched only as far as used
  if (static_cast<std::size_t>(m.narena) >= kMost) return false;
  m.narena *= 4;
#else
  constexpr int kMostRows = 12000;  // 12000² doubles of MuJoCo's dual matrix: 1.2 GB, touched only as far as used
  if (m.njmax * 2 > kMostRows) return contacts_only && grow_contacts(m);
  m.njmax *= 2;
  m.nconmax *= 2;
  m.nstack *= 4;
#endif
  return true;
}

/// False: no room among the virtual files.
inline bool add_file(mjVFS& vfs, const std::string& name, const std::string& bytes) {
#if mjVERSION_HEADER >= 300
  return mj_addBufferVFS(&vfs, name.c_str(), bytes.data(), static_cast<int>(bytes.size())) == 0;
#else
  if (mj_makeEmptyFileVFS(&vfs, name.c_str(), static_cast<int>(bytes.size())) != 0) return false;
  std::copy(bytes.begin(), bytes.end(), static_cast<char*>(vfs.filedata[mj_findFileVFS(&vfs, name.c_str())]));
  return true;
#endif
}

}  // namespace vsa::physics
