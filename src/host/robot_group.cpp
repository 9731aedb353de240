// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot_group.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "host/robot_impl.hpp"
#include "vsa/errors.hpp"

namespace vsa::host {
namespace {

/// The cluster of a robot that has its shared joints; null: it has none.
Cluster* sharing(std::vector<Cluster>& clusters) noexcept {
  const auto at = std::find_if(clusters.begin(), clusters.end(), [](const Cluster& c) { return !c.shared().empty(); });
  return at == clusters.end() ? nullptr : &*at;
}

}  // namespace

RobotGroup::RobotGroup(std::size_t robots, std::vector<std::vector<Joint>> trees)
    : joints_(std::move(trees)), shared_(robots), steps_(robots) {
  Problems problems;
  std::size_t numbers = 0;
  for (std::size_t t = 0; t < joints_.size(); ++t) {
    const std::vector<Joint>& joints = joints_[t];
    if (joints.empty()) continue;
    Tree tree(joints.size());
    tree.index = t;
    for (const Joint& joint : joints) {
      const auto there = [&](const std::vector<std::size_t>& all) {
        return std::count(all.begin(), all.end(), joint.actuator) > 0;
      };
      if (joint.robot >= robots || there(shared_[joint.robot])) {
        problems.add({"", "tree", std::to_string(joint.robot) + ", " + std::to_string(joint.actuator),
                      joint.robot >= robots ? "no such robot" : "is in a tree already",
                      "robots below " + std::to_string(robots) + ", each joint once"});
        continue;
      }
      tree.places.push_back({joint.robot, shared_[joint.robot].size(), joint.actuator});
      shared_[joint.robot].push_back(joint.actuator);
    }
    tree.mobility_at = numbers;
    numbers += joints.size() * joints.size();
    trees_.push_back(std::move(tree));
  }
  problems.throw_if_any();
  mobility_.resize(numbers);
}

const std::vector<std::size_t>& RobotGroup::shared(std::size_t robot) const {
  if (robot >= shared_.size())
    throw InputError(Problem{"", "robot", std::to_string(robot), "no such robot", "below " + std::to_string(shared_.size())});
  return shared_[robot];
}

/// What B a host can't tell is each joint's own, as in a robot by itself.
void RobotGroup::begin(Tree& tree, std::int64_t dt_ns) noexcept {
  const std::size_t n = tree.joints.size();
  const std::span<double> b = std::span(mobility_).subspan(tree.mobility_at, n * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Place& place = tree.places[i];
    tree.joints[i] = sharing(steps_[place.robot].robot->impl_->clusters)->shared()[place.shared].joint;
  }
  if (!is_usable(b, n)) {
    std::fill(b.begin(), b.end(), 0.0);
    for (std::size_t i = 0; i < n; ++i)
      b[i * n + i] = own_mobility(*tree.joints[i].unit, steps_[tree.places[i].robot].in[tree.places[i].actuator]);
  }
  tree.solver.set(b, dt_ns);
  for (std::size_t i = 0; i < n; ++i) {
    const Step& step = steps_[tree.places[i].robot];
    begin_step(tree.joints[i], step.in[tree.places[i].actuator], b[i * n + i], step.t_ns, dt_ns);
  }
}

void RobotGroup::advance(std::int64_t dt_ns, device::Holder* holder) noexcept {
  constexpr const char* kHere = "vsa::host::RobotGroup::advance";
  if (steps_.empty()) return;
  for (std::size_t r = 0; r < steps_.size(); ++r) {
    const Step& s = steps_[r];
    require(s.robot != nullptr, kHere, "a robot is missing");
    s.robot->require_step(kHere, s.t_ns, dt_ns, s.in, s.torques_out, s.mobility);
    require(s.robot->impl_->shared == shared_[r], kHere, "a robot wasn't joined with its shared()");
  }
  if (!std::all_of(steps_.begin(), steps_.end(), [](const Step& s) { return std::all_of(s.in.begin(), s.in.end(), is_told); })) {
    for (Step& s : steps_) std::fill(s.torques_out.begin(), s.torques_out.end(), std::numeric_limits<double>::quiet_NaN());
    return;
  }
  // A robot's clusters share the memory of their plans, so what isn't shared goes first, to its end.
  for (Step& s : steps_) {
    Robot::Impl& d = *s.robot->impl_;
    d.begin_step(s.t_ns);
    for (Cluster& cluster : d.clusters)
      if (cluster.shared().empty()) d.state.unsettled += cluster.advance(s.t_ns, dt_ns, s.in, s.torques_out, s.mobility, s.holder);
    if (Cluster* cluster = sharing(d.clusters)) cluster->begin(s.t_ns, dt_ns, s.in, s.mobility, s.holder);
  }
  const auto foresees = [dt_ns](const Step& s) { return has_ticks_inside(s.t_ns, dt_ns); };
  const bool any_foresees = std::any_of(steps_.begin(), steps_.end(), foresees);
  for (Tree& tree : trees_) {
    begin(tree, dt_ns);
    if (any_foresees) tree.solver.predict(tree.joints);
  }
  for (Step& s : steps_)
    if (Cluster* cluster = sharing(s.robot->impl_->clusters)) cluster->run(s.t_ns, dt_ns);
  for (Tree& tree : trees_) {
    Robot::Impl& first = *steps_[tree.places.front().robot].robot->impl_;
    device::Holder* const of_it = holder != nullptr && holder->holds(tree.index) ? holder : nullptr;
    if (!tree.solver.solve(tree.joints, tree.torques, of_it, tree.index)) first.state.unsettled += tree.joints.size();
    for (std::size_t i = 0; i < tree.joints.size(); ++i)
      steps_[tree.places[i].robot].torques_out[tree.places[i].actuator] = tree.torques[i];
  }
  for (Step& s : steps_) {
    Robot::Impl& d = *s.robot->impl_;
    if (Cluster* cluster = sharing(d.clusters)) d.state.unsettled += cluster->end(s.t_ns + dt_ns, s.torques_out, s.holder);
    d.end_step(s.t_ns + dt_ns);
  }
}

}  // namespace vsa::host
