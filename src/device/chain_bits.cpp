// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The line bit by bit, where several speak at once or rates differ. It ends when the line has been quiet for a byte.
#include <algorithm>

#include "vsa/device/chain.hpp"

namespace vsa::device {
namespace {

using Speech = ChainState::Speech;

/// The end of the byte that is on the wire at this time.
std::int64_t byte_end_ps(const Speech& s, std::int64_t now_ps) noexcept {
  std::int64_t n = (now_ps - s.start_ps) / s.rate.bytes_ps(1);
  while (s.start_ps + s.rate.bytes_ps(n) <= now_ps) ++n;
  return s.start_ps + s.rate.bytes_ps(n);
}

}  // namespace

void Chain::enter_bits() noexcept {
  const Speech& s = state_.speeches.front();
  state_.now_ps = s.start_ps + s.rate.bytes_ps(static_cast<std::int64_t>(s.heard));
  state_.mode = Mode::bits;
  state_.master_ear.from_ps = state_.now_ps;
  for (ChainState::Ear& ear : state_.ears) ear.receiver.from_ps = state_.now_ps;
}

bool Chain::step_bits(std::int64_t until_ps, std::int64_t master_ps, bus::LineMaster& master) {
  const std::int64_t now = state_.now_ps;
  if (now >= until_ps) return false;
  std::int64_t next = std::min(until_ps, std::max(next_wake_ps(), now));
  if (master_ps > now) next = std::min(next, master_ps);
  bool speaking = false;
  std::int64_t slowest_baud = state_.master_ear.rate.baud_Hz;
  for (const ChainState::Ear& ear : state_.ears) slowest_baud = std::min(slowest_baud, ear.receiver.rate.baud_Hz);
  const std::int64_t linger = bus::LineRate{slowest_baud}.bytes_ps(1);
  for (const Speech& s : state_.speeches) {
    slowest_baud = std::min(slowest_baud, s.rate.baud_Hz);
    if (s.start_ps > now) next = std::min(next, s.start_ps);
    if (s.start_ps > now || s.end_ps <= now) continue;
    next = std::min(next, byte_end_ps(s, now));
    speaking = true;
  }
  if (!speaking) next = std::min(next, state_.speeches.front().end_ps + linger);
  state_.now_ps = std::max(next, now);
  listen_bits(state_.now_ps, master);
  const bool woke = next_wake_ps() <= state_.now_ps;
  if (woke) wake(state_.now_ps);
  while (!state_.speeches.empty() && state_.speeches.front().end_ps + linger <= state_.now_ps) drop_first();
  if (state_.speeches.empty()) state_.mode = Mode::frames;
  return woke || state_.now_ps > now || state_.mode == Mode::frames;
}

bool Chain::speaks(int listener) const noexcept {
  return std::any_of(state_.speeches.begin(), state_.speeches.end(), [&](const Speech& s) { return s.speaker == listener; });
}

void Chain::speakers_for(int listener) {
  speakers_.clear();
  for (const Speech& s : state_.speeches)
    if (s.speaker != listener && s.start_ps < state_.now_ps) speakers_.push_back({s.start_ps, view(s), s.rate});
}

/// From the middle of the start bit to the middle of the stop bit: clocks that differ a little overlap a little.
bool Chain::speaks_over(int listener, bus::LineRate rate, std::int64_t byte_end_ps) const noexcept {
  const std::int64_t half_bit = rate.bits_ps(1) / 2;
  const std::int64_t begin = byte_end_ps - rate.bytes_ps(1) + half_bit, end = byte_end_ps - half_bit;
  return std::any_of(state_.speeches.begin(), state_.speeches.end(),
                     [&](const Speech& s) { return s.speaker == listener && s.start_ps < end && s.end_ps > begin; });
}

/// Those who only listen, from the same time at the same rate, hear the same: it is found once.
void Chain::listen_bits(std::int64_t until_ps, bus::LineMaster& master) {
  constexpr int kNobody = -2;
  struct Slice {
    bus::LineReceiver from, to;
    std::array<bus::HeardByte, 8> heard;
    std::size_t count = 0;
    bool known = false;
  } shared, own;
  const auto listen = [&](Slice& slice, int listener, const bus::LineReceiver& receiver) {
    speakers_for(listener);
    slice.from = slice.to = receiver;
    slice.count = bus::listen(slice.to, speakers_, slice.heard, until_ps);
    slice.known = true;
  };
  const auto listen_as = [&](int listener, bus::LineReceiver& receiver, auto take) {
    const bool silent = !speaks(listener);
    for (bool more = true; more;) {
      const bool again = silent && shared.known && shared.from == receiver;
      Slice& slice = silent ? shared : own;
      if (!again) listen(slice, silent ? kNobody : listener, receiver);
      const Slice now = slice;
      receiver = now.to;
      more = now.count == now.heard.size();
      for (std::size_t k = 0; k < now.count; ++k)
        if (silent || !speaks_over(listener, receiver.rate, now.heard[k].end_ps)) take(now.heard[k]);
    }
  };
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (!state_.ears[i].wiring.powered) continue;
    listen_as(static_cast<int>(i), state_.ears[i].receiver, [&](const bus::HeardByte& b) { hear(i, b.value, b.end_ps); });
  }
  listen_as(ChainState::kMaster, state_.master_ear, [&](const bus::HeardByte& b) { master.hear(b.value, b.end_ps); });
}

}  // namespace vsa::device
