// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the transport's tests share: a partition of their own, and waiting for something to become true by doing something useful.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace vsa::test {

inline constexpr std::chrono::seconds kPatience{60};  // for what takes well under a second on an idle machine

/// Calls `work` until it returns true; false after the deadline. The work itself is what takes the time: no sleeping.
template <class Work>
bool until(Work&& work, std::chrono::steady_clock::duration patience = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!work()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
  }
  return true;
}

/// Messages from another thread. A handle: its copies are the same box, and a handler of the transport must own one, since the
/// transport calls it for a moment after its node, let alone a variable of the test, has gone.
template <class T>
class Mailbox {
 public:
  void put(T message) const {
    {
      const std::lock_guard lock(box_->mutex);
      box_->messages.push_back(std::move(message));
    }
    box_->arrived.notify_all();
  }
  /// True once a message satisfies `wanted`, within `limit`.
  template <class Wanted>
  [[nodiscard]] bool wait(Wanted wanted, std::chrono::milliseconds limit) const {
    std::unique_lock lock(box_->mutex);
    return box_->arrived.wait_for(lock, limit, [&] { return std::any_of(box_->messages.begin(), box_->messages.end(), wanted); });
  }
  [[nodiscard]] std::vector<T> all() const {
    const std::lock_guard lock(box_->mutex);
    return box_->messages;
  }
  /// A handler for Node::Subscribe that puts what `read` makes of each message.
  template <class Message, class Read>
  [[nodiscard]] std::function<void(const Message&)> handler(Read read) const {
    return [box = *this, read](const Message& message) { box.put(read(message)); };
  }

 private:
  struct Box {
    std::mutex mutex;
    std::condition_variable arrived;
    std::vector<T> messages;
  };
  std::shared_ptr<Box> box_ = std::make_shared<Box>();
};

/// A child process and what it printed on standard output. Killed after kPatience, which gives exit code 124.
struct Output {
  int exit_code = -1;
  std::string text;
};
Output run_command(const std::string& command);

/// Debian's own clients; the `ign` script of the package looks for them in the wrong place.
inline constexpr const char* kTopicTool = "/usr/libexec/ignition/transport11/ign-transport-topic";
inline constexpr const char* kServiceTool = "/usr/libexec/ignition/transport11/ign-transport-service";

}  // namespace vsa::test
