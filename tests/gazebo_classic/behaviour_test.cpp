// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in as Gazebo Classic loads it from a world file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>

#include "classic_world.hpp"
#include "support/heap.hpp"
#include "vsa/bus/client.hpp"
#include "vsa/serial/serial_channel.hpp"

namespace vsa::test {
namespace {

/// The bench model's own text, with one thing changed.
std::string bench_model(const std::string& what = "", const std::string& with = "") {
  return replaced(model_text("qbmove_bench_load"), what, with);
}

TEST(GazeboClassic, ALoadHangsFromTheModulesSpringsAndNotFromNothing) {
  ClassicWorld w(world_sdf("hanging", include("qbmove_bench_load", "bench", kLeverLevel)));
  const auto q = w.record("bench", 2000);
  for (const double angle : q) ASSERT_TRUE(std::isfinite(angle));
  // 1.05 kg on a lever: far more than friction holds, far less than the springs' end.
  EXPECT_GT(std::abs(q.back()), 5 * kDegree);
  EXPECT_LT(std::abs(q.back()), 60 * kDegree);
  EXPECT_NEAR(q.back(), q[q.size() - 200], 0.5 * kDegree) << "at rest by now";
}

TEST(GazeboClassic, AModuleTurnsToItsInitialEquilibrium) {
  // Stiff, so that the shaft's friction holds it back by little.
  const std::string model = bench_model("equilibrium_rad=\"0\" preset_rad=\"0.2\"", "equilibrium_rad=\"0.8\" preset_rad=\"0.6\"");
  ClassicWorld w(world_sdf("turning", model, false));
  w.run(1);
  EXPECT_LT(std::abs(w.angle("qbmove_bench_load")), 0.1) << "it starts where SDF puts it";
  w.run(3000);
  EXPECT_NEAR(w.angle("qbmove_bench_load"), 0.8, 2 * kDegree);
}

TEST(GazeboClassic, TheSameRunTwiceGivesTheSameBits) {
  const std::string sdf = world_sdf("twice", include("qbmove_bench_load", "bench", kLeverLevel));
  std::vector<double> first, second;
  {
    ClassicWorld w(sdf);
    first = w.record("bench", 500);
  }
  {
    ClassicWorld w(sdf);
    second = w.record("bench", 500);
  }
  EXPECT_GT(std::abs(first.back()), 0.01);
  EXPECT_EQ(first, second);
}

TEST(GazeboClassic, AfterAResetTheRunIsThatOfAFreshWorld) {
  ClassicWorld w(world_sdf("again", include("qbmove_bench_load", "bench", kLeverLevel)));
  const auto first = w.record("bench", 700);
  w.world->Reset();
  const auto second = w.record("bench", 700);
  // Not bit for bit: ODE starts its solver from the last step's forces, a reset or not.
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_NEAR(first[i], second[i], 1e-6) << i;
}

TEST(GazeboClassic, ATimeSetBackLeavesTheActuatorsAsTheyAre) {
  ClassicWorld w(world_sdf("back", include("qbmove_bench_load", "bench", kLeverLevel)));
  w.run(2000);
  const double before = w.angle("bench");
  w.world->ResetTime();
  w.run(1000);
  EXPECT_NEAR(w.angle("bench"), before, 0.2 * kDegree);
}

TEST(GazeboClassic, OtherJointsOfTheModelAreLeftAlone) {
  const std::string extra =
      "<link name='pendulum'><pose>0 0 -0.3 0 0 0</pose><inertial><mass>0.1</mass><inertia><ixx>1e-4</ixx><iyy>1e-4</iyy>"
      "<izz>1e-4</izz></inertia></inertial></link><joint name='free' type='revolute'><parent>world</parent><child>pendulum</child>"
      "<axis><xyz>1 0 0</xyz></axis></joint><plugin name=\"vsa::Robot\"";
  ClassicWorld w(world_sdf("others", bench_model("<plugin name=\"vsa::Robot\"", extra), false));
  w.joint("qbmove_bench_load", "free")->SetVelocity(0, 1.0);
  w.run(1000);
  EXPECT_NEAR(w.angle("qbmove_bench_load", "free"), 1.0, 1e-3) << "turns on without torque";
}

TEST(GazeboClassic, ABareFlangeKickedAtTheStiffestPresetStaysBounded) {
  const std::string model = replaced(model_text("qbmove_bench_free"), "preset_rad=\"0.2\"", "preset_rad=\"0.785\"");
  for (const double step_s : {0.0005, 0.001, 0.002, 0.004}) {
    ClassicWorld w(world_sdf("kick", model, false));
    w.world->Physics()->SetMaxStepSize(step_s);
    w.run(1);
    const auto shaft = w.joint("qbmove_bench_free");
    shaft->SetVelocity(0, 20);
    double largest = 0;
    const auto connection = gazebo::event::Events::ConnectWorldUpdateEnd([&] {
      // As the coupling sees the shaft, docs/explanation/7-host.md: the angle that the engine shows swings further.
      largest = std::max(largest, std::abs(shaft->Position(0) - 0.5 * step_s * shaft->GetVelocity(0)));
    });
    w.run(static_cast<int>(1.0 / step_s));
    EXPECT_LT(largest, 20 * 0.004) << step_s << ": no further than it goes in one of the longest steps";
    EXPECT_LT(std::abs(shaft->GetVelocity(0)), 2.0) << step_s;
  }
}

TEST(GazeboClassic, ABadElementIsOneMessageAndAModelWithoutTorques) {
  std::string model = bench_model("<joint>shaft</joint>", "<joint>shift</joint>");
  model = replaced(model, "<type>qbmove_maker_pro_6_1</type>", "<type>qbmove_maker_pro_6_1</type><stifness>3</stifness>");
  testing::internal::CaptureStderr();
  ClassicWorld w(world_sdf("bad", model));
  w.run(1);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("stays without torques"), std::string::npos) << log;
  EXPECT_NE(log.find("stifness"), std::string::npos) << log;
  const auto before = w.world->SimTime();
  w.run(1000);
  EXPECT_EQ((w.world->SimTime() - before).Double(), 1.0) << "the server lives on";
  EXPECT_EQ(w.joint("qbmove_bench_load")->GetForce(0), 0.0);
}

TEST(GazeboClassic, AnUnknownJointIsAnsweredWithTheJointsThereAre) {
  testing::internal::CaptureStderr();
  ClassicWorld w(world_sdf("unknown", bench_model("<joint>shaft</joint>", "<joint>shift</joint>")));
  w.run(1);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_NE(log.find("did you mean shaft?"), std::string::npos) << log;
}

TEST(GazeboClassic, AClientOnTheSerialPortMovesTheModel) {
  const std::string path = testing::TempDir() + "vsa_classic_" + std::to_string(getpid());
  ClassicWorld w(
      world_sdf("port", bench_model("cycle_s=\"auto\"/>", "cycle_s=\"auto\"><serial_port>" + path + "</serial_port></bus>")));
  w.run(10);
  vsa::serial::SerialChannel channel(path);
  vsa::bus::Client client(channel, {.reply_timeout = std::chrono::seconds(10)});
  ASSERT_TRUE(client.activate(1, true));
  ASSERT_TRUE(client.set_inputs(1, {vsa::Ticks{7000}, vsa::Ticks{5000}}));
  ASSERT_TRUE(client.measurements(1))
      << "the answer comes from the last tick while the world stands; what was said before it is heard";
  w.run(3000);
  const auto answer = client.measurements(1);
  ASSERT_TRUE(answer);
  const double shaft_rad = w.angle("qbmove_bench_load");
  EXPECT_GT(shaft_rad, 20 * kDegree);
  EXPECT_NEAR(answer->positions[2].value * 360 * kDegree / 32768, shaft_rad, 0.5 * kDegree);
}

TEST(GazeboClassic, AStepTooLongForTheUnitsStopsThemWithOneLine) {
  ClassicWorld w(world_sdf("long", include("qbmove_bench_load", "bench", kLeverLevel)));
  w.run(10);
  w.world->Physics()->SetMaxStepSize(0.02);
  testing::internal::CaptureStderr();
  w.run(20);
  const std::string log = testing::internal::GetCapturedStderr();
  const auto first = log.find("give no torque");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("give no torque", first + 1), std::string::npos) << log;
  w.world->Physics()->SetMaxStepSize(0.001);
  w.world->Reset();
  w.run(2000);
  EXPECT_LT(std::abs(w.angle("bench")), 60 * kDegree) << "after a reset they work again";
}

