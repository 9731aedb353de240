// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// When a host works out B = (M⁻¹)_aa anew: as soon as a joint of its trees has turned by 0.02 rad since (one that nothing
// drives 0.01), which changes B by a few hundredths where an arm folds, and every 16th step at the latest, for what else moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "vsa/host/robot.hpp"
#include "vsa/owner.hpp"

namespace vsa::host {

/// Tells a host when B = (M⁻¹)_aa is due: a joint has turned, or 16 steps have passed. It is part of a host's state: a
/// restored run works B out at the same steps.
class MobilityWatch {
 public:
  MobilityWatch() = default;
  explicit MobilityWatch(std::size_t joints) : angles_(joints) {}  ///< how many driven joints

  /// Once before each step. True: B is due, and is taken to be that of these angles. Another number of joints: one line on stderr,
  /// and abort.
  [[nodiscard]] bool due(std::span<const JointIn> joints) noexcept {
    require(joints.size() == angles_.size(), "vsa::host::MobilityWatch::due", "joints has one entry a driven joint");
    bool now = steps_left_-- <= 0 || beside_rad_ > kBeside_rad;
    for (std::size_t i = 0; i < angles_.size() && !now; ++i) now = std::abs(joints[i].angle_rad - angles_[i]) > kTurned_rad;
    if (!now) return false;
    steps_left_ = kSteps - 1;
    beside_rad_ = 0;
    std::transform(joints.begin(), joints.end(), angles_.begin(), [](const JointIn& joint) { return joint.angle_rad; });
    return true;
  }
  /// Joints beside the driven ones: by how much one of them has turned since it was told last, rad at most (NaN or
  /// below 0: nothing); a slide by ten times its metres. A foldable weight behind a driven joint changes B as much as that joint's own folding.
  void turned(double rad) noexcept { beside_rad_ += std::max(0.0, rad); }
  /// In the next step whatever happens.
  void again() noexcept { steps_left_ = 0; }
  static auto fields(auto& s, auto&& visit) {
    return visit("steps_left", "", s.steps_left_, "beside", "rad", s.beside_rad_, "angles", "rad", s.angles_);
  }
  [[nodiscard]] const char* impossible() const noexcept {
    return steps_left_ >= 0 && steps_left_ < kSteps && beside_rad_ >= 0 ? nullptr : "steps_left of 0 … 15, beside of 0 or more";
  }

 private:
  static constexpr int kSteps = 16;
  static constexpr double kTurned_rad = 0.02, kBeside_rad = 0.01;
  int steps_left_ = 0;
  double beside_rad_ = 0;
  std::vector<double> angles_;
};

}  // namespace vsa::host
