// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A motion is data: keyframes of equilibrium and preset for named actuators. It is a kind of gait: Gait::load reads it where a file
// has [[keyframe]], and Gait::apply plays it.
//
//   title = "…"
//   period_s = 0.01                   # a command each, as in any gait
//   interpolation = "smooth"          # or "linear"; smooth rests at every keyframe
//   loop_from_s = 2.0                 # optional: after the last keyframe go on from this time, again and again
//   [[keyframe]]                      # times grow
//   time_s = 0.0
//   equilibrium_deg = { right_shoulder = 0.0, right_elbow = 90.0 }
//   preset_deg = { right_shoulder = 25.0 }
//
// Each actuator's equilibrium and preset are two channels of their own. A channel goes from one of its keyframes to its next,
// whatever others lie between; before its first it isn't commanded, after its last it holds that value.
//
//   linear   v = a + (b − a) s            s = (t − t_a)/(t_b − t_a)
//   smooth   v = a + (b − a)(10 s³ − 15 s⁴ + 6 s⁵)      minimum jerk: speed and acceleration are 0 at both ends
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vsa::motion {

/// One keyframe of a channel.
struct MotionKey {
  double time_s = 0,  ///< in the motion's own time
      value_rad = 0;  ///< equilibrium or preset
};

/// An actuator's keyframes.
struct MotionTrack {
  std::string actuator;                ///< as the file names it
  std::vector<MotionKey> equilibrium,  ///< times grow; may be empty
      preset;                          ///< times grow; may be empty
};

/// A motion: keyframes of equilibrium and preset for named actuators.
struct MotionParams {
  bool smooth = true;                 ///< false: linear
  double end_s = 0;                   ///< the last keyframe's time
  std::optional<double> loop_from_s;  ///< none: the last values are held
  std::vector<MotionTrack> tracks;    ///< one an actuator, in the file's order
};

/// The motion's own time: simulated time, folded where it loops.
[[nodiscard]] double motion_time(const MotionParams& motion, double t_s);

/// A channel at the motion's own time; none before its first keyframe.
[[nodiscard]] std::optional<double> motion_value(const std::vector<MotionKey>& channel, bool smooth, double t_s);

}  // namespace vsa::motion
