// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a world comes to at a point: mass matrix, gravity's stiffness, what carries the weight, what is left out and refused.
#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/arm.hpp"
#include "vsa/errors.hpp"
#include "vsa/linear_world/linear_world.hpp"

namespace {

using namespace vsa;
using namespace vsa::engine::testing;
using engine::World;
using linear::DryFriction;
using linear::Firmware;
using linear_world::WorldModel;
using linear_world::WorldPoint;

using P = ArmParams;

/// Both joints driven. Joints turn about +y with links along +x: an angle q lowers the arm.
std::string driven_arm(const std::string& more = {}, const std::string& gravity = "0 0 -9.81") {
  return world(floor_model() + "<model name='arm'>" + arm_links() +
                   plugin(engine::testing::actuator("shoulder") +
                          "<actuator name='lower'><joint>elbow</joint><type>qbmove_maker_pro_6_1</type>"
                          "<bus id='2'>arm</bus></actuator>") +
                   "</model>" + ball() + more,
               gravity);
}

Eigen::Matrix2d mass(double q2) {
  const double c = std::cos(q2), lower = P::i2 + P::m2 * P::c2 * P::c2, cross = P::m2 * P::l1 * P::c2 * c;
  Eigen::Matrix2d m;
  m << P::i1 + P::m1 * P::c1 * P::c1 + lower + P::m2 * P::l1 * P::l1 + 2 * cross, lower + cross, lower + cross, lower;
  return m;
}

/// ∂²U/∂q², U = −g (m1 c1 + m2 l1) sin q1 − g m2 c2 sin(q1 + q2) for an arm that falls with growing q.
Eigen::Matrix2d gravity_stiffness(double q1, double q2) {
  const double upper = kGravity * (P::m1 * P::c1 + P::m2 * P::l1) * std::sin(q1),
               lower = kGravity * P::m2 * P::c2 * std::sin(q1 + q2);
  Eigen::Matrix2d k;
  k << upper + lower, lower, lower, lower;
  return k;
}

/// A torque servo's preset is its own, not its law's, which has none.
TEST(Point, ATorqueServosPresetIsTheOneInForce) {
  engine::WorldOptions options;
  options.actuator.type = "ugurlu_sea";
  World w = World::load_string(driven_arm({}, "0 0 0"), options);
  for (const auto& a : w.actuators()) ASSERT_TRUE(w.command(a, 0.0, 1000.0));
  w.run(0.5);
  EXPECT_EQ(w.read("lower").preset, 1000) << "read in the unit of the command";
  const WorldModel now = linear_world::linearize(w, {}, Firmware::averaged),
                   told = linear_world::linearize(w, {{}, 1000.0}, Firmware::averaged);
  ASSERT_EQ(now.model.units.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(now.model.units[i].static_stiffness_Nm_per_rad, told.model.units[i].static_stiffness_Nm_per_rad, 1e-6);
  EXPECT_GT(now.model.units[1].static_stiffness_Nm_per_rad, 900);
}

TEST(Point, HasTheArmsMassMatrixAndGravitysStiffness) {
  const World w = World::load_string(driven_arm());
  for (const auto& [q1, q2] : std::vector<std::pair<double, double>>{{1.57, 0}, {1.2, 0.4}, {1.9, -0.3}, {-1.4, 0.1}}) {
    const WorldModel at = linear_world::linearize(w, {{{"shoulder", q1}, {"lower", q2}}, 0.3}, Firmware::frozen);
    ASSERT_EQ(at.model.bodies.joints.size(), 2u);
    EXPECT_LT((at.model.bodies.mass - mass(q2)).norm(), 1e-12);
    EXPECT_LT((at.model.bodies.gravity_stiffness - gravity_stiffness(q1, q2)).norm(), 1e-10) << q1;
    EXPECT_EQ(at.model.bodies.joints[0].name, "shoulder");
    EXPECT_EQ(at.model.bodies.joints[1].name, "lower");
    EXPECT_NEAR(at.gravity_torque[1], -kGravity * P::m2 * P::c2 * std::cos(q1 + q2), 1e-12);
    for (const double t : at.outside_torque) EXPECT_NEAR(t, 0, 1e-8) << "the actuators carry it";
  }
  EXPECT_EQ(w.joint_angle("arm::shoulder"), 0) << "the world itself stays as it is";
}

TEST(Point, OfAPassivePendulumSwingsAsTheTextbookTells) {
  // Behind a shoulder held by a heavy upper arm.
  std::string heavy = arm();
  const std::string light = "<mass>" + std::to_string(P::m1) + "</mass><inertia><ixx>" + std::to_string(P::i1);
  ASSERT_NE(heavy.find(light), std::string::npos);
  for (const char* axis : {"<iyy>", "<izz>", "<ixx>"}) {
    const std::string from = axis + std::to_string(P::i1);
    heavy.replace(heavy.find(from), from.size(), axis + std::to_string(1e6));
  }
  const World w = World::load_string(heavy);
  const WorldModel at = linear_world::linearize(w, {{{"shoulder", kPi / 2}}, 0.0}, Firmware::averaged);
  ASSERT_EQ(at.model.bodies.joints.size(), 2u);
  EXPECT_EQ(at.model.bodies.joints[1].name, "arm::elbow") << "states like the others";
  EXPECT_EQ(at.model.units.size(), 1u);
  const double expected = std::sqrt(kGravity * P::m2 * P::c2 / (P::i2 + P::m2 * P::c2 * P::c2));
  double nearest = 1e9;
  for (const auto& p : linear::poles(at.model)) nearest = std::min(nearest, std::abs(std::abs(p.s.imag()) - expected));
  EXPECT_LT(nearest, 1e-5 * expected);
  EXPECT_NEAR(at.outside_torque[1], 0, 1e-12) << "it hangs";
  const WorldModel aside = linear_world::linearize(w, {{{"arm::elbow", 0.3}, {"shoulder", kPi / 2}}, 0.0}, Firmware::averaged);
  EXPECT_NEAR(aside.outside_torque[1], kGravity * P::m2 * P::c2 * std::sin(0.3), 1e-9) << "somebody has to hold it there";
}

TEST(Point, OfOneJointIsTheUnitsOwn) {
  const std::string one =
      world("<model name='m'><link name='l'>" + inertial(0.4, 0.01) +
                "</link><joint name='j' type='revolute'><parent>world</parent><child>l</child><axis><xyz>1 0 0</xyz>"
                "<dynamics><damping>0.02</damping></dynamics></axis></joint>" +
                plugin(engine::testing::actuator("j")) + "</model>",
            "0 0 0");
  const World w = World::load_string(one);
  const device::UnitConfig unit = config::TypeLibrary().load("qbmove_maker_pro_6_1").unit;
  for (const Firmware firmware : {Firmware::frozen, Firmware::averaged, Firmware::sampled}) {
    for (const double q : {0.0, 0.15}) {
      const linear::Model own = linear::linearize(unit, {0.1, 0.3, 0.1 + q, 0, 0.01, 0.02}, firmware, DryFriction::stuck);
      WorldPoint point{{{"j", 0.1 + q}}, 0.3, {}, {{"j", 0.1}}};
      const WorldModel all = linear_world::linearize(w, point, firmware, DryFriction::stuck);
      EXPECT_LT((all.model.a - own.a).norm(), 1e-9 * own.a.norm());
      EXPECT_LT((all.model.b - own.b).norm(), 1e-9 * own.b.norm());
      EXPECT_LT((all.model.c - own.c).norm(), 1e-9 * own.c.norm());
      EXPECT_NEAR(all.outside_torque[0], own.rest.load_Nm, 1e-12);
      const auto some = linear::poles(own), others = linear::poles(all.model);
      ASSERT_EQ(some.size(), others.size());
      for (std::size_t i = 0; i < some.size(); ++i) EXPECT_LT(std::abs(some[i].s - others[i].s), 1e-9 * own.a.norm());
    }
  }
}

TEST(Point, IsWhereTheWorldIsUnlessTold) {
  World w = World::load_string(driven_arm({}, "0 0 0"));
  w.place("shoulder", 0.4, 0.2);
  w.place("lower", -0.2, 0.5);
  const WorldModel now = linear_world::linearize(w, {}, Firmware::frozen);
  EXPECT_NEAR(now.model.units[0].rest.at.q, 0.4, 1e-12);
  EXPECT_NEAR(now.model.units[1].rest.at.q, -0.2, 1e-12);
  const double stiff = now.model.units[1].held_stiffness_Nm_per_rad;
  EXPECT_GT(stiff, now.model.units[0].held_stiffness_Nm_per_rad);
  WorldPoint told;
  told.presets = {{"lower", 0.2}};
  const WorldModel softer = linear_world::linearize(w, told, Firmware::frozen);
  EXPECT_LT(softer.model.units[1].held_stiffness_Nm_per_rad, stiff);
  EXPECT_EQ(softer.model.units[0].held_stiffness_Nm_per_rad, now.model.units[0].held_stiffness_Nm_per_rad);
  // Parameters are those that its robots have now.
  device::UnitConfig other = w.robot(0).config().actuators[0].unit;
  for (auto& side : other.actuator.side) side.motor.inertia_kgm2 *= 2;
  w.robot(0).set_parameters(0, other);
  EXPECT_NE(linear_world::linearize(w, {}, Firmware::frozen).model.a, now.model.a);
}

TEST(Point, SaysOfAPresetThatNoUnitTakesThatItIsThePreset) {
  const World w = World::load_string(driven_arm());
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const WorldPoint& point :
       {WorldPoint{{}, nan}, WorldPoint{{}, infinity}, WorldPoint{{}, -1e300}, WorldPoint{{}, {}, {{"lower", nan}}}}) {
    try {
      (void)linear_world::linearize(w, point, Firmware::frozen);
      ADD_FAILURE() << "it linearises";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().back().key, "lower: preset");
      EXPECT_EQ(error.problems().back().message, "is out of range");
    }
  }
}

