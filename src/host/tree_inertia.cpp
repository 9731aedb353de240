// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/tree_inertia.hpp"

#include <algorithm>
#include <cmath>

#include "spatial.hpp"
#include "vsa/owner.hpp"

namespace vsa::host {
namespace {

using spatial::cross;
using spatial::minus;
using spatial::Vector;
using spatial::Vector3;
using Matrix = std::array<Vector, 6>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

Vector times(const Matrix& m, const Vector& v) {
  Vector out{};
  for (std::size_t i = 0; i < 6; ++i) out[i] = dot(m[i], v);
  return out;
}

using Lanes = std::array<double, TreeInertia::kBlock>;

/// sᵀ m, column by column.
Lanes product(const Vector& s, const std::array<Lanes, 6>& m) noexcept {
  Lanes out{};
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t c = 0; c < out.size(); ++c) out[c] += s[k] * m[k][c];
  return out;
}

Lanes less(const Lanes& a, const Lanes& b) noexcept {
  Lanes out{};
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = a[c] - b[c];
  return out;
}

/// Of one body about `origin`: momentum = matrix · velocity.
Matrix spatial_inertia(const TreeBody& body, const Vector3& origin) {
  const Vector3 c = minus(body.center_of_mass, origin);
  const double m = body.mass_kg, cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = body.inertia_kgm2[3 * i + j] + m * ((i == j ? cc : 0) - c[i] * c[j]);
    out[3 + i][3 + i] = m;
    Vector3 unit{};
    unit[i] = 1;
    const Vector3 column = cross(c, unit);  // of m·[c]×
    for (std::size_t j = 0; j < 3; ++j) out[j][3 + i] = out[3 + i][j] = m * column[j];
  }
  return out;
}

/// By Gauss and Jordan; the matrix is positive definite, or the result isn't finite.
Matrix inverse_of(Matrix m) {
  Matrix out{};
  for (std::size_t i = 0; i < 6; ++i) out[i][i] = 1;
  for (std::size_t p = 0; p < 6; ++p) {
    const double scale = 1 / m[p][p];
    for (std::size_t j = 0; j < 6; ++j) {
      m[p][j] *= scale;
      out[p][j] *= scale;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      if (i == p) continue;
      const double factor = m[i][p];
      for (std::size_t j = 0; j < 6; ++j) {
        m[i][j] -= factor * m[p][j];
        out[i][j] -= factor * out[p][j];
      }
    }
  }
  return out;
}

}  // namespace

TreeInertia::TreeInertia(std::size_t bodies) : nodes_(bodies) {}

void TreeInertia::update(const std::vector<TreeBody>& bodies) noexcept {
  constexpr const char* kHere = "vsa::host::TreeInertia::update";
  require(bodies.size() == nodes_.size(), kHere, "bodies need as many entries as it has");
  for (std::size_t i = 0; i < bodies.size(); ++i)
    require(bodies[i].parent < i || bodies[i].parent == TreeBody::kGround, kHere, "a parent comes before its children");
  if (bodies.empty()) return;
  const Vector3 origin = bodies.front().center_of_mass;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    nodes_[i].inertia = spatial_inertia(bodies[i], origin);
    nodes_[i].axis = spatial::axis_of(bodies[i], origin);
  }
  for (std::size_t i = bodies.size(); i-- > 0;) {
    Node& n = nodes_[i];
    n.momentum = times(n.inertia, n.axis);
    const double h = bodies[i].implicit_s, ahead = h * (bodies[i].damping + h * bodies[i].stiffness);
    n.reciprocal = spatial::moves(bodies[i]) ? 1 / (dot(n.axis, n.momentum) + ahead) : 0.0;
    if (bodies[i].joint == TreeBody::Joint::free) n.response = inverse_of(n.inertia);
    if (bodies[i].parent == TreeBody::kGround) continue;
    Matrix& parent = nodes_[bodies[i].parent].inertia;
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) parent[r][c] += n.inertia[r][c] - n.reciprocal * n.momentum[r] * n.momentum[c];
    }
  }
}

/// Towards the roots: what the joints' torques, in `drive`, ask of every body, p and u.
void TreeInertia::push(const std::vector<TreeBody>& bodies, std::size_t last) noexcept {
  for (std::size_t i = 0; i <= last; ++i) nodes_[i].bias = {};
  for (std::size_t i = last + 1; i-- > 0;) {
    Node& n = nodes_[i];
    if (bodies[i].parent == TreeBody::kGround) {
      if (n.reciprocal != 0) n.drive = less(n.drive, product(n.axis, n.bias));
      continue;
    }
    Columns& parent = nodes_[bodies[i].parent].bias;
    if (n.reciprocal == 0) {
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t c = 0; c < kBlock; ++c) parent[k][c] += n.bias[k][c];
      continue;
    }
    n.drive = less(n.drive, product(n.axis, n.bias));
    for (std::size_t k = 0; k < 6; ++k) {
      const double share = n.momentum[k] * n.reciprocal;
      for (std::size_t c = 0; c < kBlock; ++c) parent[k][c] += n.bias[k][c] + share * n.drive[c];
    }
  }
}

