// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World as numbers, in memory and in a file.
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include "arm.hpp"
#include "vsa/output_file.hpp"

long allocation_count();  // allocation_count.cpp

namespace vsa::engine::testing {
namespace {

using Numbers = std::vector<double>;

Numbers numbers_of(const World& w) {
  Numbers out(w.state_size());
  w.save(out);
  return out;
}

std::string what_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void move(World& w, int steps) {
  for (int k = 0; k < steps; ++k) {
    for (const ActuatorRef& a : w.actuators()) w.command(a, 0.5 * std::sin(5 * w.time_s() + static_cast<double>(a.index)), 0.3);
    w.step();
  }
}

TEST(WorldAsNumbers, AnotherWorldOfTheFileGoesOnBitForBit) {
  for (const char* file : {"snake_flat.sdf", "bench_load.sdf", "frank.sdf"}) {
    World one = World::load(file), other = World::load(file);
    move(one, 200);
    move(other, 30);
    other.restore(numbers_of(one));
    EXPECT_EQ(other.time_ns(), one.time_ns());
    EXPECT_EQ(first_difference(numbers_of(other), numbers_of(one)), std::nullopt) << file;
    move(one, 150);
    move(other, 150);
    EXPECT_EQ(first_difference(numbers_of(other), numbers_of(one)), std::nullopt) << file;
    EXPECT_EQ(other.state_hash(), one.state_hash()) << file;
  }
}

TEST(WorldAsNumbers, AreTheSameAsASnapshotACloneAndAReset) {
  std::string text = arm();
  text.replace(text.find("<actuator "), 0, "<substeps>4</substeps>");
  World w = World::load_string(text);
  const Numbers first = numbers_of(w);
  move(w, 40);
  const Numbers at = numbers_of(w);
  const auto snapshot = w.snapshot();
  EXPECT_EQ(first_difference(numbers_of(w.clone()), at), std::nullopt);
  move(w, 40);
  w.restore(*snapshot);
  EXPECT_EQ(first_difference(numbers_of(w), at), std::nullopt);
  w.reset();
  Numbers now = numbers_of(w);
  EXPECT_EQ(first_difference(now, first), std::nullopt) << w.state_layout().name_at(*first_difference(now, first));
}

TEST(WorldAsNumbers, NamesBodiesAndRobots) {
  World w = World::load_string(arm());
  w.command("shoulder", 0.4, 0.2);
  w.run(0.1);
  const StateLayout layout = w.state_layout();
  EXPECT_EQ(layout.size(), w.state_size());
  const Numbers at = numbers_of(w);
  const auto number = [&](const char* name) {
    const StateEntry* e = layout.find(name);
    EXPECT_NE(e, nullptr) << name;
    return e == nullptr ? std::nan("") : at[e->offset];
  };
  EXPECT_EQ(number("physics/joint arm::elbow.position"), w.joint_angle("arm::elbow"));
  EXPECT_EQ(number("physics/joint arm::shoulder.speed"), w.joint_speed("arm::shoulder"));
  EXPECT_EQ(layout.find("physics/link ball::l.position")->count, 7u);
  const auto shoulder = w.read("shoulder");  // half a step further, where the shaft is
  EXPECT_DOUBLE_EQ(number("robot[0]/shoulder/unit.physics.motor[0].angle") +
                       0.5 * number("robot[0]/shoulder/unit.last_dt") * number("robot[0]/shoulder/unit.physics.motor[0].speed"),
                   shoulder.motor_rad[0]);
  EXPECT_EQ(number("robot[0]/shoulder/equilibrium.value"), 0.4);
  EXPECT_EQ(layout.find("world.time")->kind, StateKind::wide);
}

TEST(WorldAsNumbers, ThatNoWorldHasAreRefusedAndNothingChanges) {
  World w = World::load_string(arm());
  move(w, 20);
  const Numbers good = numbers_of(w);
  const StateLayout layout = w.state_layout();
  const auto refused = [&](const char* name, double value) {
    Numbers bad = good;
    bad[layout.find(name)->offset] = value;
    const std::string said = what_of([&] { w.restore(bad); });
    EXPECT_NE(said.find(name), std::string::npos) << said;
    EXPECT_EQ(first_difference(numbers_of(w), good), std::nullopt);
  };
  refused("physics/joint arm::elbow.position", std::nan(""));
  refused("physics/joint arm::elbow.speed", 1e13);
  refused("robot[0]/shoulder/unit.held.terminal", 7);
  refused("robot[0]/shoulder/equilibrium.knot.count", 65);
  refused("world.steps", 0.5);
  refused("robot[0]/host.now.stopped", 2);
  EXPECT_NE(what_of([&] { w.restore(std::span(good).first(5)); }).find("wrong size"), std::string::npos);
  Numbers fast = good;
  fast[layout.find("physics/joint arm::elbow.speed")->offset] = 1e11;
  w.restore(fast);
  EXPECT_THROW(w.step(), SimulationError) << "what blows up does so with its error";
  EXPECT_EQ(first_difference(numbers_of(w), fast), std::nullopt);
}

TEST(WorldAsNumbers, SavingAndRestoringTakeNothingFromTheHeap) {
  World w = World::load("snake_flat.sdf"), other = w.clone();
  move(w, 50);
  Numbers out(w.state_size());
  other.restore(numbers_of(w));
  const long before = allocation_count();
  for (int k = 0; k < 20; ++k) {
    w.save(out);
    other.restore(out);
  }
  EXPECT_EQ(allocation_count(), before);
}

class StateFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "vsa_state_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
    file = folder / "at.state";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  std::string text() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& bytes) const { std::ofstream(file, std::ios::binary) << bytes; }
  std::filesystem::path folder, file;
};