TEST(Point, TellsWhatIsLeftOut) {
  const auto notices = [](const std::string& sdf, const WorldPoint& point = {}) {
    std::string all;
    for (const auto& n : linear_world::linearize(World::load_string(sdf), point, Firmware::frozen).model.notices) all += n + '\n';
    return all;
  };
  EXPECT_EQ(notices(driven_arm({}, "0 0 0")), "left out, since no actuator here moves it: ball::l\n");
  const std::string gate =
      "<model name='gate'><pose>5 0 1 0 0 0</pose><link name='a'>" + inertial(1, 0.1) +
      "</link><joint name='g' type='revolute'><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis>"
      "</joint></model>";
  EXPECT_NE(notices(driven_arm(gate)).find("gate::g"), std::string::npos);
  std::string touching = driven_arm();
  const std::string fore = "<link name='fore'><pose>0.2 0 0 0 0 0</pose>";
  touching.replace(
      touching.find(fore), fore.size(),
      fore +
          "<collision name='c'><pose>0.1 0 -0.98 0 0 0</pose><geometry><sphere><radius>0.021</radius></sphere></geometry>"
          "</collision>");
  const std::string text = notices(touching);
  EXPECT_NE(text.find("arm::fore touches floor::l: contacts are left out"), std::string::npos) << text;
  EXPECT_NE(notices(driven_arm(), {{{"shoulder", 2.5}}, 0.3, {}, {{"shoulder", 2.5}}}).find("arm::shoulder stands at its limit"),
            std::string::npos);
}

