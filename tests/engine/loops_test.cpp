// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Kinematic loops of an SDF: one joint of each is a constraint (description::Joint::closes), and all of them move as the geometry has
// it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "arm.hpp"
#include "four_bar.hpp"

namespace vsa::engine::testing {
namespace {

const std::string kDamping = "<dynamics><damping>1e-9</damping></dynamics>";  // a joint with it can't close a loop

World load(const std::string& sdf, double step_s = 1e-3) {
  WorldOptions options;
  options.step_s = step_s;
  return World::load_string(sdf, options);
}

std::string closing(const World& w) {
  std::string out;
  for (const JointInfo& j : w.joints()) out += j.closes_loop ? j.name + ' ' : "";
  return out;
}

/// Of a bar, about +y from where it is at the start.
double angle_of(const World& w, const std::string& bar) {
  const V x = turned(pose_of(w, "m::" + bar), {1, 0, 0});
  return std::atan2(-x[2], x[0]);
}

/// How far the linkage is from where its crank has it, m and rad: the points A, B and P, the bars' angles, and out of its plane.
struct Errors {
  double m = 0, rad = 0, askew = 0;
  void look(const World& w, const FourBar& f) {
    const FourBar::Posture zero = f.at(0), now = f.at(angle_of(w, "crank"));
    const auto place = [](const FourBar::At& at) { return V{at.x, 0, 1 + at.z}; };
    const V b{zero.b.x - zero.a.x, 0, zero.b.z - zero.a.z}, of_rocker{zero.b.x - f.ground, 0, zero.b.z};
    const Pose crank = pose_of(w, "m::crank"), coupler = pose_of(w, "m::coupler"), rocker = pose_of(w, "m::rocker");
    m = std::max({m, distance(point(crank, {0, 0, 0}), {0, 0, 1}), distance(point(coupler, {0, 0, 0}), place(now.a)),
                  distance(point(coupler, b), place(now.b)), distance(point(rocker, of_rocker), point(coupler, b)),
                  distance(point(rocker, {0, 0, 0}), {f.ground, 0, 1})});
    const auto off = [&](const char* bar, double at_zero, double at_now) {
      return std::abs(std::remainder(angle_of(w, bar) - (at_now - at_zero), 2 * M_PI));
    };
    rad = std::max({rad, off("coupler", zero.coupler, now.coupler), off("rocker", zero.rocker, now.rocker)});
    for (const Pose& p : {crank, coupler, rocker}) askew = std::max(askew, distance(turned(p, {0, 1, 0}), {0, 1, 0}));
  }
};

/// Puts joints so that the crank is at `angle`: those that have one.
void place(World& w, const FourBar& f, double angle) {
  const FourBar::Posture zero = f.at(0), to = f.at(angle);
  const double coupler = to.coupler - zero.coupler, rocker = to.rocker - zero.rocker;
  const std::map<std::string, double> at = {{"o", angle}, {"a", coupler - angle}, {"p", rocker}, {"b", coupler - rocker}};
  for (const JointInfo& j : w.joints())
    if (j.one_axis()) w.set_joint(j.name, std::remainder(at.at(j.name.substr(3)), 2 * M_PI), 0);
}

const std::vector<std::vector<std::string>> kOthers = {{"o", "a", "p"}, {"o", "b", "p"}, {"a", "b", "p"}, {"o", "a", "b"}};

/// A file in which only the joint that isn't among `others` can close the loop.
FourBarFile closed_elsewhere(const std::vector<std::string>& others) {
  FourBarFile out;
  for (const std::string& j : others) out.of_axis[j] = kDamping;
  return out;
}

TEST(Loops, AFourBarTurnsAsItsGeometryHasItWhicheverJointClosesIt) {
  const FourBar f;
  for (const auto& others : kOthers) {
    World w = load(four_bar(f, closed_elsewhere(others)));
    EXPECT_EQ(w.dof_count(), 3U);
    EXPECT_TRUE(w.warnings().empty());
    const std::string closes = closing(w);
    Errors e;
    double travelled = 0, last = 0;
    const LinkHandle crank = w.link("m::crank");
    while (w.time_s() < 3) {
      const double speed = w.velocity(crank).angular_rad_per_s[1];
      w.apply_wrench(crank, {{}, {0, 0.15 * (6 - speed), 0}, {}});
      w.step();
      e.look(w, f);
      const double now = angle_of(w, "crank");
      travelled += std::remainder(now - last, 2 * M_PI);
      last = now;
    }
    EXPECT_GT(travelled, 4 * M_PI) << closes << "the whole stroke, more than once";
    EXPECT_LT(e.m, 1e-4) << closes;
    EXPECT_LT(e.rad, 5e-4) << closes;
    EXPECT_LT(e.askew, 1e-6) << closes;
  }
}

TEST(Loops, ABallMayCloseThemToo) {
  const FourBar f;
  for (const char* of : {"o", "a", "b", "p"}) {
    FourBarFile file;
    file.type[of] = "ball";
    World w = load(four_bar(f, file));
    EXPECT_EQ(closing(w), "m::" + std::string(of) + ' ');
    Errors e;
    while (w.time_s() < 2) {
      w.step();
      e.look(w, f);
    }
    EXPECT_LT(e.m, 2e-4) << of << ": it turns over, some 20 rad/s fast";
    EXPECT_LT(e.rad, 1e-3) << of;
  }
}

TEST(Loops, TheOrderOfJointsInTheFileDoesNotMatter) {
  std::vector<std::string> order{"a", "b", "o", "p"};
  const FourBar f;
  std::vector<double> first;
  int n = 0;
  do {
    if (n++ % 4 != 0) continue;  // six of the 24
    World w = load(four_bar(f, {.order = order}));
    w.run(1.0);
    std::vector<double> now{angle_of(w, "crank"), angle_of(w, "coupler"), angle_of(w, "rocker")};
    if (first.empty()) first = now;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(now[i], first[i], 1e-9);
    EXPECT_EQ(closing(w), "m::b ");
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_GT(std::abs(first[0]), 0.1) << "it has moved";
}

double period(World& w, double rest) {
  std::vector<double> up;
  double last = std::remainder(angle_of(w, "crank") - rest, 2 * M_PI);
  while (up.size() < 6 && w.time_s() < 20) {
    w.step();
    const double now = std::remainder(angle_of(w, "crank") - rest, 2 * M_PI);
    if (last < 0 && now >= 0) up.push_back(w.time_s() - w.step_s() * now / (now - last));
    last = now;
  }
  return up.size() < 6 ? 0 : (up.back() - up.front()) / 5;
}

TEST(Loops, ASmallSwingsPeriodIsThatOfTheReducedInertia) {
  for (const FourBar& f : {FourBar{}, FourBar{.ground = 0.25, .crank = 0.2, .coupler = 0.15, .rocker = 0.25}}) {
    const double rest = f.hanging(M_PI), expected = 2 * M_PI * std::sqrt(f.inertia(rest) / f.stiffness(rest));
    for (const auto& others : kOthers) {
      World w = load(four_bar(f, closed_elsewhere(others)));
      place(w, f, rest + 0.05);
      const double measured = period(w, rest);
      EXPECT_NEAR(measured, expected, 0.01 * expected) << closing(w);
    }
  }
}

TEST(Loops, AParallelogramSwingsAsAPendulumAndItsCouplerDoesNotTurn) {
  const FourBar f{.ground = 0.3, .crank = 0.2, .coupler = 0.3, .rocker = 0.2};
  // Cranks about their pivots, the coupler as a point at their ends.
  const double inertia = FourBar::moment(f.crank_kg, 0.2) + f.crank_kg * 0.01 + FourBar::moment(f.rocker_kg, 0.2) +
                         f.rocker_kg * 0.01 + f.coupler_kg * 0.04,
               stiffness = f.g * (f.crank_kg * 0.1 + f.rocker_kg * 0.1 + f.coupler_kg * 0.2);
  World w = load(four_bar(f));
  for (const char* j : {"m::o", "m::p"}) w.set_joint(j, M_PI + 0.05, 0);
  w.set_joint("m::a", -M_PI - 0.05, 0);
  const double expected = 2 * M_PI * std::sqrt(inertia / stiffness), measured = period(w, M_PI);
  EXPECT_NEAR(measured, expected, 0.01 * expected);
  EXPECT_NEAR(angle_of(w, "coupler"), 0, 1e-4);
  EXPECT_NEAR(angle_of(w, "crank"), angle_of(w, "rocker"), 1e-4);
}

TEST(Loops, WithoutDampingEnergyStays) {
  const FourBar f;
  for (const auto& others : kOthers) {
    for (const double step_s : {1e-3, 4e-3}) {
      World w = load(four_bar(f, closed_elsewhere(others)), step_s);
      place(w, f, 0.5);
      const auto total = [&] { return w.energy().kinetic + w.energy().gravitational; };
      const double begun = total();
      double most = -1e9, least = 1e9, fastest = 0;
      while (w.time_s() < 5) {
        w.step();
        most = std::max(most, total() - begun);
        least = std::min(least, total() - begun);
        fastest = std::max(fastest, w.energy().kinetic);
      }
      std::printf("closed by %sstep %g s: gain %.2f %%, loss %.2f %%\n", closing(w).c_str(), step_s, 100 * most / fastest,
                  -100 * least / fastest);
      EXPECT_LT(most, (step_s > 2e-3 ? 0.01 : 0.005) * fastest) << closing(w) << step_s;
      EXPECT_GT(least, (step_s > 2e-3 ? -0.4 : -0.015) * fastest) << closing(w) << step_s;
    }
  }
}

TEST(Loops, AFixedJointMayCloseThemToo) {
  const FourBar f;
  FourBarFile file = closed_elsewhere({"o", "a", "p"});
  file.type["b"] = "fixed";
  World w = load(four_bar(f, file));  // a triangle with the world
  EXPECT_EQ(closing(w), "m::b ");
  ASSERT_EQ(w.warnings().size(), 1U);
  EXPECT_NE(w.warnings()[0].find("can't move hold their links still: m::b"), std::string::npos);
  Errors e;
  while (w.time_s() < 1) {
    w.step();
    e.look(w, f);
  }
  EXPECT_LT(e.m, 1e-4);
  EXPECT_LT(std::abs(angle_of(w, "crank")), 1e-3);
}

TEST(Loops, OneThatFliesFreeFallsAsABodyDoes) {
  std::string ring = "<model name='m'><pose>0 0 3 0.3 0.2 0</pose>";
  const auto link = [](const std::string& name, const std::string& pose, double mass) {
    return "<link name='" + name + "'><pose>" + pose + " 0 0 0</pose>" + inertial(mass, 1e-3, "0.05 0 0 0 0 0") + "</link>";
  };
  ring += link("a", "0 0 0", 0.2) + link("b", "0.2 0 0", 0.3) + link("c", "0.2 0 0.2", 0.4) + link("d", "0 0 0.2", 0.1);
  ring += hinge("ab", "a", "b") + hinge("bc", "b", "c") + hinge("cd", "c", "d") + hinge("da", "d", "a");
  World w = load(world(ring + "</model>"));
  EXPECT_EQ(w.dof_count(), 9U);
  w.set_joint("m::ab", 0, 3);
  w.set_joint("m::bc", 0, -3);
  w.run(0.1);  // as the loop has it
  const auto from = w.center_of_mass("m"), next = [&] { return w.step(), w.center_of_mass("m"); }();
  const double v = (next[2] - from[2]) / 1e-3;
  for (int n = 0; n < 400; ++n) w.step();
  EXPECT_NEAR(w.center_of_mass("m")[2], next[2] + 0.4 * v - 9.81 * 0.4 * 0.401 / 2, 3e-6);
  // Each of these joints stands where its child does.
  const std::map<std::string, std::array<double, 3>> in_parent = {
      {"ab", {0.2, 0, 0}}, {"bc", {0, 0, 0.2}}, {"cd", {-0.2, 0, 0}}, {"da", {0, 0, -0.2}}};
  for (const auto& [j, at] : in_parent)
    EXPECT_LT(distance(point(pose_of(w, "m::" + j.substr(0, 1)), at), point(pose_of(w, "m::" + j.substr(1)), {0, 0, 0})), 1e-4)
        << j;
}

TEST(Loops, AStaticLinkHoldsOneAsTheWorldDoes) {
  const std::string shape = "'><pose>9 0 0 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry></collision>",
                    wall = "<model name='wall'><static>true</static><pose>0.1 0 0.2 0 0 1</pose><link name='l'><collision name='c" +
                           shape + "<collision name='d" + shape + "</link></model>";
  FourBarFile file = closed_elsewhere({"o", "a", "b"});
  file.more = wall;
  World by_world = load(four_bar({}, file));
  file.post = "wall::l";
  World by_wall = load(four_bar({}, file));
  for (World* w : {&by_world, &by_wall}) {
    EXPECT_EQ(closing(*w), "m::p ");
    w->run(0.5);
  }
  EXPECT_GT(std::abs(angle_of(by_wall, "crank")), 0.1);
  for (const char* bar : {"crank", "coupler", "rocker"}) EXPECT_EQ(angle_of(by_wall, bar), angle_of(by_world, bar));
}

TEST(Loops, TheJointThatClosesOneHasNoAngle) {
  World w = load(four_bar({}));
  ASSERT_EQ(w.joints().size(), 4U);
  for (const JointInfo& j : w.joints()) {
    EXPECT_EQ(j.type, JointInfo::Type::revolute) << j.name;
    EXPECT_EQ(j.closes_loop, j.name == "m::b");
    EXPECT_EQ(j.dof.has_value(), j.name != "m::b");
    EXPECT_EQ(j.held, j.closes_loop ? std::vector<std::string>{} : std::vector<std::string>{"the loop that m::b closes"}) << j.name;
    if (!j.closes_loop) {
      EXPECT_NO_THROW(static_cast<void>(w.joint_angle(j.name))) << j.name;
    }
  }
  for (const auto& ask : {std::function<void()>([&] { static_cast<void>(w.joint_angle("m::b")); }),
                          std::function<void()>([&] { w.set_joint("m::b", 0, 0); })}) {
    try {
      ask();
      ADD_FAILURE();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("m::b: closes a kinematic loop and has no angle (allowed: m::a, m::o, m::p)"),
                std::string::npos)
          << e.what();
    }
  }
}

TEST(Loops, TheJointThatClosesOneIsntOfferedToAnActuator) {
  const std::string told = problems_of(four_bar({}, {.more = plugin(actuator("elbow"))}));
  EXPECT_NE(told.find("the model has no such joint (allowed: o, a, p)"), std::string::npos) << told;
  const std::string named = problems_of(four_bar({}, {.more = "<joint name='rod' type='fixed'><parent>crank</parent><child>end"
                                                              "</child></joint><link name='end'>" +
                                                              inertial(0.1, 1e-4) + "</link>" + plugin(actuator("rod"))}));
  EXPECT_NE(named.find("can't move: it is fixed"), std::string::npos) << named;
}

TEST(Loops, AnActuatedJointStaysInTheTree) {
  for (const char* driven : {"o", "a", "b", "p"}) {
    World w = load(four_bar({}, {.more = plugin(actuator(driven))}));
    EXPECT_EQ(w.joints()[w.joint(w.actuators().at(0)).index()].name, "m::" + std::string(driven));
    EXPECT_EQ(w.dof_count(), 3U);
  }
}

TEST(Loops, GoOnTheSameWayInCopiesSnapshotsAndNumbers) {
  World w = load(four_bar({}));
  w.run(0.2);
  World copy = w.clone();
  const auto there = w.snapshot();
  w.run(0.3);
  copy.run(0.3);
  EXPECT_EQ(copy.state_hash(), w.state_hash());
  const std::uint64_t after = w.state_hash();
  w.restore(*there);
  w.run(0.3);
  EXPECT_EQ(w.state_hash(), after);
}

/// Seven freedoms askew, the last hinge closes the loop: what it leaves free is one.
std::string spatial(double mass = 0.2) {
  const auto link = [&](const std::string& name, const std::string& pose) {
    return "<link name='" + name + "'><pose>" + pose + "</pose>" + inertial(mass, 4e-4, "0.05 0.02 0 0 0 0") + "</link>";
  };
  const auto joint = [](const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                        const std::string& axes, const std::string& more) {
    return "<joint name='" + name + "' type='" + type + "'>" + more + "<parent>" + parent + "</parent><child>" + child +
           "</child>" + axes + "</joint>";
  };
  const std::string d = "<dynamics><damping>0.002</damping></dynamics></axis>",
                    two = "<axis><xyz>1 0.2 0</xyz>" + d +
                          "<axis2><xyz>0 1 0.3</xyz><dynamics><damping>0.002</damping></dynamics></axis2>";
  return world("<model name='m'>" + link("k", "0 0 1 0 0 0") + link("l", "0.1 0 1 0 0 0.3") + link("n", "0.2 0.1 1.05 0.2 0 0") +
               link("r", "0.3 0.1 1.1 0 0.4 0") + joint("j1", "revolute", "world", "k", "<axis><xyz>0 0.3 1</xyz>" + d, "") +
               joint("j2", "universal", "k", "l", two, "") + joint("j3", "universal", "l", "n", two, "") +
               joint("j4", "revolute", "n", "r", "<axis><xyz>0 1 0.2</xyz>" + d, "") +
               joint("j5", "revolute", "world", "r", "<axis><xyz>0.3 0.5 1</xyz></axis>", "<pose>0.1 0 0.02 0 0 0</pose>") +
               "</model>");
}

TEST(Loops, AHingeThatClosesOneInSpaceKeepsItsAxis) {
  for (const double step_s : {1e-3, 4e-3}) {
    World w = load(spatial(), step_s);
    ASSERT_EQ(closing(w), "m::j5 ");
    EXPECT_TRUE(w.warnings().empty());
    const Pose begun = pose_of(w, "m::r");
    const V at{0.1, 0, 0.02}, world_at = point(begun, at);
    const double n = std::hypot(0.3, 0.5, 1.0);
    const V axis{0.3 / n, 0.5 / n, 1 / n}, world_axis = turned(begun, axis);
    double m = 0, rad = 0, moved = 0;
    while (w.time_s() < 3) {
      w.apply_wrench(w.link("m::k"), {{}, {0, 0, w.time_s() < 1.5 ? 0.4 : -0.4}, {}});
      w.step();
      const Pose now = pose_of(w, "m::r");
      m = std::max(m, distance(point(now, at), world_at));
      rad = std::max(rad, distance(turned(now, axis), world_axis));
      moved = std::max(moved, distance(turned(now, {1, 0, 0}), turned(begun, {1, 0, 0})));
    }
    EXPECT_GT(moved, 0.1);
    EXPECT_LT(m, step_s > 2e-3 ? 1e-3 : 2e-4) << step_s;
    EXPECT_LT(rad, step_s > 2e-3 ? 1e-2 : 2e-3) << step_s;
  }
}

TEST(Loops, AJointThatIsSetTakesThemAlongWhicheverJointClosesThem) {
  const FourBar f;
  for (const auto& others : kOthers) {
    for (const std::string& set : others) {
      World w = load(four_bar(f, closed_elsewhere(others)));
      w.set_joint("m::" + set, -0.15, 0.4);
      EXPECT_EQ(w.joint_angle("m::" + set), -0.15);
      Errors e;
      e.look(w, f);
      EXPECT_LT(std::max(e.m, e.rad), 1e-8) << closing(w) << set;
      const double crank = angle_of(w, "crank"), turn = w.velocity(w.link("m::crank")).angular_rad_per_s[1];
      EXPECT_GT(std::abs(crank), 0.05) << closing(w) << set;
      const FourBar::Posture slope = f.slope(crank - 0.5 * w.step_s() * turn);  // where the engine's speeds belong
      const std::map<std::string, double> rate = {
          {"o", 1}, {"a", slope.coupler - 1}, {"p", slope.rocker}, {"b", slope.coupler - slope.rocker}};
      for (const std::string& j : others) EXPECT_NEAR(w.joint_speed("m::" + j), rate.at(j) * turn, 1e-6) << closing(w) << set << j;
    }
  }
}

TEST(Loops, AllTheirJointsMayBeSetOneByOne) {
  const FourBar f;
  for (const double to : {0.3, 2.5, M_PI, -1.0}) {
    World w = load(four_bar(f));
    place(w, f, to);
    const FourBar::Posture zero = f.at(0), at = f.at(to);
    EXPECT_EQ(w.joint_angle("m::o"), std::remainder(to, 2 * M_PI));
    EXPECT_EQ(w.joint_angle("m::p"), std::remainder(at.rocker - zero.rocker, 2 * M_PI));
    EXPECT_EQ(w.joint_angle("m::a"), std::remainder(at.coupler - zero.coupler - to, 2 * M_PI));
  }
}

/// A beam of 10 kg whose one end may slide up, down and along x: only the hinge about x at its other end, itself in a loop, holds it
/// level. `bracket`: the hinge's link, or the beam.
std::string held_level(const std::string& bracket, const std::string& at) {
  const auto joint = [](const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                        const std::string& axes) {
    return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child + "</child>" + axes +
           "</joint>";
  };
  const std::string closing = "<joint name='h' type='revolute'><pose>" + at + "</pose><parent>world</parent><child>" +
                              (bracket.empty() ? "beam" : "bracket") + "</child><axis><xyz>1 0 0</xyz></axis></joint>";
  return world("<model name='m'><link name='a'>" + inertial(1, 0.01) + "</link><link name='b'>" + inertial(1, 0.01) +
               "</link><link name='beam'>" + inertial(10, 0.8, "0.5 0 0 0 0 0") + "</link>" + bracket +
               joint("along", "prismatic", "world", "a", "<axis><xyz>1 0 0</xyz></axis>") +
               joint("up", "prismatic", "a", "b", "<axis><xyz>0 0 1</xyz></axis>") +
               joint("u", "universal", "b", "beam", "<axis><xyz>0 1 0</xyz></axis><axis2><xyz>0 0 1</xyz></axis2>") + closing +
               "</model>");
}

TEST(Loops, AHingeAtALightBracketHoldsAHeavyBeamAsOneAtTheBeamDoes) {
  const auto dip = [](const std::string& sdf) {
    World w = load(sdf);
    EXPECT_EQ(closing(w), "m::h ");
    w.run(1.0);
    return distance(turned(pose_of(w, "m::beam"), {1, 0, 0}), {1, 0, 0});
  };
  constexpr double kAsIf_rad = 2e-5;
  EXPECT_LT(dip(held_level("", "1 0 0 0 0 0")), kAsIf_rad);
  for (const auto& [mass, moment] : {std::pair{1.0, 0.01}, std::pair{0.01, 2e-6}, std::pair{0.002, 1.1e-6}}) {
    const double with =
        dip(held_level("<link name='bracket'><pose>1 0 0 0 0 0</pose>" + inertial(mass, moment) +
                           "</link><joint name='f' type='fixed'><parent>beam</parent><child>bracket</child></joint>",
                       "0 0 0 0 0 0"));
    EXPECT_LT(with, kAsIf_rad) << mass << " kg";
  }
}

TEST(Loops, ASavedStateMayTurnABallOnlyWhereItClosesOne) {
  const FourBar f;
  const auto saved = [&](const FourBarFile& file, const std::vector<std::string>& bars) {
    const FourBar::Posture zero = f.at(0), to = f.at(0.4);
    const std::map<std::string, std::array<double, 3>> at = {{"crank", {0, 0, 0.4}},
                                                             {"coupler", {to.a.x, to.a.z, to.coupler - zero.coupler}},
                                                             {"rocker", {f.ground, 0, to.rocker - zero.rocker}}};
    std::string state = "<state world_name='w'><model name='m'><pose>0 0 1 0 0 0</pose>";
    for (const std::string& bar : bars) {
      const auto& [x, z, turn] = at.at(bar);
      char pose[200];
      std::snprintf(pose, sizeof pose, "%.17g 0 %.17g 0 %.17g 0", x, 1 + z, turn);
      state += "<link name='" + bar + "'><pose>" + pose + "</pose></link>";
    }
    std::string all = four_bar(f, file);
    return all.replace(all.find("</world>"), 0, state + "</model></state>");
  };
  FourBarFile one;
  one.type["b"] = "ball";
  World w = load(saved(one, {"crank", "coupler", "rocker"}));
  EXPECT_EQ(closing(w), "m::b ");
  EXPECT_TRUE(w.warnings().empty()) << w.warnings()[0];
  EXPECT_NEAR(w.joint_angle("m::o"), 0.4, 1e-9);
  FourBarFile two = one;
  two.type["a"] = "ball";
  const std::string told = problems_of(saved(two, {"crank", "coupler", "rocker"}));
  EXPECT_NE(told.find("m::a can't start turned: it isn't one with one axis"), std::string::npos) << told;
}

}  // namespace
}  // namespace vsa::engine::testing
