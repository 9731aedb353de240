// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joints that something holds or lets go by their torques (device/holder.hpp), against the answer in closed form: with the torques that
// the solver ends with the joints go where the units' springs give those torques.
#include "vsa/device/holder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/device/joint_solver.hpp"

namespace vsa::test {
namespace {

constexpr std::int64_t kStep_ns = 1'000'000;
constexpr double kStep_s = 1e-3;

/// A joint by itself, with dry friction, or with a stop that gives way a little.
struct Joint {
  double mobility, speed, friction_Nm = 0, stop_rad = 1e9, angle = 0;
  static constexpr double kSoft = 1e-3;  // a share of the mobility

  /// Of v' after a step: with these torques, and how it grows with them.
  [[nodiscard]] std::pair<double, double> answer(double torque) const {
    const double free = speed + kStep_s * mobility * torque, soft = kSoft / (1 + kSoft);
    // What stops it would have to give −free/(dt·B), but for what it gives way; no more than there is.
    const double most = kStep_s * mobility * friction_Nm;
    if (most > 0) {
      const double held = std::clamp(-free * (1 - soft), -most, most);
      return {free + held, std::abs(held) < most ? mobility * soft : mobility};
    }
    const double room = (stop_rad - angle) / kStep_s, beyond = free - room;
    return beyond > 0 ? std::pair{room + soft * beyond, mobility * soft} : std::pair{free, mobility};
  }
};

class Held final : public device::Holder {
 public:
  explicit Held(std::vector<Joint> joints) : joints_(std::move(joints)), held_(joints_.size(), -1.0) {}
  [[nodiscard]] bool holds(std::size_t /*tree*/) const noexcept override { return true; }
  bool holds_else(std::size_t tree, std::span<const double> torques, std::span<double> accelerations,
                  std::span<double> mobility) noexcept override {
    EXPECT_EQ(tree, 7U);
    ++asked;
    bool other = false;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const auto [speed, slope] = joints_[i].answer(torques[i]);
      other = other || slope != held_[i] || joints_[i].friction_Nm > 0;
      held_[i] = slope;
      accelerations[i] = (speed - joints_[i].speed) / kStep_s;
      for (std::size_t k = 0; k < joints_.size(); ++k) mobility[i * joints_.size() + k] = i == k ? slope : 0;
    }
    return other;
  }
  int asked = 0;

 private:
  std::vector<Joint> joints_;
  std::vector<double> held_;
};

/// Where springs and what holds put the joints in one step, as they are begun with what would hold them with no torque.
void expect_solved(const std::vector<Joint>& joints, double preset, double aside) {
  const std::size_t n = joints.size();
  device::Unit unit(maker_pro());
  std::vector<device::UnitState> states;
  std::vector<device::StepPlan> plans(n);
  std::vector<device::JointInStep> in_step;
  std::vector<double> mobility(n * n), torques(n);
  for (std::size_t i = 0; i < n; ++i) states.push_back(unit.initial(aside, preset, aside, 1));
  device::JointSolver solver(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto [speed, slope] = joints[i].answer(0);
    mobility[i * n + i] = slope;
    unit.begin_step(states[i], plans[i], 0, kStep_ns,
                    {joints[i].angle, joints[i].speed, joints[i].mobility, false, (speed - joints[i].speed) / kStep_s});
    plans[i].held[plans[i].held_count++] = states[i].held;
    in_step.push_back({&unit, &states[i], &plans[i]});
  }
  solver.set(mobility, kStep_ns);
  Held held(joints);
  EXPECT_TRUE(solver.solve(in_step, torques, &held, 7));
  EXPECT_LT(held.asked, 2 * device::solver::kMaxChanges);
  for (std::size_t i = 0; i < n; ++i) {
    const double speed = joints[i].answer(torques[i]).first, off = std::abs(states[i].reached.speed - speed);
    EXPECT_LT(off * kStep_s, 4e-6 + 2e-4 * std::abs(speed) * kStep_s)
        << "joint " << i << " of " << n << ": " << torques[i] << " N·m, " << states[i].reached.speed << " and " << speed
        << " rad/s";
  }
}

TEST(Holder, JointsGoWhereSpringsAndFrictionHaveThem) {
  std::mt19937 rng(5);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng); };
  for (int k = 0; k < 2000; ++k) {
    std::vector<Joint> joints(1 + static_cast<std::size_t>(k % 3));
    const double preset = draw(0, 0.75), aside = draw(-0.2, 0.2);
    for (Joint& j : joints)
      j = {.mobility = std::pow(10, draw(2, 6)), .speed = draw(-5, 5), .friction_Nm = std::pow(10, draw(-3, 1))};
    expect_solved(joints, preset, aside);
    if (HasFailure()) FAIL() << "robot " << k;
  }
}

TEST(Holder, AndStops) {
  std::mt19937 rng(6);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng); };
  for (int k = 0; k < 2000; ++k) {
    std::vector<Joint> joints(1 + static_cast<std::size_t>(k % 3));
    const double preset = draw(0, 0.75), aside = draw(-0.2, 0.2);
    for (Joint& j : joints) j = {.mobility = std::pow(10, draw(2, 6)), .speed = draw(-5, 5), .stop_rad = draw(-1e-3, 5e-3)};
    expect_solved(joints, preset, aside);
    if (HasFailure()) FAIL() << "robot " << k;
  }
}

/// Says that others hold, and how they do with numbers that aren't.
class Nonsense final : public device::Holder {
 public:
  explicit Nonsense(double what) noexcept : what_(what) {}
  [[nodiscard]] bool holds(std::size_t /*tree*/) const noexcept override { return true; }
  bool holds_else(std::size_t /*tree*/, std::span<const double> /*torques*/, std::span<double> accelerations,
                  std::span<double> mobility) noexcept override {
    std::fill(accelerations.begin(), accelerations.end(), what_);
    std::fill(mobility.begin(), mobility.end(), -what_);
    return true;
  }

 private:
  double what_;
};

TEST(Holder, OfNonsenseChangesNothing) {
  const auto solved = [](device::Holder* holder) {
    device::Unit unit(maker_pro());
    device::UnitState state = unit.initial(0.1, 0.3, 0.1, 1);
    device::StepPlan plan;
    unit.begin_step(state, plan, 0, kStep_ns, {0, 1, 1e4, false, 0});
    plan.held[plan.held_count++] = state.held;
    const device::JointInStep joint{&unit, &state, &plan};
    const double mobility = 1e4;
    double torque = 0;
    device::JointSolver solver(1);
    solver.set({&mobility, 1}, kStep_ns);
    EXPECT_TRUE(solver.solve({&joint, 1}, {&torque, 1}, holder));
    return torque;
  };
  const double alone = solved(nullptr);
  for (const double what : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Nonsense nonsense(what);
    EXPECT_NEAR(solved(&nonsense), alone, 1e-3 * std::abs(alone)) << what;
  }
}

}  // namespace
}  // namespace vsa::test
