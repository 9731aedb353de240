// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots that come as MJCF, from elsewhere: no SDF is needed for them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "../record/scratch.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/physics/mjcf.hpp"
#include "vsa/sdf/feature.hpp"

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;
using record::message_of;
using record::Scratch;

const std::string kArm = R"(<mujoco model="arm">
  <option timestep="0.001"/>
  <custom><text name="vsa::Robot" data="PLUGIN"/></custom>
  <worldbody>
    <geom name="floor" type="plane" size="2 3 1" pos="0 0 -1"/>
    <body name="base"><geom name="stand" type="box" size="0.1 0.1 0.02" condim="1"/>
      <body name="upper" pos="0 0 0.1">
        <joint name="shoulder" axis="0 0 1" range="-2 2" limited="true" damping="0.01"/>
        <geom type="capsule" size="0.02 0.1" rgba="1 0 0 1"/>
        <inertial pos="0.05 0 0" mass="0.3" diaginertia="1e-3 1e-3 1e-3"/>
      </body>
    </body>
  </worldbody>
</mujoco>
)";
const std::string kPlugin =
    "&lt;plugin name='vsa::Robot'&gt;&lt;actuator name='shoulder'&gt;&lt;joint&gt;shoulder&lt;/joint&gt;&lt;type&gt;"
    "qbmove_maker_pro&lt;/type&gt;&lt;bus id='1'&gt;arm&lt;/bus&gt;&lt;/actuator&gt;&lt;bus name='arm'/&gt;&lt;/plugin&gt;";
const std::string kCompiler = "<compiler angle=\"radian\"/>";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}
std::string arm() { return with(with(kArm, "PLUGIN", kPlugin), "<option", kCompiler + "<option"); }

TEST(OwnMjcf, MovesByTheActuatorInItsCustomText) {
  World world = World::load_string(arm());
  ASSERT_EQ(world.actuators().size(), 1u);
  EXPECT_EQ(world.actuators().front().model, "arm");
  world.command("shoulder", 0.5, 0.2);
  world.run(1.5);
  EXPECT_NEAR(world.joint_angle("arm::shoulder"), 0.5, 0.06);
}

TEST(OwnMjcf, HasItsBodiesJointsAndLooks) {
  const World world = World::load_string(arm());
  EXPECT_EQ(world.name(), "arm");
  ASSERT_EQ(world.links().size(), 3u);
  EXPECT_EQ(world.links()[0].name, "arm::world");
  EXPECT_TRUE(world.links()[0].is_static);
  EXPECT_EQ(world.links()[2].name, "arm::upper");
  EXPECT_EQ(world.links()[2].mass_kg, 0.3);
  ASSERT_EQ(world.links()[2].visuals.size(), 1u);
  EXPECT_EQ(world.links()[2].visuals[0].kind, scene::Shape::Kind::capsule);
  EXPECT_EQ(world.links()[2].visuals[0].size[1], 0.2);
  EXPECT_EQ(world.links()[2].visuals[0].rgba[0], 1.0f);
  ASSERT_EQ(world.joints().size(), 1u);
  ASSERT_TRUE(world.joints()[0].range);
  EXPECT_EQ((*world.joints()[0].range)[1], 2);
  EXPECT_EQ(world.joints()[0].damping, 0.01);
}

TEST(OwnMjcf, StartsWhereItsRefSays) {
  const World world = World::load_string(with(arm(), "range=", "ref=\"0.4\" range="));
  EXPECT_DOUBLE_EQ(world.joint_angle("arm::shoulder"), 0.4);
}

TEST(OwnMjcf, HasItsActuatorsInTheFileBesideIt) {
  const Scratch scratch;
  const std::string without = with(arm(), "<custom><text name=\"vsa::Robot\" data=\"" + kPlugin + "\"/></custom>", "");
  record::spew(scratch.path() / "arm.xml", without);
  EXPECT_TRUE(World::load(scratch.path() / "arm.xml").actuators().empty());
  record::spew(scratch.path() / "arm.vsa.xml", R"(<vsa><plugin name="vsa::Robot"><actuator name="shoulder"><joint>shoulder</joint>
    <type>qbmove_maker_pro</type><bus id="1">arm</bus></actuator><bus name="arm"/></plugin></vsa>)");
  EXPECT_EQ(World::load(scratch.path() / "arm.xml").actuators().size(), 1u);
}

