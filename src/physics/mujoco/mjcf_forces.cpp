// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an MJCF has that acts on joints beside their own springs, dampers, limits and followers: equalities, tendons, MuJoCo's own
// actuators, fluids. The engine steps all of it; who makes a model of the bodies by the joints alone has to know of it.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "physics/mujoco/mjcf_file.hpp"
#include "physics/mujoco/versions.hpp"

namespace vsa::physics {
namespace {

using JointIds = std::set<int>;

std::string name_of(const mjModel& m, int type, int id, const char* kind) {
  const char* name = mj_id2name(&m, type, id);
  return name == nullptr ? fmt::format("{} {}", kind, id) : fmt::format("{} {}", kind, name);
}
std::string body_name(const mjModel& m, int body) {
  const char* name = mj_id2name(&m, mjOBJ_BODY, body);
  return name == nullptr ? fmt::format("body {}", body) : name;
}

/// By which a body moves.
JointIds joints_to(const mjModel& m, int body) {
  JointIds out;
  for (; body > 0; body = m.body_parentid[body])
    for (int k = 0; k < m.body_jntnum[body]; ++k) out.insert(m.body_jntadr[body] + k);
  return out;
}

/// By which bodies move against each other: what moves all of them doesn't count.
JointIds joints_between(const mjModel& m, const std::vector<int>& bodies) {
  JointIds out, common;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const JointIds to = joints_to(m, bodies[i]);
    out.insert(to.begin(), to.end());
    if (i == 0) common = to;
    std::erase_if(common, [&](int id) { return !to.contains(id); });
  }
  std::erase_if(out, [&](int id) { return common.contains(id); });
  return out;
}

JointIds all_joints(const mjModel& m) {
  JointIds out;
  for (int id = 0; id < m.njnt; ++id) out.insert(out.end(), id);
  return out;
}

JointIds joints_of_tendon(const mjModel& m, int tendon) {
  JointIds out;
  std::vector<int> bodies;
  for (int w = m.tendon_adr[tendon]; w < m.tendon_adr[tendon] + m.tendon_num[tendon]; ++w) {
    const int object = m.wrap_objid[w];
    if (m.wrap_type[w] == mjWRAP_JOINT) out.insert(object);
    if (m.wrap_type[w] == mjWRAP_SITE) bodies.push_back(m.site_bodyid[object]);
    if (m.wrap_type[w] == mjWRAP_SPHERE || m.wrap_type[w] == mjWRAP_CYLINDER) bodies.push_back(m.geom_bodyid[object]);
  }
  out.merge(joints_between(m, bodies));
  return out;
}

class Forces {
 public:
  Forces(const mjModel& m, const LinkObjects& objects, description::World& out) : m_(m), objects_(objects), out_(out) {}

  void all() {
    if (!without_equalities(m_))
      for (int e = 0; e < m_.neq; ++e)
        if (starts_active(m_, e)) equality(e);
    for (int t = 0; t < m_.ntendon; ++t)
      if (acts(t)) add(&Joint::pulled, joints_of_tendon(m_, t), name_of(m_, mjOBJ_TENDON, t, "tendon"));
    if (!switched_off(m_, {"Actuation"}))
      for (int a = 0; a < m_.nu; ++a)
        if (m_.actuator_biastype[a] != mjBIAS_NONE || control_of(m_, a) != 0)
          add(&Joint::pulled, joints_of_actuator(a), name_of(m_, mjOBJ_ACTUATOR, a, "MuJoCo's actuator"));
    if (!without_dampers(m_) && (m_.opt.density > 0 || m_.opt.viscosity > 0))
      add(&Joint::pulled, all_joints(m_), "the fluid of <option>");
  }

 private:
  void add(std::vector<std::string> Joint::*list, const JointIds& ids, const std::string& what) {
    for (std::size_t j = 0; j < out_.joints.size(); ++j)
      if (std::any_of(objects_.joints[j].begin(), objects_.joints[j].end(), [&](int id) { return ids.contains(id); }))
        if (std::vector<std::string>& all = out_.joints[j].*list; all.empty() || all.back() != what) all.push_back(what);
  }

  void equality(int e) {
    const int one = m_.eq_obj1id[e], two = m_.eq_obj2id[e];
    const auto bodies = [&](const char* kind) {
      const int a = body_held(m_, e, one), b = body_held(m_, e, two);
      add(&Joint::held, joints_between(m_, {a, b}), fmt::format("{} of {} and {}", kind, body_name(m_, a), body_name(m_, b)));
    };
    switch (m_.eq_type[e]) {
      case mjEQ_CONNECT:
        return bodies("connect");
      case mjEQ_WELD:
        return bodies("weld");
      case mjEQ_JOINT:
        if (two < 0) add(&Joint::held, {one}, "a lock");
        return;
      case mjEQ_TENDON: {
        JointIds joints = joints_of_tendon(m_, one);
        if (two >= 0) joints.merge(joints_of_tendon(m_, two));
        return add(&Joint::held, joints, name_of(m_, mjOBJ_TENDON, one, "tendon") + "'s equality");
      }
      default:
        return add(&Joint::held, all_joints(m_), name_of(m_, mjOBJ_EQUALITY, e, "equality"));
    }
  }

  [[nodiscard]] bool acts(int t) const {
    const bool constraints = !switched_off(m_, {"Constraint"});
    return (!without_springs(m_) && m_.tendon_stiffness[t] > 0) || (!without_dampers(m_) && m_.tendon_damping[t] > 0) ||
           (constraints && !switched_off(m_, {"Limit"}) && m_.tendon_limited[t] != 0) ||
           (constraints && !switched_off(m_, {"Frictionloss"}) && m_.tendon_frictionloss[t] > 0);
  }

  [[nodiscard]] JointIds joints_of_actuator(int a) const {
    const int to = m_.actuator_trnid[2 * a];
    switch (m_.actuator_trntype[a]) {
      case mjTRN_JOINT:
      case mjTRN_JOINTINPARENT:
        return {to};
      case mjTRN_TENDON:
        return joints_of_tendon(m_, to);
      default:
        return all_joints(m_);
    }
  }

  const mjModel& m_;
  const LinkObjects& objects_;
  description::World& out_;
};

}  // namespace

void describe_forces(const mjModel& model, const LinkObjects& objects, description::World& out) {
  Forces(model, objects, out).all();
}

}  // namespace vsa::physics