void expect_refused(const std::string& sdf, const WorldPoint& point, const std::vector<std::string>& parts) {
  try {
    (void)linear_world::linearize(World::load_string(sdf), point, Firmware::averaged);
    ADD_FAILURE() << "not refused: " << parts.front();
  } catch (const InputError& e) {
    for (const auto& part : parts) EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << " in " << e.what();
  }
}

TEST(Point, RefusesWhatCantBe) {
  const std::string arm2 = driven_arm();
  expect_refused(arm2, {{{"shoulder", 2.6}}}, {"shoulder", "2.6", "2.5"});
  expect_refused(arm2, {{{"wrist", 0.1}, {"lower", NAN}}}, {"wrist", "no such joint", "shoulder", "lower", "limits"});
  expect_refused(arm2, {{}, 0.9}, {"shoulder: preset", "lower: preset", "0.785"});
  expect_refused(arm2, {{}, {}, {{"wrist", 0.1}}, {{"arm::elbow", 1.0}}}, {"presets", "wrist", "equilibria_rad", "arm::elbow"});
  expect_refused(passive_arm(), {}, {"has no actuators"});
  std::string flying = arm2;
  const std::string mount = "<joint name='mount' type='fixed'><parent>world</parent><child>base</child></joint>";
  flying.replace(flying.find(mount), mount.size(), "");
  expect_refused(flying, {}, {"arm::base", "flies free", "fixed to the world"});
  std::string heavy = arm2;
  const std::string m1 = "<mass>" + std::to_string(P::m1) + "</mass>";
  heavy.replace(heavy.find(m1), m1.size(), "<mass>100</mass>");
  expect_refused(heavy, {{}, 0.0}, {"shoulder"});
}

