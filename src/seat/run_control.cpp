// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/seat/run_control.hpp"

namespace vsa::seat {

void RunControl::request(const ControlRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
  }
  arrived_.notify_all();
}

void RunControl::Mode::reset() noexcept {
  owed = 0;
  run_to_ns.reset();
}

void RunControl::Mode::apply(const ControlRequest& request) noexcept {
  paused = request.pause.value_or(paused);
  if (!paused || request.steps == 0) owed = 0;
  if (paused) owed += request.steps;
  run_to_ns = request.run_to_ns;
  if (run_to_ns) paused = false;
}

bool RunControl::paused() const {
  const std::lock_guard lock(mutex_);
  Mode mode = mode_;
  for (const ControlRequest& request : requests_) {
    if (request.reset) mode.reset();
    mode.apply(request);
  }
  return mode.paused && mode.owed == 0;
}

RunControl::Next RunControl::next(std::int64_t time_ns) {
  const std::lock_guard lock(mutex_);
  while (!requests_.empty()) {
    ControlRequest& request = requests_.front();
    if (request.reset) {
      // The rest of this request waits for the next call, when the time is that of the reset world.
      request.reset = false;
      mode_.reset();
      return Next::reset;
    }
    mode_.apply(request);
    requests_.pop_front();
  }
  if (mode_.run_to_ns && time_ns >= *mode_.run_to_ns) {
    mode_.run_to_ns.reset();
    mode_.paused = true;
  }
  if (!mode_.paused) return Next::step;
  if (mode_.owed == 0) return Next::wait;
  --mode_.owed;
  return Next::step;
}

void RunControl::wait(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, limit, [this] { return !requests_.empty() || woken_; });
  woken_ = false;
}

void RunControl::wake() {
  {
    const std::lock_guard lock(mutex_);
    woken_ = true;
  }
  arrived_.notify_all();
}

}  // namespace vsa::seat
