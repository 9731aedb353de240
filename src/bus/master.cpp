// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/master.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vsa::bus {
namespace {

constexpr std::int64_t kMillisecondNs = 1'000'000;
constexpr std::int64_t kPsPerNs = 1000;

std::int64_t to_ns(std::int64_t ps) noexcept { return (ps + kPsPerNs - 1) / kPsPerNs; }

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
    : schedule_(schedule), ids_(std::move(ids)), client_(client) {}

std::int64_t Master::next_ps() const noexcept {
  if (ids_.empty()) return kNeverPs;
  return state_.cycle_start_ps + schedule_.frame_ps(state_.frame / 2, state_.frame % 2 != 0);
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

void Master::hear(std::uint8_t byte, std::int64_t) noexcept {
  state_.receiver.push({&byte, 1});
  Frame frame;
  while (state_.receiver.next(frame)) {
    const auto unit = std::find(ids_.begin(), ids_.end(), frame.id);
    if (unit == ids_.end()) continue;
    if (const auto reply = decode_reply<MeasurementsReply>({}, Command::get_measurements, frame))
      client_.measured(static_cast<int>(unit - ids_.begin()), reply->positions);
  }
}

}  // namespace vsa::bus