TEST(GazeboClassic, AWorldSlowerThanRealTimeIsToldOnceWhereASerialPortHasAClient) {
  const std::string path = testing::TempDir() + "vsa_classic_slow_" + std::to_string(getpid());
  const std::string port = "cycle_s=\"auto\"><serial_port>" + path + "</serial_port></bus>";
  ClassicWorld w(world_sdf("slow", bench_model("cycle_s=\"auto\"/>", port)));
  w.world->Physics()->SetRealTimeUpdateRate(100);  // a tenth of real time
  testing::internal::CaptureStderr();
  w.run(250);
  const std::string log = testing::internal::GetCapturedStderr();
  const auto first = log.find("slower than real time");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("slower than real time", first + 1), std::string::npos) << log;
}

TEST(GazeboClassic, ModelsSpawnedAndRemovedWhileTheWorldRunsLeakNothing) {
  ClassicWorld w(world_sdf("cycles", include("qbmove_bench_load", "stays", kLeverLevel)));
  const std::string spawned = "<sdf version='1.7'>" + replaced(bench_model(), "\"qbmove_bench_load\"", "\"comes\"") + "</sdf>";
  const int cycles = long_run() ? 100 : 20;
  std::vector<long> kB;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    w.world->InsertModelString(spawned);
    ASSERT_TRUE(w.run_until([&] { return w.world->ModelByName("comes") != nullptr; })) << cycle;
    w.run(20);
    w.world->RemoveModel("comes");
    ASSERT_TRUE(w.run_until([&] { return w.world->ModelByName("comes") == nullptr; })) << cycle;
    kB.push_back(heap_in_use_kB());
  }
  std::cout << "heap in use after each cycle: " << testing::PrintToString(kB) << " kB\n";
  EXPECT_LT(usual_growth(kB), 12) << "kB in a cycle; without the plug-in Gazebo itself takes 4";
  EXPECT_LT(std::abs(w.angle("stays")), 60 * kDegree);
}

}  // namespace
}  // namespace vsa::test
