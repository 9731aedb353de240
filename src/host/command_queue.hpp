// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::host {

/// What one channel of an actuator is to do from the next step on: knots, or else a constant, which needs no memory.
struct Order {
  std::size_t actuator;
  Robot::Channel channel;
  double value = 0;
  std::shared_ptr<const std::vector<Robot::Knot>> knots = nullptr;
};

struct FaultOrder {
  std::size_t actuator;
  device::Faults faults;
};

/// Orders from any thread, in order of arrival. The stepping thread takes no lock while nothing waits, and allocates nothing: it
/// swaps two vectors.
template <class T>
class Queue {
 public:
  /// Room for so many a step: until then nothing is allocated.
  void reserve(std::size_t orders) {
    waiting_.reserve(orders);
    taken_.reserve(orders);
  }

  /// Up to `most` orders that `fill` hands to its argument: no step falls between, and where memory runs out there is none of them.
  template <class F>
  void push_all(std::size_t most, F&& fill) {
    const std::lock_guard lock(mutex_);
    const std::size_t room = waiting_.size() + most;
    if (room > waiting_.capacity()) waiting_.reserve(std::max(room, 2 * waiting_.capacity()));
    fill([this](T order) noexcept { waiting_.push_back(std::move(order)); });
    any_.store(true, std::memory_order_release);
  }
  void push(T order) {
    push_all(1, [&](auto&& add) { add(std::move(order)); });
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

  /// Takes back what waits and answers to `which`.
  template <class F>
  void drop(F&& which) {
    const std::lock_guard lock(mutex_);
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), which), waiting_.end());
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

enum class NoticeKind { preset, limits, port, voltages, rate, unresolved, unsettled, energy };

struct RawNotice {
  std::size_t actuator;
  NoticeKind kind;
  double value;
};

/// At most one notice of a kind per actuator between resets, so room for them is made once.
class NoticeList {
 public:
  void reserve(std::size_t actuators) { list_.reserve(7 * actuators); }
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
