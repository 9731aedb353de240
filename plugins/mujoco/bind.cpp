// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "bind.hpp"

#include <algorithm>

#include "versions.hpp"
#include "vsa/config/text.hpp"
#include "vsa/grouped.hpp"
#include "vsa/host/robot_config.hpp"
#include "vsa/physics/tree_roots.hpp"

namespace vsa::mujoco {
namespace {

std::string name_of(const mjModel& m, int type, int id, const char* what) {
  const char* name = mj_id2name(&m, type, id);
  return name != nullptr && *name != '\0' ? name : std::string(what) + " " + std::to_string(id);
}

const char* kind_of(int type) { return type == mjJNT_FREE ? "is a free joint" : type == mjJNT_BALL ? "is a ball joint" : ""; }

class Check {
 public:
  Check(const mjModel& m, const Unit& unit, Problems& problems) : m_(m), unit_(unit), problems_(problems) {}

  int joint(std::size_t controls) {
    if (unit_.actuators.size() != controls) {
      const char* rule =
          controls == 1 ? "one: the type takes no preset" : "two: equilibrium, then preset (or its motors' voltages)";
      add("actuator", std::to_string(unit_.actuators.size()) + " of this instance", "is another number than its type takes", rule);
    }
    int found = -1;
    for (const int a : unit_.actuators) {
      const int at = of_actuator(a);
      if (at < 0) continue;
      if (found >= 0 && at != found)
        add("joint", joint_name(m_, at), "isn't the joint of this instance's other actuator, " + joint_name(m_, found),
            "one joint");
      found = at;
    }
    if (found >= 0) check_joint(found);
    return found;
  }

 private:
  int of_actuator(int a) {
    const std::string name = name_of(m_, mjOBJ_ACTUATOR, a, "actuator");
    if (m_.actuator_trntype[a] != mjTRN_JOINT) {
      add("actuator", name, "isn't on a joint", "joint=\"…\"");
      return -1;
    }
    if (m_.actuator_gear[6 * a] != 1)
      add("actuator", name, "has a gear of " + config::number_text(m_.actuator_gear[6 * a]),
          "1: the type has its gears (override drive.gear_ratio)");
    if (m_.actuator_dyntype[a] != mjDYN_NONE) add("actuator", name, "has a dyntype: the unit has dynamics of its own", "none");
    if (m_.actuator_forcelimited[a]) add("actuator", name, "has a forcerange: the unit wouldn't know of it", "none");
    return m_.actuator_trnid[2 * a];
  }

  void check_joint(int joint) {
    const std::string name = joint_name(m_, joint);
    if (const char* kind = kind_of(m_.jnt_type[joint]); *kind != '\0') add("joint", name, kind, "a hinge or a slide");
#if mjVERSION_HEADER >= 300
    if (m_.jnt_actfrclimited[joint]) add("joint", name, "has an actuatorfrcrange: the unit wouldn't know of it", "none");
#endif
  }

  void add(const char* key, const std::string& value, const std::string& message, const std::string& allowed) {
    problems_.add({where(unit_.spec), key, value, message, allowed});
  }

  const mjModel& m_;
  const Unit& unit_;
  Problems& problems_;
};

}  // namespace

std::string joint_name(const mjModel& m, int joint) { return name_of(m, mjOBJ_JOINT, joint, "joint"); }

int joint_of(const mjModel& m, const Unit& unit, std::size_t controls, Problems& problems) {
  return Check(m, unit, problems).joint(controls);
}

bool has_one_torque_a_step(const mjModel& m) noexcept {
  switch (m.opt.integrator) {
    case mjINT_EULER:
    case mjINT_IMPLICIT:
#if mjVERSION_HEADER >= 300
    case mjINT_IMPLICITFAST:
#endif
      return true;
    default:
      return false;
  }
}

void check_options(const mjModel& m, Problems& problems) {
  if (!has_one_torque_a_step(m))
    problems.add({"vsasim.unit", "integrator", m.opt.integrator == mjINT_RK4 ? "RK4" : std::to_string(m.opt.integrator),
                  "asks for other torques than one a step, which no unit has", "Euler, implicit, implicitfast"});
  if (!(m.opt.timestep >= 1e-6 && m.opt.timestep <= host::kLongestStep_s))
    problems.add({"vsasim.unit", "timestep", config::number_text(m.opt.timestep), "is out of range", "1e-06 … 0.016 s"});
}

std::vector<std::vector<std::size_t>> trees_of(const mjModel& m, const std::vector<int>& joints) {
  const physics::TreeRoots of_model(m);
  std::vector<int> roots;
  for (const int joint : joints) roots.push_back(of_model.root(m.jnt_dofadr[joint]));
  return grouped(roots);
}

}  // namespace vsa::mujoco
