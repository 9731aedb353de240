// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every robot file comes to what its row says, and no row loads with something missing: links and joints are named one by one.
#include "sdf/robot_files.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kFiles = fs::path(VSA_SOURCE_DIR) / "tests/sdf/robot_files";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

World load(const std::string& file, WorldOptions options = {}) { return World::load(kFiles / file, std::move(options)); }

std::string refusal(const std::string& file, WorldOptions options = {}) {
  try {
    static_cast<void>(load(file, std::move(options)));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Warnings that no phrase of the row is in, and phrases that no warning has.
void expect_warnings(const World& w, const RobotFile& row) {
  std::set<std::string> wanted(row.warnings.begin(), row.warnings.end());
  for (const std::string& warning : w.warnings()) {
    if (has(warning, "limits of joints aren't enforced")) continue;
    const auto it = std::find_if(wanted.begin(), wanted.end(), [&](const std::string& phrase) { return has(warning, phrase); });
    EXPECT_NE(it, wanted.end()) << row.file << " warns of what its row doesn't have: " << warning;
    if (it != wanted.end()) wanted.erase(it);
  }
  for (const std::string& phrase : wanted) ADD_FAILURE() << row.file << " doesn't warn: " << phrase;
}

/// The joints with one axis, from the answer to a name that none has.
std::set<std::string> joints_of(const World& w) {
  std::set<std::string> names;
  try {
    static_cast<void>(w.joint_angle("no joint has this name"));
  } catch (const InputError& error) {
    std::string rest = error.problems().front().allowed;
    for (std::size_t at = 0; !rest.empty(); rest = at == std::string::npos ? "" : rest.substr(at + 2)) {
      at = rest.find(", ");
      names.insert(rest.substr(0, at));
    }
  }
  return names;
}

class Refused : public ::testing::TestWithParam<RobotFile> {};
class Loaded : public ::testing::TestWithParam<RobotFile> {};

TEST_P(Refused, WithThePhraseOfItsRow) {
  const std::string text = refusal(GetParam().file);
  EXPECT_TRUE(has(text, *GetParam().refused)) << GetParam().file << ": " << (text.empty() ? "loads" : text);
  EXPECT_FALSE(has(text, "vsasim-")) << "names a copy instead of the file: " << text;
}

TEST_P(Loaded, WithEveryLinkAndJointInItsPlaceAndAWordOnWhatIsLeftOut) {
  const RobotFile& row = GetParam();
  World w = load(row.file);
  std::multiset<std::string> links;
  for (const LinkInfo& link : w.links()) links.insert(link.name);
  EXPECT_EQ(links, std::multiset<std::string>(row.links.begin(), row.links.end())) << row.file;
  std::set<std::string> joints;
  for (const auto& [name, position] : row.joints) {
    joints.insert(name);
    EXPECT_NEAR(w.joint_angle(name), position, 1e-6) << row.file << ": " << name;
  }
  EXPECT_EQ(joints_of(w), joints) << row.file;
  expect_warnings(w, row);
  for (const auto& [name, position] : row.set) w.set_joint(name, position, 0);
  for (const Place& place : row.places) {
    const Pose pose = pose_of(w, place.link);
    const double off = std::hypot(pose.position[0] - place.x, pose.position[1] - place.y, pose.position[2] - place.z);
    EXPECT_LT(off, 1e-6) << row.file << ": " << place.link;
  }
}

TEST_P(Loaded, AndRunsAndComesBackToItsStart) {
  World w = load(GetParam().file);
  for (int i = 0; i < 20; ++i) w.step();
  w.reset();
  for (const auto& [name, position] : GetParam().joints) EXPECT_NEAR(w.joint_angle(name), position, 1e-6) << name;
}

std::string test_name(const ::testing::TestParamInfo<RobotFile>& info) {
  std::string name = info.param.file;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(File, Refused, ::testing::ValuesIn(refused_files()), test_name);
INSTANTIATE_TEST_SUITE_P(Sdf, Loaded, ::testing::ValuesIn(sdf_files()), test_name);
INSTANTIATE_TEST_SUITE_P(Urdf, Loaded, ::testing::ValuesIn(urdf_files()), test_name);

TEST(RobotFiles, EachHasItsRow) {
  std::set<std::string> rows{"mesh_dae.sdf", "mesh_concave_hull_asked.sdf"};  // these have tests of their own
  for (const auto& table : {refused_files(), sdf_files(), urdf_files()}) {
    for (const RobotFile& row : table) rows.insert(row.file);
  }
  for (const auto& entry : fs::directory_iterator(kFiles)) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(rows.count(entry.path().filename().string()), 1u) << entry.path();
  }
  EXPECT_GE(rows.size(), 72u);
}

/// How far a follower is from where its leader puts it, at worst, while the leader swings.
double worst_lag(World& w, const std::string& leader, const std::string& follower, double multiplier, double offset) {
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    w.step();
    worst = std::max(worst, std::abs(w.joint_angle(follower) - (multiplier * w.joint_angle(leader) + offset)));
  }
  return worst;
}

TEST(Mimic, AFollowerFollowsItsLeaderInMotion) {
  struct Case {
    const char *file, *leader, *follower;
    double multiplier, offset;
  };
  for (const Case& k : {Case{"mimic.urdf", "r::j1", "r::j2", -2, 0.1}, Case{"mimic_1_11.sdf", "m::j1", "m::j2", -2, 0.5},
                        Case{"mimic_1_7.sdf", "m::j1", "m::j2", 3, 0}, Case{"include_newer.sdf", "m::j2", "m::j3", 2, 0}}) {
    World w = load(k.file);
    w.set_joint(k.leader, 0, 1.5);
    w.set_joint(k.follower, k.offset, 1.5 * k.multiplier);
    EXPECT_LT(worst_lag(w, k.leader, k.follower, k.multiplier, k.offset), 5e-3) << k.file;
    EXPECT_GT(std::abs(w.joint_angle(k.leader)), 0.1) << k.file << ": the leader swings";
  }
}

TEST(DummyLinks, AWristOfTwoAxesMovesAsWithItsMassAllInTheHand) {
  World w = load("dummy_wrist.urdf");
  double mass = 0;
  for (const LinkInfo& link : w.links()) mass += link.mass_kg;
  EXPECT_NEAR(mass, 2.5, 2e-5) << "the dummy's mass is stated and small";
  w.run(0.3);
  // The hand, a pendulum of 0.5 kg whose centre is 0.1 m from the pitch axis, falls: the energy of its fall is in it.
  EXPECT_GT(w.joint_angle("r::pitch"), 0.2);
  EXPECT_LT(std::abs(w.joint_angle("r::yaw")), 1e-3);
}

TEST(RobotFiles, AMassOfALumpedLinkIsKept) {
  World w = load("lumped.urdf");
  double mass = 0;
  for (const LinkInfo& link : w.links()) mass += link.mass_kg;
  EXPECT_NEAR(mass, 2.2, 1e-9);
}

TEST(RobotFiles, ALinkWithoutGravityTakesNothingOfTheWeightOfWhatIsFixedToIt) {
  World w = load("gravity_off_lumped.urdf");
  w.run(0.5);
  const double all_kg = 8, with_kg = 1, fallen_m = 9.8 / 2 * 0.5 * 0.5 * with_kg / all_kg;
  EXPECT_NEAR(pose_of(w, "r::foot").position[2], -fallen_m, 0.01 * fallen_m) << "1 of 8 kg pulls";
}

TEST(RobotFiles, CollisionsOfLumpedLinksAreKept) {
  EXPECT_EQ(load("lumped_collisions.urdf").links().front().visuals.size(), 5u) << "without visuals, collisions are shown";
}

TEST(RobotFiles, AStaticRobotOfTwoGazeboElementsIsStatic) {
  EXPECT_TRUE(load("two_gazebos_static.urdf").links().front().is_static);
}

TEST(RobotFiles, TheOriginOfOneUrdfIsntKeptForTheNext) {
  const std::string link =
      "<link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>";
  World moved = World::load_string("<robot name='r'><origin xyz='1 2 3'/>" + link + "</robot>");
  EXPECT_NEAR(pose_of(moved, "r::a").position[0], 1, 1e-12);
  World next = World::load_string("<robot name='r'>" + link + "</robot>");
  EXPECT_NEAR(pose_of(next, "r::a").position[0], 0, 1e-12);
}

TEST(RobotFiles, AFileOfOneOfLibsdformatsOwnNamesIsTheUsers) {
  const fs::path before = fs::current_path();
  fs::current_path(kFiles);
  World w = World::load("actor.sdf");
  fs::current_path(before);
  EXPECT_EQ(w.links().size(), 3u);
}

TEST(RobotFiles, AnActuatedJointThatStartsElsewhereStartsAtRest) {
  const auto robot = [](const std::string& initial) {
    return World::load_string(
        world("<model name='m'><link name='base'>" + inertial(1, 1e-3) +
                  "</link><joint name='fix' type='fixed'><parent>world</parent><child>base</child></joint><link name='a'>" +
                  inertial(1, 1e-3) +
                  "</link><joint name='j' type='revolute'><parent>base</parent><child>a</child><axis><xyz>0 0 1</xyz>"
                  "<initial_position>0.5</initial_position></axis></joint><plugin name='vsa::Robot' "
                  "filename='libvsa-robot.so'><actuator><joint>j</joint><type>qbmove_maker_pro_6_1</type>" +
                  initial + "</actuator></plugin></model>",
              "0 0 0"));
  };
  World rest = robot("");
  rest.run(0.2);
  EXPECT_NEAR(rest.joint_angle("m::j"), 0.5, 1e-3);
  EXPECT_NEAR(rest.joint_speed("m::j"), 0, 0.02) << "but for the encoder's last count";
  World driven = robot("<initial equilibrium_rad='0' preset_rad='0.2'/>");
  driven.run(1);
  EXPECT_NEAR(driven.joint_angle("m::j"), 0, 0.1) << "a start that the text gives is kept";
}

TEST(RobotFiles, ASpringPullsToItsReference) {
  World w = load("spring.sdf");
  w.run(5);
  EXPECT_NEAR(w.joint_angle("m::j1"), 0.4, 1e-3);
}

TEST(RobotFiles, NumbersAndNamesOfPathVariablesAreFound) {
  const TempDir dir("paths");
  dir.write("share/robot_parts/box.stl", "");
  fs::copy_file(kFiles / "parts/box.stl", dir.path() / "share/robot_parts/box.stl", fs::copy_options::overwrite_existing);
  dir.write("share/robot_parts/package.xml", "<package/>");
  const std::string share = (dir.path() / "share").string(), prefix = dir.path().string();
  for (const auto& [name, value] :
       std::vector<std::pair<const char*, std::string>>{{"SDF_PATH", share},
                                                        {"GZ_SIM_RESOURCE_PATH", share},
                                                        {"IGN_GAZEBO_RESOURCE_PATH", "/nowhere:" + share},
                                                        {"GAZEBO_MODEL_PATH", share},
                                                        {"GAZEBO_RESOURCE_PATH", share},
                                                        {"AMENT_PREFIX_PATH", prefix},
                                                        {"COLCON_PREFIX_PATH", prefix},
                                                        {"ROS_PACKAGE_PATH", prefix},
                                                        {"ROS_PACKAGE_PATH", share}}) {
    setenv(name, value.c_str(), 1);
    EXPECT_EQ(refusal("package.urdf"), "") << name << "=" << value;
    unsetenv(name);
    setenv(name, "/nowhere", 1);
    EXPECT_TRUE(has(refusal("package.urdf"), "/nowhere")) << "the error names where it looked: " << name;
    unsetenv(name);
  }
}

TEST(RobotFiles, TheUsersOwnSunAndGroundComeFirst) {
  const TempDir dir("sun");
  dir.write("sun/model.config", "<model><sdf version='1.7'>model.sdf</sdf></model>");
  dir.write("sun/model.sdf", "<sdf version='1.7'><model name='sun'><static>true</static><link name='disc'/></model></sdf>");
  WorldOptions options;
  options.model_path = {dir.path()};
  EXPECT_EQ(load("sun_and_ground.sdf", options).links().front().name, "sun::disc");
}

TEST(RobotFiles, AMaterialsDiffuseColourIsKeptWhateverElseItHolds) {
  EXPECT_EQ(load("foreign_material.sdf").links().front().visuals.at(0).rgba, (std::array<float, 4>{1, 0, 0, 1}));
}

TEST(RobotFiles, AFolderByItsPlainNameIsFoundBesideTheFileAndThenWhereModelsAre) {
  const TempDir dir("plain");
  const auto model = [&](const std::string& place, const std::string& link) {
    dir.write(place + "/x500/model.config", "<model><sdf version='1.7'>model.sdf</sdf></model>");
    dir.write(place + "/x500/model.sdf",
              "<sdf version='1.7'><model name='x'><link name='" + link + "'>" + inertial(1, 1) + "</link></model></sdf>");
  };
  dir.write("here/w.sdf", world("<include><uri>x500</uri></include>"));
  const auto link = [&] { return World::load(dir.path() / "here/w.sdf").links().front().name; };
  model("models", "far");
  for (const char* name : {"GZ_SIM_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH"}) {
    setenv(name, (dir.path() / "models").c_str(), 1);
    EXPECT_EQ(link(), "x::far") << name;
    unsetenv(name);
  }
  setenv("GZ_SIM_RESOURCE_PATH", (dir.path() / "models").c_str(), 1);
  model("here", "near");
  EXPECT_EQ(link(), "x::near");
  unsetenv("GZ_SIM_RESOURCE_PATH");
}

TEST(RobotFiles, OfAnIncludeThatIsntFoundThereIsOneError) {
  try {
    static_cast<void>(load("include_missing_merged.sdf"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1u) << error.what();
  }
}

/// A chain of n modules hanging from the world, each a link with an actuator.
std::string chain(int n) {
  std::string model = "<model name='m'><link name='l0'>" + inertial(1, 1e-3) +
                      "</link><joint name='fix' type='fixed'><parent>world"
                      "</parent><child>l0</child></joint>";
  std::string plugin = "<plugin name='vsa::Robot' filename='libvsa-robot.so'>";
  constexpr int kUnits = 128;  // of a bus, which takes no more than 254
  for (int bus = 0; bus * kUnits < n; ++bus) plugin += "<bus name='bus_" + std::to_string(bus) + "'/>";
  for (int i = 1; i <= n; ++i) {
    const std::string k = std::to_string(i), before = std::to_string(i - 1);
    model += "<link name='l" + k + "'><pose>0 0 " + std::to_string(-0.1 * i) + " 0 0 0</pose>" +
             inertial(0.1, 1e-4, "0 0 -0.05 0 0 0") + "</link><joint name='j" + k + "' type='revolute'><parent>l" + before +
             "</parent><child>l" + k + "</child><axis><xyz>0 1 0</xyz></axis></joint>";
    plugin += "<actuator><joint>j" + k + "</joint><type>qbmove_maker_pro_6_1</type><bus id='" +
              std::to_string(1 + (i - 1) % kUnits) + "'>bus_" + std::to_string((i - 1) / kUnits) + "</bus></actuator>";
  }
  return world(model + plugin + "</plugin></model>");
}

TEST(LongChains, Of128And256ModulesLoadAndRun) {
  for (const int n : {63, 64, 65, 128, 256}) {
    World w = World::load_string(chain(n));
    ASSERT_EQ(w.links().size(), static_cast<std::size_t>(n) + 1);
    ASSERT_EQ(w.actuators().size(), static_cast<std::size_t>(n));
    for (int i = 0; i < 5; ++i) w.step();
    EXPECT_NEAR(pose_of(w, "m::l" + std::to_string(n)).position[2], -0.1 * n, 1e-3) << n;
  }
}

}  // namespace
}  // namespace vsa::engine::testing
