// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a host that sets its own pace keeps up with the wall clock, by which clients on serial ports live.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace vsa::ports {

/// Tells once where simulated time falls behind the wall clock.
class PaceWatch {
 public:
  using Clock = std::chrono::steady_clock;  ///< of the wall
  /// A window of wall time that brings less than this much of it in simulated time was slow.
  static constexpr std::chrono::seconds kWindow{1};
  static constexpr double kSlow = 0.9;  ///< of a window that is still fast enough

  /// After a step, `sim_ns` in all. True once: after the first slow window.
  [[nodiscard]] bool fell_behind(Clock::time_point now, std::int64_t sim_ns) {
    if (told_) return false;
    if (!begin_) begin_ = {now, sim_ns};
    const auto wall = now - begin_->wall;
    if (wall < kWindow) return false;
    const double wall_ns = std::chrono::duration<double, std::nano>(wall).count();
    told_ = static_cast<double>(sim_ns - begin_->sim_ns) < kSlow * wall_ns;
    begin_ = {now, sim_ns};
    return told_;
  }
  /// The host stands, by its user's wish: the window under way doesn't count.
  void stood() { begin_.reset(); }

 private:
  struct Moment {
    Clock::time_point wall;
    std::int64_t sim_ns;
  };
  std::optional<Moment> begin_;
  bool told_ = false;
};

}  // namespace vsa::ports
