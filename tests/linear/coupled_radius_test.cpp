// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The second table of docs/explanation/7-host.md: what a step of a whole tree does to any small swing. Motors are locked and springs
// linear, so a step is a matrix of all angles and speeds; it is found by stepping robots, and its spectral radius tells whether
// something grows. Engine: v' = v + dt·B τ, q' = q + dt·v'.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "host/free_flanges.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/host/resolution.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using vsa::host::Robot;

struct Tree {
  MatrixXd mobility;              ///< B, 1/(kg·m²)
  std::vector<double> stiffness;  ///< N·m/rad
  std::int64_t dt_ns = 1'000'000;
  [[nodiscard]] std::size_t size() const { return stiffness.size(); }
};

vsa::host::RobotConfig robot_of(const Tree& tree) {
  vsa::host::RobotConfig config = vsa::test::chain(tree.size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    config.actuators[i].unit = vsa::test::without_losses();
    config.actuators[i].unit.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(tree.stiffness[i]);
  }
  return config;
}

/// Angles and speeds times dt, before and after a step.
VectorXd stepped(Robot& robot, const Tree& tree, const VectorXd& from, int steps, bool together) {
  const double dt = 1e-9 * static_cast<double>(tree.dt_ns);
  const auto n = static_cast<Eigen::Index>(tree.size());
  std::vector<vsa::host::JointIn> in(tree.size());
  std::vector<double> torques(tree.size());
  const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> rows = tree.mobility;
  const VectorXd diagonal = tree.mobility.diagonal();
  VectorXd state = from;
  robot.reset();
  for (int k = 0; k < steps; ++k) {
    for (Eigen::Index i = 0; i < n; ++i) in[static_cast<std::size_t>(i)] = {state[i], state[n + i] / dt, tree.mobility(i, i)};
    robot.advance(k * tree.dt_ns, tree.dt_ns, in, torques, {together ? rows.data() : diagonal.data(), robot.mobility_size()});
    state.tail(n) += dt * dt * tree.mobility * Eigen::Map<const VectorXd>(torques.data(), n);
    state.head(n) += state.tail(n);
  }
  return state;
}

/// Spectral radius of the matrix that takes a state to the next one.
double radius(const Tree& tree, bool together) {
  Robot robot(robot_of(tree));
  if (together) {
    std::vector<std::size_t> all(tree.size());
    std::iota(all.begin(), all.end(), 0);
    robot.join({all});
  }
  const auto n = static_cast<Eigen::Index>(2 * tree.size());
  constexpr int kBegun = 3;  // by then the torque before is one of this motion
  MatrixXd before(n, n), after(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const VectorXd one = 1e-4 * VectorXd::Unit(n, k);
    before.col(k) = stepped(robot, tree, one, kBegun, together);
    after.col(k) = stepped(robot, tree, one, kBegun + 1, together);
  }
  const MatrixXd step = before.transpose().colPivHouseholderQr().solve(after.transpose()).transpose();
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

/// Flanges of J on each other's shafts about parallel axes, equal springs: x² = k·dt²/J.
Tree flanges(int count, double x2) {
  constexpr double kInertia = 1e-3;
  MatrixXd mass(count, count);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) mass(i, j) = kInertia * (count - std::max(i, j));
  return {mass.inverse(), std::vector<double>(static_cast<std::size_t>(count), x2 * kInertia / 1e-6)};
}

TEST(CoupledRadius, OfOneFlangeIsTheFormulas) {
  for (const double x2 : {0.01, 0.1, 0.4, 4.0})
    EXPECT_NEAR(radius(flanges(1, x2), true), vsa::host::resolution(std::sqrt(x2)).radius, 1e-6) << x2;
}

TEST(CoupledRadius, IsNeverAboveOneWhereTheTreeIsSolvedAsAWholeAndAlwaysWhereEachJointIsAlone) {
  for (const double x2 : {0.01, 0.1, 0.4, 4.0, 100.0}) {
    std::printf("x² = %-5g", x2);
    for (const int count : {1, 2, 4, 12}) {
      const double whole = radius(flanges(count, x2), true);
      EXPECT_LE(whole, 1 + 1e-6) << count << " flanges, x² = " << x2;
      const double alone = radius(flanges(count, x2), false);
      EXPECT_TRUE(count == 1 || x2 > 1 || alone > 1 + 1e-7) << alone << ", " << count << " flanges, x² = " << x2;
      std::printf("   %2d: %.6f (alone %.4f)", count, whole, alone);
    }
    std::printf("\n");
  }
}

TEST(CoupledRadius, IsNeverAboveOneInTreesByChance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  double largest = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int count = 1 + trial % 8;
    MatrixXd root(count, count);
    for (int i = 0; i < count * count; ++i) root(i) = unit(random);
    Tree tree{1e3 * (root * root.transpose() + 0.05 * MatrixXd::Identity(count, count)), {}, 250'000LL << (trial % 5)};
    for (int i = 0; i < count; ++i) tree.stiffness.push_back(std::pow(10.0, 1 + 2 * unit(random)));
    largest = std::max(largest, radius(tree, true));
  }
  std::printf("largest radius of 2000 trees: %.9f\n", largest);
  EXPECT_LE(largest, 1 + 1e-5);
}

}  // namespace
