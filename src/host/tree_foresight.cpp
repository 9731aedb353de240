// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/tree_foresight.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "spatial.hpp"
#include "vsa/owner.hpp"

namespace vsa::host {
namespace {

using spatial::cross;
using spatial::minus;
using spatial::plus;
using spatial::product;
using spatial::rotation;
using spatial::translation;
using spatial::Vector3;

}  // namespace

TreeForesight::TreeForesight(std::size_t bodies)
    : nodes_(bodies), moved_(bodies), sped_up_(bodies), torques_(bodies), changes_(bodies) {}

TreeForesight::Memory TreeForesight::begin() const {
  return {0, std::vector<double>(nodes_.size()), std::vector<double>(nodes_.size())};
}

/// Which trees stand, and of which something is known. False: of none.
bool TreeForesight::survey(const std::vector<TreeBody>& bodies) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const TreeBody& body = bodies[i];
    const bool rooted = body.parent == TreeBody::kGround;
    require(rooted || body.parent < i, "vsa::host::TreeForesight", "a parent comes before its children");
    Node& node = nodes_[i];
    node.root = rooted ? i : nodes_[body.parent].root;
    node.grounded = rooted ? body.joint != TreeBody::Joint::free : nodes_[node.root].grounded;
    node.known = false;
    const bool held = spatial::moves(body) && (body.damping != 0 || body.stiffness != 0);
    if (held || (node.grounded && body.weight_N != Vector3{})) any = nodes_[node.root].known = true;
  }
  return any;
}

/// From the roots to the leaves: ΔX, and the weight of each body by itself; springs and dampers.
void TreeForesight::move(const std::vector<TreeBody>& bodies, std::span<const double> moved, std::span<const double> sped_up,
                         std::span<double> out) noexcept {
  const Vector3 origin = bodies.front().center_of_mass;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const TreeBody& body = bodies[i];
    Node& node = nodes_[i];
    node.moved = body.parent == TreeBody::kGround ? spatial::Vector{} : nodes_[body.parent].moved;
    out[i] = 0;
    if (spatial::moves(body)) {
      node.axis = spatial::axis_of(body, origin);
      for (std::size_t k = 0; k < 6; ++k) node.moved[k] += node.axis[k] * moved[i];
      out[i] = -body.damping * sped_up[i] - body.stiffness * (moved[i] + body.implicit_s * sped_up[i]);
    }
    const Vector3 weight = node.grounded ? body.weight_N : Vector3{};
    const Vector3 center = minus(body.center_of_mass, origin);
    node.weight = spatial::joined(cross(center, weight), weight);
    node.overturned = cross(plus(translation(node.moved), cross(rotation(node.moved), center)), weight);
  }
}

void TreeForesight::torques(const std::vector<TreeBody>& bodies, std::span<const double> moved, std::span<const double> sped_up,
                            std::span<double> out) noexcept {
  const std::size_t n = nodes_.size();
  require(bodies.size() == n && moved.size() == n && sped_up.size() == n && out.size() == n, "vsa::host::TreeForesight::torques",
          "bodies and joints need as many entries as it has");
  if (n == 0) return;
  survey(bodies);
  move(bodies, moved, sped_up, out);
  for (std::size_t i = n; i-- > 0;) {
    const Node& node = nodes_[i];
    if (spatial::moves(bodies[i])) {
      const Vector3 turn = rotation(node.moved), about = rotation(node.axis);
      const Vector3 axis_moved = plus(cross(turn, translation(node.axis)), cross(translation(node.moved), about));
      out[i] += product(about, node.overturned) + product(cross(turn, about), rotation(node.weight)) +
                product(axis_moved, translation(node.weight));
    }
    if (bodies[i].parent == TreeBody::kGround) continue;
    Node& parent = nodes_[bodies[i].parent];
    for (std::size_t k = 0; k < 6; ++k) parent.weight[k] += node.weight[k];
    parent.overturned = plus(parent.overturned, node.overturned);
  }
}

void TreeForesight::foresee(const std::vector<TreeBody>& bodies, TreeInertia& inertia, std::span<const double> positions,
                            std::span<const double> speeds, double dt_s, Memory& memory, std::span<double> out) noexcept {
  const std::size_t n = nodes_.size();
  require(bodies.size() == n && positions.size() == n && speeds.size() == n && memory.positions.size() == n &&
              memory.speeds.size() == n && out.size() == n,
          "vsa::host::TreeForesight::foresee", "bodies, joints and begin()'s memory need as many entries as it has");
  std::fill(out.begin(), out.end(), std::numeric_limits<double>::quiet_NaN());
  if (!survey(bodies)) return memory.forget();
  if (memory.last_dt_s != 0) {
    std::transform(positions.begin(), positions.end(), memory.positions.begin(), moved_.begin(), std::minus<>());
    std::transform(speeds.begin(), speeds.end(), memory.speeds.begin(), sped_up_.begin(), std::minus<>());
    torques(bodies, moved_, sped_up_, torques_);
    inertia.answer(bodies, torques_, changes_);
    for (std::size_t i = 0; i < n; ++i)
      if (nodes_[nodes_[i].root].known) out[i] = sped_up_[i] / memory.last_dt_s + changes_[i];
  }
  memory.last_dt_s = dt_s;
  std::copy(positions.begin(), positions.end(), memory.positions.begin());
  std::copy(speeds.begin(), speeds.end(), memory.speeds.begin());
}

}  // namespace vsa::host
