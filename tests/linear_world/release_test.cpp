// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Poles against simulated releases of arms with two and three joints: about other axes, with other loads, one joint without an
// actuator, hanging in gravity with the supply off, and without gravity with the whole program.
#include <Eigen/Dense>
#include <cmath>

#include "engine/worlds.hpp"
#include "linear/smooth.hpp"
#include "vsa/linear_world/linear_world.hpp"

namespace {

using namespace vsa;
using engine::World;
using linear::Firmware;
using linear::Pole;
using linear_world::WorldModel;
using test::Swing;

struct Link {
  const char* axis;
  double mass, length, moment;
  bool driven = true;
};

/// Links that hang below each other, each with its centre of mass aside of its axis.
std::string hanging(const std::vector<Link>& links) {
  std::string bodies, actuators, parent = "world";
  double z = 2;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& l = links[i];
    const std::string n = std::to_string(i + 1);
    bodies += "<link name='l" + n + "'><pose>0 0 " + std::to_string(z) + " 0 0 0</pose>" +
              engine::testing::inertial(l.mass, l.moment, "0 0 " + std::to_string(-0.6 * l.length) + " 0 0 0") +
              "</link><joint name='j" + n + "' type='revolute'><parent>" + parent + "</parent><child>l" + n +
              "</child><axis><xyz>" + l.axis + "</xyz></axis></joint>";
    if (l.driven)
      actuators += "<actuator name='j" + n + "'><joint>j" + n + "</joint><type>qbmove_maker_pro_6_1</type><bus id='" + n +
                   "'>b</bus></actuator>";
    parent = "l" + n;
    z -= l.length;
  }
  return "<model name='m'>" + bodies + "<plugin name='vsa::Robot' filename='libvsa-robot.so'>" + actuators +
         "<bus name='b'/></plugin></model>";
}

World load(const std::string& model, const std::string& gravity, std::vector<config::Override> overrides) {
  for (const char* key : {"drive.friction_Nm", "drive.load_loss", "tendon.friction", "shaft.friction_Nm"})
    overrides.push_back({key, "0"});
  engine::WorldOptions options;
  options.step_s = 2e-4;
  options.actuator.overrides = overrides;
  return World::load_string(engine::testing::world(model, gravity), options);
}

/// The swings with pulleys held: each joint's share, a column each, and what of a motion belongs to each.
struct Modes {
  Eigen::MatrixXd shape, filter;
};

Modes modes_of(const WorldModel& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(m.model.held_stiffness, m.model.bodies.mass);
  return {solver.eigenvectors(), solver.eigenvectors().transpose() * m.model.bodies.mass};
}

/// Of those that ring, the pole whose joints swing most like the mode.
Pole pole_like(const WorldModel& m, const Eigen::MatrixXd& filter, Eigen::Index mode) {
  const auto poles = linear::poles(m.model);
  const Eigen::MatrixXcd shapes = linear::shapes(m.model);
  const Eigen::Index joints = filter.rows();
  Pole best;
  double most = 0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (!(poles[i].s.imag() > 0)) continue;
    const Eigen::VectorXcd angles = shapes.col(static_cast<Eigen::Index>(i))(Eigen::seqN(0, joints, 2));
    const Eigen::VectorXcd part = filter * angles;
    const double share = std::abs(part[mode]) / shapes.col(static_cast<Eigen::Index>(i)).norm();
    if (share > most && std::abs(part[mode]) > 0.7 * part.norm()) {
      most = share;
      best = poles[i];
    }
  }
  return best;
}

/// The swing of one mode, released from rest with its own shape, the largest joint at `aside` rad; the first turns aren't read.
Swing released(World& w, const WorldModel& m, const Modes& modes, Eigen::Index mode, const Pole& pole, double aside) {
  const Eigen::VectorXd shape = modes.shape.col(mode) * (aside / modes.shape.col(mode).cwiseAbs().maxCoeff());
  for (Eigen::Index j = 0; j < shape.size(); ++j) w.set_joint("m::j" + std::to_string(j + 1), shape[j], 0);
  const double turn = 2 * kPi / pole.s.imag();
  std::vector<double> part;
  for (double t = 0; t < 5.2 * turn; t += w.step_s()) {
    Eigen::VectorXd q(shape.size());
    for (Eigen::Index j = 0; j < q.size(); ++j)
      q[j] = w.joint_angle("m::j" + std::to_string(j + 1)) - m.model.bodies.joints[j].angle;
    if (t > 1.2 * turn) part.push_back((modes.filter.row(mode) * q)(0));
    w.step();
  }
  return test::swing_of(part, w.step_s(), 6);
}

