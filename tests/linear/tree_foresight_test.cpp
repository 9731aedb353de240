// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What springs, dampers and gravity do to trees by chance, beside a dense solution; and that robots that are told of it only lose energy.
#include "vsa/host/tree_foresight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

#include "host/free_flanges.hpp"
#include "host/tree_by_chance.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using vsa::host::TreeForesight;
using vsa::host::TreeInertia;
using vsa::test::Dense;
using vsa::test::moves;
using vsa::test::TreeBody;

constexpr double kSmall = 1e-6;

std::vector<double> numbers(const VectorXd& v) { return {v.data(), v.data() + v.size()}; }
Eigen::Map<const VectorXd> eigen(const std::vector<double>& v) { return {v.data(), static_cast<Eigen::Index>(v.size())}; }

/// Where there are joints.
VectorXd by_chance(std::mt19937& random, const std::vector<TreeBody>& bodies, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (moves(bodies[i])) out[static_cast<Eigen::Index>(i)] = unit(random);
  return out;
}

void for_trees_by_chance(const std::function<void(std::mt19937&, const std::vector<TreeBody>&)>& each) {
  std::mt19937 random(5);
  for (std::size_t trial = 0; trial < 200; ++trial)
    each(random, vsa::test::tree_by_chance(random, 2 + trial % 9, trial % 2 == 1, trial % 3 == 0 ? 0 : 2e-3));
}

TEST(TreeForesight, TorquesAtAllJointsMoveThemAsADenseSolutionSays) {
  for_trees_by_chance([](std::mt19937& random, const std::vector<TreeBody>& bodies) {
    TreeInertia inertia(bodies.size());
    inertia.update(bodies);
    const VectorXd torques = by_chance(random, bodies, 1), right = Dense(bodies).answer(torques);
    std::vector<double> out(bodies.size());
    inertia.answer(bodies, numbers(torques), out);
    EXPECT_LE((eigen(out) - right).norm(), 1e-7 * right.norm());
  });
}

TEST(TreeForesight, SpringsDampersAndWeightsChangeTorquesAsFarAsTheJointsMove) {
  for_trees_by_chance([](std::mt19937& random, const std::vector<TreeBody>& bodies) {
    const VectorXd turned = by_chance(random, bodies, 1), sped_up = by_chance(random, bodies, 1);
    std::vector<double> out(bodies.size());
    TreeForesight(bodies.size()).torques(bodies, numbers(kSmall * turned), numbers(kSmall * sped_up), out);
    VectorXd right = VectorXd::Zero(turned.size());
    if (bodies.front().joint != TreeBody::Joint::free) {
      const VectorXd there = Dense(vsa::test::moved(bodies, kSmall * turned)).gravity;
      const VectorXd back = Dense(vsa::test::moved(bodies, -kSmall * turned)).gravity;
      right = (there - back).head(turned.size()) / (2 * kSmall);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      right[k] -= bodies[i].damping * sped_up[k] + bodies[i].stiffness * (turned[k] + bodies[i].implicit_s * sped_up[k]);
    }
    EXPECT_LT((eigen(out) / kSmall - right).norm(), 1e-6 * (1 + right.norm()));
  });
}

TEST(TreeForesight, OfAStepIsTheLastOneAndWhatHasChangedSince) {
  for_trees_by_chance([](std::mt19937& random, const std::vector<TreeBody>& bodies) {
    TreeInertia inertia(bodies.size());
    inertia.update(bodies);
    TreeForesight foresight(bodies.size());
    TreeForesight::Memory memory = foresight.begin();
    const VectorXd q = by_chance(random, bodies, 1), v = by_chance(random, bodies, 1);
    const VectorXd turned = by_chance(random, bodies, 1e-3), sped_up = by_chance(random, bodies, 0.1);
    std::vector<double> out(bodies.size()), torques(bodies.size());
    foresight.foresee(bodies, inertia, numbers(q), numbers(v), 1e-3, memory, out);
    for (const double a : out) ASSERT_TRUE(std::isnan(a)) << "nothing is known of a step before";
    foresight.foresee(bodies, inertia, numbers(q + turned), numbers(v + sped_up), 2e-3, memory, out);
    foresight.torques(bodies, numbers(turned), numbers(sped_up), torques);
    const VectorXd right = sped_up / 1e-3 + Dense(bodies).answer(eigen(torques));
    bool known = false;
    for (const TreeBody& b : bodies)
      known = known || (moves(b) && b.damping + b.stiffness > 0) ||
              (bodies.front().joint != TreeBody::Joint::free && b.weight_N[2] != 0);
    if (known)
      EXPECT_LT((eigen(out) - right).norm(), 1e-6 * right.norm());
    else
      for (const double a : out) EXPECT_TRUE(std::isnan(a));
  });
}

/// A chain that hangs at rest: links of 10 g to 1 kg on horizontal hinges, some driven, with springs and dampers at some.
struct Hanging {
  std::vector<TreeBody> bodies;
  std::vector<std::size_t> driven;
  std::vector<double> stiffness;  ///< of the actuators
  std::int64_t dt_ns = 1'000'000;
};