/// A double pendulum as MJCF, its upper joint driven, and a third body beside it.
std::string mjcf(const std::string& more, const std::string& option, const std::string& lower = {}) {
  const std::string inertial = "<inertial pos='0 0 -0.1' mass='0.3' diaginertia='0.002 0.002 0.0005'/>";
  return "<mujoco model='arm'><option timestep='0.001' gravity='0 0 -9.81' " + option +
         "<worldbody><body name='a'><joint name='j0' axis='0 1 0'/>" + inertial +
         "<body name='b' pos='0 0 -0.2'><joint name='j1' axis='0 1 0' " + lower + "/>" + inertial +
         "<site name='tip'/></body></body><body name='c' pos='0.2 0 0'><joint name='j2' axis='0 1 0'/>" + inertial +
         "</body></worldbody>" + more +
         "<custom><text name='vsa::Robot' data=\"&lt;plugin name='vsa::Robot'&gt;&lt;actuator&gt;&lt;joint&gt;j0&lt;/joint&gt;"
         "&lt;type&gt;sea_example&lt;/type&gt;&lt;/actuator&gt;&lt;/plugin&gt;\"/></custom></mujoco>";
}

TEST(Point, RefusesWhatMjcfHoldsByEqualities) {
  for (const auto& [equality, said] : std::vector<std::pair<std::string, std::string>>{
           {"<weld body1='b' body2='world'/>", "weld of b and world"},
           {"<connect body1='b' body2='c' anchor='0 0 -0.2'/>", "connect of b and c"},
           {"<joint joint1='j1' polycoef='0.3 0 0 0 0'/>", "a lock"},
           {"<joint joint1='j1' joint2='j0' polycoef='0 1 1 0 0'/>", "follows arm::j0"}})
    expect_refused(mjcf("<equality>" + equality + "</equality>", "/>"), {}, {"arm::j1", said, "isn't linearised"});
  const std::string elsewhere =
      "<equality><joint joint1='j2' polycoef='0 0 0 0 0'/><weld body1='b' body2='world' active='false'/></equality>";
  EXPECT_EQ(linear_world::linearize(World::load_string(mjcf(elsewhere, "/>")), {}, Firmware::frozen).model.bodies.joints.size(), 2u)
      << "what holds no joint of the model";
}

TEST(Point, RefusesWhatALoopHolds) {
  std::string text = "<sdf version='1.9'><world name='w'><model name='m'>";
  for (const auto& [name, pose] :
       std::vector<std::pair<std::string, std::string>>{{"a", "0 0 0"}, {"b", "0 0 0.1"}, {"c", "0.3 0 0.1"}})
    text += "<link name='" + name + "'><pose>" + pose + " 0 0 0</pose></link>";
  for (const auto& [parent, child] :
       std::vector<std::pair<std::string, std::string>>{{"world", "a"}, {"a", "b"}, {"b", "c"}, {"world", "c"}})
    text += "<joint name='" + parent + child + "' type='revolute'>" +
            (parent == "world" && child == "c" ? "<pose>0 0 -0.1 0 0 0</pose>" : "") + "<parent>" + parent + "</parent><child>" +
            child + "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  text += "<plugin name='vsa::Robot' filename='x'><actuator><joint>worlda</joint><type>sea_example</type></actuator></plugin>";
  expect_refused(text + "</model></world></sdf>", {}, {"m::ab: is held by the loop that m::bc closes, which isn't linearised"});
}

