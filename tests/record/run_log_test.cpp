// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/run_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "record/fake_snake.hpp"
#include "record/mcap_reader.hpp"
#include "record/scratch.hpp"
#include "vsa/errors.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class RunLogTest : public testing::Test {
 protected:
  void log(std::initializer_list<Sample> samples) {
    RunLog log(info_, dir_.path(), 100);
    for (const Sample& s : samples) log.write(s);
    log.close();
  }
  [[nodiscard]] mcap_reader::File file() const { return mcap_reader::read(slurp(dir_.path() / "run.mcap")); }
  [[nodiscard]] json only(const std::string& topic) const {
    const auto messages = file().on(topic);
    EXPECT_EQ(messages.size(), 1u) << topic;
    return messages.empty() ? json() : json::parse(messages[0]);
  }
  Scratch dir_;
  RunInfo info_ = fake::tiny();
};

TEST_F(RunLogTest, HoldsEveryNumberOfAReading) {
  Sample s = fake::tiny_at(1'230'000'000);
  s.actuators[0].motor_speed_rad_per_s = {3, 4};
  s.actuators[0].motor_torque_Nm = {5, 6};
  s.actuators[0].measured = {Ticks{-7}, Ticks{8}, Ticks{-9}};
  log({s});
  EXPECT_EQ(only("/model/arm/actuators"), json::parse(R"({"time_s":1.23,"actuators":[{"name":"elbow","shaft_rad":0.1,
    "shaft_speed_rad_per_s":-2,"equilibrium_command_rad":0.25,"equilibrium_rad":0.2,"preset_command":0.611,"preset":0.6,
    "deflection_rad":-0.1,"stiffness_Nm_per_rad":0.3333333333333333,"torque_Nm":1e-07,"preset_unit":"rad","motor_rad":[0.8,-0.4],
    "motor_speed_rad_per_s":[3,4],"motor_torque_Nm":[5,6],"current_A":[1.5,-1e+22],"measured_motor_ticks":[-7,8],
    "measured_shaft_ticks":-9}]})"));
  EXPECT_EQ(file().messages.at(0).log_time, 1'230'000'000u);
}

TEST_F(RunLogTest, NamesEveryFieldInItsSchema) {
  log({fake::tiny_at(0)});
  const auto f = file();
  for (const auto& m : f.messages) {
    const json schema = json::parse(f.schemas.at(f.channels.at(m.channel).schema).data);
    const json message = json::parse(m.data);
    for (const auto& [key, unused] : message.items()) {
      EXPECT_TRUE(schema.at("properties").contains(key)) << schema["title"] << " " << key;
    }
  }
  const json actuator = json::parse(f.schemas.at(1).data).at("properties").at("actuators").at("items").at("properties");
  EXPECT_EQ(actuator.size(), json::parse(f.on("/model/arm/actuators")[0]).at("actuators")[0].size());
}

TEST_F(RunLogTest, ShowsOneMotorWhereThereIsOne) {
  info_.robots[0].actuators[0].motors = 1;
  info_.robots[0].actuators[0].preset_unit = "";
  log({fake::tiny_at(0)});
  const json a = only("/model/arm/actuators").at("actuators")[0];
  EXPECT_EQ(a.at("motor_rad"), json::parse("[0.8]"));
  EXPECT_EQ(a.at("measured_motor_ticks").size(), 1u);
  EXPECT_EQ(a.at("preset_unit"), "");
}

TEST_F(RunLogTest, PlacesTheLinksInTheWorld) {
  Sample s = fake::tiny_at(2'500'000'001);
  s.poses[1].quaternion = {0.5, 0.1, 0.2, 0.3};
  log({s});
  EXPECT_EQ(only("/world/bench/links"), json::parse(R"({"transforms":[{"timestamp":{"sec":2,"nsec":500000001},
    "parent_frame_id":"world","child_frame_id":"arm::lever","translation":{"x":0.5,"y":0,"z":-1},
    "rotation":{"x":0.1,"y":0.2,"z":0.3,"w":0.5}}]})"));
  EXPECT_EQ(only("/world/bench/static_links").at("transforms").at(0).at("translation"), json::parse(R"({"x":5,"y":5,"z":5})"));
}

