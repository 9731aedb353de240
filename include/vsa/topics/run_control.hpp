// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Pause, step and reset: asked from any thread, done by the loop that owns the world, between two steps.
//
//   while (…) {
//     const auto next = control.next(world.time_ns());
//     if (next == RunControl::Next::reset) world.reset();
//     else if (next == RunControl::Next::step) world.step();
//     else control.wait(100ms);
//   }
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

namespace vsa::topics {

/// One request, as gz-sim understands a WorldControl message: first the reset, then `pause` (false: run), then the steps.
struct ControlRequest {
  bool reset = false;                     ///< back to the first sample; steps still owed are dropped
  bool pause = false;                     ///< the state afterwards: false lets the world run, also when only a reset is asked for
  std::uint32_t steps = 0;                ///< with pause: so many steps are owed, added to those not yet done; without: no meaning
  std::optional<std::int64_t> run_to_ns;  ///< run until this simulated time, then pause; a time that has passed pauses at once
};

class RunControl {
 public:
  enum class Next { step, reset, wait };

  explicit RunControl(bool paused = false) : paused_(paused) {}

  /// Any thread; in order of arrival.
  void request(const ControlRequest& request);
  [[nodiscard]] bool paused() const;  ///< any thread: no step will follow without a further request

  /// The loop's thread: what to do now at this simulated time. `step` counts as done.
  [[nodiscard]] Next next(std::int64_t time_ns);
  /// The loop's thread: until something is requested or somebody wakes it, at most `limit`.
  void wait(std::chrono::milliseconds limit);
  /// Any thread: ends the present wait, or the next.
  void wake();

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<ControlRequest> requests_;
  std::optional<std::int64_t> run_to_ns_;
  std::uint64_t owed_ = 0;
  bool woken_ = false;
  bool paused_;
};

}  // namespace vsa::topics
