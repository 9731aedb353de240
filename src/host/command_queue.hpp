// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::host {

/// What one channel of an actuator is to do from the next step on.
struct Order {
  std::size_t actuator;
  Robot::Channel channel;
  std::shared_ptr<const std::vector<Robot::Knot>> knots;
};

inline Order make_order(std::size_t actuator, Robot::Channel channel, std::vector<Robot::Knot> knots) {
  return {actuator, channel, std::make_shared<const std::vector<Robot::Knot>>(std::move(knots))};
}

struct FaultOrder {
  std::size_t actuator;
  device::Faults faults;
};

/// Orders from any thread, in order of arrival. The stepping thread takes no lock while nothing waits, and allocates nothing: it
/// swaps two vectors.
template <class T>
class Queue {
 public:
  /// All of them, so that no step falls between.
  void push(std::vector<T> orders) {
    const std::lock_guard lock(mutex_);
    for (T& order : orders) waiting_.push_back(std::move(order));
    any_.store(true, std::memory_order_release);
  }

  template <class F>
  void drain(F&& take) noexcept {
    if (!any_.load(std::memory_order_acquire)) return;
    {
      const std::lock_guard lock(mutex_);
      std::swap(waiting_, taken_);
      any_.store(false, std::memory_order_relaxed);
    }
    for (T& order : taken_) take(order);
    taken_.clear();
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    any_.store(false, std::memory_order_relaxed);
  }

 private:
  std::mutex mutex_;
  std::vector<T> waiting_, taken_;
  std::atomic<bool> any_{false};
};

using CommandQueue = Queue<Order>;
using FaultQueue = Queue<FaultOrder>;

enum class NoticeKind { preset, limits, port, unresolved, unsettled, energy };

struct RawNotice {
  std::size_t actuator;
  NoticeKind kind;
  double value;
};

/// At most one notice of a kind per actuator between resets, so room for them is made once.
class NoticeList {
 public:
  void reserve(std::size_t actuators) { list_.reserve(6 * actuators); }
  void push_back(const RawNotice& notice) noexcept {
    const std::lock_guard lock(mutex_);
    if (list_.size() < list_.capacity()) list_.push_back(notice);
  }
  [[nodiscard]] std::vector<RawNotice> take() {
    const std::lock_guard lock(mutex_);
    std::vector<RawNotice> out(list_);
    list_.clear();
    return out;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    list_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<RawNotice> list_;
};

}  // namespace vsa::host