TEST(OwnMjcf, ThatMujocoRefusesIsToldInItsWords) {
  const std::string told =
      message_of<InputError>([] { (void)World::load_string(with(arm(), "<worldbody>", "<worldbody><bdy/>")); });
  EXPECT_NE(told.find("MuJoCo refuses it"), std::string::npos) << told;
  EXPECT_NE(told.find("bdy"), std::string::npos) << told;
}

TEST(OwnMjcf, TellsWhatItLeavesOut) {
  const std::string text = with(with(arm(), "timestep", "integrator=\"RK4\" timestep"), "</worldbody>",
                                "</worldbody><actuator><motor joint=\"shoulder\"/></actuator>");
  const World world = World::load_string(text);
  ASSERT_EQ(world.warnings().size(), 3u);
  EXPECT_NE(world.warnings()[0].find("control 0"), std::string::npos);
  EXPECT_NE(world.warnings()[1].find("semi-implicit Euler"), std::string::npos);
  EXPECT_NE(world.warnings()[2].find("in each other from the start: arm::base and"), std::string::npos) << world.warnings()[2];
}

TEST(OwnMjcf, WithActuatorsThatHaveStatesIsRefused) {
  const std::string text =
      with(arm(), "</worldbody>", "</worldbody><actuator><general joint=\"shoulder\" dyntype=\"integrator\"/></actuator>");
  EXPECT_NE(message_of<InputError>([&] { (void)World::load_string(text); }).find("states of their own"), std::string::npos);
}

TEST(OwnMjcf, MayHoldAnyNumberOfBlanks) {
  const std::string blanks(1'000'000, ' ');
  EXPECT_NO_THROW((void)World::load_string(with(arm(), "<worldbody>", "<!-- file" + blanks + "--><worldbody>")));
  using physics::gives_attribute;
  EXPECT_TRUE(gives_attribute("<mesh file = \"a.stl\"/>", "file"));
  EXPECT_TRUE(gives_attribute("<mesh file" + blanks + "=\"a.stl\"/>", "file"));
  EXPECT_FALSE(gives_attribute("<mesh profile=\"a\"/> a file, file" + blanks, "file"));
  EXPECT_TRUE(gives_attribute("<key time='1' name" + blanks + "= 'start'/>", "name", "start"));
  for (const char* other : {"<key name='starts'/>", "<key name='sta", "<key name=start/>", "<key name=", "<key name='start"})
    EXPECT_FALSE(gives_attribute(other, "name", "start")) << other;
}

/// What has no name is called by its number, unless somebody is called so: an actuator found the wrong joint.
TEST(OwnMjcf, MakesUpNoNameThatIsThere) {
  const std::string unnamed = R"(<body name="first" pos="2 0 0"><joint axis="0 0 1"/><geom size="0.1"/></body>)";
  World world = World::load_string(
      with(with(with(arm(), "<body name=\"base\">", unnamed + "<body name=\"body_1\">"), "name=\"shoulder\"", "name=\"joint_0\""),
           "&lt;joint&gt;shoulder", "&lt;joint&gt;joint_0"));
  ASSERT_EQ(world.joints().size(), 2u);
  EXPECT_EQ(world.joints()[0].name, "arm::joint_0_");
  EXPECT_EQ(world.joints()[1].name, "arm::joint_0");
  world.command("shoulder", 0.5, 0.2);
  world.run(1.0);
  EXPECT_NEAR(world.joint_angle("arm::joint_0"), 0.5, 0.1);
  EXPECT_NEAR(world.joint_angle("arm::joint_0_"), 0.0, 1e-6);
  const std::string twice = message_of<InputError>([] {
    (void)World::load_string(with(arm(), "<body name=\"base\">", "<body name=\"arm::upper\"><geom size=\"0.1\"/></body><body>"));
  });
  EXPECT_NE(twice.find("arm::upper"), std::string::npos) << twice;
  EXPECT_NE(twice.find("is there twice"), std::string::npos) << twice;
  const std::string alike = message_of<InputError>([] {
    (void)World::load_string(with(arm(), "<body name=\"base\">",
                                  "<body name=\"a b::x\"><geom size=\"0.1\"/></body><body name=\"a_b::x\"><geom size=\"0.1\"/>"
                                  "</body><body>"));
  });
  EXPECT_NE(alike.find("a_b::x: is there twice: \"a b::x\" and \"a_b::x\" are both called so here"), std::string::npos) << alike;
}

