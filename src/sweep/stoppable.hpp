// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>

#include "vsa/experiment/bench.hpp"

namespace vsa::sweep {

/// What `work` gives, which runs in a thread of its own, so that a watch can end it where `wanted` says no or throws; none: it did.
template <class Do>
auto stoppable(const std::function<bool()>& wanted, experiment::Watch& watch, Do&& work) -> std::optional<decltype(work())> {
  auto result = std::async(std::launch::async, std::forward<Do>(work));
  try {
    bool stopped = false;
    while (result.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
      try {
        stopped = stopped || (wanted && !wanted());
      } catch (...) {
        watch.stop = true;
        result.wait();
        throw;
      }
      watch.stop = stopped;
    }
    return result.get();
  } catch (const experiment::Stopped&) {
    return std::nullopt;
  }
}

}  // namespace vsa::sweep
