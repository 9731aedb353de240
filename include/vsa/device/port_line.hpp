// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A chain as an external client meets it, in real time, while another thread steps the simulation.
//
// THE LINE'S CLOCK is the faster of wall time and simulated time, since the first of either came. In real time both run together; a
// simulation that is slow, or stands, doesn't slow the line down: units answer from their last tick, as they do on hardware, and
// what waits for time (a store, the watchdog) goes on. A simulation that is fast takes the line along, so that a unit's store is
// as long as its ticks say. A lead of more than kMaxLead on either side is forgotten.
//
// ANSWERS AT ONCE. The line is simulated a little ahead of its clock (kAhead), so that a usual answer is there when the client's
// bytes are in; bytes that the client sends then start after what it has heard. A client can't outrun the wire by more than that:
// its bytes, and long answers, wait for their time, and `wake` tells when. Of more than kMaxWaiting bytes the rest is lost, as in
// a serial port that overruns.
//
// THE RATE. A client whose port is set to another rate than every unit's (by more than kRateSlack, half a bit in ten) sends them
// noise: its bytes are dropped and counted. Where some units have another rate than others, the line is simulated bit by bit.
//
// Threads: `exchange`, `wake` and `set_rate` from the port's; `ticks` from the one that steps, which holds the lock for one tick's
// programs and never for physics.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "vsa/bus/line_master.hpp"
#include "vsa/bus/serial_line.hpp"
#include "vsa/device/chain.hpp"

namespace vsa::device {

/// A chain of units as an external client meets it, in real time, while another thread steps the simulation. Its lock keeps the two
/// apart; the chain is nobody else's.
class PortLine final : public bus::SerialLine, private bus::LineMaster {
 public:
  static constexpr std::int64_t kAheadNs = 500'000;       ///< how far the line is simulated ahead of its clock
  static constexpr std::int64_t kMaxLeadNs = 50'000'000;  ///< lead of one clock over the other that is still kept
  static constexpr std::size_t kMaxWaiting = 4096;        ///< bytes of a client
  static constexpr double kRateSlack = 0.05;              ///< part of the units' rate

  /// `now` is the wall clock, for tests.
  explicit PortLine(Chain& chain, std::function<Clock::time_point()> now = Clock::now) : chain_(chain), wall_(std::move(now)) {}

  void exchange(std::span<const std::uint8_t> from_client, std::vector<std::uint8_t>& answer) override;
  [[nodiscard]] std::optional<Clock::time_point> wake() const override;
  /// The client's serial port is set to this, from the next exchange on; before the first call: to the units' own rate.
  void set_rate(std::int64_t baud_Hz) override { client_Hz_ = baud_Hz; }
  /// Before the port is opened: for clients that can't set a rate, any counts as the line's.
  void take_any_rate() noexcept { any_rate_ = true; }

  /// Does `work(line time in ns)` under the lock, with the line heard up to a tick of simulated time.
  template <class Work>
  void ticks(std::int64_t sim_ns, Work&& work) {
    give_way();
    const std::lock_guard lock(mutex_);
    work(move_to_tick(sim_ns));
  }
  /// For whatever else touches the programs' states.
  template <class Work>
  auto locked(Work&& work) const {
    const std::lock_guard lock(mutex_);
    return work();
  }
  void lock() const { mutex_.lock(); }      ///< as a mutex: for std::lock_guard
  void unlock() const { mutex_.unlock(); }  ///< see lock()
  /// Under the lock, after a restore or reset: time begins anew, nothing is under way to the client.
  void forget();
  /// Bytes of the client that were lost because too many waited.
  [[nodiscard]] std::uint64_t lost() const;
  /// What was dropped because of its rate, and the rates when that happened last.
  struct WrongRate {
    std::uint64_t bytes = 0;                 ///< so far
    std::int64_t client_Hz = 0,              ///< of the client, then
        units_Hz = 0;                        ///< of the units, then
    [[nodiscard]] std::string text() const;  ///< for a user
  };
  [[nodiscard]] WrongRate wrong_rate() const;  ///< so far

 private:
  std::int64_t next_ps() const noexcept override;
  bus::FrameBytes speak() noexcept override;
  void hear(std::uint8_t byte, std::int64_t end_ps) noexcept override;
  /// A simulation that never sleeps would take the lock again before the client wakes up.
  void give_way() const noexcept;
  std::int64_t move_to_tick(std::int64_t sim_ns);
  std::int64_t line_now_ns();
  std::int64_t wall_ns() const;
  [[nodiscard]] bool heard_at_clients_rate();

  mutable std::mutex mutex_;
  std::atomic<bool> client_waits_{false};
  Chain& chain_;
  std::function<Clock::time_point()> wall_;
  bool started_ = false;
  std::int64_t wall_offset_ns_ = 0, sim_offset_ns_ = 0;  // line time = wall or simulated time + offset
  std::int64_t sim_line_ns_ = 0, now_ns_ = 0;            // line time of the last tick; of the last look
  std::vector<std::uint8_t> waiting_;                    // of the client, not on the wire yet
  std::size_t taken_ = 0;
  std::int64_t may_speak_ps_ = 0;
  std::vector<std::uint8_t> heard_;
  std::int64_t heard_ps_ = 0;
  std::uint64_t lost_ = 0;
  std::optional<std::int64_t> client_Hz_;  // the port's thread alone
  bool any_rate_ = false;
  WrongRate wrong_rate_;
};

}  // namespace vsa::device
