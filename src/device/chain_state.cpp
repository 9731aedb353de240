// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a line's numbers can't be.
#include "vsa/device/chain.hpp"

namespace vsa::device {

const char* ChainState::impossible() const noexcept {
  constexpr std::int64_t kFarthest_ps = 4'000'000'000'000'000'000;
  const auto near = [](std::int64_t ps) { return ps >= -kFarthest_ps && ps <= kFarthest_ps; };
  const auto last_heard = [&](const bus::LineReceiver& r) { return mode != Mode::bits || near(r.from_ps); };
  if (!near(now_ps) || !near(host_free_ps) || !last_heard(master_ear)) return "times within ±4e18 ps";
  for (const Ear& ear : ears)
    if (!near(ear.free_ps) || !last_heard(ear.receiver)) return "times within ±4e18 ps";
  if (speeches.empty() && mode != Mode::frames) return "a line that is quiet";
  std::int64_t start_ps = -kFarthest_ps;
  for (const Speech& s : speeches) {
    if (s.start_ps < start_ps || s.start_ps > kFarthest_ps) return "speeches in the order of their starts";
    if (s.size == 0 || s.heard >= s.size || std::uint64_t{s.begin} + s.size > bytes.size())
      return "speeches that are in line.bytes";
    if (s.end_ps != s.start_ps + s.rate.bytes_ps(s.size)) return "speeches as long as their bytes take";
    if (s.speaker < kMaster || s.speaker >= static_cast<int>(ears.size())) return "speakers that are on the line";
    start_ps = s.start_ps;
  }
  return nullptr;
}

}  // namespace vsa::device
