// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The snake with its gait: energy, determinism, reset.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"

namespace {

using vsa::engine::World;
using vsa::motion::Gait;

std::filesystem::path model(const char* path) { return vsa::config::data_directory() / "models" / path; }

struct Crawl {
  World world = World::load(model("worlds/snake_flat.sdf"));
  Gait gait = Gait::load(model("gaits/sidewind.toml"));

  void run(double seconds) {
    const auto end = world.time_ns() + static_cast<std::int64_t>(seconds * 1e9);
    while (world.time_ns() < end) {
      gait.apply(world);
      world.step();
    }
  }

  [[nodiscard]] std::vector<double> numbers() const {
    std::vector<double> out;
    for (const auto& a : world.actuators()) {
      const auto r = world.read(a);
      out.insert(out.end(), {r.shaft_rad, r.shaft_speed_rad_per_s, r.torque_Nm, r.motor_rad[0], r.motor_rad[1], r.current_A[0]});
    }
    std::vector<vsa::engine::Pose> poses(world.links().size());
    world.poses(poses);
    for (const auto& p : poses) out.insert(out.end(), p.position.begin(), p.position.end());
    return out;
  }
};

TEST(Snake, EnergyLedgerClosesOverAMinuteOfCrawling) {
  Crawl c;
  c.run(60.0);
  const auto l = c.world.ledger();
  EXPECT_GT(l.moved(), 100.0);
  EXPECT_LT(std::abs(l.imbalance()), 1e-9 * l.moved());
  EXPECT_LT(std::abs(l.integrator) + std::abs(l.coupling), 0.01 * l.moved());
  RecordProperty("moved_J", std::to_string(l.moved()));
  std::printf("moved %.1f J, imbalance %.2e, integrator %.3e, coupling %.3e, supply %.1f J\n", l.moved(), l.imbalance() / l.moved(),
              l.integrator / l.moved(), l.coupling / l.moved(), l.supply);
}

TEST(Snake, IntegratorAndCouplingErrorsShrinkWithTheStep) {
  auto errors = [](double step_s) {
    vsa::engine::WorldOptions options;
    options.step_s = step_s;
    Crawl c;
    c.world = World::load(model("worlds/snake_flat.sdf"), options);
    c.run(6.0);
    const auto l = c.world.ledger();
    return (std::abs(l.integrator) + std::abs(l.coupling)) / l.moved();
  };
  const double coarse = errors(1e-3);
  EXPECT_LT(errors(2.5e-4), 0.6 * coarse);
}

TEST(Snake, TwoRunsAndAResetGiveTheSameBits) {
  Crawl a, b;
  a.run(3.0);
  b.run(3.0);
  const auto first = a.numbers();
  EXPECT_EQ(first, b.numbers());
  a.world.reset();
  a.gait.reset();
  EXPECT_EQ(a.world.time_ns(), 0);
  a.run(3.0);
  EXPECT_EQ(first, a.numbers());
}

TEST(Snake, ASnapshotContinuesBitForBit) {
  Crawl a;
  a.run(1.5);
  const auto snapshot = a.world.snapshot();
  const Gait gait = a.gait;
  a.run(1.0);
  const auto first = a.numbers();
  a.world.restore(*snapshot);
  a.gait = gait;
  a.run(1.0);
  EXPECT_EQ(first, a.numbers());
}

}  // namespace
