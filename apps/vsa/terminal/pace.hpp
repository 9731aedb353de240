// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Simulated time against the wall's.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <thread>

namespace vsa::app {

inline constexpr const char* kLowLatencyHelp = "Keep this machine's processors awake, for short round trips on serial ports (root)";

/// Wall time spent running, pauses left out.
class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;
  void run() {
    if (!running_) since_ = Clock::now();
    running_ = true;
  }
  void pause() {
    if (running_) sum_ += Clock::now() - since_;
    running_ = false;
  }
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(running_ ? sum_ + (Clock::now() - since_) : sum_).count();
  }

 private:
  Clock::duration sum_{};
  Clock::time_point since_{};
  bool running_ = false;
};

/// Holds simulated time to the wall's, or a multiple of it. Where it can't keep up it doesn't race to catch up later: at most
/// `kSlack` of lag is made good.
class RealTimePace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kSlack{100};

  /// Simulated time counts from here: at the start, after a pause, after a reset.
  void anchor(std::int64_t sim_ns) { anchor(sim_ns, Clock::now()); }
  void anchor(std::int64_t sim_ns, Clock::time_point wall) {
    sim_ns_ = sim_ns;
    wall_ = wall;
  }

  /// Simulated by wall time from the anchor on, above 0; anchor it anew with a change.
  void set_speed(double factor) { speed_ = factor; }

  /// When the state at `sim_ns` is due. False where that is more than kSlack ago: it is late, and the anchor moves.
  [[nodiscard]] bool keeps_up(std::int64_t sim_ns, Clock::time_point now, Clock::time_point& due) {
    const std::int64_t since_ns = sim_ns - sim_ns_;
    due = wall_ + std::chrono::nanoseconds(speed_ == 1 ? since_ns : std::llround(static_cast<double>(since_ns) / speed_));
    if (now - due <= kSlack) return true;
    anchor(sim_ns, now - kSlack);
    return false;
  }

  /// Waits until the state at `sim_ns` is due; false where it is late.
  bool hold(std::int64_t sim_ns) {
    Clock::time_point due;
    if (!keeps_up(sim_ns, Clock::now(), due)) return false;
    std::this_thread::sleep_until(due);
    return true;
  }

 private:
  std::int64_t sim_ns_ = 0;
  Clock::time_point wall_{};
  double speed_ = 1;
};

}  // namespace vsa::app
