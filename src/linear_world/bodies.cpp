// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "linear_world/bodies.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "vsa/errors.hpp"

namespace vsa::linear_world {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using engine::JointInfo;
using engine::World;

constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
constexpr double kStep = 1e-3;    // rad or m
constexpr double kError = 1e-10;  // of differences, in N·m/rad over the largest torque in N·m or slope

VectorXd gravity(const World& w) {
  VectorXd out(static_cast<Index>(w.dof_count()));
  w.gravity_torques({out.data(), w.dof_count()});
  return out;
}

/// ∂g/∂q of one joint: two differences, extrapolated.
VectorXd slope(World& w, const std::string& joint) {
  const double at = w.joint_angle(joint);
  const auto there = [&](double by) {
    w.set_joint(joint, at + by, 0);
    return gravity(w);
  };
  const VectorXd near = there(kStep) - there(-kStep), far = there(2 * kStep) - there(-2 * kStep);
  w.set_joint(joint, at, 0);
  return (8 * near - far) / (12 * kStep);
}

/// All of the world's degrees of freedom, and whose they are.
struct Whole {
  MatrixXd mass, stiffness;
  std::vector<std::size_t> joint;    ///< of one axis; kNobody: another's
  std::vector<std::string> refused;  ///< why that one can't be in the model; empty: it can
  std::vector<bool> moves;           ///< with a driven joint

  explicit Whole(World& w);
  void spread(Index from);
};

Whole::Whole(World& w) {
  const auto n = static_cast<Index>(w.dof_count());
  mass.resize(n, n);
  w.mass_matrix({mass.data(), static_cast<std::size_t>(n * n)});
  stiffness = MatrixXd::Zero(n, n);
  joint.assign(w.dof_count(), kNobody);
  refused.resize(w.dof_count());
  moves.resize(w.dof_count());
  for (const scene::LinkInfo& link : w.links()) {
    const auto first = link.is_static ? std::nullopt : w.free_dof(w.link(link.name));
    for (std::size_t i = 0; first && i < 6; ++i) refused[*first + i] = link.name;
  }
  for (std::size_t j = 0; j < w.joints().size(); ++j) {
    const JointInfo& info = w.joints()[j];
    if (!info.dof) continue;
    if (info.one_axis()) {
      joint[*info.dof] = j;
      stiffness.col(static_cast<Index>(*info.dof)) = slope(w, info.name);
      continue;
    }
    for (std::size_t i = 0; i < (info.type == JointInfo::Type::ball ? 3u : 2u); ++i) refused[*info.dof + i] = info.name;
  }
}

void Whole::spread(Index from) {
  if (moves[static_cast<std::size_t>(from)]) return;
  moves[static_cast<std::size_t>(from)] = true;
  for (Index i = 0; i < mass.rows(); ++i)
    if (mass(i, from) != 0 || stiffness(i, from) != 0 || stiffness(from, i) != 0) spread(i);
}

void check(const World& w, const Whole& all, Problems& problems) {
  std::string told;
  for (std::size_t i = 0; i < all.joint.size(); ++i) {
    if (!all.moves[i]) continue;
    if (all.joint[i] != kNobody) {
      const JointInfo& joint = w.joints()[all.joint[i]];
      if (joint.follows)
        problems.add({"", joint.name, "",
                      "follows " + w.joints()[*joint.follows].name + " (<mimic> or <equality>), which isn't linearised",
                      "joints that move by themselves"});
      for (const std::string& what : joint.held)
        problems.add({"", joint.name, "", "is held by " + what + ", which isn't linearised", "joints that move by themselves"});
    } else if (all.refused[i] != told) {
      told = all.refused[i];
      const bool link = std::any_of(w.links().begin(), w.links().end(), [&](const auto& l) { return l.name == all.refused[i]; });
      problems.add({"", all.refused[i], "",
                    link ? "flies free, held by contacts alone, which aren't linearised" : "has more than one axis",
                    link ? "a robot fixed to the world" : "revolute and prismatic joints"});
    }
  }
}

/// Of the model's joints: each once, with those that it acts on.
void tell_of_forces(const World& w, const std::vector<std::size_t>& joints, std::vector<std::string>& notices) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const std::size_t j : joints) {
    for (const std::string& what : w.joints()[j].pulled) {
      const auto it = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == what; });
      if (it == all.end()) {
        all.emplace_back(what, w.joints()[j].name);
      } else {
        it->second += ", " + w.joints()[j].name;
      }
    }
  }
  for (const auto& [what, on] : all) notices.push_back("left out: " + what + ", which acts on " + on);
}

void tell_what_is_left_out(const World& w, const Whole& all, std::vector<std::string>& notices) {
  std::string out, last;
  for (std::size_t i = 0; i < all.joint.size(); ++i) {
    if (all.moves[i]) continue;
    const std::string& name = all.joint[i] == kNobody ? all.refused[i] : w.joints()[all.joint[i]].name;
    if (name == last) continue;
    out += (out.empty() ? "" : ", ") + name;
    last = name;
  }
  if (!out.empty()) notices.push_back("left out, since no actuator here moves it: " + out);
}

}  // namespace

std::string actuator_name(const World& world, std::size_t actuator) { return world.name_of(world.actuators()[actuator]); }

WorldBodies find_bodies(World& w) {
  Whole all(w);
  for (const JointInfo& joint : w.joints())
    if (joint.actuator && joint.dof) all.spread(static_cast<Index>(*joint.dof));
  Problems problems;
  check(w, all, problems);
  problems.throw_if_any();
  WorldBodies out;
  const VectorXd weight = gravity(w);
  std::vector<Index> dofs;
  for (std::size_t i = 0; i < all.joint.size(); ++i) {
    if (!all.moves[i]) continue;
    const JointInfo& joint = w.joints()[all.joint[i]];
    const std::string name = joint.actuator ? actuator_name(w, *joint.actuator) : joint.name;
    out.bodies.joints.push_back(
        {name, joint.type == JointInfo::Type::prismatic, w.joint_angle(joint.name), joint.damping, joint.stiffness});
    if (joint.dry_friction > 0) out.notices.push_back(joint.name + ": its joint's dry friction in the file is left out");
    out.joint.push_back(all.joint[i]);
    out.gravity.push_back(weight[static_cast<Index>(i)]);
    dofs.push_back(static_cast<Index>(i));
  }
  tell_of_forces(w, out.joint, out.notices);
  tell_what_is_left_out(w, all, out.notices);
  out.bodies.mass = all.mass(dofs, dofs);
  MatrixXd k = all.stiffness(dofs, dofs);
  // What the differences' error may be counts for nothing: of a joint that the weight leaves alone it would make a pole that grows.
  const double error = kError * std::max(k.cwiseAbs().maxCoeff(), weight(dofs).cwiseAbs().maxCoeff());
  k = (k.array().abs() <= error).select(0.0, k);
  out.bodies.gravity_stiffness = 0.5 * (k + k.transpose());
  return out;
}

}  // namespace vsa::linear_world
