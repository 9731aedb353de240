// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Programs on a line, without physics: a host that says what the test wants, when it wants, and keeps what it hears.
#pragma once

#include <deque>
#include <vector>

#include "vsa/bus/codec.hpp"
#include "vsa/device/chain.hpp"

namespace vsa::test {

using Bytes = std::vector<std::uint8_t>;

class ScriptMaster : public bus::LineMaster {
 public:
  struct Heard {
    std::uint8_t byte;
    std::int64_t end_ps;
  };
  std::deque<std::pair<std::int64_t, bus::FrameBytes>> script;
  std::vector<Heard> heard;

  std::int64_t next_ps() const noexcept override { return script.empty() ? bus::kNeverPs : script.front().first; }
  bus::FrameBytes speak() noexcept override {
    const bus::FrameBytes frame = script.front().second;
    script.pop_front();
    return frame;
  }
  void hear(std::uint8_t byte, std::int64_t end_ps) noexcept override { heard.push_back({byte, end_ps}); }

  [[nodiscard]] Bytes bytes() const {
    Bytes out;
    for (const Heard& h : heard) out.push_back(h.byte);
    return out;
  }
};

inline bus::FrameBytes raw(const Bytes& bytes) {
  bus::FrameBytes f;
  for (const std::uint8_t b : bytes) f.push(b);
  return f;
}

struct ChainRig {
  explicit ChainRig(std::size_t units, device::LineConfig line = {}, firmware::ProgramParams params = {})
      : program(params), states(units, program.fresh(0)), chain(line, stations(units)) {
    for (std::size_t i = 0; i < units; ++i) set_id(i, static_cast<std::uint8_t>(i + 1));
  }
  std::vector<device::Station> stations(std::size_t units) {
    std::vector<device::Station> out;
    for (std::size_t i = 0; i < units; ++i) out.push_back({&program, &states[i]});
    return out;
  }
  void set_id(std::size_t i, std::uint8_t id) {
    firmware::MemoryState& m = states[i].memory;
    m.stored.id = m.current.id = m.user.id = m.factory.id = id;
  }
  template <class R>
  void say(std::int64_t at_ns, int id, const R& request) {
    host.script.emplace_back(at_ns * 1000, bus::encode_request({}, static_cast<std::uint8_t>(id), bus::Request{request}));
  }
  void say_bytes(std::int64_t at_ns, const Bytes& bytes) { host.script.emplace_back(at_ns * 1000, raw(bytes)); }
  /// Ticks each millisecond, the line between.
  void run_to(std::int64_t until_ns) {
    for (; next_tick_ns <= until_ns; next_tick_ns += 1'000'000) {
      chain.run_to(next_tick_ns, host);
      for (std::size_t i = 0; i < states.size(); ++i) chain.tick(i, in, next_tick_ns);
    }
    chain.run_to(until_ns, host);
  }
  /// Whole frames that the host made of what it heard.
  [[nodiscard]] std::vector<bus::Frame> frames() const {
    bus::MasterReceiver receiver;
    std::vector<bus::Frame> out;
    bus::Frame frame;
    for (const auto& h : host.heard) {
      receiver.push({&h.byte, 1});
      while (receiver.next(frame)) out.push_back(frame);
    }
    return out;
  }

  firmware::Program program;
  std::vector<firmware::ProgramState> states;
  ScriptMaster host;
  device::Chain chain;
  firmware::TickInputs in{{160, -160, 80}, {1638, 1638}, 1638 + 787};
  std::int64_t next_tick_ns = 1'000'000;
};

}  // namespace vsa::test