TEST(OwnMjcf, IsNoUrdfWithAnotherEnding) {
  const Scratch scratch;
  for (const char* root : {"robot", "sdf"}) {
    record::spew(scratch.path() / "r.xml",
                 std::string("<?xml version='1.0'?><!-- <mujoco> -->\n<") + root + " name='r'><link name='l'/></" + root + ">");
    const std::string told = message_of<InputError>([&] { (void)World::load(scratch.path() / "r.xml"); });
    EXPECT_NE(told.find("isn't MJCF"), std::string::npos) << told;
    EXPECT_NE(told.find(std::string(root) == "sdf" ? ".sdf" : ".urdf"), std::string::npos) << told;
  }
}

TEST(OwnMjcf, WithSomethingBehindItsFirstElementIsRefused) {
  const std::string second = "<!-- a comment is nothing -->\n<mujoco model=\"lost\"/>\n";
  const std::string told = message_of<InputError>([&] { (void)World::load_string(arm() + second); });
  EXPECT_NE(told.find("<mujoco>: stands outside the file's first element (allowed: one <mujoco> a file)"), std::string::npos)
      << told;
  const std::string words = message_of<InputError>([&] { (void)World::load_string(arm() + "lost words <!-- -->"); });
  EXPECT_NE(words.find("lost words : stands outside the file's first element"), std::string::npos) << words;
  EXPECT_NO_THROW((void)World::load_string("<?xml version=\"1.0\"?><?vim sw=2?><!DOCTYPE mujoco [<!ENTITY a 'b'>]><!-- before -->" +
                                           arm() + "<!-- behind -->"));
  const Scratch scratch;
  fs::create_directory(scratch.path() / "parts");
  record::spew(scratch.path() / "arm.xml", with(arm(), "<worldbody>", "<include file=\"parts/a.xml\"/><worldbody>"));
  record::spew(scratch.path() / "parts/a.xml", "<mujocoinclude><include file=\"parts/b.xml\"/></mujocoinclude>");
  record::spew(scratch.path() / "parts/b.xml", "<mujocoinclude/>\n<mujocoinclude/>");
  const std::string included = message_of<InputError>([&] { (void)World::load(scratch.path() / "arm.xml"); });
  EXPECT_NE(included.find("parts/b.xml:2: <mujocoinclude>: stands outside"), std::string::npos) << included;
}

TEST(OwnMjcf, HasNoNumberThatIsntFinite) {
  const auto told = [](const std::string& from, const std::string& to) {
    return message_of<InputError>([&] { (void)World::load_string(with(arm(), from, to)); });
  };
  const std::string motor = "</worldbody><actuator><motor joint=\"shoulder\" gear=\"nan\"/></actuator>";
  for (const auto& [from, to, key] : std::vector<std::array<std::string, 3>>{
           {"timestep", "gravity=\"0 0 nan\" timestep", "option@gravity = nan"},
           {"timestep", "density=\"inf\" timestep", "option@density = inf"},
           {"<worldbody>", "<statistic meaninertia=\"inf\"/><worldbody>", "statistic@meaninertia = inf"},
           {"pos=\"0 0 0.1\"", "pos=\"0 nan 0.1\"", "body[upper]/pos = nan"},
           {"mass=\"0.3\"", "mass=\"inf\"", "body[upper]/mass = inf"},
           {"damping=\"0.01\"", "damping=\"inf\"", "joint[shoulder]/damping = inf"},
           {"damping=\"0.01\"", "ref=\"nan\"", "joint[shoulder]/ref = nan"},
           {"damping=\"0.01\"", "springref=\"nan\"", "joint[shoulder]/springref = nan"},
           {"range=\"-2 2\"", "range=\"-2 nan\"", "joint[shoulder]/range = nan"},
           {"size=\"0.02 0.1\"", "size=\"0.02 0.1\" friction=\"-inf 1 1\"", "geom[number 2]/friction = -inf"},
           {"</worldbody>", motor, "actuator[number 0]/gear = nan"}})
    EXPECT_NE(told(from, to).find(key + ": isn't finite (allowed: finite numbers)"), std::string::npos)
        << key << ": " << told(from, to);
  EXPECT_NE(told("0.001", "nan").find("option@timestep = nan"), std::string::npos);
  EXPECT_NO_THROW((void)World::load_string(with(arm(), "range=\"-2 2\"", "range=\"-2 inf\""))) << "open on one side";
}

