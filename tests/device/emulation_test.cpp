// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/emulation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "support/one_joint.hpp"
#include "vsa/bus/client.hpp"
#include "vsa/device/unit_batch.hpp"

namespace {

using namespace vsa;
using Clock = bus::SerialLine::Clock;
using namespace std::chrono_literals;

/// Units whose wall clock is the test's.
struct Bench {
  explicit Bench(int units) : emulation(make(units), {}, [this] { return wall; }) {}
  static std::vector<device::EmulatedUnit> make(int units) {
    std::vector<device::EmulatedUnit> out;
    for (int i = 0; i < units; ++i) out.push_back({test::maker_pro(), i + 1, false, 0.0});
    return out;
  }
  /// Simulation and wall together.
  void run(std::chrono::milliseconds time) {
    for (; time > 0ms; time -= 1ms) {
      wall += 1ms;
      sim_ns += 1'000'000;
      emulation.advance(sim_ns);
    }
  }
  Clock::time_point wall{1h};
  std::int64_t sim_ns = 0;
  device::Emulation emulation;
};

/// A client on it whose waiting is the bench's time.
class BenchChannel final : public bus::Channel {
 public:
  explicit BenchChannel(Bench& bench, bool simulation_runs = true) : bench_(bench), runs_(simulation_runs) {}
  bool write(std::span<const std::uint8_t> bytes) override {
    bench_.emulation.line().exchange(bytes, answer_);
    return true;
  }
  std::optional<std::size_t> read(std::span<std::uint8_t> into, Time timeout) override {
    for (Time waited{};; waited += 100us) {
      bench_.emulation.line().exchange({}, answer_);
      if (!answer_.empty() || waited >= timeout) break;
      bench_.wall += 100us;
      if (runs_ && (waited / 100us) % 10 == 9) bench_.wall -= 1ms, bench_.run(1ms);
    }
    const std::size_t n = std::min(into.size(), answer_.size());
    std::copy_n(answer_.begin(), n, into.begin());
    answer_.erase(answer_.begin(), answer_.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }
  Time now() const override { return bench_.wall.time_since_epoch(); }

 private:
  Bench& bench_;
  bool runs_;
  std::vector<std::uint8_t> answer_;
};

TEST(Emulation, AClientPingsActivatesMovesAndReadsAnyUnitOfTheChain) {
  Bench bench(12);
  bench.run(10ms);
  BenchChannel channel(bench);
  bus::Client client(channel, {});
  for (std::uint8_t id = 1; id <= 12; ++id) ASSERT_TRUE(client.ping(id)) << int{id};
  EXPECT_FALSE(client.ping(13));
  ASSERT_TRUE(client.activate(7, true));
  bench.run(5ms);
  ASSERT_TRUE(client.set_inputs(7, {Ticks{3000}, Ticks{1000}}));
  bench.run(1500ms);
  const auto m = client.measurements(7);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->positions[0].value, 3000, 300) << "the loop's dead band";
  EXPECT_NEAR(m->positions[1].value, 1000, 300);
  const int middle = (m->positions[0].value + m->positions[1].value) / 2;
  EXPECT_NEAR(m->positions[2].value, middle, 250) << "a free shaft goes to the equilibrium, up to its friction";
  EXPECT_NEAR(bench.emulation.read(7 - 1).shaft_rad, m->positions[2].value * kPi / 16384, 0.01);
  EXPECT_EQ(bench.emulation.read(0).motor_rad[0], 0.0);
}

TEST(Emulation, AClientAtAnotherRateIsNotHeardAndThatIsCounted) {
  Bench bench(2);
  bench.run(10ms);
  BenchChannel channel(bench);
  bus::Client client(channel, {});
  EXPECT_TRUE(client.ping(1)) << "who says nothing of rates has the line's";
  for (const std::int64_t rate : {460'800, 1'000'000, 38'400, 1, 0}) {
    bench.emulation.line().set_rate(rate);
    const auto before = bench.emulation.line().wrong_rate().bytes;
    EXPECT_FALSE(client.ping(1)) << rate;
    EXPECT_GE(bench.emulation.line().wrong_rate().bytes, before + 6) << rate;
    EXPECT_EQ(bench.emulation.line().wrong_rate().client_Hz, rate);
  }
  const auto text = bench.emulation.line().wrong_rate().text();
  EXPECT_NE(text.find("the units listen at 2000000"), std::string::npos) << text;
  for (const std::int64_t rate : {1'980'000, 2'000'000}) {
    const auto before = bench.emulation.line().wrong_rate().bytes;
    bench.emulation.line().set_rate(rate);
    EXPECT_TRUE(client.ping(2)) << rate;
    EXPECT_EQ(bench.emulation.line().wrong_rate().bytes, before);
  }
}

TEST(Emulation, AClientFollowsAUnitToTheRateItTellsItToTake) {
  Bench bench(2);
  bench.run(10ms);
  bench.emulation.line().set_rate(2'000'000);
  BenchChannel channel(bench);
  bus::Client client(channel, {});
  std::vector<std::uint8_t> answer;
  bench.emulation.line().exchange(bus::encode_request({}, 1, bus::SetBaudRate{13}).view(), answer);
  bench.run(5ms);
  EXPECT_FALSE(client.ping(1));
  EXPECT_TRUE(client.ping(2)) << "the other one stays";
  bench.emulation.line().set_rate(460'800);
  EXPECT_TRUE(client.ping(1));
  EXPECT_FALSE(client.ping(2));
  EXPECT_EQ(bench.emulation.line().wrong_rate().bytes, 0U) << "one of the units hears it";
}

TEST(Emulation, WhereAnyRateIsTakenAllAreHeard) {
  Bench bench(1);
  bench.run(10ms);
  bench.emulation.line().take_any_rate();
  BenchChannel channel(bench);
  bus::Client client(channel, {});
  for (const std::int64_t rate : {0, 38'400, 460'800, 2'000'000}) {
    bench.emulation.line().set_rate(rate);
    EXPECT_TRUE(client.ping(1)) << rate;
  }
  EXPECT_EQ(bench.emulation.line().wrong_rate().bytes, 0U);
}

TEST(Emulation, InfoListAndStoreGoThroughThePort) {
  Bench bench(2);
  bench.run(10ms);
  BenchChannel channel(bench);
  bus::Client client(channel, {});
  const auto info = client.info(2);
  ASSERT_TRUE(info);
  EXPECT_NE(info->find("Max stiffness: 3000"), std::string::npos);
  const auto parameters = client.parameters(1);
  ASSERT_TRUE(parameters);
  EXPECT_EQ(parameters->id, 1);
  ASSERT_TRUE(client.set_parameter(1, bus::ParameterId::id, std::uint8_t{5}));
  ASSERT_TRUE(client.store(1));
  bench.run(5ms);
  EXPECT_TRUE(client.ping(5));
  EXPECT_FALSE(client.ping(1));
}

TEST(Emulation, AnAnswerIsThereAtOnceEvenIfNoTickComes) {
  Bench bench(12);
  bench.run(10ms);
  std::vector<std::uint8_t> answer;
  const auto request = bus::encode_request({}, 3, bus::GetMeasurements{});
  bench.emulation.line().exchange(request.view(), answer);
  EXPECT_EQ(answer.size(), 12U);
  // The simulation stands; the client goes on for a second.
  BenchChannel channel(bench, false);
  bus::Client client(channel, {});
  for (int n = 0; n < 200; ++n) {
    ASSERT_TRUE(client.measurements(static_cast<std::uint8_t>(1 + n % 12))) << n;
    bench.wall += 5ms;
  }
  ASSERT_TRUE(client.set_parameter(1, bus::ParameterId::current_limit, std::int16_t{900}));
  EXPECT_TRUE(client.store(1)) << "a store takes its time on the wall";
}

TEST(Emulation, ATickIsNeverLostWhateverTheClientSends) {
  Bench bench(2);
  bench.run(10ms);
  std::vector<std::uint8_t> answer;
  const std::vector<std::uint8_t> flood(20'000, 0x55);
  for (int n = 0; n < 20; ++n) {
    bench.emulation.line().exchange(flood, answer);
    bench.run(1ms);
  }
  EXPECT_GT(bench.emulation.line().lost(), 300'000U);
  bench.run(50ms);  // what waits gets through: 4096 bytes take 20 ms
  BenchChannel channel(bench);
  bus::Client client(channel, {});
  EXPECT_TRUE(client.ping(1));
  EXPECT_TRUE(client.ping(2));
}

TEST(Emulation, AFastSimulationTakesTheLineAlong) {
  Bench bench(1);
  bench.run(10ms);
  std::vector<std::uint8_t> answer;
  bench.emulation.line().exchange(bus::encode_request({}, 1, bus::StoreParameters{}).view(), answer);
  EXPECT_TRUE(answer.empty());
  bench.emulation.advance(bench.sim_ns += 100'000'000);  // without any time on the wall
  bench.emulation.line().exchange({}, answer);
  EXPECT_EQ(answer.size(), 6U) << "seven rows of EEPROM in simulated time";
}

TEST(Emulation, WakesWhenAStoreIsDone) {
  Bench bench(1);
  bench.run(10ms);
  std::vector<std::uint8_t> answer;
  EXPECT_FALSE(bench.emulation.line().wake());
  bench.emulation.line().exchange(bus::encode_request({}, 1, bus::StoreParameters{}).view(), answer);
  for (int n = 0; n < 50 && answer.empty(); ++n) {
    const auto wake = bench.emulation.line().wake();
    ASSERT_TRUE(wake);
    ASSERT_GT(*wake, bench.wall);
    bench.wall = *wake;
    bench.emulation.line().exchange({}, answer);
  }
  EXPECT_EQ(answer.size(), 6U);
  EXPECT_FALSE(bench.emulation.line().wake());
}

/// Units of two types in turns, some held, some off, some at fault, after commands to one after the other; all that they do.
std::vector<double> mixed_line(std::string_view instructions) {
  auto other = test::maker_pro();
  other.actuator.transmission = std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{{0.03, 0.02}, {6.0, 6.5}});
  std::vector<device::EmulatedUnit> units;
  for (int id = 1; id <= 23; ++id) units.push_back({id % 3 == 0 ? other : test::maker_pro(), id, id % 5 == 0, 0.1 * (id % 4)});
  device::Emulation e(
      std::move(units), {}, [] { return Clock::time_point{}; }, instructions);
  device::Faults fault;
  fault.motor_unplugged[0] = true;
  fault.encoder[1].noise_rad = 0.01;
  e.set_faults(3, fault);
  std::vector<double> out;
  std::vector<std::uint8_t> answer;
  for (int n = 0; n < 600; ++n) {
    const auto id = static_cast<std::uint8_t>(1 + n % 23);
    if (n < 23 && id % 7 != 0) e.line().exchange(bus::encode_request({}, id, bus::Activate{3}).view(), answer);
    if (n > 400 && n % 23 == 8) e.line().exchange(bus::encode_request({}, 9, bus::Activate{0}).view(), answer);
    const auto x = static_cast<std::int16_t>(9000.0 * std::sin(0.01 * n)), y = static_cast<std::int16_t>(n % 2 == 0 ? x : -x);
    e.line().exchange(bus::encode_request({}, id, bus::SetInputs{{Ticks{x}, Ticks{y}}}).view(), answer);
    e.line().exchange(bus::encode_request({}, id, bus::GetMeasurements{}).view(), answer);
    e.advance((n + 1) * 1'000'000);
    for (std::size_t i = 0; i < e.size(); ++i) {
      const auto r = e.read(i);
      out.insert(out.end(), {r.motor_rad[0], r.motor_rad[1], r.shaft_rad, r.shaft_speed_rad_per_s, r.torque_Nm});
    }
  }
  out.insert(out.end(), answer.begin(), answer.end());
  return out;
}

TEST(Emulation, UnitsSideBySideDoToTheLastBitWhatEachDoesByItself) {
  const std::vector<double> alone = mixed_line("none");
  EXPECT_GT(std::count_if(alone.begin(), alone.end(), [](double x) { return std::abs(x) > 0.2; }), 10'000) << "they move";
  EXPECT_EQ(mixed_line(""), alone);
  for (const std::string_view set : device::UnitBatch::instruction_sets()) EXPECT_EQ(mixed_line(set), alone) << set;
}

TEST(Emulation, AHeldShaftStays) {
  device::Emulation e({{test::maker_pro(), 1, true, 0.3}});
  e.advance(500'000'000);
  EXPECT_EQ(e.read(0).shaft_rad, 0.3);
  EXPECT_NE(e.read(0).torque_Nm, 0.0);
}

TEST(Emulation, RefusesIdsThatCannotBe) {
  const auto config = test::maker_pro();
  EXPECT_THROW(device::Emulation({}), InputError);
  try {
    device::Emulation e({{config, 0}, {config, 255}, {config, 3}, {config, 3}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 3U);
  }
}

TEST(Emulation, ClientAndSimulationRunInTheirOwnThreads) {
  device::Emulation e(Bench::make(4));
  std::atomic<bool> stop{false};
  std::thread client([&] {
    std::vector<std::uint8_t> answer;
    for (int n = 0; n < 3'000; ++n) {
      const auto id = static_cast<std::uint8_t>(1 + n % 4);
      e.line().exchange(bus::encode_request({}, id, bus::SetInputs{{Ticks{static_cast<std::int16_t>(n)}, Ticks{}}}).view(), answer);
      e.line().exchange(bus::encode_request({}, id, bus::GetMeasurements{}).view(), answer);
      (void)e.line().wake();
      device::Faults late;
      late.late_s = n % 200 == 0 ? 0.001 : 0.0;
      if (n % 100 == 0) e.set_faults(static_cast<std::size_t>(n / 100 % 4), late);
    }
    stop = true;
  });
  for (std::int64_t t = 0; !stop; t += 1'000'000) e.advance(t);
  client.join();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(e.read(i).shaft_rad));
}

}  // namespace
