// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The second World of a file: made of what was read for the first, unless something has changed. Two worlds share what was read
// where their links() lie at the same place.
#include <unistd.h>

#include <chrono>
#include <thread>

#include "arm.hpp"

namespace vsa::engine::testing {
namespace {

namespace fs = std::filesystem;

bool share(const World& a, const World& b) { return &a.links() == &b.links(); }

/// A world of what this process keeps of the file. What was written a moment ago isn't kept, so: as soon as it is.
World kept(const fs::path& file) {
  World w = World::load(file);
  for (int i = 0; i < 200; ++i) {
    World again = World::load(file);
    if (share(again, w)) return again;
    w = std::move(again);
  }
  ADD_FAILURE() << "never kept: " << file;
  return w;
}

/// A text that no test has loaded before.
std::string fresh(const std::string& text) {
  static int n = 0;
  return text + "<!-- " + std::to_string(++n) + " -->";
}

double mass_of(const World& w, const std::string& link) { return w.links()[w.link(link).index()].mass_kg; }

std::string lump(const std::string& mass) {
  return "<link name='l'><inertial><mass>" + mass +
         "</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>";
}
std::string model_file(const std::string& mass) { return "<sdf version='1.9'><model name='m'>" + lump(mass) + "</model></sdf>"; }
std::string includes(const std::string& uri) { return world("<include><uri>" + uri + "</uri></include>"); }

std::vector<double> trajectory(World w) {
  std::vector<double> out;
  w.command("shoulder", -0.6, 0.4);
  for (int k = 0; k < 400; ++k) {
    w.step();
    const auto now = w.read("shoulder");
    for (const double x : {now.shaft_rad, now.shaft_speed_rad_per_s, now.torque_Nm, now.current_A[0], w.joint_angle("arm::elbow")})
      out.push_back(x);
    for (const double x : w.pose(w.link("ball::l")).position) out.push_back(x);
  }
  return out;
}

/// The arm with a damper at its passive elbow, a ball that lies on the floor, and something to be warned of.
std::string lively() {
  std::string text = arm();
  const std::string damped = "<xyz>0 1 0</xyz></axis></joint><plugin";
  EXPECT_NE(text.find(damped), std::string::npos);
  text.replace(text.find(damped), damped.size(),
               "<xyz>0 1 0</xyz><dynamics><damping>0.02</damping></dynamics></axis></joint><plugin");
  const std::string heavy =
      "<model name='x'><pose>0.5 0 0.1 0 0 0</pose><link name='l'>" + inertial(1, 0.01) +
      "<sensor name='imu' type='imu'/><collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
      "</collision></link></model>";
  const std::string end = "</world></sdf>";
  text.replace(text.rfind(end), end.size(), heavy + end);
  return text;
}

TEST(SecondLoad, GivesTheSameBitsAndTheSameWarnings) {
  const std::string text = fresh(lively());
  World first = World::load_string(text), second = World::load_string(text);
  ASSERT_TRUE(share(first, second));
  EXPECT_EQ(first.warnings().size(), 1U);
  EXPECT_EQ(second.warnings(), first.warnings());
  EXPECT_EQ(trajectory(std::move(second)), trajectory(std::move(first)));
  EXPECT_EQ(trajectory(World::load_string(text)), trajectory(World::load_string(fresh(lively())))) << "after others have run";
}

TEST(SecondLoad, HasTheStepThatWasAskedFor) {
  const std::string text = fresh(lively());
  WorldOptions slow;
  slow.step_s = 4e-3;
  const auto one = trajectory(World::load_string(text)), four = trajectory(World::load_string(text, slow));
  EXPECT_EQ(trajectory(World::load_string(text)), one);
  EXPECT_EQ(trajectory(World::load_string(text, slow)), four);
  EXPECT_EQ(four, trajectory(World::load_string(fresh(lively()), slow)));
}

/// What it saves is in bench/bench_load.cpp: times have no place here.
TEST(SecondLoad, OfAShippedWorldIsSharedEachTime) {
  const std::string file = VSA_SOURCE_DIR "/models/worlds/snake_rubble.sdf";
  const World first = World::load(file);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(share(World::load(file), first));
}

TEST(SecondLoad, OfOneTextWithOtherWishesForConcaveMeshesIsReadAnew) {
  const std::string text = fresh(arm());
  WorldOptions hull;
  hull.concave = Concave::hull;
  EXPECT_FALSE(share(World::load_string(text), World::load_string(text, hull)));
}

TEST(SecondLoad, AnEditedWorldIsReadAnewEvenWhereSizeAndTimeAreTheSame) {
  const TempDir dir("edited");
  const fs::path file = dir.write("w.sdf", world("<model name='m'>" + lump("1.5") + "</model>"));
  EXPECT_EQ(mass_of(kept(file), "m::l"), 1.5);
  const auto written = fs::last_write_time(file);
  dir.write("w.sdf", world("<model name='m'>" + lump("2.5") + "</model>"));
  fs::last_write_time(file, written);
  EXPECT_EQ(mass_of(World::load(file), "m::l"), 2.5);
}

TEST(SecondLoad, AFileWithTheOthersNameAndTimesIsReadAnew) {
  const TempDir dir("renamed");
  const fs::path file = dir.write("w.sdf", world("<model name='m'>" + lump("1.5") + "</model>"));
  const fs::path other = dir.write("other.sdf", world("<model name='m'>" + lump("2.5") + "</model>"));
  EXPECT_EQ(mass_of(kept(file), "m::l"), 1.5);
  fs::last_write_time(other, fs::last_write_time(file));
  fs::rename(other, file);
  EXPECT_EQ(mass_of(World::load(file), "m::l"), 2.5);
  fs::remove(file);
  EXPECT_THROW(static_cast<void>(World::load(file)), InputError);
}

TEST(SecondLoad, AnEditedIncludeIsReadAnew) {
  const TempDir dir("include");
  dir.write("part/model.config", "<model><name>m</name><sdf version='1.9'>a.sdf</sdf></model>");
  dir.write("part/a.sdf", model_file("1.5"));
  dir.write("part/b.sdf", model_file("3.5"));
  const fs::path file = dir.write("w.sdf", includes("part"));
  EXPECT_EQ(mass_of(kept(file), "m::l"), 1.5);
  dir.write("part/a.sdf", model_file("2.5"));
  EXPECT_EQ(mass_of(kept(file), "m::l"), 2.5);
  dir.write("part/model.config", "<model><name>m</name><sdf version='1.9'>b.sdf</sdf></model>");
  EXPECT_EQ(mass_of(World::load(file), "m::l"), 3.5);
}

TEST(SecondLoad, AModelThatIsFoundEarlierNowIsReadInstead) {
  const TempDir dir("earlier");
  dir.write("second/part/model.sdf", model_file("1.5"));
  fs::create_directories(dir.path() / "first");
  const fs::path file = dir.write("w.sdf", includes("model://part"));
  const std::string path = (dir.path() / "first").string() + ":" + (dir.path() / "second").string();
  ::setenv("GZ_SIM_RESOURCE_PATH", path.c_str(), 1);
  EXPECT_EQ(mass_of(kept(file), "m::l"), 1.5);
  dir.write("first/part/model.sdf", model_file("2.5"));
  EXPECT_EQ(mass_of(kept(file), "m::l"), 2.5);
  ::setenv("GZ_SIM_RESOURCE_PATH", (dir.path() / "second").c_str(), 1);
  EXPECT_EQ(mass_of(World::load(file), "m::l"), 1.5) << "another search path";
  ::unsetenv("GZ_SIM_RESOURCE_PATH");
}

TEST(SecondLoad, APackageThatAppearsIsFound) {
  const TempDir dir("package");
  const fs::path file = dir.write("w.sdf", world("<model name='m'><link name='l'>" + inertial(1, 1) +
                                                 "<visual name='v'><geometry><mesh><uri>package://pkg/s.obj</uri></mesh></geometry>"
                                                 "</visual></link></model>"));
  fs::create_directories(dir.path() / "src" / "group");
  ::setenv("ROS_PACKAGE_PATH", (dir.path() / "src").c_str(), 1);
  EXPECT_EQ(kept(file).warnings().size(), 1U) << "the mesh isn't there";
  dir.write("src/group/pkg/package.xml", "<package/>");
  dir.write("src/group/pkg/s.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(World::load(file).warnings().size(), 0U);
  ::unsetenv("ROS_PACKAGE_PATH");
}

TEST(SecondLoad, AnEditedMeshIsReadAnew) {
  const TempDir dir("mesh");
  const auto obj = [](const char* height) {
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 " + std::string(height) + "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  };
  dir.write("s.obj", obj("1"));
  const std::string shape = "<geometry><mesh><uri>s.obj</uri></mesh></geometry>";
  const fs::path file = dir.write("w.sdf", world("<model name='m'><link name='l'>" + inertial(1, 1) + "<collision name='c'>" +
                                                 shape + "</collision><visual name='v'>" + shape + "</visual></link></model>"));
  EXPECT_EQ(kept(file).links()[0].visuals[0].vertices[11], 1.F);
  dir.write("s.obj", obj("2"));
  EXPECT_EQ(World::load(file).links()[0].visuals[0].vertices[11], 2.F);
}

TEST(SecondLoad, AnEditedPresetIsReadAnewThoughTheWorldIsKept) {
  const TempDir dir("type");
  std::ifstream shipped(VSA_SOURCE_DIR "/actuators/qbmove_maker_pro_6_1.toml");
  std::string type{std::istreambuf_iterator<char>(shipped), {}};
  const std::string line = "resistance_Ohm = { value = 6.64,";
  ASSERT_NE(type.find(line), std::string::npos);
  dir.write("qbmove_maker_pro_6_1.toml", type);
  WorldOptions options;
  options.types = config::TypeLibrary({dir.path()});
  const std::string text = fresh(arm());
  const auto resistance = [](const World& w) {
    return w.robot(0).config().actuators[0].unit.actuator.side[0].motor.resistance_Ohm;
  };
  const World before = World::load_string(text, options);
  type.replace(type.find(line), line.size(), "resistance_Ohm = { value = 4.0,");
  dir.write("qbmove_maker_pro_6_1.toml", type);
  const World after = World::load_string(text, options);
  EXPECT_TRUE(share(before, after));
  EXPECT_EQ(resistance(before), 6.64);
  EXPECT_EQ(resistance(after), 4.0);
}

TEST(SecondLoad, WhatWasWrittenAMomentAgoIsntTakenForUnchanged) {
  const TempDir dir("moment");
  const fs::path file = dir.write("w.sdf", world("<model name='m'>" + lump("1.5") + "</model>"));
  fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));  // a moment that lasts
  const World first = World::load(file);
  EXPECT_FALSE(share(first, World::load(file)));
}

TEST(SecondLoad, WhatWasRefusedIsReadAnew) {
  const TempDir dir("refused");
  const fs::path file = dir.write("w.sdf", world("<model name='m'>" + lump("-1") + "</model>"));
  std::vector<std::string> said;
  for (int i = 0; i < 3; ++i) {
    try {
      static_cast<void>(World::load(file));
      ADD_FAILURE();
    } catch (const InputError& error) {
      said.emplace_back(error.what());
    }
  }
  EXPECT_EQ(said[1], said[0]);
  EXPECT_EQ(said[2], said[0]);
  dir.write("w.sdf", world("<model name='m'>" + lump("2.5") + "</model>"));
  EXPECT_EQ(mass_of(World::load(file), "m::l"), 2.5);
}

TEST(SecondLoad, RelativeNamesAreOfTheWorkingDirectory) {
  const TempDir dir("relative");
  dir.write("a/w.sdf", model_file("1.5"));
  dir.write("b/w.sdf", model_file("2.5"));
  const std::string text = fresh(includes("w.sdf"));
  const fs::path before = fs::current_path();
  fs::current_path(dir.path() / "a");
  EXPECT_EQ(mass_of(kept("w.sdf"), "m::l"), 1.5);
  EXPECT_EQ(mass_of(World::load_string(text), "m::l"), 1.5);
  fs::current_path(dir.path() / "b");
  EXPECT_EQ(mass_of(World::load("w.sdf"), "m::l"), 2.5);
  EXPECT_EQ(mass_of(World::load_string(text), "m::l"), 2.5);
  fs::current_path(before);
}

TEST(SecondLoad, OnlyTheFilesUsedLastAreKept) {
  const std::string text = fresh(world("<model name='m'>" + lump("1") + "</model>"));
  const World first = World::load_string(text);
  const std::string other = "<model name='other'>" + lump("1") + "</model>";
  for (int i = 0; i < 7; ++i) static_cast<void>(World::load_string(fresh(world(other))));
  EXPECT_TRUE(share(first, World::load_string(text)));
  for (int i = 0; i < 7; ++i) static_cast<void>(World::load_string(fresh(world(other))));
  EXPECT_TRUE(share(first, World::load_string(text))) << "used in between";
  for (int i = 0; i < 8; ++i) static_cast<void>(World::load_string(fresh(world(other))));
  EXPECT_FALSE(share(first, World::load_string(text)));
}

TEST(SecondLoad, ThreadsMayLoadTheSameFileAtOnce) {
  const std::string text = fresh(lively());
  std::vector<std::vector<double>> seen(4);
  std::vector<std::thread> threads;
  for (auto& out : seen) {
    threads.emplace_back([&out, &text] {
      for (int i = 0; i < 5; ++i) out = trajectory(World::load_string(text));
    });
  }
  for (std::thread& t : threads) t.join();
  for (const auto& out : seen) EXPECT_EQ(out, seen.front());
}

}  // namespace
}  // namespace vsa::engine::testing
