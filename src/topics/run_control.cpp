// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/run_control.hpp"

namespace vsa::topics {

void RunControl::request(const ControlRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
  }
  arrived_.notify_all();
}

bool RunControl::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_ && owed_ == 0 && requests_.empty();
}

RunControl::Next RunControl::next(std::int64_t time_ns) {
  const std::lock_guard lock(mutex_);
  while (!requests_.empty()) {
    ControlRequest& request = requests_.front();
    if (request.reset) {
      // The rest of this request waits for the next call, when the time is that of the reset world.
      request.reset = false;
      owed_ = 0;
      run_to_ns_.reset();
      return Next::reset;
    }
    paused_ = request.pause;
    if (!paused_ || request.steps == 0) owed_ = 0;
    if (paused_) owed_ += request.steps;
    run_to_ns_ = request.run_to_ns;
    if (run_to_ns_) paused_ = false;
    requests_.pop_front();
  }
  if (run_to_ns_ && time_ns >= *run_to_ns_) {
    run_to_ns_.reset();
    paused_ = true;
  }
  if (!paused_) return Next::step;
  if (owed_ == 0) return Next::wait;
  --owed_;
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

}  // namespace vsa::topics
