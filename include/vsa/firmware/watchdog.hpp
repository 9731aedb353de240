// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The watchdog: an 8-bit down counter clocked every 40.96 ms. Each byte that the main loop sees reloads it (at the next clock);
// passing zero raises a flag and reloads. A counter period N is N + 1 clocks.
//
//   SET_WATCHDOG b:  N = (min(b, 250)·500) >> 10, about b·20 ms + one clock; 0 disables; b = 1 and 2 give N = 0 (one clock)
//   power-up:        N = 127 (5.24 s) whatever the stored period; disabled if the stored period is 0
//
// Sources: NMMI/qbmove-maker-pro 6.1 (cmd_set_watchdog, main), the generated design of NMMI/qbmove-advanced (clock divider,
// counter).
#pragma once

#include <cstdint>

namespace vsa::firmware {

inline constexpr std::int64_t kWatchdogClockNs = 40'960'000;  ///< of its counter

/// The 8-bit down counter, clocked every 40.96 ms, that tells the program that nobody has spoken for long.
struct Watchdog {
  std::int64_t next_clock_ns = 0;  ///< of its clock, line time
  std::uint8_t period = 127;       ///< N: clocks until it goes off, less one
  std::uint8_t count = 127;        ///< down to 0
  bool enabled = false;            ///< false: it counts nothing
  bool reload = false;             ///< asked for; done at the next clock
  bool expired = false;            ///< until the next byte

  /// At the clock that begins then.
  void power_up(std::int64_t now_ns, bool on) noexcept {
    *this = {};
    enabled = on;
    next_clock_ns = now_ns + kWatchdogClockNs;
  }
  /// Every clock up to then.
  void run_to(std::int64_t now_ns) noexcept {
    for (; next_clock_ns <= now_ns; next_clock_ns += kWatchdogClockNs) {
      const bool out = enabled && !reload && count == 0;
      expired = expired || out;
      count = !enabled || reload || out ? period : static_cast<std::uint8_t>(count - 1);
      reload = false;
    }
  }
  /// Reloads at the next clock.
  void heard_byte() noexcept {
    reload = true;
    expired = false;
  }
  static auto fields(auto& s, auto&& visit) {
    return visit("next_clock", "ns", s.next_clock_ns, "period", "", s.period, "count", "", s.count, "enabled", "", s.enabled,
                 "reload", "", s.reload, "expired", "", s.expired);
  }
};

/// The counter period of a SET_WATCHDOG.
[[nodiscard]] constexpr std::uint8_t watchdog_period(std::uint8_t requested) noexcept {
  return static_cast<std::uint8_t>(((requested > 250 ? 250U : requested) * 500U) >> 10);
}

}  // namespace vsa::firmware