TEST(Point, TellsOfForcesThatOnlyMjcfHas) {
  const auto notices = [](const std::string& text) {
    std::string all;
    for (const auto& n : linear_world::linearize(World::load_string(text), {}, Firmware::frozen).model.notices) all += n + '\n';
    return all;
  };
  const std::string tendon =
      "<tendon><fixed name='t' stiffness='50'><joint joint='j0' coef='1'/><joint joint='j1' coef='-1'/></fixed></tendon>";
  EXPECT_NE(notices(mjcf(tendon, "/>")).find("left out: tendon t, which acts on arm::j0, arm::j1\n"), std::string::npos);
  const std::string servo = "<actuator><position name='p' joint='j1' kp='100'/><motor joint='j0'/></actuator>";
  EXPECT_NE(notices(mjcf(servo, "/>")).find("left out: MuJoCo's actuator p, which acts on arm::j1\n"), std::string::npos);
  EXPECT_NE(notices(mjcf("", "viscosity='20'/>")).find("left out: the fluid of <option>, which acts on arm::j0, arm::j1\n"),
            std::string::npos);
  const std::string slack = tendon.substr(0, tendon.find(" stiffness")) + tendon.substr(tendon.find("'50'") + 4);
  EXPECT_EQ(notices(mjcf(slack + "<actuator><motor joint='j0'/></actuator>", "/>")),
            "left out, since no actuator here moves it: arm::j2\n")
      << "what pulls at nothing";
}

/// A joint that neither weight nor spring brings back stays where it is put and goes on as it is pushed: two poles at 0, none grows.
TEST(Point, OfAJointThatNothingHoldsHasTwoPolesAtZero) {
  const auto zeros = [](const std::string& text, Firmware firmware) {
    const WorldModel m = linear_world::linearize(World::load_string(text), {}, firmware);
    EXPECT_EQ(m.model.bodies.joints.size(), 2u);
    std::ptrdiff_t out = 0;
    for (const linear::Pole& p : linear::poles(m.model)) {
      EXPECT_LE(p.s.real(), 0) << text;
      out += p.s == 0.0 ? 1 : 0;
    }
    return out;
  };
  for (const Firmware firmware : {Firmware::frozen, Firmware::averaged, Firmware::sampled})
    EXPECT_EQ(zeros(mjcf("", "><flag gravity='disable'/></option>"), firmware), 3)
        << "the motor has nothing to carry, and yields for ever";
  // Upright, so that the weight leaves it alone; askew, so that the other joint's motion doesn't.
  std::string upright = mjcf("", "/>");
  const std::string joint = "<joint name='j1' axis='0 1 0'", inertia = "diaginertia='0.002 0.002 0.0005'";
  upright.replace(upright.find(joint), joint.size(), "<joint name='j1' axis='0 0 1'");
  upright.replace(upright.find(inertia, upright.find("j1")), inertia.size(), "fullinertia='0.002 0.002 0.001 0 0 0.0005'");
  EXPECT_EQ(zeros(upright, Firmware::frozen), 2);
}

/// A spring, a damper and the weight that a file's flags switch off are no part of it either.
TEST(Point, HasWhatMjcfFlagsLeave) {
  const std::string lower = "stiffness='3' damping='0.1'";
  const auto model = [&](const std::string& flags) {
    return linear_world::linearize(World::load_string(mjcf("", ">" + flags + "</option>", lower)), {{{"arm::j1", 0.5}}},
                                   Firmware::frozen);
  };
  const WorldModel whole = model(""), slack = model("<flag passive='disable'/>"), floating = model("<flag gravity='disable'/>");
  EXPECT_EQ(whole.model.bodies.joints[1].stiffness, 3);
  EXPECT_EQ(slack.model.bodies.joints[1].stiffness, 0);
  EXPECT_EQ(slack.model.bodies.joints[1].damping, 0);
  EXPECT_GT(std::abs(whole.gravity_torque[1]), 0.1);
  EXPECT_EQ(floating.gravity_torque[1], 0);
}

}  // namespace
