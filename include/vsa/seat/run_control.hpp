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

namespace vsa::seat {

/// One request, as gz-sim understands a WorldControl message: first the reset, then `pause` (false: run), then the steps.
struct ControlRequest {
  bool reset = false;                     ///< back to the first sample; steps still owed are dropped
  std::optional<bool> pause = false;      ///< the state afterwards: false lets the world run, also when only a reset is asked for;
                                          ///< none: as it is when the request's turn comes
  std::uint32_t steps = 0;                ///< while paused: so many steps are owed, added to those not yet done; else: no meaning
  std::optional<std::int64_t> run_to_ns;  ///< run until this simulated time, then pause; a time that has passed pauses at once
};

/// Between who asks (a topic, a page, a signal) and the one loop that steps: requests wait in order of arrival, and next()
/// carries them out.
class RunControl {
 public:
  /// What the loop is to do.
  enum class Next { step, reset, wait };

  explicit RunControl(bool paused = false) : mode_{paused, 0, std::nullopt} {}  ///< how it begins

  /// Any thread; in order of arrival.
  void request(const ControlRequest& request);
  /// Any thread: whether no step will follow without a further request. Those that wait for their turn count as done, so that a
  /// reset of a paused world shows no moment of running.
  [[nodiscard]] bool paused() const;

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
  bool woken_ = false;

  struct Mode {
    bool paused = false;
    std::uint64_t owed = 0;  ///< steps, while paused
    std::optional<std::int64_t> run_to_ns;
    void reset() noexcept;
    void apply(const ControlRequest& request) noexcept;  ///< but for its reset
  };
  Mode mode_;
};

}  // namespace vsa::seat
