// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Any bytes, at any time, into whole units on a line, and through the port's end of it. A broken invariant traps. The input is a
// script: what the units are, then pieces of line: bytes as they are, or frames with a right checksum so that commands are reached;
// pauses with ticks; units that lose power or bytes. How to run: CMakeLists.txt here; a seeded run without libFuzzer is
// tests/random_bytes.
#include <algorithm>
#include <chrono>
#include <deque>
#include <vector>

#include "vsa/bus/bytes.hpp"
#include "vsa/device/chain.hpp"
#include "vsa/device/port_line.hpp"

namespace {

using namespace vsa;
using Input = std::span<const std::uint8_t>;

void require(bool ok) {
  if (!ok) __builtin_trap();
}

class Host final : public bus::LineMaster {
 public:
  std::deque<std::pair<std::int64_t, bus::FrameBytes>> script;
  std::int64_t last_ps = 0;
  std::uint64_t heard = 0;
  std::int64_t next_ps() const noexcept override { return script.empty() ? bus::kNeverPs : script.front().first; }
  bus::FrameBytes speak() noexcept override {
    const bus::FrameBytes f = script.front().second;
    script.pop_front();
    return f;
  }
  void hear(std::uint8_t byte, std::int64_t end_ps) noexcept override {
    require(end_ps >= last_ps);
    last_ps = end_ps;
    heard = heard * 31 + byte;
  }
};

firmware::ProgramParams params_of(std::uint8_t bits) {
  firmware::ProgramParams p;
  p.model = (bits & 1) != 0 ? firmware::Model::advanced : firmware::Model::maker_pro;
  p.dialect = (bits & 2) != 0 ? bus::Dialect::seven : bus::Dialect::six;
  p.repairs.short_frames_refused = (bits & 4) != 0;
  p.repairs.layout_134 = p.repairs.list_checksum = (bits & 8) != 0;
  p.repairs.watchdog_stops_motors = (bits & 16) != 0;
  p.row_write_ns = (bits & 32) != 0 ? 10'000'000 : 100'000;
  return p;
}

struct Units {
  Units(std::uint8_t bits, std::size_t count) : program(params_of(bits)), states(count, program.fresh(0)), chain({}, stations()) {
    for (std::size_t i = 0; i < count; ++i) {
      auto& m = states[i].memory;
      m.stored.id = m.current.id = m.user.id = m.factory.id = static_cast<std::uint8_t>(i + 1);
    }
  }
  std::vector<device::Station> stations() {
    std::vector<device::Station> out;
    for (auto& s : states) out.push_back({&program, &s});
    return out;
  }
  void tick(std::int64_t now_ns, std::uint8_t noise) {
    firmware::TickInputs in;
    for (int i = 0; i < 3; ++i) in.encoder[i] = static_cast<std::int16_t>((noise * 517 + i * 9000) & 0xFFFF);
    in.current_adc = {1638 + noise, 4095 - noise};
    in.supply_adc = noise < 8 ? 0 : 1638 + 787;
    in.encoder_ok = {noise % 7 != 0, true, noise % 11 != 0};
    for (std::size_t i = 0; i < states.size(); ++i) chain.tick(i, in, now_ns);
  }
  void check() const {
    for (const auto& s : states) {
      for (int i = 0; i < 2; ++i) require(s.loop.duty[i] >= -32768 && s.loop.duty[i] <= 32767 && s.loop.limit_pct <= 100);
      require(s.receiver.wanted <= bus::kMaxLength && s.receiver.received <= bus::kMaxLength);
      require(s.buffer.read < 32 && s.buffer.write < 32);
    }
    require(chain.state().speeches.size() < 10'000 && chain.state().bytes.size() < 2'000'000);
  }
  firmware::Program program;
  std::vector<firmware::ProgramState> states;
  device::Chain chain;
};

/// The next piece of line: raw bytes, or a frame with a right sum.
bus::FrameBytes piece(bus::ByteReader& in) {
  static constexpr std::uint8_t commands[] = {0,   1,   3,   4,   5,   6,   10,  11,  12,  128, 129, 130, 131,
                                              132, 133, 134, 135, 137, 138, 143, 144, 147, 150, 9,   77};
  const std::uint8_t kind = in.u8();
  std::vector<std::uint8_t> bytes(kind % 24);
  for (auto& b : bytes) b = in.u8();
  if (kind < 200) return bus::encode_frame(static_cast<std::uint8_t>(kind % 6), commands[in.u8() % sizeof commands], bytes);
  bus::FrameBytes raw;
  for (const std::uint8_t b : bytes) raw.push(b);
  return raw;
}

void on_a_line(bus::ByteReader in, Units& units) {
  Host host;
  std::int64_t now = 0, tick = 1'000'000;
  while (in.left() > 0) {
    const std::uint8_t pause = in.u8();
    if (pause == 255) {
      device::Wiring w;
      w.powered = in.u8() % 3 != 0;
      w.flipped_byte = in.u8() % 2 * 0.1;
      w.lost_byte = in.u8() % 2 * 0.1;
      w.late_ns = in.u8() * std::int64_t{10'000};
      units.chain.set_wiring(in.u8() % units.states.size(), w, 1);
    }
    host.script.emplace_back(now * 1000, piece(in));
    now += pause * std::int64_t{3'000} + (pause > 240 ? 20'000'000 : 0);
    for (; tick <= now; tick += 1'000'000) {
      units.chain.run_to(tick, host);
      units.tick(tick, pause);
    }
    units.chain.run_to(now, host);
    units.check();
  }
}

void through_the_port(bus::ByteReader in, Units& units) {
  device::PortLine::Clock::time_point wall{};
  device::PortLine port(units.chain, [&wall] { return wall; });
  std::vector<std::uint8_t> answer;
  std::int64_t sim = 0;
  while (in.left() > 0) {
    const std::uint8_t pause = in.u8();
    const bus::FrameBytes bytes = piece(in);
    port.exchange(bytes.view(), answer);
    wall += std::chrono::microseconds(pause * 4);
    if (pause % 3 != 0) port.ticks(sim += 1'000'000, [&](std::int64_t line) { units.tick(line, pause); });
    if (const auto wake = port.wake(); wake && pause > 250) wall = std::max(wall, *wake);
    if (pause == 199) port.set_rate(460'800);
    if (pause == 198) port.set_rate(2'000'000);
    units.check();
    require(answer.size() < 10'000'000);
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::size_t count = 1 + data[1] % 4;
  const bus::ByteReader script{Input{data + 2, size - 2}};
  Units on_line(data[0], count), on_port(data[0], count);
  on_a_line(script, on_line);
  through_the_port(script, on_port);
  return 0;
}
