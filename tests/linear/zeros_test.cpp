// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Poles at 0 are counted right beside fast ones, and slow ones aren't taken for them.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "vsa/linear/linear.hpp"

namespace {

using namespace vsa;
using Eigen::MatrixXd;
using linear::System;

/// The same motion in states that are mixed and of other units.
System mixed(const MatrixXd& a) {
  const Eigen::Index n = a.rows();
  MatrixXd mix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) mix(i, k) = std::sin(static_cast<double>(3 * i + 7 * k + i * k)) + (i == k ? 3 : 0);
  Eigen::VectorXd units(n);
  for (Eigen::Index i = 0; i < n; ++i) units[i] = std::pow(10.0, static_cast<double>(i % 3) - 1);
  const MatrixXd t = units.asDiagonal() * mix;
  System out;
  out.a = t * a * t.inverse();
  return out;
}

std::ptrdiff_t zeros(const std::vector<linear::Pole>& poles) {
  return std::count_if(poles.begin(), poles.end(), [](const linear::Pole& p) { return p.s == 0.0; });
}

/// `integrators` in a row that nothing holds, a swing, a fast and a slow decay.
MatrixXd plant(Eigen::Index integrators, double fast, double slow) {
  MatrixXd a = MatrixXd::Zero(integrators + 4, integrators + 4);
  for (Eigen::Index i = 0; i + 1 < integrators; ++i) a(i, i + 1) = 1;
  a.block(integrators, integrators, 2, 2) << 0, 1, -400, -2;
  a(integrators + 2, integrators + 2) = -fast;
  a(integrators + 3, integrators + 3) = -slow;
  return a;
}

TEST(Zeros, AreCountedHoweverManyShareAnEigenvector) {
  for (const Eigen::Index n : {1, 2, 3, 4}) {
    const System m = mixed(plant(n, 5000, 0.01));
    const auto poles = linear::poles(m);
    ASSERT_EQ(poles.size(), static_cast<std::size_t>(n) + 3) << "the swing is one of them";
    EXPECT_EQ(zeros(poles), n);
    for (const linear::Pole& p : poles) EXPECT_LE(p.s.real(), 0) << n << ": nothing grows";
    EXPECT_NEAR(poles[static_cast<std::size_t>(n)].s.real(), -0.01, 1e-6);
    EXPECT_NEAR(std::abs(poles[static_cast<std::size_t>(n) + 1].s), 20, 1e-6);
    const Eigen::MatrixXcd shapes = linear::shapes(m);
    for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
      const Eigen::VectorXcd v = shapes.col(i);
      EXPECT_NEAR(v.norm(), 1, 1e-12);
      EXPECT_LT((m.a * v - poles[static_cast<std::size_t>(i)].s * v).norm(), 1e-9 * m.a.norm()) << n << ", pole " << i;
    }
  }
}

TEST(Zeros, SlowPolesArent) {
  const auto poles = linear::poles(mixed(plant(1, 1e7, 1e-3)));
  EXPECT_EQ(zeros(poles), 1);
  EXPECT_NEAR(poles[1].s.real(), -1e-3, 1e-5);
}

/// Two units alike have the same poles, which rounding may move off the axis as a pair.
TEST(Zeros, TwoRealPolesAlikeAreTwo) {
  for (const double other : {2.0, 2.0 * (1 + 1e-12)}) {
    const auto poles = linear::poles(mixed(Eigen::Vector4d(-2, -other, -30, -30).asDiagonal()));
    ASSERT_EQ(poles.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(std::abs(poles[i].s - (i < 2 ? -2.0 : -30.0)), 0, 1e-9);
  }
}

TEST(Zeros, OfASampledSystemStayWhereTheyAre) {
  for (const Eigen::Index n : {1, 2, 3}) {
    System m = mixed(plant(n, 5000, 0.01));
    m.period_s = 1e-3;
    m.a = (m.a * m.period_s).exp();
    const auto poles = linear::poles(m);
    ASSERT_EQ(poles.size(), static_cast<std::size_t>(n) + 3);
    EXPECT_EQ(zeros(poles), n);
    for (const linear::Pole& p : poles) EXPECT_LE(p.s.real(), 0) << n;
    EXPECT_NEAR(poles[static_cast<std::size_t>(n)].s.real(), -0.01, 1e-5);
    EXPECT_NEAR(std::abs(poles[static_cast<std::size_t>(n) + 1].s), 20, 1e-5);
  }
}

}  // namespace
