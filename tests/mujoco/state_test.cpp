// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// All that decides the future is in numbers that MuJoCo copies as it likes, and no mjData knows of another.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <thread>

#include "rig.hpp"
#include "vsa/engine/mjcf.hpp"

namespace vsa::mujoco::test {
namespace {

std::string snake() {
  return engine::export_plugin_mjcf(std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds/snake_flat.xml").file.bytes;
}

/// Waves along the snake, of `phase`.
void run(Data& data, const Rig& rig, int steps, double phase) {
  for (int k = 0; k < steps; ++k) {
    for (std::size_t u = 0; u < rig.units().size(); ++u) {
      data.d().ctrl[2 * u] = 0.4 * std::sin(5 * data.d().time - 0.5 * static_cast<double>(u) + phase);
      data.d().ctrl[2 * u + 1] = 0.3 + 0.1 * std::cos(phase);
    }
    data.step();
  }
}

TEST(State, ForwardChangesNothingHoweverOften) {
  const Rig rig(snake());
  Data once(rig), often(rig);
  for (int k = 0; k < 100; ++k) {
    run(once, rig, 1, 0);
    for (int again = 0; again < k % 4; ++again) {
      const std::vector<double> before = often.all(), units = often.plugin_state();
      often.forward();
      ASSERT_EQ(often.plugin_state(), units);
      often.set_all(before);  // mj_forward leaves its solver another first guess
    }
    run(often, rig, 1, 0);
    ASSERT_EQ(often.all(), once.all()) << "step " << k;
  }
}

TEST(State, ForwardElsewhereInBetweenChangesNothing) {
  // As finite differences and planners do: set, evaluate, set back.
  const Rig rig(snake());
  Data straight(rig), around(rig);
  run(straight, rig, 40, 0);
  run(around, rig, 20, 0);
  const std::vector<double> here = around.all();
  run(around, rig, 30, 1.3);
  around.set_all(here);
  around.d().qpos[8] += 1e-3;
  around.forward();
  around.set_all(here);
  run(around, rig, 20, 0);
  EXPECT_EQ(around.all(), straight.all());
}

TEST(State, ACopyGoesOnAsTheOtherAndTheyDontMix) {
  const Rig rig(snake());
  Data one(rig), lone(rig);
  run(one, rig, 50, 0);
  run(lone, rig, 50, 0);
  Data two(one);
  for (int k = 0; k < 50; ++k) {  // by turns, otherwise
    run(one, rig, 1, 0);
    run(two, rig, 1, 0.8);
  }
  run(lone, rig, 50, 0);
  EXPECT_EQ(one.all(), lone.all());
  EXPECT_NE(two.all(), one.all());
  Data three(one);
  run(one, rig, 20, 0.1);
  run(three, rig, 20, 0.1);
  EXPECT_EQ(three.all(), one.all());
}

TEST(State, ACopyIsSteppedWhileTheOtherIs) {
  const Rig rig(snake());
  Data one(rig), lone(rig);
  run(one, rig, 20, 0);
  run(lone, rig, 120, 0);
  Data two(one);
  std::thread other([&] { run(two, rig, 100, 0); });
  run(one, rig, 100, 0);
  other.join();
  EXPECT_EQ(one.all(), lone.all());
  EXPECT_EQ(two.all(), lone.all());
}

TEST(State, AnyOldOneGoesOnAsItDid) {
  const Rig rig(snake());
  Data data(rig), other(rig);
  std::vector<std::vector<double>> at{data.all()};
  for (int k = 0; k < 60; ++k) {
    run(data, rig, 1, 0);
    at.push_back(data.all());
  }
  for (std::size_t k = 0; k < 60; ++k) {
    const std::size_t back = (k * 37) % 60;
    for (Data* d : {&data, &other}) {
      d->set_all(at[back]);
      if (k % 3 == 0) d->forward();
      if (k % 3 == 0) d->set_all(at[back]);  // mj_forward leaves its solver another first guess
      run(*d, rig, 1, 0);
      ASSERT_EQ(d->all(), at[back + 1]) << back;
    }
  }
}

/// Another number of its kind, as far as one can tell.
double changed(double v) { return v == 0 ? 1 : v == 1 ? 0 : v == std::trunc(v) ? v + 1 : v * 1.001; }

TEST(State, ANumberThatSomebodyOverwritesCountsWhicheverItIs) {
  // Units that are at the state before it against others that have never seen it.
  const Rig rig(mjcf_of());
  Data used(rig);
  for (int k = 0; k < 30; ++k) {
    used.d().ctrl[0] = 0.02 * k;
    used.step();
  }
  const std::vector<double> here = used.all();
  const auto step = [](Data& d) {  // what it tells, or that it refuses
    std::vector<double> out;
    try {
      d.forward();
      out.assign(d.sensor(0).begin(), d.sensor(0).end());
      d.step();
    } catch (const InputError&) {
      return out;
    }
    const std::vector<double> all = d.all();
    out.insert(out.end(), all.begin(), all.end());
    return out;
  };
  used.set_all(here);
  const std::vector<double> plain = step(used);
  const std::size_t units = here.size() - used.plugin_state().size();
  const auto count = static_cast<std::size_t>(here[units]);
  std::size_t refused = 0, told = 0, moved = 0;
  for (std::size_t i = units; i < here.size(); ++i) {
    std::vector<double> there = here;
    there[i] = changed(here[i]);
    used.set_all(here);
    used.forward();  // its units are there, and have foreseen a step
    used.set_all(there);
    Data fresh(rig);
    fresh.set_all(there);
    std::vector<double> out = step(used);
    ASSERT_EQ(out, step(fresh)) << "number " << i - units;
    if (i >= units + count) {
      out[kReadings + i] = plain[kReadings + i];
      ASSERT_EQ(out, plain) << "room";
      continue;
    }
    refused += out.size() < here.size() ? 1 : 0;
    told += out.size() > here.size() && !std::equal(out.begin(), out.begin() + kReadings, plain.begin()) ? 1 : 0;
    moved += out.size() > here.size() && out != plain ? 1 : 0;
  }
  EXPECT_GT(refused, 5u);
  EXPECT_GT(told, 10u);
  EXPECT_GT(moved, count / 2) << "of " << count;
}

TEST(State, ACopyBetweenForwardAndStepGoesOn) {
  const Rig rig(snake());
  Data one(rig);
  run(one, rig, 10, 0);
  one.forward();
  Data two(one);
  run(one, rig, 10, 0);
  run(two, rig, 10, 0);
  EXPECT_EQ(two.all(), one.all());
}

TEST(State, AResetIsTheFirstSampleAgain) {
  const Rig rig(snake());
  Data fresh(rig), used(rig);
  fresh.key(0);
  run(used, rig, 60, 0.4);
  used.key(0);
  run(fresh, rig, 60, 0);
  run(used, rig, 60, 0);
  EXPECT_EQ(used.all(), fresh.all());
  used.reset();
  EXPECT_EQ(used.plugin_state(), Data(rig).plugin_state());
}

TEST(State, RolloutsOnThreadsAreThoseOfOneThread) {
  const Rig rig(snake());
  constexpr std::size_t kRollouts = 16, kThreads = 4;
  std::vector<std::vector<double>> serial(kRollouts), parallel(kRollouts);
  const auto rollout = [&](Data& data, std::size_t i) {
    data.key(0);
    run(data, rig, 100, 0.3 * static_cast<double>(i));
    return data.all();
  };
  Data alone(rig);
  for (std::size_t i = 0; i < kRollouts; ++i) serial[i] = rollout(alone, i);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      Data data(rig);  // made here, at the same time as the others
      for (std::size_t i = t; i < kRollouts; i += kThreads) parallel[i] = rollout(data, i);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kRollouts; ++i) EXPECT_EQ(parallel[i], serial[i]) << i;
}

TEST(State, ThatNoUnitsHaveIsRefusedAndTheyLive) {
  const Rig rig(mjcf_of());
  Data data(rig);
  for (int k = 0; k < 20; ++k) data.step();
  const std::vector<double> good = data.all();
  std::vector<double> bad = good;
  for (std::size_t i = bad.size() - data.plugin_state().size() + 3; i < bad.size(); ++i) bad[i] = std::nan("");
  data.set_all(bad);
  EXPECT_THROW(data.step(), InputError);
  data.set_all(good);
  data.step();
  Data same(rig);
  for (int k = 0; k < 21; ++k) same.step();
  EXPECT_EQ(data.all(), same.all());
}

}  // namespace
}  // namespace vsa::mujoco::test
