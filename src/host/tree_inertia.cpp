// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/tree_inertia.hpp"

#include <cmath>

#include "vsa/owner.hpp"

namespace vsa::host {
namespace {

using Vector3 = std::array<double, 3>;
using Vector = std::array<double, 6>;  // rotation first
using Matrix = std::array<Vector, 6>;

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

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

Vector spatial_axis(const TreeBody& body, const Vector3& origin) {
  Vector s{};
  const bool turns = body.joint == TreeBody::Joint::revolute;
  const Vector3 moved = turns ? cross(minus(body.anchor, origin), body.axis) : body.axis;
  for (std::size_t i = 0; i < 3; ++i) {
    if (turns) s[i] = body.axis[i];
    s[3 + i] = moved[i];
  }
  return s;
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

void TreeInertia::gather(const std::vector<TreeBody>& bodies) noexcept {
  const Vector3 origin = bodies.front().center_of_mass;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    nodes_[i].inertia = spatial_inertia(bodies[i], origin);
    nodes_[i].axis = spatial_axis(bodies[i], origin);
  }
  for (std::size_t i = bodies.size(); i-- > 0;) {
    Node& n = nodes_[i];
    const TreeBody::Joint joint = bodies[i].joint;
    const bool moves = joint == TreeBody::Joint::revolute || joint == TreeBody::Joint::prismatic;
    n.momentum = times(n.inertia, n.axis);
    n.reciprocal = moves ? 1 / dot(n.axis, n.momentum) : 0.0;
    if (bodies[i].parent == TreeBody::kGround) continue;
    Matrix& parent = nodes_[bodies[i].parent].inertia;
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) parent[r][c] += n.inertia[r][c] - n.reciprocal * n.momentum[r] * n.momentum[c];
    }
  }
}

void TreeInertia::update(const std::vector<TreeBody>& bodies, std::vector<double>& inverse) noexcept {
  constexpr const char* kHere = "vsa::host::TreeInertia::update";
  require(bodies.size() == nodes_.size() && inverse.size() == nodes_.size(), kHere,
          "bodies and inverse need as many entries as it has");
  for (std::size_t i = 0; i < bodies.size(); ++i)
    require(bodies[i].parent < i || bodies[i].parent == TreeBody::kGround, kHere, "a parent comes before its children");
  if (bodies.empty()) return;
  gather(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Node& n = nodes_[i];
    if (bodies[i].joint == TreeBody::Joint::free) {
      n.response = inverse_of(n.inertia);
      inverse[i] = 0;
      continue;
    }
    n.response = bodies[i].parent == TreeBody::kGround ? Matrix{} : nodes_[bodies[i].parent].response;
    const double d = n.reciprocal;
    const Vector w = times(n.response, n.momentum);  // Ω_parent U
    const double uw = dot(n.momentum, w);
    inverse[i] = d + d * d * uw;
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) {
        n.response[r][c] += (d + d * d * uw) * n.axis[r] * n.axis[c] - d * (n.axis[r] * w[c] + w[r] * n.axis[c]);
      }
    }
  }
}

}  // namespace vsa::host
