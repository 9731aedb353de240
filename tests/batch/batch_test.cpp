// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Copies in a batch go as worlds by themselves do.
#include "batch_test.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

namespace vsa::batch {
namespace {

using engine::World;
constexpr std::size_t kCopies = 9;

/// The same without a batch.
std::vector<World> single_runs(const World& from, int calls, int steps) {
  std::vector<World> out;
  for (std::size_t c = 0; c < kCopies; ++c) {
    out.push_back(from.clone());
    for (int k = 0; k < calls; ++k) {
      command(out.back(), c, k);
      for (int n = 0; n < steps; ++n) out.back().step();
    }
  }
  return out;
}

TEST(Batch, GivesTheBitsOfSingleRunsForAnyNumberOfThreads) {
  World w = World::load("snake_flat.sdf");
  w.run(0.05);
  const std::vector<World> alone = single_runs(w, 6, 8);
  for (const std::size_t threads : {1, 2, 7}) {
    Batch batch(w, kCopies, threads);
    ASSERT_EQ(batch.threads(), threads);
    for (int k = 0; k < 6; ++k) {
      command(batch, k);
      batch.step(8);
    }
    for (std::size_t c = 0; c < kCopies; ++c)
      EXPECT_EQ(first_difference(batch.state(c), numbers_of(alone[c])), std::nullopt) << c << " of " << threads << " threads";
  }
}

TEST(Batch, GivesTheSameBitsInAnyOrderAndInPieces) {
  World w = World::load("snake_flat.sdf");
  const std::vector<World> alone = single_runs(w, 5, 4);
  Batch batch(w, kCopies, 3);
  std::vector<std::size_t> order(kCopies);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(1);
  for (int k = 0; k < 5; ++k) {
    std::shuffle(order.begin(), order.end(), random);
    command(batch, k);
    batch.step(4, std::span(order).first(4));
    batch.step(4, std::span(order).subspan(4));
  }
  for (std::size_t c = 0; c < kCopies; ++c) EXPECT_EQ(first_difference(batch.state(c), numbers_of(alone[c])), std::nullopt) << c;
}

TEST(Batch, GivesTheSameBitsInSlicesAndCanBeEndedBetweenThem) {
  const World w = World::load("bench_load.sdf");
  Batch whole(w, 3, 2), sliced(w, 3, 2), ended(w, 3, 2);
  const std::vector<std::size_t> all{0, 1, 2};
  const int steps = 2 * Batch::kSlice / 3 + 5;
  int calls = 0;
  for (Batch* b : {&whole, &sliced, &ended}) command(*b, 1);
  whole.step(steps);
  sliced.step(steps, all, [&] {
    ++calls;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(sliced.time_s()[c], sliced.time_s()[0]);
    command(sliced, 2);  // a command is taken when step() begins
  });
  EXPECT_EQ(calls, 2);
  for (const std::size_t c : all) EXPECT_EQ(first_difference(sliced.state(c), whole.state(c)), std::nullopt) << c;
  EXPECT_THROW(ended.step(steps, all, [] { throw std::runtime_error("enough"); }), std::runtime_error);
  const int made = Batch::kSlice / 3;
  for (const std::size_t c : all) EXPECT_DOUBLE_EQ(ended.time_s()[c], made * w.step_s()) << c;
  for (std::size_t k = 0; k < 3 * ended.actuators(); ++k) ended.equilibrium()[k] = ended.preset()[k] = std::nan("");
  ended.step(steps - made);
  for (const std::size_t c : all) EXPECT_EQ(first_difference(ended.state(c), whole.state(c)), std::nullopt) << c;
}

TEST(Batch, TellsWhatAWorldWouldTell) {
  World w = World::load("snake_flat.sdf");
  const std::vector<World> alone = single_runs(w, 3, 10);
  Batch batch(w, kCopies, 2);
  for (int k = 0; k < 3; ++k) {
    command(batch, k);
    batch.step(10);
  }
  std::vector<scene::Pose> poses(w.links().size());
  for (std::size_t c = 0; c < kCopies; ++c) {
    EXPECT_EQ(batch.time_s()[c], alone[c].time_s());
    for (std::size_t a = 0; a < batch.actuators(); ++a) {
      const auto now = alone[c].read(alone[c].actuators()[a]);
      const std::size_t at = c * batch.actuators() + a;
      EXPECT_EQ(batch.shaft_rad()[at], now.shaft_rad);
      EXPECT_EQ(batch.shaft_speed_rad_per_s()[at], now.shaft_speed_rad_per_s);
      EXPECT_EQ(batch.torque_Nm()[at], now.torque_Nm);
      EXPECT_EQ(batch.stiffness_Nm_per_rad()[at], now.stiffness_Nm_per_rad);
      EXPECT_EQ(batch.motor_rad()[2 * at + 1], now.motor_rad[1]);
    }
    ASSERT_GE(batch.joints().size(), batch.actuators());
    for (std::size_t j = 0; j < batch.joints().size(); ++j) {
      EXPECT_EQ(batch.joint_position()[c * batch.joints().size() + j], alone[c].joint_angle(batch.joints()[j]));
      EXPECT_EQ(batch.joint_speed()[c * batch.joints().size() + j], alone[c].joint_speed(batch.joints()[j]));
    }
    alone[c].poses(poses);
    for (std::size_t l = 0; l < poses.size(); ++l) EXPECT_EQ(batch.poses()[c * batch.links() + l].position, poses[l].position);
  }
}

TEST(Batch, StepsAndResetsOnlyThoseThatAreNamed) {
  const World w = World::load("bench_load.sdf");
  Batch batch(w, 4, 2);
  const Numbers first(batch.state(0).begin(), batch.state(0).end());
  batch.step(5, std::vector<std::size_t>{2, 0});
  EXPECT_EQ(batch.time_s()[0], 5 * w.step_s());
  EXPECT_EQ(batch.time_s()[1], 0.0);
  EXPECT_EQ(first_difference(batch.state(1), first), std::nullopt);
  EXPECT_NE(first_difference(batch.state(2), first), std::nullopt);
  batch.step(3, {});
  EXPECT_EQ(batch.time_s()[0], 5 * w.step_s()) << "nobody is nobody";
  batch.reset(std::vector<std::size_t>{2});
  EXPECT_EQ(first_difference(batch.state(2), first), std::nullopt);
  EXPECT_EQ(batch.time_s()[2], 0.0);
  EXPECT_EQ(batch.time_s()[0], 5 * w.step_s());
  batch.restore(3, batch.state(0));
  EXPECT_EQ(first_difference(batch.state(3), batch.state(0)), std::nullopt);
  EXPECT_EQ(batch.time_s()[3], 5 * w.step_s());
}

TEST(Batch, ACopyThatBlowsUpIsMarkedAndTheOthersGoOn) {
  const World w = World::load("snake_flat.sdf");
  Batch batch(w, 5, 2), good(w, 5, 2);
  Numbers bad(batch.state(3).begin(), batch.state(3).end());
  const StateLayout layout = w.state_layout();
  const auto speed = std::find_if(layout.entries().begin(), layout.entries().end(), [](const StateEntry& e) {
    return e.name.rfind("physics/joint", 0) == 0 && e.name.find(".speed") != std::string::npos;
  });
  ASSERT_NE(speed, layout.entries().end());
  bad[speed->offset] = 1e11;
  batch.restore(3, bad);
  batch.step(20);
  good.step(20);
  EXPECT_EQ(batch.status(3), Status::failed);
  EXPECT_NE(batch.failure(3).find("blew up"), std::string::npos) << batch.failure(3);
  EXPECT_EQ(first_difference(batch.state(3), bad), std::nullopt) << "it stays where it was";
  for (const std::size_t c : {0, 1, 2, 4}) {
    EXPECT_EQ(batch.status(c), Status::running);
    EXPECT_EQ(first_difference(batch.state(c), good.state(c)), std::nullopt) << c;
  }
  batch.reset(std::vector<std::size_t>{3});
  EXPECT_EQ(batch.status(3), Status::running);
  batch.step(20, std::vector<std::size_t>{3});
  EXPECT_EQ(first_difference(batch.state(3), good.state(3)), std::nullopt);
}

/// Copies share the Worlds of their threads: what one has to tell is its own, whoever steps it.
TEST(Batch, NoticesAreOfTheirCopy) {
  const World w = World::load("bench_load.sdf");
  for (const std::size_t threads : {1, 3}) {
    Batch batch(w, 40, threads);
    for (std::size_t c = 0; c < 40; c += 3) batch.preset()[c] = 100.0 + static_cast<double>(c);
    batch.step(5);
    const std::vector<Notice> told = batch.take_notices();
    ASSERT_EQ(told.size(), 14u);
    for (std::size_t k = 0; k < told.size(); ++k) {
      EXPECT_EQ(told[k].copy, 3 * k);
      EXPECT_NE(told[k].text.find(": preset " + std::to_string(100 + 3 * k)), std::string::npos) << told[k].text;
    }
    batch.step(5);
    EXPECT_TRUE(batch.take_notices().empty()) << "each once";
    for (int episode = 0; episode < 100; ++episode) {
      batch.reset();
      batch.step(5);
    }
    const std::vector<Notice> many = batch.take_notices();
    EXPECT_EQ(many.size(), 14 * (Batch::kMostNotices + 1)) << "nobody asked";
    EXPECT_NE(many[Batch::kMostNotices].text.find("left out"), std::string::npos);
    EXPECT_TRUE(batch.take_notices().empty());
  }
}

TEST(Batch, RefusesWhatItCantDoBeforeAnythingMoves) {
  const World w = World::load("bench_load.sdf");
  Batch batch(w, 3, 2);
  const auto text = [](auto&& work) -> std::string {
    try {
      work();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using Which = std::vector<std::size_t>;
  EXPECT_NE(text([&] { batch.step(1, Which{0, 3}); }).find("copy = 3"), std::string::npos);
  EXPECT_NE(text([&] { batch.step(1, Which{1, 1}); }).find("twice"), std::string::npos);
  EXPECT_NE(text([&] { batch.reset(Which{7}); }).find("copy = 7"), std::string::npos);
  EXPECT_NE(text([&] { batch.step(0); }).find("steps = 0"), std::string::npos);
  EXPECT_NE(text([&] { batch.restore(0, batch.state(0).first(3)); }).find("wrong size"), std::string::npos);
  batch.equilibrium()[1] = std::numeric_limits<double>::infinity();
  EXPECT_NE(text([&] { batch.step(); }).find("copy 1, "), std::string::npos);
  EXPECT_NE(text([&] { Batch(w, 0); }).find("copies = 0"), std::string::npos);
  EXPECT_NE(text([&] { Batch(w, 1, 5000); }).find("threads = 5000"), std::string::npos);
  for (const double t : batch.time_s()) EXPECT_EQ(t, 0.0);
  EXPECT_EQ(batch.status(0), Status::running);
  Batch moved = std::move(batch);
  EXPECT_THROW(batch.step(), std::logic_error);  // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(moved.size(), 3u);
}

}  // namespace
}  // namespace vsa::batch
