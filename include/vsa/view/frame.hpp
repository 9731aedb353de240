// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One moment for the live page (web/src/live/frame.js reads it). A binary message, little-endian:
//
//   u32  frames that this viewer missed so far     written by the server
//   f64  simulated time, s
//   f32  simulated by wall time, lately
//   u32  flags: 1 paused, 2 recording, 4 the gait plays
//   u32  contacts, u32 pulls
//   f32  poses, readings, energy, as the replay page's arrays hold one frame (record/page.hpp)
//   f32  each contact: place x y z (m), force x y z (N)
//   f32  each pull: link, point x y z in the link's frame, target x y z in the world
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vsa/host/simulation.hpp"
#include "vsa/record/page.hpp"

namespace vsa::view {

/// What a frame says beside the world.
struct FrameInfo {
  double time_s = 0;      ///< simulated
  double factor = 0;      ///< simulated by wall time, lately
  bool paused = false,    ///< flag 1
      recording = false,  ///< flag 2
      gait = false;       ///< flag 4: it plays
};

inline constexpr std::size_t kContactsMax = 256;  ///< the strongest are shown where there are more

/// Makes frames of a world; keeps its buffers.
class FrameMaker {
 public:
  /// Of that world; the same for all frames.
  explicit FrameMaker(const record::RunInfo& info) : moving_(record::moving_links(info)) {}
  /// At the world's present time, without the four bytes of the server.
  [[nodiscard]] std::shared_ptr<const std::string> make(const host::Simulation& world, const FrameInfo& info);

 private:
  std::vector<std::size_t> moving_;
  record::Sample sample_;
  record::Frame frame_;
  std::vector<scene::Contact> contacts_;
  std::vector<float> touches_;
};

}  // namespace vsa::view
