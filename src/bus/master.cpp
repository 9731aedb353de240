// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/master.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vsa::bus {
namespace {

constexpr std::int64_t kMillisecondNs = 1'000'000;

LineRate rate_of(double baud_Hz) noexcept { return {std::max(std::llround(baud_Hz), 1LL)}; }

}  // namespace

std::int64_t Schedule::inputs_at_ns(std::int64_t cycle_start_ns, int k) const noexcept {
  return cycle_start_ns + to_ns(frame_ps(k, true));
}

std::int64_t Schedule::request_at_ns(std::int64_t cycle_start_ns, int k) const noexcept {
  return cycle_start_ns + to_ns(frame_ps(k, true) + rate.bytes_ps(kGetMeasurementsBytes));
}

std::int64_t Schedule::reply_at_ns(std::int64_t cycle_start_ns, int k) const noexcept {
  return cycle_start_ns + to_ns(frame_ps(k + 1, false));
}

std::int64_t wire_time_ns(int units, double baud_Hz) noexcept {
  return to_ns(Schedule{0, rate_of(baud_Hz), 0, units}.frame_ps(units, false));
}

Schedule make_schedule(int units, double baud_Hz, std::optional<double> cycle_s) noexcept {
  Schedule s;
  s.units = units;
  s.rate = rate_of(baud_Hz);
  s.cycle_ns = cycle_s ? std::llround(*cycle_s * 1e9) : std::max(wire_time_ns(units, baud_Hz), kMillisecondNs * units);
  return s;
}

Master::Master(const Schedule& schedule, std::vector<std::uint8_t> ids, MasterClient& client)
    : schedule_(schedule),
      slot_ps_(schedule.slot_ps()),
      get_ps_(schedule.frame_ps(0, true)),
      ids_(std::move(ids)),
      client_(client) {}

std::int64_t Master::next_ps() const noexcept {
  if (ids_.empty()) return kNeverPs;
  return state_.cycle_start_ps + state_.frame / 2 * slot_ps_ + (state_.frame % 2 != 0 ? get_ps_ : 0);
}

FrameBytes Master::speak() noexcept {
  const int k = state_.frame / 2;
  const bool get = state_.frame % 2 != 0;
  const std::int64_t now_ps = next_ps();
  if (++state_.frame == 2 * static_cast<int>(ids_.size())) {
    state_.frame = 0;
    state_.cycle_start_ps += schedule_.cycle_ns * kPsPerNs;
  }
  const std::uint8_t id = ids_[static_cast<std::size_t>(k)];
  if (!get) return encode_request({}, id, SetInputs{client_.inputs(k, now_ps / kPsPerNs)});
  state_.receiver.clear();
  return encode_request({}, id, GetMeasurements{});
}

void Master::hear(std::uint8_t byte, std::int64_t end_ps) noexcept { hear_all({&byte, 1}, end_ps, schedule_.rate); }

void Master::hear_all(std::span<const std::uint8_t> bytes, std::int64_t, LineRate) noexcept {
  while (!bytes.empty()) {
    const std::size_t taken = state_.receiver.push(bytes);
    bytes = bytes.subspan(taken);
    while (state_.receiver.next(heard_)) take();
    if (taken == 0) return;  // can't be: what is full holds a frame, or noise that next drops
  }
}

void Master::take() noexcept {
  const auto unit = std::find(ids_.begin(), ids_.end(), heard_.id);
  if (unit == ids_.end()) return;
  if (const auto reply = decode_reply<MeasurementsReply>({}, Command::get_measurements, heard_))
    client_.measured(static_cast<int>(unit - ids_.begin()), reply->positions);
}

}  // namespace vsa::bus
