// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/tree_inertia.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using vsa::host::TreeBody;
using vsa::host::TreeInertia;
using Joint = TreeBody::Joint;

TreeBody body(std::size_t parent, Joint joint, std::array<double, 3> axis, std::array<double, 3> anchor, double mass,
              std::array<double, 3> center, double inertia) {
  return {parent, joint, axis, anchor, mass, center, {inertia, 0, 0, 0, inertia, 0, 0, 0, inertia}};
}

/// B over the joints of all bodies.
std::vector<double> mobility(const std::vector<TreeBody>& bodies) {
  std::vector<std::size_t> all(bodies.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<double> out(bodies.size() * bodies.size(), -1);
  TreeInertia tree(bodies.size());
  tree.update(bodies);
  tree.mobility(bodies, all, out);
  return out;
}

std::vector<double> inverse(const std::vector<TreeBody>& bodies) {
  const auto b = mobility(bodies);
  std::vector<double> out;
  for (std::size_t i = 0; i < bodies.size(); ++i) out.push_back(b[i * (bodies.size() + 1)]);
  return out;
}

constexpr std::array<double, 3> kZ{0, 0, 1};

TEST(TreeInertia, APendulumHasTheInertiaAboutItsPivot) {
  // Far from the world's origin, so that a reference point forgotten somewhere shows.
  const auto a = inverse({body(TreeBody::kGround, Joint::revolute, kZ, {7, -3, 2}, 1.5, {7.2, -3, 2.4}, 0.01)});
  EXPECT_NEAR(a[0], 1 / (0.01 + 1.5 * 0.2 * 0.2), 1e-9);
}

TEST(TreeInertia, ASliderCarriesItsMassWhateverItsInertia) {
  const auto a = inverse({body(TreeBody::kGround, Joint::prismatic, {0.6, 0.8, 0}, {0, 0, 0}, 2.5, {1, 1, 1}, 0.3)});
  EXPECT_NEAR(a[0], 1 / 2.5, 1e-12);
}

TEST(TreeInertia, TwoDiscsThatFlyFreeTurnAgainstEachOther) {
  const auto a = inverse({body(TreeBody::kGround, Joint::free, {}, {}, 1.0, {1, 2, 3}, 0.02),
                          body(0, Joint::revolute, kZ, {1, 2, 3.1}, 0.5, {1, 2, 3.1}, 0.03)});
  EXPECT_EQ(a[0], 0.0);
  EXPECT_NEAR(a[1], 1 / 0.02 + 1 / 0.03, 1e-8);
}

TEST(TreeInertia, ABodyFixedToAnotherAddsToIt) {
  const auto a = inverse({body(TreeBody::kGround, Joint::revolute, kZ, {0, 0, 0}, 1.0, {0.1, 0, 0}, 0.01),
                          body(0, Joint::fixed, {}, {}, 2.0, {0.3, 0.1, 5}, 0.02)});
  EXPECT_NEAR(a[0], 1 / (0.01 + 1.0 * 0.01 + 0.02 + 2.0 * (0.09 + 0.01)), 1e-9);
  EXPECT_EQ(a[1], 0.0);
}

TEST(TreeInertia, ADoublePendulumHasItsInverseMassMatrix) {
  const double l1 = 0.4, c1 = 0.15, c2 = 0.25, m1 = 1.2, m2 = 0.8, i1 = 0.02, i2 = 0.03, q1 = 0.3, q2 = 0.9;
  const std::array<double, 3> elbow{l1 * std::cos(q1), l1 * std::sin(q1), 0};
  const auto b = mobility(
      {body(TreeBody::kGround, Joint::revolute, kZ, {0, 0, 0}, m1, {c1 * std::cos(q1), c1 * std::sin(q1), 0}, i1),
       body(0, Joint::revolute, kZ, elbow, m2, {elbow[0] + c2 * std::cos(q1 + q2), elbow[1] + c2 * std::sin(q1 + q2), 0}, i2)});
  const double m22 = i2 + m2 * c2 * c2, m12 = m22 + m2 * l1 * c2 * std::cos(q2);
  const double m11 = i1 + m1 * c1 * c1 + i2 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * std::cos(q2));
  const double det = m11 * m22 - m12 * m12;
  EXPECT_NEAR(b[0], m22 / det, 1e-9);
  EXPECT_NEAR(b[1], -m12 / det, 1e-9);
  EXPECT_NEAR(b[2], -m12 / det, 1e-9);
  EXPECT_NEAR(b[3], m11 / det, 1e-9);
}

