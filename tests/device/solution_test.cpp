// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// When a unit's torque counts as found (include/vsa/device/joint_solver.hpp).
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "support/one_joint.hpp"

namespace {

using vsa::device::UnitConfig;
using vsa::test::maker_pro;
namespace device = vsa::device;
namespace elastic = vsa::elastic;

/// A law in all that is calculated, but one that doesn't say which springs it has.
class Unnamed final : public elastic::Transmission {
 public:
  explicit Unnamed(std::shared_ptr<const elastic::Transmission> law) : law_(std::move(law)) {}
  [[nodiscard]] elastic::Response evaluate(const elastic::Positions& p) const noexcept override { return law_->evaluate(p); }
  [[nodiscard]] elastic::SegmentMean mean_over(const elastic::Positions& a, const elastic::Positions& b) const noexcept override {
    return law_->mean_over(a, b);
  }
  [[nodiscard]] std::array<double, 2> references(const elastic::EquilibriumPreset& c) const noexcept override {
    return law_->references(c);
  }
  [[nodiscard]] elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return law_->attained(x);
  }

 private:
  std::shared_ptr<const elastic::Transmission> law_;
};

void is_found_with_its_motors(const UnitConfig& config) {
  device::Unit unit(config);
  device::UnitState state = unit.initial(0.0, 0.75, 0.0);
  device::StepPlan plan;
  unit.begin_step(state, plan, 0, 1'000'000, {0.0, 0.0, 1e3});
  plan.held[plan.held_count++] = {{12.0, -12.0}};
  unit.begin_trials(state, plan);
  const double dy = 0.25;
  (void)unit.attempt(state, plan, dy, true);
  EXPECT_FALSE(unit.carried(state, plan, 0.0).settled) << "one round for motors that two springs pull elsewhere";
  const device::ShaftTorque found = unit.attempt(state, plan, dy, false);
  const device::ShaftTorque there = unit.carried(state, plan, 0.0);
  EXPECT_TRUE(there.settled);
  EXPECT_EQ(there.torque, found.torque);
  EXPECT_FALSE(unit.carried(state, plan, 1e-3).settled) << "a milliradian further the exponential has left its tangent";
}

TEST(Solution, IsntFoundBeforeTheMotorsAre) { is_found_with_its_motors(maker_pro()); }

TEST(Solution, OfALawThatDoesntNameItsSpringsIsNoEasier) {
  UnitConfig config = maker_pro();
  config.actuator.transmission = std::make_shared<Unnamed>(config.actuator.transmission);
  is_found_with_its_motors(config);
}

}  // namespace