Hanging hanging_by_chance(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Hanging out;
  out.dt_ns = 500'000LL << (random() % 3);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 3 * unit(random), top = -0.08 * static_cast<double>(i);
    TreeBody b{i == 0 ? TreeBody::kGround : i - 1, TreeBody::Joint::revolute, {std::cos(angle), std::sin(angle), 0}, {0, 0, top}};
    b.mass_kg = std::pow(10.0, -1 + unit(random));
    b.center_of_mass = {0, 0, top - 0.04};
    for (const std::size_t k : {0, 4, 8}) b.inertia_kgm2[k] = b.mass_kg * 6e-4;
    if (random() % 2 == 0) b.damping = std::pow(10.0, -1 + unit(random));
    if (random() % 2 == 0) b.stiffness = std::pow(10.0, 1 + unit(random));
    b.implicit_s = 1e-9 * static_cast<double>(out.dt_ns);
    b.weight_N = {0, 0, -9.81 * b.mass_kg};
    out.bodies.push_back(b);
    if (i != random() % count) {
      out.driven.push_back(i);
      out.stiffness.push_back(std::pow(10.0, 1 + 2 * unit(random)));
    }
  }
  return out;
}

/// What is left of a small swing's energy, as a root, after 400 steps of an engine that takes springs and dampers implicitly:
/// v' = v + dt (M + dt·D + dt²·K)⁻¹ (τ − D v − K (q + dt v) + ∂τ_g/∂q q).
double growth(const Hanging& chain, bool told) {
  const auto n = static_cast<Eigen::Index>(chain.bodies.size());
  const std::size_t actuators = chain.driven.size();
  const double dt = 1e-9 * static_cast<double>(chain.dt_ns);
  vsa::host::RobotConfig config = vsa::test::chain(actuators);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < actuators; ++i) {
    config.actuators[i].unit = vsa::test::without_losses();
    config.actuators[i].unit.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(chain.stiffness[i]);
    all.push_back(i);
  }
  vsa::host::Robot robot(config);
  robot.join({all});
  VectorXd d(n), k(n), springs = VectorXd::Zero(n);
  std::vector<TreeBody> bare = chain.bodies;
  for (Eigen::Index i = 0; i < n; ++i) {
    TreeBody& b = bare[static_cast<std::size_t>(i)];
    d[i] = std::exchange(b.damping, 0);
    k[i] = std::exchange(b.stiffness, 0);
  }
  for (std::size_t i = 0; i < actuators; ++i) springs[static_cast<Eigen::Index>(chain.driven[i])] = chain.stiffness[i];
  MatrixXd gravity(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const VectorXd step = 1e-5 * VectorXd::Unit(n, j);
    gravity.col(j) = (Dense(vsa::test::moved(bare, step)).gravity - Dense(vsa::test::moved(bare, -step)).gravity).head(n) / 2e-5;
  }
  const MatrixXd mass = Dense(bare).mass.topLeftCorner(n, n);
  const MatrixXd answer = (mass + MatrixXd((dt * d + dt * dt * k).asDiagonal())).inverse();
  const MatrixXd hold = MatrixXd((k + springs).asDiagonal()) - gravity;
  TreeInertia inertia(chain.bodies.size());
  inertia.update(chain.bodies);
  std::vector<double> mobility(actuators * actuators), torques(actuators), free(chain.bodies.size());
  inertia.mobility(chain.bodies, chain.driven, mobility);
  TreeForesight foresight(chain.bodies.size());
  auto memory = foresight.begin();
  std::vector<vsa::host::JointIn> in(actuators);
  VectorXd q = 1e-4 * VectorXd::Ones(n), v = VectorXd::Zero(n), tau = v;
  double begun = 0, left = 0;
  for (int step = 0; step < 400; ++step) {
    foresight.foresee(chain.bodies, inertia, numbers(q), numbers(v), dt, memory, free);
    for (std::size_t i = 0; i < actuators; ++i) {
      const auto at = static_cast<Eigen::Index>(chain.driven[i]);
      in[i] = {q[at], v[at], mobility[i * (actuators + 1)]};
      if (told && step > 0) in[i].free_acceleration_rad_per_s2 = free[chain.driven[i]];
    }
    robot.advance(step * chain.dt_ns, chain.dt_ns, in, torques, mobility);
    for (std::size_t i = 0; i < actuators; ++i) tau[static_cast<Eigen::Index>(chain.driven[i])] = torques[i];
    v += dt * (answer * (tau - d.cwiseProduct(v) - k.cwiseProduct(q + dt * v) + gravity * q));
    q += dt * v;
    const VectorXd y = q - 0.5 * dt * v;
    const double energy = v.dot(mass * v) + y.dot(hold * y);
    if (step < 20) begun = std::max(begun, energy);
    if (step >= 380) left = std::max(left, energy);
  }
  return std::sqrt(left / begun);
}

TEST(TreeForesight, ChainsBesideSpringsDampersAndWeightsOnlyLoseEnergy) {
  std::mt19937 random(11);
  double largest = 0;
  int grown = 0;  // where nothing is told
  for (std::size_t trial = 0; trial < 300; ++trial) {
    const Hanging chain = hanging_by_chance(random, 1 + trial % 6);
    if (chain.driven.empty()) continue;
    largest = std::max(largest, growth(chain, true));
    grown += growth(chain, false) < 1.001 ? 0 : 1;
  }
  std::printf("largest growth of chains with springs, dampers and weights: %.6f; untold %d of them grow\n", largest, grown);
  EXPECT_LE(largest, 1.001) << "the largest of 20 steps isn't a swing's exact energy";
  EXPECT_GT(grown, 10) << "then this test shows nothing";
}

}  // namespace