TEST(TreeInertia, ArmsOnAFixedBaseAreTreesOfTheirOwnAndThoseOfAFreeBaseAreOne) {
  const auto tree = [](Joint base) {
    return std::vector<TreeBody>{body(TreeBody::kGround, base, kZ, {}, 1.0, {0, 0, 0}, 0.05),
                                 body(0, Joint::revolute, kZ, {0.1, 0, 0}, 0.4, {0.2, 0, 0}, 0.004),
                                 body(0, Joint::revolute, kZ, {-0.1, 0, 0}, 0.6, {-0.3, 0, 0}, 0.006),
                                 body(1, Joint::revolute, kZ, {0.3, 0, 0}, 0.2, {0.4, 0, 0}, 0.001)};
  };
  const std::vector<std::size_t> driven{3, 2, 1};
  using Groups = std::vector<std::vector<std::size_t>>;
  EXPECT_EQ(vsa::host::joined(tree(Joint::fixed), driven), (Groups{{0, 2}, {1}}));
  EXPECT_EQ(vsa::host::joined(tree(Joint::free), driven), (Groups{{0, 1, 2}}));
  const auto fixed = mobility(tree(Joint::fixed)), free = mobility(tree(Joint::free));
  EXPECT_EQ(fixed[1 * 4 + 2], 0.0) << "they don't move each other";
  EXPECT_GT(free[1 * 4 + 2], 1.0) << "one turns the base, and with it the other";
}

TEST(TreeInertia, ABranchedTreeDoesNotDependOnTheOrderOfItsBranches) {
  const auto root = body(TreeBody::kGround, Joint::free, {}, {}, 1.0, {0, 0, 0}, 0.05);
  const auto left = body(0, Joint::revolute, {1, 0, 0}, {0.1, 0, 0}, 0.4, {0.2, 0.1, 0}, 0.004);
  const auto right = body(0, Joint::revolute, {0, 1, 0}, {-0.1, 0, 0.1}, 0.6, {-0.3, 0, 0.2}, 0.006);
  const auto a = inverse({root, left, right}), b = inverse({root, right, left});
  EXPECT_NEAR(a[1], b[2], 1e-9 * a[1]);
  EXPECT_NEAR(a[2], b[1], 1e-9 * a[2]);
}

TEST(TreeInertia, WhatTwoJointsDoToEachOtherDoesNotDependOnWhichOthersAreAskedFor) {
  // Two arms of five joints on a body that flies, so several blocks of columns; in an order that isn't the bodies'.
  std::vector<TreeBody> bodies{body(TreeBody::kGround, Joint::free, {}, {}, 1.0, {0, 0, 0}, 0.05)};
  for (std::size_t i = 1; i <= 10; ++i) {
    const double x = 0.1 * static_cast<double>(i), y = 0.03 * static_cast<double>(i * i);
    const std::array<double, 3> axis = i % 3 == 0 ? std::array<double, 3>{1, 0, 0} : std::array<double, 3>{0, 0.6, 0.8};
    bodies.push_back(body(i < 3 ? 0 : i - 2, Joint::revolute, axis, {x, y, 0}, 0.3 + 0.02 * x, {x + 0.05, y, 0.02}, 0.001));
  }
  const std::vector<std::size_t> all{7, 2, 10, 1, 9, 4, 3, 8, 6, 5};
  std::vector<double> whole(100), pair(4);
  TreeInertia tree(bodies.size());
  tree.update(bodies);
  tree.mobility(bodies, all, whole);
  for (std::size_t i = 0; i < 10; ++i) {
    for (std::size_t j = 0; j < 10; ++j) {
      if (i == j) continue;
      const std::array<std::size_t, 2> two{all[i], all[j]};
      tree.mobility(bodies, two, pair);
      EXPECT_NEAR(whole[10 * i + j], pair[1], 1e-9 * std::abs(pair[0])) << all[i] << ", " << all[j];
      EXPECT_NEAR(whole[10 * i + i], pair[0], 1e-9 * pair[0]);
    }
  }
}

TEST(TreeInertia, ABodyWithoutMassGivesNoAnswerAndNoCrash) {
  const auto a = inverse({body(TreeBody::kGround, Joint::revolute, kZ, {0, 0, 0}, 0, {0, 0, 0}, 0)});
  EXPECT_FALSE(std::isfinite(a[0]));
}

}  // namespace
