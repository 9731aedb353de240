// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a controller asks of a world, against closed forms: the two-link arm of arm.hpp, whose angles turn its links down from +x
// (about +y), and a body that flies free.
//
//   M11 = I1 + I2 + m1 c1² + m2 (l1² + c2² + 2 l1 c2 cos b)   M12 = I2 + m2 (c2² + l1 c2 cos b)   M22 = I2 + m2 c2²
//   Coriolis: −h ḃ (2ȧ + ḃ), +h ȧ²   with h = m2 l1 c2 sin b
//   gravity:  what has to be given at each joint is −g (…) cos: the arm wants to turn to +a, downwards
#include <cmath>

#include "engine/arm.hpp"

namespace vsa::engine::testing {
namespace {

using P = ArmParams;

struct Arm {
  explicit Arm(double a, double b, double va = 0, double vb = 0, const std::string& text = passive_arm())
      : w(World::load_string(text)) {
    shoulder = w.joint("arm::shoulder");
    elbow = w.joint("arm::elbow");
    w.set_joint(shoulder, a, va);
    w.set_joint(elbow, b, vb);
    i = *w.joints()[shoulder.index()].dof;
    j = *w.joints()[elbow.index()].dof;
    n = w.dof_count();
  }
  World w;
  JointHandle shoulder, elbow;
  std::size_t i = 0, j = 0, n = 0;
};

TEST(Dynamics, MassMatrixOfATwoLinkArm) {
  for (const double b : {0.0, 0.7, -2.0}) {
    Arm arm(0.4, b);
    std::vector<double> m(arm.n * arm.n);
    arm.w.mass_matrix(m);
    const double c = std::cos(b);
    EXPECT_NEAR(m[arm.i * arm.n + arm.i],
                P::i1 + P::i2 + P::m1 * P::c1 * P::c1 + P::m2 * (P::l1 * P::l1 + P::c2 * P::c2 + 2 * P::l1 * P::c2 * c), 1e-12);
    EXPECT_NEAR(m[arm.i * arm.n + arm.j], P::i2 + P::m2 * (P::c2 * P::c2 + P::l1 * P::c2 * c), 1e-12);
    EXPECT_NEAR(m[arm.j * arm.n + arm.i], m[arm.i * arm.n + arm.j], 1e-15);
    EXPECT_NEAR(m[arm.j * arm.n + arm.j], P::i2 + P::m2 * P::c2 * P::c2, 1e-12);
  }
}

TEST(Dynamics, BiasAndGravityTorquesOfATwoLinkArm) {
  for (const double b : {0.3, -1.2}) {
    const double a = 0.5, va = 2.0, vb = -3.0;
    Arm arm(a, b, va, vb);
    std::vector<double> bias(arm.n), gravity(arm.n), again(arm.n);
    arm.w.bias_torques(bias);
    arm.w.gravity_torques(gravity);
    arm.w.bias_torques(again);
    EXPECT_EQ(bias, again) << "looking changes nothing";
    const double g2 = -kGravity * P::m2 * P::c2 * std::cos(a + b);
    const double g1 = g2 - kGravity * (P::m1 * P::c1 + P::m2 * P::l1) * std::cos(a);
    EXPECT_NEAR(gravity[arm.i], g1, 1e-9);
    EXPECT_NEAR(gravity[arm.j], g2, 1e-9);
    const double h = P::m2 * P::l1 * P::c2 * std::sin(b);
    EXPECT_NEAR(bias[arm.i] - gravity[arm.i], -h * vb * (2 * va + vb), 1e-9);
    EXPECT_NEAR(bias[arm.j] - gravity[arm.j], h * va * va, 1e-9);
  }
}

TEST(Dynamics, TheJacobianOfTheTipIsThatOfAPlanarArm) {
  const double a = 0.4, b = 0.9, va = 1.5, vb = -0.5;
  Arm arm(a, b, va, vb);
  std::vector<double> jac(6 * arm.n);
  const LinkHandle fore = arm.w.link("arm::fore");
  arm.w.jacobian(fore, {0.15, 0, 0}, jac);
  // The tip: x = l1 cos a + 0.15 cos(a + b), z = 1 − l1 sin a − 0.15 sin(a + b).
  const double s12 = 0.15 * std::sin(a + b), c12 = 0.15 * std::cos(a + b);
  EXPECT_NEAR(jac[0 * arm.n + arm.i], -P::l1 * std::sin(a) - s12, 1e-12);
  EXPECT_NEAR(jac[0 * arm.n + arm.j], -s12, 1e-12);
  EXPECT_NEAR(jac[2 * arm.n + arm.i], -P::l1 * std::cos(a) - c12, 1e-12);
  EXPECT_NEAR(jac[2 * arm.n + arm.j], -c12, 1e-12);
  EXPECT_NEAR(jac[4 * arm.n + arm.i], 1, 1e-12) << "turns about +y";
  EXPECT_NEAR(jac[1 * arm.n + arm.i], 0, 1e-12);
  // The link's own velocity is that of its origin, the elbow.
  const Twist v = arm.w.velocity(fore);
  EXPECT_NEAR(v.linear_m_per_s[0], -P::l1 * std::sin(a) * va, 1e-12);
  EXPECT_NEAR(v.linear_m_per_s[2], -P::l1 * std::cos(a) * va, 1e-12);
  EXPECT_NEAR(v.angular_rad_per_s[1], va + vb, 1e-12);
  const Pose pose = arm.w.pose(fore);
  EXPECT_NEAR(pose.position[0], P::l1 * std::cos(a), 1e-12);
  EXPECT_NEAR(pose.position[2], 1 - P::l1 * std::sin(a), 1e-12);
}

TEST(Dynamics, TorquesThatEqualTheBiasHoldTheArm) {
  Arm arm(0.6, -0.8);
  for (int k = 0; k < 500; ++k) {
    std::vector<double> bias(arm.n);
    arm.w.bias_torques(bias);
    arm.w.apply_torque(arm.shoulder, bias[arm.i]);
    arm.w.apply_torque(arm.elbow, bias[arm.j]);
    arm.w.step();
  }
  EXPECT_NEAR(arm.w.joint_angle(arm.shoulder), 0.6, 1e-9);
  EXPECT_NEAR(arm.w.joint_angle(arm.elbow), -0.8, 1e-9);
}

TEST(Dynamics, ATorqueOnAPassiveJointTurnsItUntilItIsTakenAway) {
  Arm arm(0, 0, 0, 0, passive_arm("0 0 0"));
  arm.w.set_joint(arm.shoulder, 0, 0);
  arm.w.apply_torque(arm.elbow, 1e-3);
  arm.w.apply_torque(arm.elbow, 2e-3);  // instead of the first
  arm.w.step();
  // M v̇ = (0, τ), the shoulder free.
  std::vector<double> m(arm.n * arm.n);
  arm.w.mass_matrix(m);
  const double m11 = m[arm.i * arm.n + arm.i], m12 = m[arm.i * arm.n + arm.j], m22 = m[arm.j * arm.n + arm.j];
  const double expected = 2e-3 * 1e-3 * m11 / (m11 * m22 - m12 * m12);
  EXPECT_NEAR(arm.w.joint_speed(arm.elbow), expected, 1e-5 * expected);
  arm.w.apply_torque(arm.elbow, 0);
  const double before = arm.w.energy().kinetic;
  arm.w.run(0.01);
  EXPECT_NEAR(arm.w.energy().kinetic, before, 1e-6 * before);
}

TEST(Dynamics, AWrenchIsAForceAtItsPointAndATorque) {
  World w = World::load_string(passive_arm("0 0 0"));
  const LinkHandle ball = w.link("ball::l");
  // The ball's centre of mass lies at y = 0.1 of its link: a force through it turns nothing.
  w.apply_wrench(ball, {{2, 0, 0}, {}, {0, 0.1, 0}});
  w.run(0.1);
  Twist v = w.velocity(ball);
  EXPECT_NEAR(v.linear_m_per_s[0], 2 / 0.5 * 0.1, 1e-9);
  EXPECT_NEAR(v.angular_rad_per_s[2], 0, 1e-12);
  w.reset();
  EXPECT_EQ(w.velocity(ball).linear_m_per_s[0], 0);
  w.run(0.1);
  EXPECT_EQ(w.velocity(ball).linear_m_per_s[0], 0) << "a reset ends it";
  // At the origin of the link it turns the ball about z by F·0.1, and so does a torque.
  w.apply_wrench(ball, {{2, 0, 0}, {}, {}});
  w.step();
  v = w.velocity(ball);
  EXPECT_NEAR(v.angular_rad_per_s[2], 2 * 0.1 / 0.01 * 1e-3, 1e-9);
  w.reset();
  w.apply_wrench(ball, {{}, {0, 0, 0.2}, {}});
  w.step();
  EXPECT_NEAR(w.velocity(ball).angular_rad_per_s[2], 0.2 / 0.01 * 1e-3, 1e-9);
  w.apply_wrench(ball, {});
  w.step();
  EXPECT_NEAR(w.velocity(ball).angular_rad_per_s[2], 0.2 / 0.01 * 1e-3, 1e-9);
}

TEST(Dynamics, AWrenchHoldsAFlyingBodyAgainstGravity) {
  World w = World::load_string(passive_arm());
  const LinkHandle ball = w.link("ball::l");
  w.apply_wrench(ball, {{0, 0, 0.5 * kGravity}, {}, {0, 0.1, 0}});
  const Pose before = w.pose(ball);
  w.run(0.5);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(w.pose(ball).position[k], before.position[k], 1e-12);
}

TEST(Dynamics, AFreeBodyHasSixDegreesOfFreedomOfItsOwn) {
  Arm arm(0.1, 0.2);
  const LinkHandle ball = arm.w.link("ball::l");
  const auto at = arm.w.free_dof(ball);
  ASSERT_TRUE(at);
  EXPECT_EQ(arm.n, 8U);
  EXPECT_FALSE(arm.w.free_dof(arm.w.link("arm::fore")));
  EXPECT_FALSE(arm.w.free_dof(arm.w.link("floor::l")));
  std::vector<double> m(64), g(8);
  arm.w.mass_matrix(m);
  arm.w.gravity_torques(g);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(m[(*at + k) * 8 + *at + k], 0.5, 1e-12);
  EXPECT_NEAR(m[(*at + 5) * 8 + *at + 5], 0.01 + 0.5 * 0.01, 1e-12) << "about z through its origin";
  EXPECT_NEAR(m[(*at) * 8 + *at + 5], -0.5 * 0.1, 1e-12) << "m × (centre × axis)";
  EXPECT_NEAR(g[*at + 2], 0.5 * kGravity, 1e-12);
  EXPECT_NEAR(g[*at + 3], 0.5 * kGravity * 0.1, 1e-12);
}

TEST(Dynamics, TheListOfJointsSaysWhatTheyAreAndWhoDrivesThem) {
  World w = World::load_string(arm());
  ASSERT_EQ(w.joints().size(), 3U);
  using Type = JointInfo::Type;
  for (const JointInfo& joint : w.joints()) {
    if (joint.name == "arm::mount") {
      EXPECT_EQ(joint.type, Type::fixed);
      EXPECT_FALSE(joint.dof || joint.range || joint.actuator);
    } else if (joint.name == "arm::shoulder") {
      EXPECT_EQ(joint.type, Type::revolute);
      ASSERT_TRUE(joint.range);
      EXPECT_EQ((*joint.range)[1], 2.5);
      EXPECT_EQ(joint.actuator, 0U);
    } else {
      EXPECT_EQ(joint.name, "arm::elbow");
      EXPECT_FALSE(joint.range || joint.actuator);
      EXPECT_TRUE(joint.dof);
    }
  }
  EXPECT_EQ(w.joint(w.actuators().front()), w.joint("arm::shoulder"));
}

}  // namespace
}  // namespace vsa::engine::testing
