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

struct Command {
  std::size_t actuator;
  Robot::Channel channel;
  std::shared_ptr<const std::vector<Robot::Knot>> knots;
};

/// Commands from any thread, in order of arrival. The stepping thread takes no lock while nothing waits, and allocates nothing: it
/// swaps two vectors.
class CommandQueue {
 public:
  struct Item {
    std::size_t actuator;
    Robot::Channel channel;
    std::vector<Robot::Knot> knots;
  };

  void push(Item item) {
    Command c{item.actuator, item.channel, std::make_shared<const std::vector<Robot::Knot>>(std::move(item.knots))};
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(c));
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
    for (Command& c : taken_) take(c);
    taken_.clear();
  }

  void clear() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    any_.store(false, std::memory_order_relaxed);
  }

 private:
  std::mutex mutex_;
  std::vector<Command> waiting_, taken_;
  std::atomic<bool> any_{false};
};

enum class NoticeKind { preset, limits };

struct RangeNotice {
  std::size_t actuator;
  NoticeKind kind;
  double value;
};

/// At most two notices an actuator between resets, so room for them is made once.
class NoticeList {
 public:
  void reserve(std::size_t actuators) { list_.reserve(2 * actuators); }
  void push_back(const RangeNotice& notice) noexcept {
    const std::lock_guard lock(mutex_);
    if (list_.size() < list_.capacity()) list_.push_back(notice);
  }
  [[nodiscard]] std::vector<RangeNotice> take() {
    const std::lock_guard lock(mutex_);
    std::vector<RangeNotice> out(list_);
    list_.clear();
    return out;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    list_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<RangeNotice> list_;
};

}  // namespace vsa::host
