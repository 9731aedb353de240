// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the transport's tests share: a partition of their own, and waiting for something to become true by doing something useful.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace vsa::test {

inline constexpr std::chrono::seconds kPatience{20};  // for what takes well under a second on an idle machine

/// Calls `work` until it returns true; false after the deadline. The work itself is what takes the time: no sleeping.
template <class Work>
bool until(Work&& work, std::chrono::steady_clock::duration patience = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!work()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
  }
  return true;
}

/// Messages from another thread.
template <class T>
class Mailbox {
 public:
  void put(T message) {
    {
      const std::lock_guard lock(mutex_);
      messages_.push_back(std::move(message));
    }
    arrived_.notify_all();
  }
  /// True once a message satisfies `wanted`, within `limit`.
  template <class Wanted>
  bool wait(Wanted wanted, std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, limit, [&] {
      for (const T& message : messages_) {
        if (wanted(message)) return true;
      }
      return false;
    });
  }
  [[nodiscard]] std::vector<T> all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    messages_.clear();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<T> messages_;
};

/// A child process and what it printed on standard output. Killed after `limit` seconds, which gives exit code 124.
struct Output {
  int exit_code = -1;
  std::string text;
};
Output run_command(const std::string& command);

/// Debian's own clients; the `ign` script of the package looks for them in the wrong place.
inline constexpr const char* kTopicTool = "/usr/libexec/ignition/transport11/ign-transport-topic";
inline constexpr const char* kServiceTool = "/usr/libexec/ignition/transport11/ign-transport-service";

}  // namespace vsa::test
