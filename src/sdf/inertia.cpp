// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a body can have a link's mass and inertia.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "sdf/reading.hpp"

namespace vsa::reader {
namespace {

constexpr double kTriangleTolerance = 1e-6;  // relative; engines get the nearest inertia that satisfies it

constexpr double kLight_kg = 1e-5, kLight_kgm2 = 1e-9;  // told, for a gram weighed in tonnes

using Principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;  // moments in rising order, with their axes

bool is_finite(const Mat3& m) {
  for (std::size_t i = 0; i < 9; ++i)
    if (!std::isfinite(m(i / 3, i % 3))) return false;
  return true;
}

Principal principal_of(const Mat3& m) {
  Eigen::Matrix3d all;
  for (std::size_t i = 0; i < 9; ++i) all(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = m(i / 3, i % 3);
  return Principal(all);
}

/// I − excess·v vᵀ with v the axis of the largest principal moment: that moment less `excess`, about the same axes.
Mat3 lowered(const Mat3& inertia, const Principal& principal, double excess) {
  const Eigen::Vector3d v = principal.eigenvectors().col(2);
  Mat3 out = inertia;
  for (std::size_t i = 0; i < 9; ++i)
    out(i / 3, i % 3) -= excess * v(static_cast<Eigen::Index>(i / 3)) * v(static_cast<Eigen::Index>(i % 3));
  return out;
}

}  // namespace

void check_inertia(Reading& r, const std::string& in, const std::string& key, const std::string& shown, Link& link) {
  if (!link.com.IsFinite()) r.problems.add({in, key + "/inertial/pose", "", "isn't finite", "finite numbers"});
  if (!std::isfinite(link.mass) || link.mass <= 0)
    r.problems.add({in, key + "/inertial/mass", fmt::format("{}", link.mass), "isn't a positive mass", "> 0 kg, finite"});
  const Principal principal = principal_of(is_finite(link.inertia) ? link.inertia : Mat3());
  const double low = principal.eigenvalues()(0), middle = principal.eigenvalues()(1), high = principal.eigenvalues()(2);
  if (!(low > 0)) {
    r.problems.add({in, key + "/inertial/inertia", shown, "isn't positive definite", "principal moments > 0, finite"});
  } else if (low + middle < high * (1 - kTriangleTolerance)) {
    const std::string moments = fmt::format("principal moments {:.6g} + {:.6g} < {:.6g}", low, middle, high);
    if (r.impossible_inertia == ImpossibleInertia::lower) {
      link.inertia = lowered(link.inertia, principal, high - low - middle);
      r.notes.add("inertias that no body can have are lowered to the sum of the two smaller principal moments",
                  fmt::format("{} ({})", key, moments));
    } else {
      r.problems.add(
          {in, key + "/inertial/inertia", shown, "violates the triangle inequality: " + moments,
           "the sum of two principal moments ≥ the third; or ask for the nearest such: vsa run --impossible-inertia lower, "
           "WorldOptions::impossible_inertia"});
    }
  }
  if (link.mass > 0 && (link.mass < kLight_kg || (low > 0 && low < kLight_kgm2)))
    r.notes.add(
        fmt::format("links lighter than {} kg or {} kg·m² answer the smallest torque with blow-ups", kLight_kg, kLight_kgm2), key);
}

}  // namespace vsa::reader
