// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot's bus as the units meet it: when frames arrive, who answers, what faults do.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <future>
#include <new>

#include "host/free_flanges.hpp"
#include "vsa/bus/client.hpp"
#include "vsa/errors.hpp"

void fail_allocation(long nth);  // allocation_count.cpp

namespace {

using namespace vsa;
using vsa::host::Robot;
using vsa::test::chain;
using vsa::test::Flanges;

/// Steps of one byte's time: in which one does each unit's answer show that its references are new? The unit's own GET_INPUTS isn't
/// asked by the master, so the motors tell: with 5 µs steps a tick is seen within a step.
TEST(RobotChain, EachUnitsReferencesArriveWhenTheWireModelSaysWithinAByte) {
  Flanges bench(chain(12), 5'000);
  bench.run(2);
  std::vector<Robot::Command> commands;
  for (std::size_t i = 0; i < 12; ++i) commands.push_back({i, 0.3, std::nullopt});
  while (bench.t_ns < 11'999'000) bench.step();
  ASSERT_TRUE(bench.robot.command(commands));  // before the cycle that begins at 12 ms
  const auto schedule = bus::make_schedule(12, 2e6, std::nullopt);
  std::vector<std::int64_t> arrived(12, 0);
  std::vector<std::array<Ticks, 2>> before(12);
  for (std::size_t i = 0; i < 12; ++i) before[i] = bench.robot.received_inputs(i);
  while (bench.t_ns < 24'000'000) {
    bench.step();
    for (std::size_t i = 0; i < 12; ++i)
      if (arrived[i] == 0 && bench.robot.received_inputs(i) != before[i]) arrived[i] = bench.t_ns;
  }
  for (int k = 0; k < 12; ++k)
    EXPECT_NEAR(static_cast<double>(arrived[static_cast<std::size_t>(k)]),
                static_cast<double>(schedule.inputs_at_ns(12'000'000, k)), 5'000)
        << "unit " << k + 1;
  EXPECT_EQ(schedule.inputs_at_ns(0, 11) - schedule.inputs_at_ns(0, 0), 11 * 28 * 5000);
}

TEST(RobotChain, AUnitWithoutPowerIsLimpSilentAndComesBackSwitchedOff) {
  Flanges bench(chain(3));
  bench.run(50);
  const auto measured = bench.robot.read(1).measured;
  device::Faults off;
  off.powered = false;
  bench.robot.set_faults(1, off);
  for (std::size_t i = 0; i < 3; ++i) bench.robot.command(i, 0.8, std::nullopt);
  bench.run(1000);
  EXPECT_EQ(bench.robot.read(1).measured, measured) << "nobody answers";
  EXPECT_NEAR(bench.robot.read(1).equilibrium_rad, 0.0, 0.02) << "nobody drives";
  EXPECT_GT(bench.robot.read(0).equilibrium_rad, 0.6);
  EXPECT_GT(bench.robot.read(2).equilibrium_rad, 0.6);
  device::Faults on;
  on.encoder[2].noise_rad = 0.1;
  bench.robot.set_faults(1, on);
  bench.run(500);
  EXPECT_NE(bench.robot.read(1).measured[2], measured[2]) << "answers again";
  EXPECT_NEAR(bench.robot.read(1).equilibrium_rad, 0.0, 0.02) << "motors stay off after a power-up";
}

TEST(RobotChain, LostBytesCostFramesAndTheUnitStillFollows) {
  Flanges bench(chain(2));
  device::Faults bad;
  bad.lost_byte = 0.05;
  bad.flipped_byte = 0.05;
  bench.robot.set_faults(0, bad);
  bench.robot.command(0, 0.8, std::nullopt);
  bench.run(1500);
  EXPECT_NEAR(bench.robot.read(0).equilibrium_rad, 0.8, 0.1);
}

TEST(RobotChain, AStuckShaftEncoderReadsTheSameForEverAndANoisyOneDoesNot) {
  Flanges bench(chain(2));
  bench.run(100);
  device::Faults stuck, noisy;
  stuck.encoder[2].stuck = true;
  noisy.encoder[2].noise_rad = 0.05;
  bench.robot.set_faults(0, stuck);
  bench.robot.set_faults(1, noisy);
  const auto before = bench.robot.read(0).measured[2];
  bench.robot.command(0, 0.8, std::nullopt);
  bench.run(1000);
  EXPECT_EQ(bench.robot.read(0).measured[2], before);
  EXPECT_GT(bench.robot.read(0).shaft_rad, 0.5);
  int changes = 0;
  for (int n = 0; n < 50; ++n) {
    const auto last = bench.robot.read(1).measured[2];
    bench.run(2);
    changes += bench.robot.read(1).measured[2] != last ? 1 : 0;
    EXPECT_NEAR(radians(Raw{2 * bench.robot.read(1).measured[2].value}), bench.robot.read(1).shaft_rad, 0.06);
  }
  EXPECT_GT(changes, 40);
}

TEST(RobotChain, ASaggingSupplySlowsTheMotors) {
  const auto speed = [](std::optional<double> volts) {
    Flanges bench(chain(1));
    device::Faults f;
    f.supply_V = volts;
    bench.robot.set_faults(0, f);
    bench.run(50);
    bench.robot.command(0, 2.0, std::nullopt);
    bench.run(300);
    return bench.robot.read(0).motor_speed_rad_per_s[0];
  };
  const double full = speed(std::nullopt);
  EXPECT_GT(full, 3.0);
  EXPECT_LT(speed(6.0), 0.8 * full);
  EXPECT_NEAR(speed(0.0), 0.0, 0.05);
  const auto at = [](double volts) { return (0.8 * volts / 2.3 - 0.8) / (0.01 + 0.8 * 1.3 / 2.3); };
  EXPECT_NEAR(speed(24.0), at(43.0 / 101.0 * 24.0), 0.1) << "the program's limit is 43 % there";
}

TEST(RobotChain, AnUnpluggedMotorTakesNoCurrentAndTheOtherOneGoes) {
  Flanges bench(chain(1));
  bench.run(20);
  device::Faults f;
  f.motor_unplugged[0] = true;
  bench.robot.set_faults(0, f);
  bench.robot.command(0, 0.8, std::nullopt);
  bench.run(300);
  EXPECT_EQ(bench.robot.read(0).current_A[0], 0.0);
  EXPECT_GT(bench.robot.read(0).motor_rad[1] + 0.3, 0.5) << "motor 2 on its way";
  EXPECT_LT(std::abs(bench.robot.read(0).motor_rad[0] - 0.3), 0.3) << "motor 1 only as far as the springs pull";
}

TEST(RobotChain, LateAnswersSpoilTheFramesTheyMeetAndNoCommandIsLostForEver) {
  Flanges bench(chain(12));
  device::Faults late;
  late.late_s = 300e-6;  // unit 1 talks into unit 3's slot
  bench.robot.set_faults(0, late);
  bench.run(30);
  const auto unit_3 = bench.robot.read(2).measured;
  for (std::size_t i = 0; i < 12; ++i) bench.robot.command(i, 0.8, std::nullopt);
  bench.run(1000);
  EXPECT_GT(bench.robot.read(11).equilibrium_rad, 0.6);
  EXPECT_NE(bench.robot.read(11).measured[0], unit_3[0]);
  const Ticks seen = bench.robot.read(2).measured[0];
  bench.robot.set_faults(0, {});
  bench.run(30);
  EXPECT_NE(bench.robot.read(2).measured[0], seen) << "unit 3 is heard again";
}

TEST(RobotChain, FaultsRepeatGoWithASnapshotAndEndWithAReset) {
  Flanges bench(chain(3));
  device::Faults bad;
  bad.lost_byte = 0.1;
  bad.encoder[0].noise_rad = 0.02;
  bad.late_s = 2e-4;
  const auto history = [&] {
    std::vector<double> h;
    for (int n = 0; n < 300; ++n) {
      if (n == 20) bench.robot.command(1, 0.7, 0.5);
      bench.step();
      h.insert(h.end(), bench.out.begin(), bench.out.end());
      for (std::size_t i = 0; i < 3; ++i) h.push_back(bench.robot.read(i).measured[0].value);
    }
    return h;
  };
  const auto clean = history();
  bench.robot.set_faults(1, bad);
  bench.run(37);
  const auto snapshot = bench.robot.snapshot();
  const auto in = bench.in;
  const auto t = bench.t_ns;
  const auto a = history();
  bench.robot.restore(*snapshot);
  bench.in = in;
  bench.t_ns = t;
  EXPECT_EQ(bench.robot.faults(1), bad);
  EXPECT_EQ(history(), a);
  bench.robot.reset();
  bench.in.assign(3, {0, 0, 1e3});
  bench.t_ns = 0;
  EXPECT_EQ(bench.robot.faults(1), device::Faults{});
  EXPECT_EQ(history(), clean);
}

TEST(RobotChain, RefusesFaultsOutOfBounds) {
  Flanges bench(chain(1));
  device::Faults bad;
  bad.lost_byte = 1.5;
  bad.flipped_byte = std::nan("");
  bad.late_s = -1;
  bad.encoder[1].noise_rad = 9;
  bad.supply_V = -3;
  try {
    bench.robot.set_faults(0, bad);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().size(), 5U);
  }
  EXPECT_THROW(bench.robot.set_faults(1, {}), InputError);
}

TEST(RobotChain, AHostWhoseTimeJumpsIsNotNoticedByTheUnits) {
  Flanges a(chain(3)), b(chain(3));
  for (Flanges* bench : {&a, &b}) bench->run(100);
  b.t_ns += 5'000'000'000;
  for (Flanges* bench : {&a, &b}) {
    bench->robot.command(2, 0.6, std::nullopt);
    bench->run(400);
  }
  EXPECT_EQ(a.in[2].angle_rad, b.in[2].angle_rad);
  EXPECT_EQ(a.robot.read(2).measured, b.robot.read(2).measured);
}

host::RobotConfig with_port(std::size_t count) {
  auto config = chain(count);
  config.buses[0].serial_port = "vsa-test";
  return config;
}

TEST(RobotPort, AClientMovesTheUnitsAndCommandsAreNotTaken) {
  Flanges bench(with_port(2));
  ASSERT_NE(bench.robot.serial_line(0), nullptr);
  EXPECT_EQ(bench.robot.serial_line(1), nullptr);
  bench.run(20);
  bench.robot.command(0, 1.0, std::nullopt);
  bench.run(500);
  EXPECT_NEAR(bench.robot.read(0).equilibrium_rad, 0.0, 0.02);
  EXPECT_EQ(bench.robot.read(0).equilibrium_command_rad, 0.0) << "and the state doesn't say that they were";
  const auto notices = bench.robot.take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].text.find("vsa-test"), std::string::npos);
  std::vector<std::uint8_t> answer;
  const bus::SetInputs inputs{{Ticks{3000}, Ticks{3000}}};
  bench.robot.serial_line(0)->exchange(bus::encode_request({}, 1, inputs).view(), answer);
  bench.run(1500);
  EXPECT_NEAR(bench.robot.read(0).motor_rad[0], 3000 * kPi / 16384, 0.06);
  EXPECT_NEAR(bench.robot.read(1).motor_rad[0], 0.3, 0.06) << "the other one holds what it began with";
  bench.robot.serial_line(0)->exchange(bus::encode_request({}, 2, bus::GetMeasurements{}).view(), answer);
  bus::MasterReceiver receiver;
  bus::Frame frame;
  receiver.push(answer);
  ASSERT_TRUE(receiver.next(frame));
  const auto reply = bus::decode_reply<bus::MeasurementsReply>({}, bus::Command::get_measurements, frame);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->positions, bench.robot.read(1).measured);
}