/// Towards the leaves: how every joint answers, into `drive`.
void TreeInertia::pull(const std::vector<TreeBody>& bodies, std::size_t last) noexcept {
  for (std::size_t i = 0; i <= last; ++i) {
    Node& n = nodes_[i];
    if (bodies[i].joint == TreeBody::Joint::free) {
      for (std::size_t k = 0; k < 6; ++k) n.acceleration[k] = less({}, product(n.response[k], n.bias));
      n.drive = {};
      continue;
    }
    const bool grounded = bodies[i].parent == TreeBody::kGround;
    n.acceleration = grounded ? Columns{} : nodes_[bodies[i].parent].acceleration;
    n.drive = less(n.drive, product(n.momentum, n.acceleration));
    for (double& answer : n.drive) answer *= n.reciprocal;
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t c = 0; c < kBlock; ++c) n.acceleration[k][c] += n.axis[k] * n.drive[c];
  }
}

void TreeInertia::mobility(const std::vector<TreeBody>& bodies, std::span<const std::size_t> of, std::span<double> out) noexcept {
  constexpr const char* kHere = "vsa::host::TreeInertia::mobility";
  const std::size_t n = of.size();
  require(bodies.size() == nodes_.size() && out.size() == n * n, kHere, "bodies and out need their sizes");
  for (const std::size_t body : of) require(body < nodes_.size(), kHere, "no such body");
  for (std::size_t j = 0; j < n; j += kBlock) {
    const auto block = of.subspan(j, std::min(kBlock, n - j));
    const std::size_t last = *std::max_element(block.begin(), block.end());
    for (std::size_t i = 0; i <= last; ++i) nodes_[i].drive = {};
    for (std::size_t c = 0; c < block.size(); ++c) nodes_[block[c]].drive[c] = 1;
    push(bodies, last);
    pull(bodies, last);
    // What lies behind a joint in the list has that joint in its own block, or in this.
    for (std::size_t c = 0; c < block.size(); ++c)
      for (std::size_t i = 0; i < n; ++i)
        if (of[i] <= block[c]) out[i * n + j + c] = out[(j + c) * n + i] = nodes_[of[i]].drive[c];
  }
}

void TreeInertia::answer(const std::vector<TreeBody>& bodies, std::span<const double> torques,
                         std::span<double> accelerations) noexcept {
  const std::size_t n = nodes_.size();
  require(bodies.size() == n && torques.size() == n && accelerations.size() == n, "vsa::host::TreeInertia::answer",
          "bodies, torques and accelerations need as many entries as it has");
  if (n == 0) return;
  for (std::size_t i = 0; i < n; ++i) nodes_[i].drive = {nodes_[i].reciprocal == 0 ? 0.0 : torques[i]};
  push(bodies, n - 1);
  pull(bodies, n - 1);
  for (std::size_t i = 0; i < n; ++i) accelerations[i] = nodes_[i].drive.front();
}

std::vector<std::vector<std::size_t>> joined(const std::vector<TreeBody>& bodies, std::span<const std::size_t> of) {
  constexpr const char* kHere = "vsa::host::joined";
  std::vector<std::size_t> root;  // of each of `of`: the last body that moves on the way to the ground
  for (std::size_t body : of) {
    require(body < bodies.size(), kHere, "no such body");
    std::size_t last = body;
    while (body != TreeBody::kGround) {
      if (bodies[body].joint != TreeBody::Joint::fixed) last = body;
      const std::size_t parent = bodies[body].parent;
      require(parent == TreeBody::kGround || parent < body, kHere, "parents come before their children");
      body = parent;
    }
    root.push_back(last);
  }
  std::vector<std::vector<std::size_t>> out;
  std::vector<std::size_t> of_tree;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto at = static_cast<std::size_t>(std::find(of_tree.begin(), of_tree.end(), root[i]) - of_tree.begin());
    if (at == of_tree.size()) {
      of_tree.push_back(root[i]);
      out.emplace_back();
    }
    out[at].push_back(i);
  }
  return out;
}

}  // namespace vsa::host
