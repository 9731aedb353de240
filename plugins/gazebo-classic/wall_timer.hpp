// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Calls a function again and again in wall time, from a thread of its own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace vsa::plugins {

class WallTimer {
 public:
  /// First after one `period`.
  WallTimer(std::chrono::milliseconds period, std::function<void()> call);
  ~WallTimer();  ///< waits for a call that is under way
  WallTimer(const WallTimer&) = delete;
  WallTimer& operator=(const WallTimer&) = delete;

 private:
  void run();

  std::chrono::milliseconds period_;
  std::function<void()> call_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace vsa::plugins
