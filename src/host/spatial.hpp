// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Motions and forces of bodies in world axes about one point.
#pragma once

#include <array>
#include <cstddef>

#include "vsa/host/tree_inertia.hpp"

namespace vsa::host::spatial {

using Vector3 = std::array<double, 3>;
using Vector = std::array<double, 6>;  ///< rotation first

inline Vector3 cross(const Vector3& a, const Vector3& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vector3 minus(const Vector3& a, const Vector3& b) noexcept { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector3 plus(const Vector3& a, const Vector3& b) noexcept { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline double product(const Vector3& a, const Vector3& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vector3 rotation(const Vector& v) noexcept { return {v[0], v[1], v[2]}; }
inline Vector3 translation(const Vector& v) noexcept { return {v[3], v[4], v[5]}; }
inline Vector joined(const Vector3& rotation, const Vector3& translation) noexcept {
  return {rotation[0], rotation[1], rotation[2], translation[0], translation[1], translation[2]};
}

inline bool moves(const TreeBody& body) noexcept {
  return body.joint == TreeBody::Joint::revolute || body.joint == TreeBody::Joint::prismatic;
}

/// S of the body's joint.
inline Vector axis_of(const TreeBody& body, const Vector3& origin) noexcept {
  if (body.joint != TreeBody::Joint::revolute) return joined({}, body.axis);
  return joined(body.axis, cross(minus(body.anchor, origin), body.axis));
}

}  // namespace vsa::host::spatial