struct Arm {
  std::string name;
  std::vector<Link> links;
};

std::vector<Arm> arms() {
  return {{"two, across", {{"0 1 0", 0.5, 0.25, 4e-3}, {"1 0 0", 0.3, 0.2, 2e-3}}},
          {"two, askew", {{"0 1 0.5", 0.2, 0.15, 1e-3}, {"0.4 1 0", 0.8, 0.3, 6e-3}}},
          {"three", {{"1 0 0", 0.6, 0.2, 5e-3}, {"0 1 0", 0.3, 0.25, 2e-3}, {"0.7 0.7 0.1", 0.25, 0.15, 1e-3}}},
          {"three, one free", {{"0 1 0", 0.4, 0.3, 3e-3}, {"0.2 1 0", 0.3, 0.2, 1e-3, false}, {"1 0.3 0", 0.2, 0.2, 8e-4}}}};
}

TEST(Release, OfHangingArmsWithoutSupplyRingsAsThePolesTell) {
  int swings = 0;
  for (const Arm& arm : arms()) {
    World w = load(hanging(arm.links), "0 0 -9.81", {});
    w.robot(0).set_supply(false);
    const WorldModel m = linear_world::linearize(w, {{}, 0.0}, Firmware::frozen);
    for (const double t : m.outside_torque) ASSERT_NEAR(t, 0, 1e-9) << "it hangs";
    const Modes modes = modes_of(m);
    const auto start = w.snapshot();
    for (Eigen::Index mode = 0; mode < modes.shape.cols(); ++mode) {
      const Pole pole = pole_like(m, modes.filter, mode);
      if (!(pole.s.imag() > 0.1) || pole.damping_ratio > 0.3) continue;  // a free joint without gravity stands anywhere
      w.restore(*start);
      w.robot(0).set_supply(false);
      const Swing swing = released(w, m, modes, mode, pole, 2e-3);
      EXPECT_NEAR(swing.damped_Hz, pole.s.imag() / (2 * kPi), 0.02 * swing.damped_Hz) << arm.name << ", mode " << mode;
      EXPECT_NEAR(swing.damping_ratio, pole.damping_ratio, 0.02 * pole.damping_ratio) << arm.name << ", mode " << mode;
      ++swings;
    }
  }
  EXPECT_GE(swings, 8);
}

/// Linear springs, so that a motion may be wide: many percents of duty and many counts, beside which the quantisation is small.
TEST(Release, OfProgrammedArmsRingsAsTheSampledPolesTell) {
  const std::vector<config::Override> linear_springs{{"elastic.k1_Nm", "1e-6"},     {"elastic.c1_Nm_per_rad", "5"},
                                                     {"elastic.k2_Nm", "1e-6"},     {"elastic.c2_Nm_per_rad", "5"},
                                                     {"sensor.encoder_bits", "16"}, {"drive.dead_band", "0"}};
  int swings = 0;
  for (Arm arm : arms()) {
    for (Link& l : arm.links) {  // light, so that they ring fast and the loops' damping is more than the quantisation's
      l.mass *= 0.2;
      l.moment *= 0.2;
    }
    World w = load(hanging(arm.links), "0 0 0", linear_springs);
    const WorldModel m = linear_world::linearize(w, {{}, 0.0}, Firmware::sampled);
    const Modes modes = modes_of(m);
    const auto start = w.snapshot();
    for (Eigen::Index mode = 0; mode < modes.shape.cols(); ++mode) {
      const Pole pole = pole_like(m, modes.filter, mode);
      if (!(pole.s.imag() > 0.1) || pole.damping_ratio > 0.3) continue;  // a free joint without gravity stands anywhere
      w.restore(*start);
      const Swing swing = released(w, m, modes, mode, pole, 0.2);
      EXPECT_NEAR(swing.damped_Hz, pole.s.imag() / (2 * kPi), 0.02 * swing.damped_Hz) << arm.name << ", mode " << mode;
      EXPECT_NEAR(swing.damping_ratio, pole.damping_ratio, 0.02 * pole.damping_ratio) << arm.name << ", mode " << mode;
      ++swings;
    }
  }
  EXPECT_GE(swings, 4);
}

}  // namespace
