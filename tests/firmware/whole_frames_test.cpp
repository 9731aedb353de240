// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Frames handed over whole are what they are byte by byte.
#include <gtest/gtest.h>

#include <random>

#include "firmware/unit_bench.hpp"

namespace {

using namespace vsa::firmware;
using vsa::firmware::test::Bytes;

constexpr std::int64_t kByteNs = 5000;

struct Pair {
  explicit Pair(ProgramParams p) : program(p), whole(program.fresh(0)), single(whole) {}
  Program program;
  ProgramState whole, single;
  Output a, b;
};

Bytes said(const Output& out) {
  Bytes all;
  for (int i = 0; i < out.count; ++i) {
    const auto view = out.view(out.replies[i]);
    all.insert(all.end(), view.begin(), view.end());
    for (int shift = 0; shift < 64; shift += 8) all.push_back(static_cast<std::uint8_t>(out.replies[i].delay_ns >> shift));
  }
  return all;
}

/// All that a program remembers, but for the bytes that lie read in the ring.
void expect_same(const ProgramState& a, const ProgramState& b, int n) {
  ASSERT_EQ(a.memory, b.memory) << n;
  ASSERT_EQ(a.receiver, b.receiver) << n;
  ASSERT_EQ(a.buffer.read, b.buffer.read) << n;
  ASSERT_EQ(a.buffer.write, b.buffer.write) << n;
  ASSERT_EQ(a.busy_until_ns, b.busy_until_ns) << n;
  ASSERT_EQ(a.watchdog.next_clock_ns, b.watchdog.next_clock_ns) << n;
  ASSERT_EQ(a.watchdog.count, b.watchdog.count) << n;
  ASSERT_EQ(a.watchdog.reload, b.watchdog.reload) << n;
  ASSERT_EQ(a.watchdog.expired, b.watchdog.expired) << n;
  ASSERT_EQ(a.loop.ref_new, b.loop.ref_new) << n;
  ASSERT_EQ(a.loop.duty, b.loop.duty) << n;
  ASSERT_EQ(a.loop.orders_new.onoff, b.loop.orders_new.onoff) << n;
  ASSERT_EQ(a.enable, b.enable) << n;
  ASSERT_EQ(a.bytes_waiting, b.bytes_waiting) << n;
  ASSERT_EQ(a.counters.value, b.counters.value) << n;
}

/// Frames with right headers: any command, right or wrong sum, for this unit, another, or all.
Bytes any_frame(std::mt19937& rng) {
  static constexpr std::uint8_t commands[] = {0, 1, 3, 6, 12, 128, 129, 130, 131, 132, 133, 134, 135, 137, 143, 200};
  const auto any = [&](unsigned n) { return static_cast<std::uint8_t>(rng() % n); };
  const std::uint8_t ids[] = {1, 1, 2, 0, 58};
  const std::uint8_t length = any(10) == 0 ? static_cast<std::uint8_t>(2 + any(127)) : static_cast<std::uint8_t>(2 + any(8));
  Bytes f{':', ':', ids[any(5)], length, commands[any(sizeof commands)]};
  while (f.size() < 3U + length) f.push_back(any(4) == 0 ? ':' : any(256));
  std::uint8_t sum = 0;
  for (std::size_t i = 4; i < f.size(); ++i) sum ^= f[i];
  f.push_back(any(6) == 0 ? any(256) : sum);
  return f;
}

TEST(WholeFrames, LeaveTheProgramAsTheirBytesOneByOneDo) {
  for (const Model model : {Model::maker_pro, Model::advanced}) {
    Pair p(model == Model::advanced ? test::advanced_unit() : ProgramParams{});
    std::mt19937 rng(3);
    std::int64_t now = 0, tick = kTickNs;
    int whole = 0;
    const TickInputs in{{100, -100, 50}, {1700, 1700}, test::kTwelveVolts};
    for (int n = 0; n < 60000; ++n) {
      const Bytes f = any_frame(rng);
      const std::int64_t end = now + kByteNs * static_cast<std::int64_t>(f.size());
      p.a.clear(), p.b.clear();
      for (std::size_t i = 0; i < f.size(); ++i) p.program.receive(p.single, f[i], now + kByteNs * static_cast<int>(i + 1), p.b);
      if (p.program.hears_frames(p.whole, now + kByteNs, end)) {
        ASSERT_TRUE(vsa::bus::whole_frame(f));
        p.program.receive_frame(p.whole, f, end, p.a);
        ++whole;
      } else {
        for (std::size_t i = 0; i < f.size(); ++i) p.program.receive(p.whole, f[i], now + kByteNs * static_cast<int>(i + 1), p.a);
      }
      ASSERT_EQ(said(p.a), said(p.b)) << n;
      expect_same(p.whole, p.single, n);
      now = end + static_cast<std::int64_t>(rng() % 400'000);
      for (; tick <= now; tick += kTickNs) {
        p.program.tick(p.whole, in, tick, p.a);
        p.program.tick(p.single, in, tick, p.b);
      }
    }
    EXPECT_GT(whole, 5000);
  }
}

TEST(WholeFrames, AreToldByTheirHeader) {
  const Bytes ping{':', ':', 1, 2, 0, 0};
  EXPECT_TRUE(vsa::bus::whole_frame(ping));
  for (const Bytes& bad : {Bytes{}, Bytes{':', ':', 1, 2, 0}, Bytes{':', ':', 1, 2, 0, 0, 0}, Bytes{':', ';', 1, 2, 0, 0},
                           Bytes{':', ':', 1, 1, 0}, Bytes{':', ':', 1, 3, 0, 0}})
    EXPECT_FALSE(vsa::bus::whole_frame(bad));
  Bytes longest(132, 0);
  longest[0] = longest[1] = ':';
  longest[3] = 128;
  EXPECT_TRUE(vsa::bus::whole_frame(longest));
  longest.push_back(0);
  longest[3] = 129;
  EXPECT_FALSE(vsa::bus::whole_frame(longest));
}

TEST(Settle, AUnitThatHasBeenOnStandsOnItsReferencesWithItsTurnsCounted) {
  const Program program{ProgramParams{}};
  Memory memory = initial_memory(Model::maker_pro);
  memory.limits_on = 0;
  ProgramState s = program.fresh(0, memory);
  s.loop.ref_new = {70000, -40000};
  const TickInputs in{{70000 - 65536, -40000 + 65536, 0}, {1638, 1638}, test::kTwelveVolts};
  settle(program, s, in);
  EXPECT_EQ(s.loop.meas[0], 70000);
  EXPECT_EQ(s.loop.meas[1], -40000);
  Output out;
  program.tick(s, in, kTickNs, out);
  EXPECT_EQ(s.loop.pwm[0], 0) << "no kick";
  EXPECT_EQ(s.loop.limit_pct, 61);
  EXPECT_TRUE(program.drive(s).enabled[0] && program.drive(s).enabled[1]);
}

}  // namespace
