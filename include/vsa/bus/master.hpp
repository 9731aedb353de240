// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The master of a chain of units: what a robot's own computer is on hardware, in simulated time.
//
// Each cycle it sends, for every unit in id order, SET_INPUTS (10 bytes, no reply) and GET_MEASUREMENTS (6 bytes, reply 12 bytes),
// by a time table: it doesn't wait, so a silent unit costs the others nothing and a late answer meets a later frame. A byte is
// 10 bits (8N1). With B baud and no turn-around, unit k (0 = first) has its new references at
//     t_k = t_cycle + (k·28 + 10)·10/B,
// so at 2 Mbaud unit 12 hears 11·140 µs = 1.54 ms after unit 1. The cycle is max(N·28·10/B, 1 ms·N) unless it is set; 1 ms a unit
// is the published guidance for clients. Before a request it forgets what it had half received,
// as the public client libraries do.
//
// Sources: NMMI/qbmove-maker-pro 6.1 (frame layout), NMMI/qbAPI (order of calls).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vsa/bus/codec.hpp"
#include "vsa/bus/line_master.hpp"
#include "vsa/bus/timing.hpp"

namespace vsa::bus {

inline constexpr int kSetInputsBytes = 10;          ///< on the wire
inline constexpr int kGetMeasurementsBytes = 6;     ///< on the wire
inline constexpr int kMeasurementsReplyBytes = 12;  ///< on the wire

/// The time table of one bus. Times "_ns" are integer nanoseconds of simulated time, rounded up: a frame isn't there before its
/// last bit.
struct Schedule {
  std::int64_t cycle_ns = 0;        ///< between two cycles
  LineRate rate{};                  ///< of the line
  std::int64_t turn_around_ps = 0;  ///< of every unit
  int units = 0;                    ///< in the cycle

  /// One unit's part of a cycle.
  [[nodiscard]] constexpr std::int64_t slot_ps() const noexcept {
    return rate.bytes_ps(kSetInputsBytes) + exchange_ps(rate, kGetMeasurementsBytes, turn_around_ps, kMeasurementsReplyBytes);
  }
  /// From the cycle's start to the first bit of unit k's SET_INPUTS, or its GET_MEASUREMENTS.
  [[nodiscard]] constexpr std::int64_t frame_ps(int k, bool get) const noexcept {
    return k * slot_ps() + (get ? rate.bytes_ps(kSetInputsBytes) : 0);
  }
  /// When unit `k`'s SET_INPUTS frame is complete in the cycle that starts at `cycle_start_ns`.
  [[nodiscard]] std::int64_t inputs_at_ns(std::int64_t cycle_start_ns, int k) const noexcept;
  /// When the unit has received GET_MEASUREMENTS: what it answers is its last completed tick at that time.
  [[nodiscard]] std::int64_t request_at_ns(std::int64_t cycle_start_ns, int k) const noexcept;
  /// When the master has the unit's reply.
  [[nodiscard]] std::int64_t reply_at_ns(std::int64_t cycle_start_ns, int k) const noexcept;
};

/// Wire time of one whole cycle, ns.
[[nodiscard]] std::int64_t wire_time_ns(int units, double baud_Hz) noexcept;

/// cycle_s none: automatic. A set cycle shorter than the wire time is the caller's error (config refuses it).
[[nodiscard]] Schedule make_schedule(int units, double baud_Hz, std::optional<double> cycle_s) noexcept;

/// For whom the master works: gives references, and takes measurements. Called by the thread that runs the line.
class MasterClient {
 public:
  virtual ~MasterClient() = default;
  /// What unit `k`'s SET_INPUTS frame carries that sets out now.
  virtual std::array<Ticks, 2> inputs(int k, std::int64_t now_ns) noexcept = 0;
  /// Unit `k` answered.
  virtual void measured(int k, const std::array<Ticks, 3>& positions) noexcept = 0;

 protected:
  MasterClient() = default;
  MasterClient(const MasterClient&) = default;
  MasterClient& operator=(const MasterClient&) = default;
};

/// Where a master is in its cycle: copy it for a snapshot.
struct MasterState {
  std::int64_t cycle_start_ps = 0;  ///< of the cycle under way
  int frame = 0;                    ///< of the cycle, the next to set out: two per unit
  MasterReceiver receiver;          ///< of the replies
  static auto fields(auto& s, auto&& visit) {
    return visit("cycle_start", "ps", s.cycle_start_ps, "frame", "", s.frame, "receiver", "", s.receiver);
  }
};

/// The simulated bus master: sends SET_INPUTS and GET_MEASUREMENTS by the schedule's time table and hands the client what units
/// answer.
class Master final : public LineMaster {
 public:
  /// `ids` in the order of the cycle; as many as the schedule has units.
  Master(const Schedule& schedule, std::vector<std::uint8_t> ids, MasterClient& client);

  [[nodiscard]] const Schedule& schedule() const noexcept { return schedule_; }  ///< as given
  [[nodiscard]] const MasterState& state() const noexcept { return state_; }     ///< to copy
  void restore(const MasterState& state) { state_ = state; }                     ///< of the same schedule
  /// The owner's time jumped.
  void shift_time(std::int64_t by_ns) noexcept { state_.cycle_start_ps += by_ns * kPsPerNs; }

  [[nodiscard]] std::int64_t next_ps() const noexcept override;
  FrameBytes speak() noexcept override;
  void hear(std::uint8_t byte, std::int64_t end_ps) noexcept override;
  void hear_all(std::span<const std::uint8_t> bytes, std::int64_t end_ps, LineRate rate) noexcept override;

 private:
  void take() noexcept;

  Schedule schedule_;
  std::int64_t slot_ps_, get_ps_;  // of the schedule
  std::vector<std::uint8_t> ids_;
  MasterClient& client_;
  MasterState state_;
  Frame heard_;  // scratch
};

}  // namespace vsa::bus
