// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a page may ask for. One JSON object a message, UTF-8; angles in rad, the preset in its law's unit:
//
//   {"do":"play"}  {"do":"pause"}  {"do":"step","steps":1…1000}  {"do":"reset"}
//   {"do":"speed","factor":0.01…100}            simulated by wall time; null: as fast as it can
//   {"do":"command","actuators":[0,3],"equilibrium_rad":0.5,"preset":0.3}      one of the two, or both
//   {"do":"pull","link":4,"point_m":[x,y,z],"target_m":[x,y,z]}                point in the link's frame, target in the world
//   {"do":"release"}
//   {"do":"record","on":true}
//   {"do":"gait","frequency_rad_per_s":4.7,"groups":[{"name":"vertical","amplitude_rad":1,"offset_rad":0,"lambda":5,
//                 "delta_rad":0,"preset_rad":0.6}, …]}                          all groups; bounds: motion::kGaitBounds
//   {"do":"gait_play","on":false}               false: the last commands hold
//   {"do":"give_back"}                          commands given by hand go back to the gait
//   {"do":"next"}                               a frame has been drawn: one more may come
//
// A message with an unknown or missing key, a value of another type, a number out of range or more than this is refused whole, with
// a sentence that says why.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vsa/host/simulation.hpp"
#include "vsa/motion/gait.hpp"

namespace vsa::view {

/// The ends of what a value may be.
struct Span {
  double min = 0,  ///< end included
      max = 0;     ///< end included
};

/// What there is to ask for.
struct Rules {
  /// What a page may command of an actuator.
  struct Actuator {
    Span equilibrium_rad,  ///< that the controller lets it have
        preset;            ///< in its law's unit
  };
  std::vector<Actuator> actuators;       ///< in the world's order
  std::vector<bool> moves;               ///< one a link
  std::vector<std::string> gait_groups;  ///< in the gait's order
  bool gait = false;                     ///< whether there is a gait to play and change
  bool control = false;                  ///< play, pause, step, reset, speed
  bool hands = false;                    ///< pull
  bool contacts = false;                 ///< nothing to ask for: whether frames have any
};

/// What the world, its gait and its loop allow.
[[nodiscard]] Rules rules_of(const host::Simulation& world, const motion::Gait* gait, bool control);

/// The world runs.
struct Play {};
/// It stands.
struct Pause {};
/// One step, or some.
struct Step {
  std::uint32_t steps = 1;  ///< 1 … 1000
};
/// Back to the first sample.
struct Reset {};
/// How fast simulated time is to go.
struct Speed {
  std::optional<double> factor;  ///< simulated by wall time; none: as fast as it can
};
/// Equilibrium, preset or both by hand, for some actuators.
struct Command {
  std::vector<std::size_t> actuators;     ///< of the world
  std::optional<double> equilibrium_rad,  ///< none: it keeps what it has
      preset;                             ///< in the law's unit; none: it keeps what it has
};
/// A hand that pulls at a link, from now on.
struct PullLink {
  std::size_t link = 0;             ///< of the world
  std::array<double, 3> point_m{},  ///< in the link's frame
      target_m{};                   ///< in the world
};
/// The hand lets go.
struct Release {};
/// Recording on or off.
struct Record {
  bool on = false;  ///< whether one begins
};
/// Another gait, blended in.
struct ChangeGait {
  motion::GaitChange to;  ///< all groups
};
/// The gait plays, or is held.
struct PlayGait {
  bool on = false;  ///< false: the last commands stay
};
/// Commands given by hand go back to the gait.
struct GiveBack {};
/// A frame has been drawn: one more may come.
struct Next {};

/// Any request.
using Request =
    std::variant<Play, Pause, Step, Reset, Speed, Command, PullLink, Release, Record, ChangeGait, PlayGait, GiveBack, Next>;

/// A message, read.
struct Parsed {
  std::optional<Request> request;  ///< none: it was refused
  std::string error;               ///< where there is no request
};

/// Any bytes; never throws for them.
[[nodiscard]] Parsed parse_request(std::string_view text, const Rules& rules);

}  // namespace vsa::view
