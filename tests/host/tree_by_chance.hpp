// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Trees of rigid bodies by chance, and what a dense solution says of them.
#pragma once

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "vsa/host/tree_inertia.hpp"

namespace vsa::test {

using host::TreeBody;

inline Eigen::Vector3d eigen(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
inline std::array<double, 3> array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline bool moves(const TreeBody& b) { return b.joint == TreeBody::Joint::revolute || b.joint == TreeBody::Joint::prismatic; }

/// Hinges, sliders and fixed joints in any order on a fixed or a free base, with springs, dampers and weights.
inline std::vector<TreeBody> tree_by_chance(std::mt19937& random, std::size_t count, bool free, double implicit_s) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto place = [&] { return std::array<double, 3>{0.3 * unit(random) + 5, 0.3 * unit(random), 0.3 * unit(random) - 2}; };
  std::vector<TreeBody> out;
  for (std::size_t i = 0; i < count; ++i) {
    TreeBody b;
    const double kind = unit(random);
    b.joint = i == 0        ? (free ? TreeBody::Joint::free : TreeBody::Joint::fixed)
              : kind < -0.8 ? TreeBody::Joint::fixed
              : kind < -0.3 ? TreeBody::Joint::prismatic
                            : TreeBody::Joint::revolute;
    b.parent = i == 0 ? TreeBody::kGround : random() % i;
    b.axis = array(Eigen::Vector3d(unit(random), unit(random), 1.5).normalized());
    b.anchor = place();
    b.mass_kg = std::pow(10.0, -0.5 + 1.5 * unit(random));
    b.center_of_mass = place();
    Eigen::Matrix3d root;
    for (int k = 0; k < 9; ++k) root(k) = 0.1 * unit(random);
    const Eigen::Matrix3d inertia = b.mass_kg * (root * root.transpose() + 1e-3 * Eigen::Matrix3d::Identity());
    for (unsigned k = 0; k < 9; ++k) b.inertia_kgm2[k] = inertia(k / 3, k % 3);
    b.damping = random() % 2 == 0 ? 0 : std::pow(10.0, -1 + unit(random));
    b.stiffness = random() % 2 == 0 ? 0 : std::pow(10.0, 1 + unit(random));
    b.implicit_s = implicit_s;
    if (random() % 4 != 0) b.weight_N = array(b.mass_kg * Eigen::Vector3d(1, -3, -9));
    out.push_back(b);
  }
  return out;
}

/// Where the bodies are when each joint has moved by so much, one after the other from the leaves on: no order matters.
inline std::vector<TreeBody> moved(std::vector<TreeBody> bodies, const Eigen::VectorXd& by) {
  for (std::size_t j = bodies.size(); j-- > 0;) {
    if (!moves(bodies[j])) continue;
    const double q = by[static_cast<Eigen::Index>(j)];
    const bool turns = bodies[j].joint == TreeBody::Joint::revolute;
    const Eigen::Vector3d axis = eigen(bodies[j].axis), anchor = eigen(bodies[j].anchor);
    const Eigen::Matrix3d turn = turns ? Eigen::AngleAxisd(q, axis).toRotationMatrix() : Eigen::Matrix3d::Identity();
    const Eigen::Vector3d shift = turns ? Eigen::Vector3d::Zero() : Eigen::Vector3d(q * axis);
    for (std::size_t i = j; i < bodies.size(); ++i) {
      std::size_t up = i;
      while (up != j && up != TreeBody::kGround) up = bodies[up].parent;
      if (up != j) continue;
      TreeBody& b = bodies[i];
      b.axis = array(turn * eigen(b.axis));
      b.anchor = array(anchor + turn * (eigen(b.anchor) - anchor) + shift);
      b.center_of_mass = array(anchor + turn * (eigen(b.center_of_mass) - anchor) + shift);
    }
  }
  return bodies;
}

/// Of a dense solution: one column a body's joint, zeros where it has none, then six of a free base.
struct Dense {
  Eigen::MatrixXd mass;     ///< M + h·D + h²·K
  Eigen::VectorXd gravity;  ///< torques of the weights

  explicit Dense(const std::vector<TreeBody>& bodies) {
    const auto n = static_cast<Eigen::Index>(bodies.size());
    const bool free = bodies.front().joint == TreeBody::Joint::free;
    mass = Eigen::MatrixXd::Zero(n + 6, n + 6);
    gravity = Eigen::VectorXd::Zero(n + 6);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Eigen::MatrixXd along = Eigen::MatrixXd::Zero(3, n + 6), about = along;
      const Eigen::Vector3d center = eigen(bodies[i].center_of_mass);
      const auto add = [&](Eigen::Index column, const Eigen::Vector3d& axis, const Eigen::Vector3d& anchor) {
        about.col(column) = axis;
        along.col(column) = axis.cross(center - anchor);
      };
      for (std::size_t up = i; up != TreeBody::kGround; up = bodies[up].parent) {
        const auto column = static_cast<Eigen::Index>(up);
        if (bodies[up].joint == TreeBody::Joint::prismatic) along.col(column) = eigen(bodies[up].axis);
        if (bodies[up].joint == TreeBody::Joint::revolute) add(column, eigen(bodies[up].axis), eigen(bodies[up].anchor));
      }
      for (Eigen::Index k = 0; free && k < 3; ++k) {
        add(n + k, Eigen::Vector3d::Unit(k), Eigen::Vector3d::Zero());
        along.col(n + 3 + k) = Eigen::Vector3d::Unit(k);
      }
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> inertia(bodies[i].inertia_kgm2.data());
      mass += bodies[i].mass_kg * along.transpose() * along + about.transpose() * inertia * about;
      gravity += along.transpose() * eigen(bodies[i].weight_N);
      const auto k = static_cast<Eigen::Index>(i);
      const double h = bodies[i].implicit_s;
      if (moves(bodies[i])) mass(k, k) += h * bodies[i].damping + h * h * bodies[i].stiffness;
    }
    for (Eigen::Index k = 0; k < n + 6; ++k)
      if (mass(k, k) == 0) mass(k, k) = 1;  // no joint there
  }
  /// Of joints under these torques.
  [[nodiscard]] Eigen::VectorXd answer(const Eigen::VectorXd& torques) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(mass.rows());
    all.head(torques.size()) = torques;
    return mass.ldlt().solve(all).head(torques.size());
  }
};

}  // namespace vsa::test