TEST_F(StateFile, BringsAWorldBack) {
  World w = World::load_string(arm());
  move(w, 30);
  w.save_file(file);
  const Numbers at = numbers_of(w);
  EXPECT_EQ(std::filesystem::file_size(file), 8 * (6 + 1 + w.actuators().size() + at.size()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "nothing else is left";
  move(w, 30);
  w.restore_file(file);
  EXPECT_EQ(first_difference(numbers_of(w), at), std::nullopt);
}

TEST_F(StateFile, IsRefusedWhereItDoesntFit) {
  World w = World::load_string(arm()), other = World::load("bench_load.sdf");
  w.save_file(file);
  const std::string good = text();
  const Numbers before = numbers_of(other);
  EXPECT_NE(what_of([&] { other.restore_file(file); }).find("another world"), std::string::npos);
  EXPECT_EQ(first_difference(numbers_of(other), before), std::nullopt);
  const auto said = [&](const std::string& bytes) {
    write(bytes);
    std::string out = what_of([&] { w.restore_file(file); });
    EXPECT_NE(out.find("at.state"), std::string::npos) << out;
    return out;
  };
  std::string other_version = good, damaged = good, poisoned = good;
  other_version[8] = 4;
  char& last = damaged[damaged.size() - 8];
  last = static_cast<char>(last ^ 1);
  EXPECT_NE(said(other_version).find("version = 4"), std::string::npos);
  EXPECT_NE(said(damaged).find("damaged"), std::string::npos);
  EXPECT_NE(said(good.substr(0, good.size() - 8)).find("another length"), std::string::npos);
  EXPECT_NE(said(good.substr(0, 30)).find("no world's state"), std::string::npos);
  EXPECT_NE(said("").find("no world's state"), std::string::npos);
  EXPECT_NE(what_of([&] { w.restore_file(folder / "none"); }).find("can't be read"), std::string::npos);
  write(good);
  EXPECT_EQ(what_of([&] { w.restore_file(file); }), "");
}

TEST_F(StateFile, OfActuatorsOfAnotherKindIsRefusedAsTheirSnapshotIs) {
  const auto of = [](const char* type) {
    WorldOptions options;
    options.actuator.type = type;
    return World::load_string(arm(), options);
  };
  const World w = of("qbmove_maker_pro_6_1");
  w.save_file(file);
  World other = of("sea_example");
  const Numbers before = numbers_of(other);
  ASSERT_EQ(other.state_layout().hash(), w.state_layout().hash());
  EXPECT_NE(what_of([&] { other.restore(*w.snapshot()); }).find("number of motors"), std::string::npos);
  EXPECT_NE(what_of([&] { other.restore_file(file); }).find("are of other kinds"), std::string::npos);
  EXPECT_EQ(first_difference(numbers_of(other), before), std::nullopt);
}

TEST_F(StateFile, OfOtherParametersIsRefusedWithTheirOwner) {
  World w = World::load_string(arm());
  move(w, 30);
  w.save_file(file);
  const auto refused = [&](World& other, const char* owner) {
    const Numbers before = numbers_of(other);
    const std::string said = what_of([&] { other.restore_file(file); });
    EXPECT_NE(said.find(owner), std::string::npos) << said;
    EXPECT_EQ(first_difference(numbers_of(other), before), std::nullopt);
  };
  const ActuatorRef& last = w.actuators().back();
  World weaker = World::load_string(arm());
  host::UnitConfig unit = weaker.robot(last.robot).config().actuators[last.index].unit;
  unit.actuator.supply_V -= 1;
  weaker.robot(last.robot).set_parameters(last.index, unit);
  refused(weaker, ("robot[0]/" + w.robot(last.robot).config().actuators[last.index].name).c_str());
  unit.actuator.supply_V += 1;
  weaker.robot(last.robot).set_parameters(last.index, unit);
  EXPECT_EQ(what_of([&] { weaker.restore_file(file); }), "") << "the same again";

  World heavier = World::load_string(arm());
  for (const scene::LinkInfo& link : heavier.links()) {
    if (link.is_static) continue;
    const LinkHandle handle = heavier.link(link.name);
    LinkParameters parameters = heavier.link_parameters(handle);
    parameters.mass_kg *= 1.01;
    heavier.set_link_parameters(handle, parameters);
    break;
  }
  refused(heavier, "links");
}

TEST_F(StateFile, OfEarlierVersionsIsStillRead) {
  World w = World::load_string(arm());
  move(w, 30);
  w.save_file(file);
  const Numbers at = numbers_of(w);
  const std::string now = text();
  for (const int version : {1, 2}) {
    std::string earlier = now;
    earlier[8] = static_cast<char>(version);
    earlier.erase(48, 8 * (1 + w.actuators().size()));  // the parameters
    if (version == 1) earlier.erase(40, 8);             // the kinds
    write(earlier);
    move(w, 30);
    w.restore_file(file);
    EXPECT_EQ(first_difference(numbers_of(w), at), std::nullopt) << version;
  }
}

TEST_F(StateFile, ThatCantBeWrittenLeavesWhatWasThere) {
  World w = World::load_string(arm());
  std::filesystem::create_directory(file);
  EXPECT_THROW(w.save_file(file), OutputError);
  EXPECT_TRUE(std::filesystem::is_directory(file));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  EXPECT_THROW(w.save_file(folder / "no" / "such"), OutputError);
}

}  // namespace
}  // namespace vsa::engine::testing
