// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/linear_world/linear_world.hpp"

#include <algorithm>
#include <cmath>

#include "linear_world/bodies.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/inverse.hpp"
#include "vsa/errors.hpp"

namespace vsa::linear_world {
namespace {

using config::number_text;
using engine::JointInfo;
using engine::World;

std::optional<std::size_t> find_actuator(const World& w, const std::string& name) {
  try {
    return static_cast<std::size_t>(&w.actuator(name) - w.actuators().data());
  } catch (const InputError&) {  // of none, or of several
    return std::nullopt;
  }
}

/// By its own name or its actuator's.
std::optional<std::size_t> find_joint(const World& w, const std::string& name) {
  const auto actuator = find_actuator(w, name);
  for (std::size_t j = 0; j < w.joints().size(); ++j) {
    const JointInfo& joint = w.joints()[j];
    if (joint.one_axis() && (joint.name == name || (actuator && joint.actuator == actuator))) return j;
  }
  return std::nullopt;
}

std::string known(const World& w, bool joints) {
  std::vector<std::string> out;
  for (std::size_t a = 0; a < w.actuators().size(); ++a) out.push_back(actuator_name(w, a));
  for (const JointInfo& j : w.joints())
    if (joints && j.one_axis() && !j.actuator) out.push_back(j.name);
  return config::join(out);
}

/// One value an actuator of the world.
using PerActuator = std::vector<std::optional<double>>;

PerActuator per_actuator(const World& w, const Named& given, const char* key, Problems& problems) {
  PerActuator out(w.actuators().size());
  for (const auto& [name, value] : given) {
    if (const auto a = find_actuator(w, name)) {
      out[*a] = value;
    } else {
      problems.add({"", key, name, "no such actuator", known(w, false)});
    }
  }
  return out;
}

void pose(World& w, const Named& angles, Problems& problems) {
  for (const JointInfo& joint : w.joints())
    if (joint.one_axis()) w.set_joint(joint.name, w.joint_angle(joint.name), 0);
  for (const auto& [name, value] : angles) {
    const auto j = find_joint(w, name);
    if (!j) {
      problems.add({"", "angles", name, "no such joint with one axis", known(w, true)});
      continue;
    }
    const JointInfo& joint = w.joints()[*j];
    const std::array<double, 2> range = joint.range.value_or(std::array<double, 2>{-1e4, 1e4});
    if (value >= range[0] && value <= range[1]) {
      w.set_joint(joint.name, value, 0);
    } else {
      problems.add(
          {"", name, number_text(value), "is beyond the joint's limits", number_text(range[0]) + " … " + number_text(range[1])});
    }
  }
}

/// Whether a link moves with the model's joints.
bool moved(const World& w, const WorldBodies& b, std::size_t link) {
  std::vector<double> j(6 * w.dof_count());
  w.jacobian(w.link(w.links()[link].name), {}, j);
  for (const std::size_t joint : b.joint)
    for (std::size_t row = 0; row < 6; ++row)
      if (j[row * w.dof_count() + *w.joints()[joint].dof] != 0) return true;
  return false;
}

/// What the linear model doesn't have and the world does, there. Steps the world, since that finds its contacts.
void tell_of_touch(World& w, const WorldBodies& b, std::vector<std::string>& notices) {
  if (!w.pulls().empty()) notices.emplace_back("hands that pull are left out");
  for (const std::size_t j : b.joint) {
    const JointInfo& joint = w.joints()[j];
    const double q = w.joint_angle(joint.name);
    if (joint.range && (q <= (*joint.range)[0] || q >= (*joint.range)[1]))
      notices.push_back(joint.name + " stands at its limit, which is left out");
  }
  w.step();
  std::vector<scene::Contact> contacts;
  w.contacts(contacts);
  std::vector<std::string> told;
  for (const scene::Contact& c : contacts) {
    std::string text = w.links()[c.link].name + " touches " + w.links()[c.other].name + ": contacts are left out";
    if (std::find(told.begin(), told.end(), text) != told.end()) continue;
    if (moved(w, b, c.link) || moved(w, b, c.other)) told.push_back(std::move(text));
  }
  notices.insert(notices.end(), told.begin(), told.end());
}

/// What the file's own spring and the weight ask of a joint.
double asked(const JointInfo& joint, double angle, double gravity) { return gravity + joint.stiffness * (angle - joint.rest); }

std::vector<linear::MountedUnit> mount(const World& w, const WorldBodies& b, const WorldPoint& point, Problems& problems) {
  const PerActuator presets = per_actuator(w, point.presets, "presets", problems);
  const PerActuator equilibria = per_actuator(w, point.equilibria_rad, "equilibria_rad", problems);
  problems.throw_if_any();
  std::vector<linear::MountedUnit> out;
  for (std::size_t j = 0; j < b.joint.size(); ++j) {
    const JointInfo& joint = w.joints()[b.joint[j]];
    if (!joint.actuator) continue;
    const engine::ActuatorRef& ref = w.actuators()[*joint.actuator];
    linear::MountedUnit unit{b.bodies.joints[j].name, w.robot(ref.robot).config().actuators[ref.index].unit, {}, j};
    const elastic::Transmission& law = *unit.unit.actuator.transmission;
    const double q = b.bodies.joints[j].angle;
    const double there = unit.unit.preset_unit().empty() ? 0.0 : w.read(ref).preset;
    unit.point.preset = presets[*joint.actuator].value_or(point.preset.value_or(there));
    unit.point.shaft_rad = q;
    const double torque = asked(joint, q, b.gravity[j]);
    std::optional<double> carried = equilibria[*joint.actuator];
    if (!carried && std::abs(unit.point.preset) <= unit.unit.preset_max) {
      carried = elastic::equilibrium_for(law, q, torque, unit.point.preset);
    } else if (!carried) {
      carried = 0.0;  // linear::linearize() says what is wrong with the preset
    }
    if (carried) {
      unit.point.equilibrium_rad = *carried;
    } else {
      problems.add({"", unit.name, number_text(torque) + " N·m", "no equilibrium within a turn carries that",
                    "another pose or preset, or an equilibrium of your own"});
    }
    out.push_back(std::move(unit));
  }
  return out;
}

}  // namespace

WorldModel linearize(const World& world, const WorldPoint& point, linear::Firmware firmware, linear::DryFriction friction) {
  if (world.actuators().empty()) throw InputError({"", world.name(), "", "has no actuators", "a world with a robot"});
  World there = world.clone();
  Problems problems;
  pose(there, point.angles, problems);
  problems.throw_if_any();
  WorldBodies b = find_bodies(there);
  const std::vector<linear::MountedUnit> units = mount(world, b, point, problems);
  problems.throw_if_any();
  WorldModel out;
  out.model = linear::linearize(b.bodies, units, firmware, friction);
  tell_of_touch(there, b, b.notices);
  out.model.notices.insert(out.model.notices.end(), b.notices.begin(), b.notices.end());
  out.gravity_torque = b.gravity;
  for (std::size_t j = 0; j < b.joint.size(); ++j)
    out.outside_torque.push_back(asked(world.joints()[b.joint[j]], b.bodies.joints[j].angle, b.gravity[j]));
  // A unit's load is what holds its shaft, its weight included.
  for (const auto& unit : out.model.units) out.outside_torque[unit.joint] += unit.rest.load_Nm;
  return out;
}

}  // namespace vsa::linear_world
