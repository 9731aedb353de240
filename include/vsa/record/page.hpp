// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The data of the replay page (page/page.hpp), as JSON with base64 arrays of little-endian 32-bit floats; times are 64-bit.
#pragma once

#include <string>
#include <vector>

#include "vsa/record/run_data.hpp"

namespace vsa::record {

/// What stands around the numbers.
struct PageText {
  std::string title;               ///< of the page
  std::vector<Statistic> summary;  ///< lines below the title
  std::vector<std::string> notes;  ///< what a reader must know, e.g. why the run ended early
};

/// One moment as the page holds it, one array after the other: poses of the links that move (x y z qw qx qy qz each), readings (the
/// page's channels, an actuator after the other), energy columns.
struct Frame {
  /// For each link seven, for each actuator its channels, for each column one.
  std::vector<float> poses,  ///< seven for each link that moves
      readings,              ///< a page's channels, an actuator after the other
      energy;                ///< the energy columns
  void clear();              ///< keeps the memory
  /// A moment more; `moving` are the links whose poses it takes.
  void append(const Sample& sample, const std::vector<std::size_t>& moving);
};
/// Links that aren't static, in order.
[[nodiscard]] std::vector<std::size_t> moving_links(const RunInfo& info);

/// Collects frames at the page's rate. When `frames_max` is reached every other frame is dropped and the rate is halved from then
/// on, so that a long run gives a page of bounded size.
class PageData {
 public:
  PageData(const RunInfo& info, double rate_Hz, std::size_t frames_max);  ///< rate in (0, 1e6] Hz; at least 2 frames

  [[nodiscard]] bool due(std::int64_t time_ns) const noexcept { return cadence_.due(time_ns); }  ///< at the page's present rate
  void add(const Sample& sample);                                             ///< halves the rate where there are frames_max
  void restart();                                                             ///< without frames, at the first rate
  [[nodiscard]] std::size_t frames() const noexcept { return time_.size(); }  ///< so far

  /// All of it, for the page.
  [[nodiscard]] std::string json(const RunInfo& info, const PageText& text) const;

 private:
  void halve();

  std::vector<std::size_t> moving_;  // links whose poses are frames
  std::vector<scene::Pose> first_;   // poses of the first sample, for the links that don't move
  std::size_t actuators_ = 0;
  double rate_Hz_;
  std::size_t frames_max_;
  Cadence cadence_;
  std::vector<double> time_;
  Frame data_;  // frame after frame
};

}  // namespace vsa::record