TEST(OwnMjcf, AsksAboutATextWithNearlyTheRightName) {
  const auto asks = [](const std::string& name) {
    const World world = World::load_string(with(arm(), "\"vsa::Robot\"", '"' + name + '"'));
    EXPECT_TRUE(world.actuators().empty()) << name;
    const std::string said = "<text name=\"" + name + "\"> is left out, did you mean vsa::Robot?";
    return !world.warnings().empty() && world.warnings().front().find(said) != std::string::npos;
  };
  for (const char* name : {"vsa::robot", "vsa_Robot", "vsa::Robot2", "anything, as its data say whose it is"})
    EXPECT_TRUE(asks(name)) << name;
  const World other = World::load_string(with(arm(), "<custom>", "<custom><text name=\"author\" data=\"somebody\"/>"));
  for (const std::string& text : other.warnings()) EXPECT_EQ(text.find("did you mean"), std::string::npos) << text;
}

/// What isn't read for another error isn't missing.
TEST(OwnMjcf, ThatIsRefusedIsntToldToLackItsJoints) {
  const std::string state = "</worldbody><actuator><general joint=\"shoulder\" dyntype=\"filter\"/></actuator>";
  std::string told = message_of<InputError>([&] { (void)World::load_string(with(arm(), "</worldbody>", state)); });
  EXPECT_NE(told.find("states of their own"), std::string::npos) << told;
  EXPECT_EQ(told.find("no such joint"), std::string::npos) << told;
  told = message_of<InputError>(
      [&] { (void)World::load_string(with(with(arm(), "</worldbody>", state), "&lt;type&gt;qbmove", "&lt;type&gt;qbmvoe")); });
  EXPECT_NE(told.find("states of their own"), std::string::npos) << told;
  EXPECT_NE(told.find("unknown actuator type"), std::string::npos) << "what is wrong in the element itself comes with it: " << told;
}

TEST(OwnMjcf, WhoseNameTopicsCantCarryHasAnother) {
  const World world = World::load_string(with(arm(), "model=\"arm\"", "model=\"my arm@home\""));
  EXPECT_EQ(world.name(), "my_arm_home");
  EXPECT_EQ(world.actuators().front().model, "my_arm_home");
  EXPECT_NE(world.warnings().front().find("my arm@home"), std::string::npos) << world.warnings().front();
  // As a part of names of its bodies and joints, too.
  World scoped = World::load_string(
      with(with(arm(), "model=\"arm\"", "model=\"my arm:=1\""), "name=\"shoulder\"", "name=\"my arm:=1::shoulder\""));
  EXPECT_EQ(scoped.joints()[0].name, "my_arm_=1::shoulder");
  EXPECT_EQ(scoped.joints()[0].actuator, 0u);
}

/// The name in the file beside it counts.
TEST(OwnMjcf, IsCalledAsTheFileBesideItSays) {
  const Scratch scratch;
  record::spew(scratch.path() / "arm.xml", with(arm(), "model=\"arm\"", "model=\"my arm\""));
  record::spew(scratch.path() / "arm.vsa.xml", "<vsa><world name=\"lab\"/></vsa>");
  const World world = World::load(scratch.path() / "arm.xml");
  EXPECT_EQ(world.name(), "lab");
  for (const std::string& text : world.warnings()) EXPECT_EQ(text.find("is called"), std::string::npos) << text;
}

/// Neither a world without geoms nor a joint by which a body flies free is anything here.
TEST(OwnMjcf, MayCallWhatIsntThereAsItLikes) {
  std::string text = with(arm(), R"(<geom name="floor" type="plane" size="2 3 1" pos="0 0 -1"/>)",
                          R"(<body name="arm::world" pos="3 0 0"><freejoint name="arm::shoulder"/><geom size="0.1"/></body>)");
  EXPECT_EQ(World::load_string(text).joints().size(), 1u);
}

TEST(OwnMjcf, GetsRoomForContactsWhateverItsRows) {
  const std::string falling = R"(<body pos="0 0.5 -0.8996"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body>)";
  World world = World::load_string(with(with(arm(), "<worldbody>", "<size njmax=\"6001\" nconmax=\"1\"/><worldbody>"),
                                        "<body name=\"base\">", falling + "<body name=\"base\">"));
  EXPECT_NO_THROW(world.run(0.02));
  EXPECT_GE(world.contact_count(), 4);
}

