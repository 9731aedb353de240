// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/motion.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::motion {

double motion_time(const MotionParams& motion, double t_s) {
  if (!motion.loop_from_s || t_s < motion.end_s) return t_s;
  return *motion.loop_from_s + std::fmod(t_s - motion.end_s, motion.end_s - *motion.loop_from_s);
}

std::optional<double> motion_value(const std::vector<MotionKey>& channel, bool smooth, double t_s) {
  const auto next =
      std::upper_bound(channel.begin(), channel.end(), t_s, [](double t, const MotionKey& k) { return t < k.time_s; });
  if (next == channel.begin()) return std::nullopt;
  const MotionKey& from = *std::prev(next);
  if (next == channel.end()) return from.value_rad;
  const double s = (t_s - from.time_s) / (next->time_s - from.time_s);
  const double share = smooth ? s * s * s * (10 - s * (15 - 6 * s)) : s;
  return from.value_rad + (next->value_rad - from.value_rad) * share;
}

}  // namespace vsa::motion
