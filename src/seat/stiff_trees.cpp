// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/seat/stiff_trees.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "vsa/device/unit.hpp"
#include "vsa/errors.hpp"

namespace vsa::seat {

bool may_be_stiff(const host::Robot& robot, std::size_t actuator, double inverse_inertia) {
  if (actuator >= robot.size())
    throw InputError(
        Problem{"", "actuator", std::to_string(actuator), "no such actuator", "below " + std::to_string(robot.size())});
  const device::UnitConfig& unit = robot.config().actuators[actuator].unit;
  const elastic::Transmission& law = *unit.actuator.transmission;
  const double preset = unit.is(control::ServoKind::torque_servo) ? 0 : unit.preset_max;  // of that one it is none of the law's
  const double stiffness = law.evaluate({0, law.references({0, preset})}).curvature.qq;
  return kUsualStep_s * kUsualStep_s * inverse_inertia * stiffness > device::kHardlyResolved;
}

void join_stiff_trees(std::vector<std::vector<std::size_t>>& trees, std::span<const char> stiff,
                      std::span<const std::size_t> neighbours) {
  const auto is_stiff = [&](const std::vector<std::size_t>& tree) {
    return std::any_of(tree.begin(), tree.end(), [&](std::size_t k) { return stiff[k] != 0; });
  };
  std::map<std::size_t, std::vector<std::size_t>> joined;  // by label
  for (const auto& tree : trees) {
    if (!is_stiff(tree)) continue;
    std::vector<std::size_t>& all = joined[neighbours[tree.front()]];
    all.insert(all.end(), tree.begin(), tree.end());
  }
  std::erase_if(joined, [](const auto& group) { return group.second.size() > kMostJoined; });
  std::erase_if(trees, [&](const auto& tree) { return is_stiff(tree) && joined.contains(neighbours[tree.front()]); });
  for (auto& [label, all] : joined) trees.push_back(std::move(all));
}

}  // namespace vsa::seat
