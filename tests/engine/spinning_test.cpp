// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Bodies that spin: free, on a ball joint, in gimbals; nothing brakes them, and what stands beside them doesn't matter.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "four_bar.hpp"
#include "vsa/physics/mujoco.hpp"

long allocation_count();  // allocation_count.cpp

namespace vsa::engine::testing {
namespace {

using Numbers = std::vector<double>;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string link(const std::string& name, const std::string& pose, double mass, const Numbers& moments,
                 const std::string& at = "0 0 0 0 0 0") {
  return "<link name='" + name + "'><pose>" + pose + "</pose><inertial><pose>" + at + "</pose><mass>" + number(mass) +
         "</mass><inertia><ixx>" + number(moments[0]) + "</ixx><iyy>" + number(moments[1]) + "</iyy><izz>" + number(moments[2]) +
         "</izz></inertia></inertial></link>";
}
std::string turning(const std::string& name, const std::string& parent, const std::string& child, const std::string& axis) {
  return "<joint name='" + name + "' type='revolute'><parent>" + parent + "</parent><child>" + child + "</child><axis><xyz>" +
         axis + "</xyz></axis></joint>";
}
std::string disc(const std::string& name = "disc") {
  return "<model name='" + name + "'>" + link("l", "0 0 3 0 0 0", 0.5, {1e-3, 1e-3, 2e-3}) + "</model>";
}
/// Its centre of mass is 0.1 m above the ball; it leans by 0.3 rad.
std::string top() {
  return "<model name='top'>" + link("l", "0 0 1 0.3 0 0", 0.5, {2e-4, 2e-4, 4e-4}, "0 0 0.1 0 0 0") +
         "<joint name='b' type='ball'><parent>world</parent><child>l</child></joint></model>";
}
std::string gimbals() {
  return "<model name='g'>" + link("a", "0 0 1 0 0 0", 0.1, {1e-4, 1e-4, 1e-4}) +
         link("b", "0 0 1 0 0 0", 0.1, {1e-4, 1e-4, 1e-4}, "0 0.05 0 0 0 0") + link("w", "0 0.1 1 0 0 0", 0.5, {2e-4, 4e-4, 2e-4}) +
         turning("z", "world", "a", "0 0 1") + turning("x", "a", "b", "1 0 0") + turning("y", "b", "w", "0 1 0") + "</model>";
}
/// A free base with two wheels, one of them out of balance.
std::string satellite() {
  return "<model name='s'>" + link("l", "0 0 3 0 0 0", 1, {2e-3, 3e-3, 4e-3}) +
         link("u", "0.1 0 3 0 0 0", 0.2, {2e-4, 1e-4, 1e-4}) +
         link("v", "0 0.1 3 0 0 0", 0.2, {1e-4, 2e-4, 1e-4}, "0.02 0 0 0 0 0") + turning("a", "l", "u", "1 0 0") +
         turning("b", "l", "v", "0 1 0") + "</model>";
}
/// Two hinged links of which one follows the other.
std::string mimic() {
  return "<model name='pair'><pose>0 8 1 0 0 0</pose>" + link("a", "0 0 0 0 0 0", 0.1, {1e-3, 1e-3, 1e-3}) +
         link("b", "0.1 0 0 0 0 0", 0.1, {1e-3, 1e-3, 1e-3}) + turning("x", "world", "a", "0 1 0") +
         "<joint name='y' type='revolute'><parent>world</parent><child>b</child><axis><xyz>0 1 0</xyz><mimic "
         "joint='x'><multiplier>1"
         "</multiplier><offset>0</offset><reference>0</reference></mimic></axis></joint></model>";
}
std::string rods(int count) {
  std::string links, joints, before = "world";
  for (int k = 0; k < count; ++k) {
    const std::string name = "l" + std::to_string(k);
    links += link(name, number(0.2 * k) + " -4 1 0 0 0", 0.1, {1e-5, 3.3e-4, 3.3e-4}, "0.1 0 0 0 0 0");
    joints += turning("j" + std::to_string(k), before, name, "0 1 0");
    before = name;
  }
  return "<model name='c'>" + links + joints + "</model>";
}

struct Start {
  std::string what;  ///< "joint top::b", "link disc::l"
  Numbers speeds;
};
World begun(const std::string& sdf, double step_s, const std::vector<Start>& starts,
            physics::Coriolis coriolis = physics::Coriolis::of_now) {
  WorldOptions options;
  options.step_s = step_s;
  options.physics = physics::mujoco(coriolis);
  World w = World::load_string(sdf, options);
  Numbers state(w.state_size());
  w.save(state);
  const StateLayout layout = w.state_layout();
  for (const Start& s : starts) {
    const StateEntry* entry = layout.find("physics/" + s.what + ".speed");
    if (entry == nullptr) throw std::runtime_error(s.what);
    std::copy(s.speeds.begin(), s.speeds.end(), state.begin() + static_cast<std::ptrdiff_t>(entry->offset));
  }
  w.restore(state);
  return w;
}

struct Drift {
  double gain = 0, loss = 0;  ///< over the kinetic energy at the start, or the largest
};
/// HUGE_VAL: it blew up, and said so.
Drift drift(World w, double seconds) {
  Drift out;
  try {
    w.step();
    const auto total = [&] { return w.energy().kinetic + w.energy().gravitational; };
    const double at_first = total();
    double most = 0, least = 0, fastest = w.energy().kinetic;
    while (w.time_s() < seconds) {
      w.step();
      most = std::max(most, total() - at_first);
      least = std::min(least, total() - at_first);
      fastest = std::max(fastest, w.energy().kinetic);
      if (fastest > 1e6) return {HUGE_VAL, 0};
    }
    out = {most / fastest, -least / fastest};
  } catch (const SimulationError&) {
    out.gain = HUGE_VAL;
  }
  return out;
}

void show(const char* what, double speed, double step_s, const Drift& d, const Drift& by_itself) {
  std::printf("%s, %g rad/s, %g ms: gain %.3g %%, loss %.3g %%; as in mj_step %.3g %%, %.3g %%\n", what, speed, 1000 * step_s,
              100 * d.gain, 100 * d.loss, 100 * by_itself.gain, 100 * by_itself.loss);
}

/// From its own axis, of the spin.
double wobble(const World& w, const std::string& name) {
  const LinkHandle l = w.link(name);
  const V axis = turned(w.pose(l), {0, 0, 1}), spin = w.velocity(l).angular_rad_per_s;
  const double along = axis[0] * spin[0] + axis[1] * spin[1] + axis[2] * spin[2];
  return std::sqrt(std::max(0.0, spin[0] * spin[0] + spin[1] * spin[1] + spin[2] * spin[2] - along * along)) / std::abs(along);
}

TEST(Spinning, AFreeDiscKeepsItsEnergyAndItsWobble) {
  for (const double part : {0.01, 0.5}) {
    for (const double speed : {50.0, 200.0, 1000.0}) {
      for (const double step_s : {1e-3, 2e-3, 4e-3}) {
        const std::vector<Start> start = {{"link disc::l", {0, 0, 0, part * speed, 0, speed}}};
        const std::string sdf = world(disc(), "0 0 0");
        const Drift d = drift(begun(sdf, step_s, start), 3);
        if (part < 0.1) show("free disc", speed, step_s, d, drift(begun(sdf, step_s, start, physics::Coriolis::as_in_mj_step), 3));
        EXPECT_LT(d.gain, 1e-6) << speed << " rad/s, " << step_s;
        EXPECT_LT(d.loss, 1e-6) << speed << " rad/s, " << step_s;
        if (std::isinf(d.gain)) continue;
        World w = begun(sdf, step_s, start);
        w.run(3);
        EXPECT_NEAR(wobble(w, "disc::l"), part, 1e-4 * part) << speed << " rad/s, " << step_s;
      }
    }
  }
}

TEST(Spinning, AHeavyTopOnABallKeepsItsEnergy) {
  for (const double speed : {20.0, 50.0, 100.0, 200.0, 800.0}) {
    for (const double step_s : {1e-3, 2e-3, 4e-3}) {
      const std::vector<Start> start = {{"joint top::b", {0, 0, speed}}};
      const Drift d = drift(begun(world(top()), step_s, start), 2);
      show("heavy top", speed, step_s, d, drift(begun(world(top()), step_s, start, physics::Coriolis::as_in_mj_step), 2));
      EXPECT_LT(d.gain, 0.01) << speed << " rad/s, " << step_s;
      EXPECT_LT(d.loss, 0.01) << speed << " rad/s, " << step_s;
    }
  }
}

/// Its frame is aside of its centre of mass, its axes are turned, and it tumbles.
TEST(Spinning, AFreeBodyKeepsItsEnergyWhereverItsFrameIs) {
  const std::string body = world(
      "<model name='s'>" + link("l", "0 0 3 0 0 0", 0.5, {1e-3, 2e-3, 2.8e-3}, "0.03 0.01 0.02 0.1 0.2 0.3") + "</model>", "0 0 0");
  for (const double speed : {50.0, 200.0, 1000.0}) {
    for (const double step_s : {1e-3, 4e-3}) {
      const Drift d = drift(begun(body, step_s, {{"link s::l", {0, 0, 0, 0.1 * speed, speed, 0.1 * speed}}}), 3);
      EXPECT_LT(std::max(d.gain, d.loss), 1e-6) << speed << " rad/s, " << step_s;
    }
  }
}

TEST(Spinning, WheelsInGimbalsAndOnAFreeBaseKeepTheirEnergy) {
  for (const double speed : {20.0, 50.0, 100.0, 200.0}) {
    for (const double step_s : {1e-3, 2e-3, 4e-3}) {
      const std::vector<Start> wheel = {{"joint g::y", {speed}}},
                               wheels = {
                                   {"link s::l", {0, 0, 0, 1, 2, -1}}, {"joint s::a", {speed}}, {"joint s::b", {-0.7 * speed}}};
      const std::string in_gimbals = world(gimbals()), free = world(satellite(), "0 0 0");
      const Drift a = drift(begun(in_gimbals, step_s, wheel), 3), b = drift(begun(free, step_s, wheels), 3);
      show("gimbals", speed, step_s, a, drift(begun(in_gimbals, step_s, wheel, physics::Coriolis::as_in_mj_step), 3));
      show("wheels on a free base", speed, step_s, b, drift(begun(free, step_s, wheels, physics::Coriolis::as_in_mj_step), 3));
      EXPECT_LT(std::max(a.gain, a.loss), step_s > 2e-3 ? 0.03 : 0.01) << speed << " rad/s, " << step_s;
      EXPECT_LT(std::max(b.gain, b.loss), 0.01) << speed << " rad/s, " << step_s;
    }
  }
}

/// Where one is afterwards, alone and beside what doesn't touch it.
Numbers place_after(const std::string& sdf, double step_s, const std::vector<Start>& starts, const std::string& of) {
  World w = begun(sdf, step_s, starts);
  w.run(1);
  const Pose p = pose_of(w, of);
  Numbers out(p.position.begin(), p.position.end());
  out.insert(out.end(), p.quaternion.begin(), p.quaternion.end());
  return out;
}

TEST(Spinning, WhatStandsBesideDoesNotMatter) {
  const std::string heavy = "<model name='heavy'><pose>0 20 0 0 0 0</pose>" + link("l", "0 0 9 0 0 0", 1e4, {9, 9, 9}) + "</model>";
  const std::vector<Start> spun = {{"joint top::b", {0, 0, 100}}}, hurled = {{"link heavy::l", {30, 0, 0, 0, 0, 0}}};
  for (const double step_s : {1e-3, 4e-3}) {
    const Numbers top_alone = place_after(world(top()), step_s, spun, "top::l"),
                  rods_alone = place_after(world(rods(4)), step_s, {}, "c::l3");
    const Numbers top_beside = place_after(world(top() + mimic()), step_s, spun, "top::l"),
                  rods_beside = place_after(world(rods(4) + mimic()), step_s, {}, "c::l3"),
                  rods_by_heavy = place_after(world(rods(4) + heavy), step_s, hurled, "c::l3");
    for (std::size_t i = 0; i < top_alone.size(); ++i) {
      EXPECT_NEAR(top_beside[i], top_alone[i], 1e-9) << i << ", " << step_s;
      EXPECT_NEAR(rods_beside[i], rods_alone[i], 1e-9) << i << ", " << step_s;
      EXPECT_EQ(rods_by_heavy[i], rods_alone[i]) << i << ", " << step_s;
    }
  }
}

/// Inertias a thousandfold apart.
TEST(Spinning, RandomChainsOfThreeStayFinite) {
  std::mt19937 random(1);
  const auto spread = [&] { return std::pow(1000.0, static_cast<double>(random()) / 4294967295.0); };
  for (int k = 0; k < 100; ++k) {
    std::string links, joints, before = "world";
    for (int i = 0; i < 3; ++i) {
      const double moment = 1e-5 * spread();
      const std::string name = "l" + std::to_string(i);
      links += link(name, number(0.2 * i) + " 0 1 0 0 0", moment / 3.3e-3, {moment, moment, moment}, "0.1 0 0 0 0 0");
      joints += turning("j" + std::to_string(i), before, name, k % 2 == 0 || i != 1 ? "0 1 0" : "0 0 1");
      before = name;
    }
    EXPECT_TRUE(std::isfinite(drift(begun(world("<model name='c'>" + links + joints + "</model>"), 4e-3, {}), 1).gain)) << k;
  }
}

/// A top on a top.
std::string tops() {
  return "<model name='t'>" + link("a", "0 0 1 0.3 0 0", 0.5, {2e-4, 2e-4, 4e-4}, "0 0 0.1 0 0 0") +
         "<joint name='b' type='ball'><parent>world</parent><child>a</child></joint>" +
         link("c", "0 0 1.2 0.3 0 0", 0.3, {2e-4, 3e-4, 3e-4}, "0 0 0.1 0 0 0") +
         "<joint name='e' type='ball'><parent>a</parent><child>c</child></joint></model>";
}
std::string disc_with_an_arm() {
  return "<model name='h'>" + link("l", "0 0 3 0 0 0", 0.5, {1e-3, 1e-3, 2e-3}) +
         link("arm", "0.1 0 3 0 0 0", 0.1, {1e-5, 1e-4, 1e-4}, "0.05 0 0 0 0 0") + turning("j", "l", "arm", "0 1 0") + "</model>";
}
/// Links on axes in turns; `parent`: the world's, or none.
std::string thrown(int count, const std::string& parent) {
  std::string links, joints, before = parent;
  for (int k = 0; k < count; ++k) {
    const std::string name = "l" + std::to_string(k);
    links += link(name, number(0.1 * k) + " 0 3 0 0 0", 0.2, {1e-4, 3e-4, 3e-4}, "0.05 0 0 0 0 0");
    if (!before.empty()) joints += turning("j" + std::to_string(k), before, name, k % 2 == 0 ? "0 0 1" : "0 1 0");
    before = name;
  }
  return "<model name='n'>" + links + joints + "</model>";
}

/// What turns by up to a tenth of a radian in a step keeps its energy to some percent, and twice as fast it stays finite.
TEST(Spinning, TreesOfSeveralLinksKeepTheirEnergy) {
  struct Case {
    const char* name;
    std::string sdf;
    std::vector<Start> (*start)(double speed);
    double gain, loss;
  };
  const std::vector<Case> cases = {{"a top on a top", world(tops()),
                                    [](double w) {
                                      return std::vector<Start>{{"joint t::b", {1, 0, w}}, {"joint t::e", {0, 1, 0.5 * w}}};
                                    },
                                    0.06, 0.06},
                                   {"a disc with an arm", world(disc_with_an_arm(), "0 0 0"),
                                    [](double w) {
                                      return std::vector<Start>{{"link h::l", {0, 0, 0, 0.05 * w, 0, w}}};
                                    },
                                    2e-4, 2e-5},
                                   {"4 free links", world(thrown(4, ""), "0 0 0"),
                                    [](double w) {
                                      return std::vector<Start>{{"link n::l0", {0, 0, 0, w, 0.1 * w, 0.2 * w}}};
                                    },
                                    0.02, 0.02},
                                   {"12 free links", world(thrown(12, ""), "0 0 0"),
                                    [](double w) {
                                      return std::vector<Start>{{"link n::l0", {0, 0, 0, w, 0.02 * w, 0.02 * w}}};
                                    },
                                    0.08, 0.02},
                                   {"3 links on hinges", world(thrown(3, "world")),
                                    [](double w) {
                                      return std::vector<Start>{{"joint n::j0", {w}}, {"joint n::j1", {0.2 * w}}};
                                    },
                                    2e-4, 2e-5}};
  for (const Case& c : cases) {
    for (const double step_s : {1e-3, 4e-3}) {
      const double speed = 0.1 / step_s;
      const Drift d = drift(begun(c.sdf, step_s, c.start(speed)), 2), faster = drift(begun(c.sdf, step_s, c.start(2 * speed)), 2);
      show(c.name, speed, step_s, d, drift(begun(c.sdf, step_s, c.start(speed), physics::Coriolis::as_in_mj_step), 2));
      EXPECT_LT(d.gain, c.gain) << c.name << ", " << step_s;
      EXPECT_LT(d.loss, c.loss) << c.name << ", " << step_s;
      EXPECT_TRUE(std::isfinite(faster.gain)) << c.name << ", " << step_s;
    }
  }
}

/// On one base, which is fixed to the world.
TEST(Spinning, WhatSpinsOnTheSameBaseDoesNotMatter) {
  const std::string two =
      world("<model name='c'>" + link("base", "0 0 1 0 0 0", 1, {1, 1, 1}) +
            "<joint name='f' type='fixed'><parent>world</parent><child>base</child></joint>" +
            link("a", "0 0 1 0 0 0", 0.1, {1e-5, 3e-4, 3e-4}, "0.1 0 0 0 0 0") +
            link("b", "0.2 0 1 0 0 0", 0.1, {1e-5, 3e-4, 3e-4}, "0.1 0 0 0 0 0") + turning("x", "base", "a", "0 1 0") +
            turning("y", "a", "b", "0 1 0") + link("w", "0 1 1 0 0 0", 0.1, {1e-4, 1e-4, 1e-4}) +
            turning("z", "base", "w", "0 0 1") + "</model>");
  EXPECT_EQ(place_after(two, 1e-3, {}, "c::b"), place_after(two, 1e-3, {{"joint c::z", {300}}}, "c::b"));
}

/// From a tree of few links to one of many.
TEST(Spinning, TakesNothingFromTheHeap) {
  for (const int count : {2, 4, 12, 40}) {
    World w = begun(world(thrown(count, ""), "0 0 0"), 1e-3, {{"link n::l0", {0, 0, 0, 60, 6, 0}}});
    w.run(0.1);
    const long before = allocation_count();
    for (int k = 0; k < 200; ++k) w.step();
    EXPECT_EQ(allocation_count() - before, 0) << count;
  }
}

}  // namespace
}  // namespace vsa::engine::testing
