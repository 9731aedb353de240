// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Messages on their way from the thread that steps a simulation to the one that sends them: packing and sending a robot's state,
// and above all waking the transport's thread, cost the step more than the robot does.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace vsa::topics {

/// Calls `work` in a thread of its own until it is destroyed, and then once more.
class Sender {
 public:
  /// `work` gives the time until it wants to be called again.
  explicit Sender(std::function<std::chrono::milliseconds()> work) : work_(std::move(work)), thread_([this] { run(); }) {}
  ~Sender() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  /// Before its time. Where it is at work already, nothing.
  void hurry() noexcept { wake_.notify_one(); }

 private:
  void run() {
    std::unique_lock lock(mutex_);
    while (!ends_) {
      lock.unlock();
      const auto pause = work_();
      lock.lock();
      if (!ends_) wake_.wait_for(lock, pause);
    }
    work_();
  }

  std::function<std::chrono::milliseconds()> work_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  std::thread thread_;  ///< last: it uses the others
};

/// For one thread that puts and one that takes. A full box makes the first one wait: nothing is lost, and nothing out of order.
template <class Message, std::size_t kSlots>
class Outbox {
 public:
  /// `fill` gets a slot that may hold an old message. `hurry` is called when the box gets half full.
  template <class Fill, class Hurry>
  void put(const Fill& fill, const Hurry& hurry) {
    const std::size_t at = put_.load(std::memory_order_relaxed);
    while (at - taken_.load(std::memory_order_acquire) == kSlots) {
      if (closed_.load(std::memory_order_relaxed)) return;
      hurry();
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
    fill(slots_[at % kSlots]);
    put_.store(at + 1, std::memory_order_release);
    if (at + 1 - taken_.load(std::memory_order_relaxed) == kSlots / 2) hurry();
  }

  template <class Take>
  void drain(const Take& take) {
    const std::size_t end = put_.load(std::memory_order_acquire);
    for (std::size_t at = taken_.load(std::memory_order_relaxed); at != end; ++at) {
      take(slots_[at % kSlots]);
      taken_.store(at + 1, std::memory_order_release);
    }
  }

  /// Nobody takes any more: what is put into a full box is dropped.
  void close() noexcept { closed_ = true; }

 private:
  std::array<Message, kSlots> slots_{};
  std::atomic<std::size_t> put_{0}, taken_{0};
  std::atomic<bool> closed_{false};
};

}  // namespace vsa::topics
