// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/port_line.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

namespace vsa::device {
namespace {

using bus::kPsPerNs;
constexpr std::int64_t kShortestSleepNs = 50'000;
constexpr int kMaxYields = 100;

}  // namespace

void PortLine::give_way() const noexcept {
  for (int n = 0; n < kMaxYields && client_waits_.load(std::memory_order_relaxed); ++n) std::this_thread::yield();
}

std::int64_t PortLine::wall_ns() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(wall_().time_since_epoch()).count();
}

std::int64_t PortLine::line_now_ns() {
  const std::int64_t wall = wall_ns();
  if (!started_) {
    started_ = true;
    wall_offset_ns_ = now_ns_ - wall;
  }
  now_ns_ = std::max({now_ns_, wall + wall_offset_ns_, sim_line_ns_});
  return now_ns_;
}

std::int64_t PortLine::move_to_tick(std::int64_t sim_ns) {
  if (!started_) {
    now_ns_ = sim_line_ns_ = std::max(now_ns_, sim_ns);
    sim_offset_ns_ = now_ns_ - sim_ns;
    line_now_ns();
  }
  const std::int64_t wall = wall_ns() + wall_offset_ns_;
  const std::int64_t sim = std::max(sim_ns + sim_offset_ns_, sim_line_ns_);
  if (sim < wall - kMaxLeadNs) sim_offset_ns_ = wall - kMaxLeadNs - sim_ns;
  if (wall < sim - kMaxLeadNs) wall_offset_ns_ += sim - kMaxLeadNs - wall;
  sim_line_ns_ = std::max(sim_ns + sim_offset_ns_, sim_line_ns_);
  const std::int64_t now = line_now_ns();
  chain_.run_to(now, *this);
  return now;
}

void PortLine::exchange(std::span<const std::uint8_t> from_client, std::vector<std::uint8_t>& answer) {
  client_waits_.store(true, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  client_waits_.store(false, std::memory_order_relaxed);
  const std::int64_t now = line_now_ns();
  if (!heard_at_clients_rate()) {
    wrong_rate_.bytes += from_client.size();
    from_client = {};
  }
  const std::size_t room = kMaxWaiting - std::min(kMaxWaiting, waiting_.size() - taken_);
  const auto kept = from_client.first(std::min(room, from_client.size()));
  lost_ += from_client.size() - kept.size();
  if (taken_ == waiting_.size()) {
    waiting_.clear();
    taken_ = 0;
    may_speak_ps_ = std::max(now * kPsPerNs, heard_ps_);
  }
  if (taken_ > kMaxWaiting) {  // a client that never lets it run empty
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(taken_));
    taken_ = 0;
  }
  waiting_.insert(waiting_.end(), kept.begin(), kept.end());
  chain_.run_to(now + kAheadNs, *this);
  answer.insert(answer.end(), heard_.begin(), heard_.end());
  heard_.clear();
}

std::optional<bus::SerialLine::Clock::time_point> PortLine::wake() const {
  const std::lock_guard lock(mutex_);
  const auto now = wall_();
  if (!heard_.empty()) return now;
  std::int64_t event_ps = chain_.next_event_ps();
  if (taken_ < waiting_.size()) event_ps = std::min(event_ps, std::max(next_ps(), chain_.state().host_free_ps));
  if (event_ps == bus::kNeverPs) return std::nullopt;
  const std::int64_t line = std::max(now_ns_, wall_ns() + wall_offset_ns_);
  const std::int64_t sleep = event_ps / kPsPerNs - (line + kAheadNs);
  return now + std::chrono::nanoseconds(std::max(sleep, kShortestSleepNs));
}

/// Under the lock: the line's own port gets the client's rate; false: no unit can make out what is said at it.
bool PortLine::heard_at_clients_rate() {
  if (!client_Hz_ || any_rate_) return true;
  const bus::LineRate rate{*client_Hz_};
  if (rate.baud_Hz > 0 && !(chain_.state().master_ear.rate == rate)) chain_.set_master_rate(rate);
  const auto& ears = chain_.state().ears;
  const auto hears = [&](const ChainState::Ear& ear) {
    const auto units = static_cast<double>(ear.receiver.rate.baud_Hz), clients = static_cast<double>(rate.baud_Hz);
    return std::abs(clients - units) <= kRateSlack * units;
  };
  if (ears.empty() || std::any_of(ears.begin(), ears.end(), hears)) return true;
  wrong_rate_.client_Hz = *client_Hz_;
  wrong_rate_.units_Hz = ears.front().receiver.rate.baud_Hz;
  return false;
}

std::string PortLine::WrongRate::text() const {
  const std::string units = std::to_string(units_Hz);
  return "the client's serial port is set to " + std::to_string(client_Hz) + " bit/s, the units listen at " + units +
         ": what it sends is noise to them (in a shell: stty -F PORT " + units + "; if it can't set a rate: any_rate, --any-rate)";
}

PortLine::WrongRate PortLine::wrong_rate() const {
  const std::lock_guard lock(mutex_);
  return wrong_rate_;
}

void PortLine::forget() {
  started_ = false;
  now_ns_ = chain_.state().now_ps / kPsPerNs;
  sim_line_ns_ = sim_offset_ns_ = 0;
  waiting_.clear();
  heard_.clear();
  taken_ = 0;
  may_speak_ps_ = heard_ps_ = 0;
}

std::uint64_t PortLine::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

std::int64_t PortLine::next_ps() const noexcept { return taken_ == waiting_.size() ? bus::kNeverPs : may_speak_ps_; }

/// One frame if one is there, so that the line can hand it over whole; else what is there.
bus::FrameBytes PortLine::speak() noexcept {
  const std::span<const std::uint8_t> rest{waiting_.data() + taken_, waiting_.size() - taken_};
  std::size_t size = std::min(rest.size(), bus::kMaxFrameBytes);
  if (rest.size() > bus::kHeaderBytes && rest[0] == bus::kStartByte && rest[1] == bus::kStartByte) {
    const std::size_t frame = bus::kHeaderBytes + rest[3];
    if (bus::whole_frame(rest.first(std::min(frame, rest.size())))) size = frame;
  }
  bus::FrameBytes out;
  for (const std::uint8_t byte : rest.first(size)) out.push(byte);
  taken_ += size;
  may_speak_ps_ = std::max(may_speak_ps_, chain_.state().host_free_ps);
  return out;
}

void PortLine::hear(std::uint8_t byte, std::int64_t end_ps) noexcept {
  heard_.push_back(byte);
  heard_ps_ = std::max(heard_ps_, end_ps);
}

}  // namespace vsa::device