/// It takes such a place for none that is given.
TEST(OwnMjcf, TellsWhatMujocoWarnsOf) {
  const World world = World::load_string(with(arm(), "pos=\"0 0 0.1\"", "pos=\"nan 0 0.1\""));
  EXPECT_NE(world.warnings().front().find("NaN"), std::string::npos) << world.warnings().front();
}

TEST(OwnMjcf, TellsOfControlsThatCantBeZero) {
  const World world = World::load_string(
      with(arm(), "</worldbody>",
           "</worldbody><actuator><motor name=\"m\" joint=\"shoulder\" ctrllimited=\"true\" ctrlrange=\"5 10\"/></actuator>"));
  ASSERT_GE(world.warnings().size(), 2u);
  EXPECT_NE(world.warnings()[1].find("m has no control 0 in its ctrlrange: MuJoCo takes 5"), std::string::npos)
      << world.warnings()[1];
  const World off = World::load_string(
      with(arm(), "</worldbody>",
           "</worldbody><option><flag actuation=\"disable\"/></option><actuator><motor name=\"m\" joint=\"shoulder\" "
           "ctrllimited=\"true\" ctrlrange=\"5 10\"/></actuator>"));
  for (const std::string& text : off.warnings()) EXPECT_EQ(text.find("control"), std::string::npos) << text;
}

TEST(OwnMjcf, HasNoLimitsThatItSwitchesOff) {
  const World world = World::load_string(with(arm(), "<worldbody>", "<option><flag limit=\"disable\"/></option><worldbody>"));
  EXPECT_FALSE(world.joints()[0].range);
}

TEST(OwnMjcf, SaysWhichOfItsWordsIsWrong) {
  const std::string slow = message_of<InputError>([] { (void)World::load_string(with(arm(), "0.001", "0.02")); });
  EXPECT_NE(slow.find("option@timestep"), std::string::npos) << slow;
  EXPECT_NE(slow.find("--step-s"), std::string::npos) << slow;
  const Scratch scratch;
  record::spew(scratch.path() / "arm.xml", arm());
  fs::create_directory(scratch.path() / "arm.vsa.xml");
  const std::string folder = message_of<InputError>([&] { (void)World::load(scratch.path() / "arm.xml"); });
  EXPECT_NE(folder.find("arm.vsa.xml"), std::string::npos) << folder;
}

struct Wrong {
  const char *name, *text, *says;
};
class WrongBeside : public testing::TestWithParam<Wrong> {};

