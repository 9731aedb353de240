// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "wall_timer.hpp"

#include <utility>

namespace vsa::plugins {

WallTimer::WallTimer(std::chrono::milliseconds period, std::function<void()> call)
    : period_(period), call_(std::move(call)), thread_([this] { run(); }) {}

WallTimer::~WallTimer() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void WallTimer::run() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, period_, [this] { return ends_; })) {
    lock.unlock();
    call_();
    lock.lock();
  }
}

}  // namespace vsa::plugins