TEST(RobotPort, AClientAtAnotherRateIsToldOnce) {
  Flanges bench(with_port(2));
  bench.run(20);
  bench.robot.serial_line(0)->set_rate(460'800);
  std::vector<std::uint8_t> answer;
  std::vector<std::string> said;
  for (int n = 0; n < 3; ++n) {
    bench.robot.serial_line(0)->exchange(bus::encode_request({}, 1, bus::Ping{}).view(), answer);
    bench.run(200);
    for (const auto& notice : bench.robot.take_notices()) said.push_back(notice.text);
  }
  EXPECT_TRUE(answer.empty());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("bus spine: the client's serial port is set to 460800 bit/s, the units listen at 2000000"),
            std::string::npos)
      << said[0];
  auto config = with_port(1);
  config.buses[0].any_rate = true;
  Flanges lenient(config);
  lenient.run(20);
  lenient.robot.serial_line(0)->set_rate(460'800);
  lenient.robot.serial_line(0)->exchange(bus::encode_request({}, 1, bus::Ping{}).view(), answer);
  EXPECT_FALSE(answer.empty());
}

TEST(RobotPort, ASnapshotThatMemoryDoesNotSufficeForLeavesTheBusesToTheirClients) {
  auto config = with_port(2);
  config.buses.push_back({"other", 2e6, std::nullopt, "vsa-other"});
  config.actuators[1].bus = 1;
  Robot robot(config);
  const auto client_gets_in = [&robot](std::size_t bus) {
    auto exchange = std::async(std::launch::async, [&robot, bus] {
      std::vector<std::uint8_t> answer;
      robot.serial_line(bus)->exchange({}, answer);
    });
    const bool got_in = exchange.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
    if (!got_in) robot.serial_line(bus)->unlock();  // we hold it
    return got_in;
  };
  int failures = 0;
  for (bool whole = false; !whole; ++failures) {
    ASSERT_LT(failures, 1000);
    fail_allocation(failures + 1);
    try {
      whole = robot.snapshot() != nullptr;
    } catch (const std::bad_alloc&) {
    }
    fail_allocation(0);
    for (const std::size_t bus : {0U, 1U}) ASSERT_TRUE(client_gets_in(bus)) << "bus " << bus << ", allocation " << failures + 1;
  }
  EXPECT_GT(failures, 3);
}

TEST(RobotPort, WithoutAClientARunRepeatsBitForBit) {
  Flanges a(with_port(2)), b(with_port(2));
  a.run(300);
  b.run(300);
  EXPECT_EQ(a.in[1].angle_rad, b.in[1].angle_rad);
  a.robot.reset();
  a.in.assign(2, {0, 0, 1e3});
  a.t_ns = 0;
  a.run(300);
  EXPECT_EQ(a.in[1].angle_rad, b.in[1].angle_rad);
}

}  // namespace