TEST_P(WrongBeside, IsRefusedWithFileKeyAndWhatIsAllowed) {
  const Scratch scratch;
  record::spew(scratch.path() / "arm.xml", arm());
  record::spew(scratch.path() / "arm.vsa.xml", GetParam().text);
  const std::string told = message_of<InputError>([&] { (void)World::load(scratch.path() / "arm.xml"); });
  EXPECT_NE(told.find("arm.vsa.xml"), std::string::npos) << told;
  EXPECT_NE(told.find(GetParam().says), std::string::npos) << told;
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongBeside,
    testing::Values(
        Wrong{"broken", "<vsa", "an XML file"}, Wrong{"root", "<other/>", "<vsa>"},
        Wrong{"element", "<vsa><bone/></vsa>", "world, link, joint"},
        Wrong{"link", "<vsa><link name=\"forearm\"/></vsa>", "no such body in the MJCF"},
        Wrong{"unlisted", "<vsa><link name=\"base\"/></vsa>", "isn't among the links"},
        Wrong{"moves", "<vsa><link name=\"base\"/><link name=\"upper\" static=\"true\"/></vsa>", "can move"},
        Wrong{"joint", "<vsa><joint name=\"elbow\" kind=\"hinge\"/></vsa>", "no such joint of that kind"},
        Wrong{"kind", "<vsa><joint name=\"shoulder\" kind=\"screw\"/></vsa>", "fixed, hinge, slide, ball, universal"},
        Wrong{"end", "<vsa><joint name=\"shoulder\" kind=\"hinge\" parent=\"hand\"/></vsa>", "no such link"},
        Wrong{"shape", "<vsa><link name=\"base\"><visual shape=\"cone\"/></link></vsa>", "box, sphere, cylinder"},
        Wrong{"numbers", "<vsa><link name=\"base\"><visual shape=\"box\" pose=\"0 0 zero\"/></link></vsa>", "7 numbers"},
        Wrong{"start", "<vsa><joint name=\"shoulder\" kind=\"hinge\" start=\"up\"/></vsa>", "1 number"},
        Wrong{"closes", "<vsa><joint name=\"k\" kind=\"slide\" closes=\"true\" place=\"0 0 0\"/></vsa>",
              "a fixed, hinge or ball joint"},
        Wrong{"place", "<vsa><joint name=\"k\" kind=\"ball\" closes=\"true\"/></vsa>", "3 numbers"},
        Wrong{"axis", "<vsa><joint name=\"k\" kind=\"hinge\" closes=\"true\" place=\"0 0 0\"/></vsa>", "joint@axis"},
        Wrong{"unknown", "<vsa><link name=\"base\" masss_kg=\"1\"/></vsa>", "name, model, static, mass_kg, gravity"},
        Wrong{"child", "<vsa><link name=\"base\"><visaul/></link></vsa>", "link/visaul"},
        Wrong{"flag", "<vsa><link name=\"base\" static=\"yes\"/></vsa>", "true, false"},
        Wrong{"friction", "<vsa><friction geom=\"x\" mu=\"1\" mu2=\"2\" along=\"1 0 0\"/></vsa>", "no such geom"},
        Wrong{"direction", "<vsa><friction geom=\"x\" mu=\"1\" mu2=\"2\" along=\"1 1 0\"/></vsa>", "a unit vector"},
        Wrong{"mu", "<vsa><friction geom=\"x\" mu=\"-1\" mu2=\"2\" along=\"1 0 0\"/></vsa>", "not both 0"},
        Wrong{"gravity", "<vsa><link name=\"base\" gravity=\"off\"/></vsa>", "link@gravity"},
        Wrong{"coordinate",
              "<vsa><joint name=\"shoulder\" kind=\"hinge\" child=\"arm::upper\" closes=\"true\" place=\"0 0 0\" "
              "axis=\"0 0 1\"/></vsa>",
              "is a joint of the MJCF, which has a coordinate"},
        Wrong{"equality", "<vsa><joint name=\"k\" kind=\"ball\" child=\"arm::upper\" closes=\"true\" place=\"0 0 0\"/></vsa>",
              "no such equality between its links in the MJCF (allowed: a <connect> at its place)"},
        Wrong{"no_direction", "<vsa><joint name=\"k\" kind=\"hinge\" closes=\"true\" place=\"0 0 0\" axis=\"0 0 0\"/></vsa>",
              "a unit vector"},
        Wrong{"long_axis", "<vsa><joint name=\"k\" kind=\"hinge\" closes=\"true\" place=\"0 0 0\" axis=\"0 0 7\"/></vsa>",
              "a unit vector"},
        Wrong{"frictions",
              "<vsa><friction geom=\"floor\" mu=\"1\" mu2=\"2\" along=\"1 0 0\"/><friction geom=\"floor\" mu=\"1\" "
              "mu2=\"3\" along=\"1 0 0\"/></vsa>",
              "friction@geom = floor: has several"},
        Wrong{"slippery", "<vsa><friction geom=\"stand\" mu=\"1\" mu2=\"2\" along=\"1 0 0\"/></vsa>", "has condim 1 in the MJCF"},
        Wrong{"weightless", "<vsa><link name=\"base\" static=\"true\" gravity=\"false\"/></vsa>", "is static and has no weight"},
        Wrong{"second", "<vsa/><vsa><link name=\"base\"/></vsa>",
              "vsa: stands outside the file's first element (allowed: one <vsa>)"},
        Wrong{"mass", "<vsa><link name=\"base\" mass_kg=\"nan\"/></vsa>", "link@mass_kg = nan"},
        Wrong{"robot", "<vsa><robot model=\"arm\"/></vsa>", "<plugin>"}),
    [](const auto& of) { return std::string(of.param.name); });

TEST(BuiltInWorlds, AreThereWithAndWithoutSdf) {
  World world = World::load("bench_load");
  world.command(world.actuators().front(), 0.3, 0.2);
  world.run(0.5);
  EXPECT_GT(world.read(world.actuators().front()).shaft_rad, 0.05);
}

TEST(WithoutSdf, AnSdfSaysWhatWouldBringIt) {
  if (reader::sdf_feature().is_in()) GTEST_SKIP() << "this build reads SDF";
  const std::string told = message_of<InputError>([] { (void)World::load_string("<sdf version='1.7'/>"); });
  EXPECT_NE(told.find(reader::sdf_feature().missing()), std::string::npos) << told;
}

}  // namespace
}  // namespace vsa::engine
