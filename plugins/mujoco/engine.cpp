// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "engine.hpp"

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace {

// What the units call of MuJoCo, as it declares them.
struct Called {
  decltype(&::mj_id2name) id2name = nullptr;
  decltype(&::mj_solveM) solve_m = nullptr;
  decltype(&::mj_factorM) factor_m = nullptr;
  decltype(&::mj_mulJacVec) mul_jac_vec = nullptr;
  decltype(&::mj_mulJacTVec) mul_jac_t_vec = nullptr;
  decltype(&::mj_mulM) mul_m = nullptr;
  decltype(&::mj_isSparse) is_sparse = nullptr;
  decltype(&::mj_fwdConstraint) fwd_constraint = nullptr;
  decltype(&::mj_constraintUpdate) constraint_update = nullptr;
  decltype(&::mju_cholFactor) chol_factor = nullptr;
  decltype(&::mju_cholSolve) chol_solve = nullptr;
  decltype(&::mju_norm3) norm3 = nullptr;
  decltype(&::mju_dist3) dist3 = nullptr;
  decltype(&::mju_rotVecQuat) rot_vec_quat = nullptr;
  decltype(&::mju_mulQuat) mul_quat = nullptr;
#if mjVERSION_HEADER >= 3005000
  decltype(&::mj_readCtrl) read_ctrl = nullptr;
#endif
};

constinit Called called;
constinit vsa::mujoco::Engine of_program;

}  // namespace

// Under MuJoCo's names, so that units.cpp is compiled as it is for a program that links MuJoCo; seen inside this library only.
extern "C" {
const char* mj_id2name(const mjModel* m, int type, int id) { return called.id2name(m, type, id); }
void mj_solveM(const mjModel* m, mjData* d, mjtNum* x, const mjtNum* y, int n) { called.solve_m(m, d, x, y, n); }
void mj_factorM(const mjModel* m, mjData* d) { called.factor_m(m, d); }
void mj_mulJacVec(const mjModel* m, const mjData* d, mjtNum* res, const mjtNum* vec) { called.mul_jac_vec(m, d, res, vec); }
void mj_mulJacTVec(const mjModel* m, const mjData* d, mjtNum* res, const mjtNum* vec) { called.mul_jac_t_vec(m, d, res, vec); }
void mj_mulM(const mjModel* m, const mjData* d, mjtNum* res, const mjtNum* vec) { called.mul_m(m, d, res, vec); }
int mj_isSparse(const mjModel* m) { return called.is_sparse(m); }
void mj_fwdConstraint(const mjModel* m, mjData* d) { called.fwd_constraint(m, d); }
void mj_constraintUpdate(const mjModel* m, mjData* d, const mjtNum* jar, mjtNum* cost, int hessians) {
  called.constraint_update(m, d, jar, cost, hessians);
}
int mju_cholFactor(mjtNum* mat, int n, mjtNum mindiag) { return called.chol_factor(mat, n, mindiag); }
void mju_cholSolve(mjtNum* res, const mjtNum* mat, const mjtNum* vec, int n) { called.chol_solve(res, mat, vec, n); }
mjtNum mju_norm3(const mjtNum vec[3]) { return called.norm3(vec); }
mjtNum mju_dist3(const mjtNum pos1[3], const mjtNum pos2[3]) { return called.dist3(pos1, pos2); }
void mju_rotVecQuat(mjtNum res[3], const mjtNum vec[3], const mjtNum quat[4]) { called.rot_vec_quat(res, vec, quat); }
void mju_mulQuat(mjtNum res[4], const mjtNum quat1[4], const mjtNum quat2[4]) { called.mul_quat(res, quat1, quat2); }
#if mjVERSION_HEADER >= 3005000
mjtNum mj_readCtrl(const mjModel* m, const mjData* d, int id, mjtNum time, int interp) {
  return called.read_ctrl(m, d, id, time, interp);
}
#endif
}

namespace vsa::mujoco {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& to) {
  to = reinterpret_cast<Function>(dlsym(library, name));
  return to != nullptr;
}

/// Loaded already; the program itself first, which may have MuJoCo in it.
std::vector<void*> libraries() {
  std::vector<std::string> names;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* to) {
        const std::string_view path = info->dlpi_name == nullptr ? "" : info->dlpi_name;
        const std::string_view name = path.substr(path.rfind('/') + 1);
        if (name.starts_with("libmujoco")) static_cast<std::vector<std::string>*>(to)->emplace_back(path);
        return 0;
      },
      &names);
  std::vector<void*> out{dlopen(nullptr, RTLD_LAZY)};
  for (const std::string& name : names) out.push_back(dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD));
  std::erase(out, nullptr);
  return out;  // never closed: they are the program's
}

bool take(void* library) {
  Engine& e = of_program;
  bool all = find(library, "mjp_registerPlugin", e.mjp_registerPlugin) && find(library, "mjp_getPlugin", e.mjp_getPlugin) &&
             find(library, "mj_getPluginConfig", e.mj_getPluginConfig) && find(library, "mju_warning", e.mju_warning) &&
             find(library, "mj_id2name", called.id2name) && find(library, "mj_solveM", called.solve_m) &&
             find(library, "mj_factorM", called.factor_m) && find(library, "mj_mulJacVec", called.mul_jac_vec) &&
             find(library, "mj_mulJacTVec", called.mul_jac_t_vec) && find(library, "mj_mulM", called.mul_m) &&
             find(library, "mj_isSparse", called.is_sparse) && find(library, "mj_fwdConstraint", called.fwd_constraint) &&
             find(library, "mj_constraintUpdate", called.constraint_update) &&
             find(library, "mju_cholFactor", called.chol_factor) && find(library, "mju_cholSolve", called.chol_solve) &&
             find(library, "mju_norm3", called.norm3) && find(library, "mju_dist3", called.dist3) &&
             find(library, "mju_rotVecQuat", called.rot_vec_quat) && find(library, "mju_mulQuat", called.mul_quat);
#if mjVERSION_HEADER >= 3005000
  all = all && find(library, "mj_readCtrl", called.read_ctrl);
#endif
  if (!all) e = {};
  return all;
}

}  // namespace

const Engine& engine() noexcept { return of_program; }

std::string version_text(int version) {
  const int base = version < 1000 ? 10 : 1000;
  return std::to_string(version / (base * base)) + "." + std::to_string(version / base % base) + "." +
         std::to_string(version % base);
}

std::string find_engine() {
  const std::string own = version_text(mjVERSION_HEADER), us = "vsasim.unit: this library is for MuJoCo " + own + ", ";
  std::vector<std::string> others;
  for (void* library : libraries()) {
    int (*version)() = nullptr;
    // One without plug-ins isn't meant: vsasim's own engine, in a Python that has both.
    if (dlsym(library, "mjp_registerPlugin") == nullptr || !find(library, "mj_version", version)) continue;
    if (const int found = version(); found != mjVERSION_HEADER) {
      if (const std::string text = version_text(found); std::find(others.begin(), others.end(), text) == others.end())
        others.push_back(text);
    } else if (take(library)) {
      return {};
    }
  }
  if (others.empty()) return us + "and the program has none loaded: load MuJoCo first";
  std::string list;
  for (const std::string& text : others) list += (list.empty() ? "" : " and ") + text;
  return us + "the program has " + list + ": build vsasim against that one (docs/howto/mujoco.md)";
}

}  // namespace vsa::mujoco
