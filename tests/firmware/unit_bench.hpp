// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit on a bench: its program, a clock, electronics that the test sets, and a host that speaks to it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vsa/bus/codec.hpp"
#include "vsa/firmware/program.hpp"

namespace vsa::firmware::test {

using Bytes = std::vector<std::uint8_t>;

inline constexpr int kTwelveVolts = 1638 + 787;  // 787·1952 >> 7 = 12001 mV

class UnitBench {
 public:
  explicit UnitBench(ProgramParams params = {}) : program(params), state(program.fresh(0)) {}

  Program program;
  ProgramState state;
  TickInputs in{{0, 0, 0}, {1638, 1638}, kTwelveVolts};
  std::int64_t now_ns = 0;
  std::int64_t last_delay_ns = 0;  ///< of the last reply
  Output out;

  void tick(int ticks = 1) {
    for (; ticks > 0; --ticks) {
      out.clear();
      program.tick(state, in, now_ns += kTickNs, out);
    }
  }

  /// Bytes as they come, 5 µs each; all that the unit sends while they do.
  Bytes send(const Bytes& bytes) { return send_all(bytes); }
  Bytes send_all(std::span<const std::uint8_t> bytes) {
    Bytes replies;
    for (const std::uint8_t byte : bytes) {
      out.clear();
      program.receive(state, byte, now_ns += 5000, out);
      collect(replies);
    }
    return replies;
  }
  Bytes poll() {
    Bytes replies;
    out.clear();
    program.poll(state, now_ns, out);
    collect(replies);
    return replies;
  }

  /// A request to this unit's current ID (or to `id`), 10 ms after what was before.
  template <class R>
  Bytes request(const R& r, std::optional<int> id = {}) {
    now_ns += 10 * kTickNs;
    const auto to = static_cast<std::uint8_t>(id.value_or(state.memory.current.id));
    const bus::FrameBytes frame = bus::encode_request(program.wire(), to, bus::Request{r});
    return send_all(frame.view());
  }

  /// The reply as its type; none: nothing, or something else.
  template <class R>
  auto ask(const R& r, std::optional<int> id = {}) -> std::optional<typename R::Reply> {
    return read<typename R::Reply>(R::code, request(r, id));
  }
  template <class Reply>
  std::optional<Reply> read(bus::Command command, const Bytes& bytes) {
    bus::MasterReceiver receiver;
    bus::Frame frame;
    receiver.push(bytes);
    if (!receiver.next(frame)) return std::nullopt;
    last_id = frame.id;
    return bus::decode_reply<Reply>(program.wire(), command, frame);
  }
  std::uint8_t last_id = 0;

  void set(std::uint16_t index, const Bytes& value) {
    bus::SetParameter r;
    r.index = index;
    r.value_bytes = static_cast<std::uint8_t>(value.size());
    std::copy(value.begin(), value.end(), r.value.begin());
    request(r);
  }
  bool stores() { return ask(bus::StoreParameters{}) == bus::Acknowledgement{true}; }
  void wait_for_store() { now_ns = std::max(now_ns, state.busy_until_ns); }

 private:
  void collect(Bytes& into) {
    for (int i = 0; i < out.count; ++i) {
      const auto view = out.view(out.replies[i]);
      into.insert(into.end(), view.begin(), view.end());
      last_delay_ns = out.replies[i].delay_ns;
    }
  }
};

inline ProgramParams with(Repairs repairs) {
  ProgramParams p;
  p.repairs = repairs;
  return p;
}
inline ProgramParams dialect_seven() {
  ProgramParams p;
  p.dialect = bus::Dialect::seven;
  return p;
}
inline ProgramParams advanced_unit(Repairs repairs = {}) {
  ProgramParams p;
  p.model = Model::advanced;
  p.repairs = repairs;
  return p;
}

}  // namespace vsa::firmware::test
