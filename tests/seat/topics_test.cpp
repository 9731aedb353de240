// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a seat says and hears: notices, topics, faults.
#include <gtest/gtest.h>

#include <chrono>

#include "host/topics_fixture.hpp"
#include "seat/seats.hpp"

namespace vsa::seat::testing {
namespace {

struct Told {
  std::vector<std::string> lines;
  Options options;
  Told() {
    options.report = [this](const std::string& line) { lines.push_back(line); };
  }
};

void run(Seat& seat, int steps, std::int64_t& time_ns) {
  Pendulums host;
  for (int k = 0; k < steps; ++k) {
    host.step(seat);
    seat.publish_step(time_ns += Pendulums::kStep_ns);
  }
}

TEST(SeatTopics, WithoutTopicsNoticesAreToldTenTimesASimulatedSecond) {
  Told told;
  Seat seat(model(), told.options);
  std::int64_t time_ns = 0;
  run(seat, 5, time_ns);
  seat.robot().command(0, 0.0, 9.0);
  run(seat, 90, time_ns);
  EXPECT_TRUE(told.lines.empty());
  run(seat, 5, time_ns);
  ASSERT_EQ(told.lines.size(), 1U);
  EXPECT_EQ(told.lines[0].rfind("lab::arm: shoulder: preset 9", 0), 0U) << told.lines[0];
  seat.robot().command(1, 0.0, 9.0);
  run(seat, 1, time_ns);
  seat.publish(time_ns);
  EXPECT_EQ(told.lines.size(), 2U) << "at once where it is asked for";
}

TEST(SeatTopics, ARobotCanBeCommandedAndSeenOnEveryPortThatItIsConnectedTo) {
  Told told;
  Seat seat(model(), told.options);
  const auto one = std::make_shared<test::FakeTransport>(), two = std::make_shared<test::FakeTransport>();
  seat.connect(one);
  seat.connect(two);
  std::int64_t time_ns = 0;
  two->doubles.at("/model/lab/arm/joint/elbow/cmd_equilibrium")(0.25);
  run(seat, 30, time_ns);
  EXPECT_EQ(seat.robot().read(1).equilibrium_command_rad, 0.25);
  EXPECT_EQ(one->wire->states.size(), 4U) << "at once and at 10, 20 and 30 ms";
  EXPECT_EQ(two->wire->states.size(), 4U);
  one->doubles.at("/model/lab/arm/joint/elbow/cmd_equilibrium")(NAN);
  EXPECT_EQ(seat.refused(), 1U);
  seat.disconnect();
  run(seat, 30, time_ns);
  EXPECT_EQ(one->wire->states.size(), 4U);
  two->doubles.at("/model/lab/arm/joint/elbow/cmd_equilibrium")(0.5);
  run(seat, 1, time_ns);
  EXPECT_EQ(seat.robot().read(1).equilibrium_command_rad, 0.25) << "handlers that a transport still has do nothing";
}

TEST(SeatTopics, FaultsAreAServiceOfTheRobotUntilItIsDisconnected) {
  Seat seat(model(), {});
  const auto transport = std::make_shared<test::FakeTransport>();
  seat.connect(transport);
  const auto& ask = transport->services.at("/model/lab/arm/vsa/faults");
  std::int64_t time_ns = 0;
  EXPECT_EQ(ask("elbow supply_V=7"), "ok: elbow");
  run(seat, 1, time_ns);
  EXPECT_EQ(seat.robot().faults(1).supply_V, 7.0);
  const std::string refused = ask("elbow supply_V=700").value_or("");
  EXPECT_EQ(refused.rfind("refused: ", 0), 0U) << refused;
  EXPECT_NE(refused.find("/model/lab/arm/vsa/faults"), std::string::npos) << refused;
  seat.disconnect();
  EXPECT_EQ(ask("all off"), std::nullopt);
}

TEST(SeatTopics, ATransportThatTakesNoSuchServiceIsAnErrorAndOneWithoutServicesIsnt) {
  Seat seat(model(), {});
  const auto transport = std::make_shared<test::FakeTransport>();
  transport->of_services = host::Outcome::unsupported;
  EXPECT_NO_THROW(seat.connect(transport));
  transport->of_services = host::Outcome::refused;
  EXPECT_THROW(seat.connect(transport), InputError);
}

TEST(SeatTopics, OneActuatorOrAllAreBrokenOrNoneWhereSomethingIsWrong) {
  Seat seat(model(), {});
  std::int64_t time_ns = 0;
  EXPECT_EQ(seat.apply_faults("elbow supply_V=7", "").size(), 1U);
  run(seat, 1, time_ns);
  EXPECT_EQ(seat.robot().faults(0), device::Faults{});
  EXPECT_EQ(seat.robot().faults(1).supply_V, 7.0);
  EXPECT_EQ(seat.apply_faults(" all off", "").size(), 2U);
  run(seat, 1, time_ns);
  EXPECT_FALSE(seat.robot().faults(0).powered || seat.robot().faults(1).powered);
  EXPECT_NE(seat.robot().faults(0).seed, seat.robot().faults(1).seed);
  EXPECT_THROW((void)seat.apply_faults("wrist none", ""), InputError);
  EXPECT_THROW((void)seat.apply_faults("all none stuck=x", ""), InputError);
  EXPECT_THROW((void)seat.apply_faults("", ""), InputError);
  run(seat, 1, time_ns);
  EXPECT_FALSE(seat.robot().faults(0).powered);
}

/// An elbow without a bus can't lose bytes, and then the shoulder doesn't either.
TEST(SeatFaults, OfAllAreSetOfNoneWhereOneCannotHaveThem) {
  std::string xml = element();
  const std::size_t at = xml.rfind("qbmove_maker_pro_6_1");
  xml.replace(at, std::string("qbmove_maker_pro_6_1").size(), "ugurlu_sea");
  Seat seat(model(xml), {});
  EXPECT_THROW((void)seat.apply_faults("all lost_byte=0.5", ""), InputError);
  Pendulums world;
  world.tell(seat);
  seat.step(Pendulums::kStep_ns);
  EXPECT_EQ(seat.robot().faults(0), device::Faults{});
}

TEST(SeatTopics, WhileTheHostStandsTheStateIsPublishedTenTimesAWallSecondAtMost) {
  Seat seat(model(), {});
  const auto transport = std::make_shared<test::FakeTransport>();
  seat.connect(transport);
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 50; ++k) seat.publish_paused(0);
  const auto tenths = (std::chrono::steady_clock::now() - begin) / std::chrono::milliseconds(100);
  EXPECT_GE(transport->wire->states.size(), 1U);
  EXPECT_LE(transport->wire->states.size(), 1U + static_cast<std::size_t>(tenths));
}

}  // namespace
}  // namespace vsa::seat::testing
