// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "terminal/interrupt.hpp"
#include "vsa/experiment/bench.hpp"

namespace vsa::app {

/// Sets a watch's stop when a signal comes.
class SignalWatch {
 public:
  explicit SignalWatch(experiment::Watch& watch)
      : thread_([this, &watch] {
          while (!over_) {
            if (interrupted() != 0) watch.stop = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
          }
        }) {}
  ~SignalWatch() {
    over_ = true;
    thread_.join();
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace vsa::app