TEST_F(RunLogTest, DrawsEveryKindOfShapeInItsLinksFrame) {
  using K = scene::Shape::Kind;
  auto& visuals = info_.links[1].visuals;
  visuals.clear();
  const auto add = [&](K kind, std::array<double, 3> size) {
    visuals.emplace_back();
    visuals.back().kind = kind;
    visuals.back().size = size;
    return &visuals.back();
  };
  add(K::box, {1, 2, 3});
  add(K::sphere, {0.5, 0, 0});
  add(K::cylinder, {0.5, 2, 0});
  const double half_turn = std::sqrt(0.5);
  add(K::capsule, {0.1, 2, 0})->pose = {{1, 0, 0}, {half_turn, 0, half_turn, 0}};  // z turned onto x
  add(K::plane, {4, 6, 0});
  add(K::mesh, {1, 1, 1})->vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  visuals.back().indices = {0, 1, 2};
  log({fake::tiny_at(0)});
  const json e = only("/world/bench/shapes").at("entities").at(1);
  EXPECT_EQ(e.at("frame_id"), "arm::lever");
  EXPECT_EQ(e.at("frame_locked"), true);
  EXPECT_EQ(e.at("cubes").at(0).at("size"), json::parse(R"({"x":1,"y":2,"z":3})"));
  EXPECT_EQ(e.at("cylinders").size(), 2u);
  EXPECT_EQ(e.at("cylinders").at(0).at("size"), json::parse(R"({"x":1,"y":1,"z":2})")) << "diameters and length";
  ASSERT_EQ(e.at("spheres").size(), 3u) << "a sphere and a capsule's two ends";
  EXPECT_EQ(e.at("spheres").at(0).at("size").at("x"), 1);
  EXPECT_NEAR(e.at("spheres").at(1).at("pose").at("position").at("x").get<double>(), 0, 1e-12);
  EXPECT_NEAR(e.at("spheres").at(2).at("pose").at("position").at("x").get<double>(), 2, 1e-12);
  ASSERT_EQ(e.at("triangles").size(), 2u);
  EXPECT_EQ(e.at("triangles").at(0).at("points").at(2), json::parse(R"({"x":2,"y":3,"z":0})"));
  EXPECT_EQ(e.at("triangles").at(1).at("indices"), json::parse("[0,1,2]"));
}

TEST_F(RunLogTest, WritesShapesOnceAndAgainAfterAReset) {
  RunLog log(info_, dir_.path(), 100);
  log.write(fake::tiny_at(0));
  log.write(fake::tiny_at(10'000'000));
  log.restart();
  log.write(fake::tiny_at(0));
  log.write(fake::tiny_at(10'000'000));
  log.close();
  EXPECT_EQ(file().on("/world/bench/shapes").size(), 1u);
  EXPECT_EQ(file().on("/world/bench/links").size(), 2u);
}

TEST_F(RunLogTest, LeavesOutWhatJsonHasNoWordFor) {
  Sample s = fake::tiny_at(0);
  s.actuators[0].torque_Nm = std::numeric_limits<double>::quiet_NaN();
  s.actuators[0].current_A[1] = std::numeric_limits<double>::infinity();
  s.poses[1].position[0] = std::numeric_limits<double>::infinity();
  s.ledger.supply = std::numeric_limits<double>::quiet_NaN();
  log({s});
  const json a = only("/model/arm/actuators").at("actuators")[0];
  EXPECT_FALSE(a.contains("torque_Nm") || a.contains("current_A"));
  EXPECT_TRUE(a.contains("motor_rad"));
  EXPECT_TRUE(only("/world/bench/links").at("transforms").empty());
  EXPECT_FALSE(only("/world/bench/energy").contains("supply_J"));
  EXPECT_EQ(only("/world/bench/energy").at("gravitational_J"), -9.81);
}

TEST_F(RunLogTest, TellsHowTheRunWasMade) {
  info_.faults = "elbow noise_rad=0.01 seed=3";
  log({fake::tiny_at(0)});
  const auto run = file().metadata.at("vsasim.run");
  EXPECT_EQ(run.at("world"), "bench");
  EXPECT_EQ(run.at("step_s"), "0.001");
  EXPECT_EQ(run.at("rate_Hz"), "100");
  EXPECT_EQ(run.at("faults"), "elbow noise_rad=0.01 seed=3");
  EXPECT_FALSE(run.at("version").empty());
  EXPECT_EQ(file().channels.at(1).metadata.at("elbow"), "qbmove_maker_pro_6_1");
}

TEST_F(RunLogTest, GivesEachRobotATopicOfItsOwnWhateverTheNames) {
  info_.robots[0].model = "lab::\"arm\"\xff";
  info_.robots.push_back(info_.robots[0]);
  Sample s = fake::tiny_at(0);
  s.actuators.push_back(s.actuators[0]);
  log({s});
  const auto f = file();
  EXPECT_EQ(f.channels.at(1).topic, "/model/lab/\"arm\"\uFFFD/actuators");
  EXPECT_EQ(f.channels.at(2).topic, "/model/lab/\"arm\"\uFFFD/actuators_2");
}

TEST_F(RunLogTest, SaysWhyItCantWrite) {
  fs::create_symlink("/dev/full", dir_.path() / "run.mcap");
  const std::string message = message_of<InputError>([&] { RunLog(info_, dir_.path(), 100); });
  EXPECT_NE(message.find("run.mcap: can't write: No space left on device"), std::string::npos) << message;
}

}  // namespace
}  // namespace vsa::record
