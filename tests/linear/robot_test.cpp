// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Several units on bodies: against the unit by itself, and against differences of the physics' own right-hand side.
#include "vsa/linear/robot.hpp"

#include <Eigen/Dense>

#include "smooth.hpp"
#include "vsa/errors.hpp"

namespace {

using namespace vsa;
using Eigen::MatrixXd;
using linear::Bodies;
using linear::DryFriction;
using linear::Firmware;
using linear::Model;
using linear::MountedUnit;
using linear::RobotModel;
using test::Case;

constexpr std::array kFirmwares{Firmware::frozen, Firmware::averaged, Firmware::sampled};

Bodies one_body(const linear::OperatingPoint& p) {
  return {{{"j", false, 0, p.damping_Nms_per_rad, 0}}, MatrixXd::Constant(1, 1, *p.inertia_kgm2), MatrixXd::Zero(1, 1)};
}

void expect_close(const MatrixXd& a, const MatrixXd& b, const std::string& what) {
  ASSERT_EQ(a.rows(), b.rows()) << what;
  ASSERT_EQ(a.cols(), b.cols()) << what;
  EXPECT_LE((a - b).norm(), 1e-12 * b.norm()) << what;
}

TEST(OneJoint, IsTheUnitsOwnLinearization) {
  auto all = test::cases();
  all.push_back({"with friction", test::loaded("qbmove_maker_pro_6_1"), test::point(0, 0.3, 0.05, 1e-3, 0.01)});
  for (const Case& c : all) {
    for (const Firmware firmware : kFirmwares) {
      for (const DryFriction friction : {DryFriction::sliding, DryFriction::stuck}) {
        const Model unit = linear::linearize(c.unit, c.point, firmware, friction);
        const RobotModel robot = linear::linearize(one_body(c.point), {{"j", c.unit, c.point, 0}}, firmware, friction);
        expect_close(robot.a, unit.a, c.name + " A");
        expect_close(robot.b, unit.b, c.name + " B");
        expect_close(robot.c, unit.c, c.name + " C");
        expect_close(robot.d, unit.d, c.name + " D");
        EXPECT_EQ(robot.period_s, unit.period_s);
        EXPECT_EQ(robot.notices.size(), unit.notices.size());
        EXPECT_NEAR(robot.static_stiffness(0, 0), unit.static_stiffness_Nm_per_rad, 1e-12 * unit.held_stiffness_Nm_per_rad);
        EXPECT_NEAR(robot.held_stiffness(0, 0), unit.held_stiffness_Nm_per_rad, 1e-12 * unit.held_stiffness_Nm_per_rad);
        const auto z = linear::response(unit, 7.0).impedance, many = linear::response(robot, 7.0).impedance(0, 0);
        EXPECT_LT(std::abs(z - many), 1e-9 * std::abs(z)) << c.name;
      }
    }
  }
}

/// Three joints, the middle one without a unit, one unit with a current of its own; nothing in M or K is zero.
struct Three {
  std::vector<Case> units;
  Bodies bodies;

  Three() {
    for (Case& c : test::cases())
      if (c.name == "winding with a current of its own" || c.name == "mixed terms") units.push_back(std::move(c));
    bodies.joints = {{"a", false, 0, 0.02, 0}, {"b", true, 0, 0.5, 30}, {"c", false, 0, 0, 1.5}};
    bodies.mass.resize(3, 3);
    bodies.mass << 0.02, 0.01, -0.004, 0.01, 0.4, 0.003, -0.004, 0.003, 0.006;
    bodies.gravity_stiffness.resize(3, 3);
    bodies.gravity_stiffness << 0.7, -0.2, 0.1, -0.2, -0.4, 0.3, 0.1, 0.3, 1.1;
  }
  [[nodiscard]] std::vector<MountedUnit> mounted() const {
    return {{"a", units[0].unit, units[0].point, 0}, {"c", units[1].unit, units[1].point, 2}};
  }
};

/// τ of the three joints for their angles and the motors', by the laws.
Eigen::Vector3d torques(const Three& t, const std::vector<Model>& own, const Eigen::VectorXd& x,
                        const std::vector<Eigen::Index>& at) {
  Eigen::Vector3d q(x[0], x[2], x[4]), v(x[1], x[3], x[5]);
  Eigen::Vector3d out = -t.bodies.gravity_stiffness * q;
  for (int j = 0; j < 3; ++j) out[j] -= t.bodies.joints[j].stiffness * q[j] + t.bodies.joints[j].damping * v[j];
  for (std::size_t u = 0; u < 2; ++u) {
    const int joint = u == 0 ? 0 : 2, each = own[u].a.rows() == 8 ? 3 : 2;
    elastic::Positions where = own[u].rest.at;
    where.q += q[joint];
    for (int i = 0; i < 2; ++i) where.x[i] += x[at[u] + i * each];
    out[joint] += t.units[u].unit.actuator.transmission->evaluate(where).torque + own[u].rest.load_Nm;
  }
  return out;
}

TEST(ThreeJoints, AccelerateAsTheMassMatrixAndAllTorquesTell) {
  const Three t;
  const RobotModel m = linear::linearize(t.bodies, t.mounted(), Firmware::frozen);
  std::vector<Model> own;
  for (const Case& c : t.units) own.push_back(linear::linearize(c.unit, c.point, Firmware::frozen));
  ASSERT_EQ(m.a.rows(), 6 + (own[0].a.rows() - 2) + (own[1].a.rows() - 2));
  const std::vector<Eigen::Index> at{6, 6 + own[0].a.rows() - 2};
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < m.a.cols(); ++j) {
    const auto acceleration = [&](double by) -> Eigen::Vector3d {
      return t.bodies.mass.inverse() * torques(t, own, by * Eigen::VectorXd::Unit(m.a.cols(), j), at);
    };
    const Eigen::Vector3d slope = (acceleration(h) - acceleration(-h)) / (2 * h);
    const Eigen::Vector3d found(m.a(1, j), m.a(3, j), m.a(5, j));
    EXPECT_LT((found - slope).norm(), 1e-6 * m.a.norm() * 1e-2) << m.states[static_cast<std::size_t>(j)].name;
  }
  EXPECT_LT((m.b(Eigen::seqN(1, 3, 2), Eigen::seqN(0, 3)) - t.bodies.mass.inverse()).norm(), 1e-9);
}

TEST(ThreeJoints, HaveTheirUnitsMotorsAsEachAlone) {
  const Three t;
  for (const Firmware firmware : {Firmware::frozen, Firmware::averaged}) {
    const RobotModel m = linear::linearize(t.bodies, t.mounted(), firmware);
    Eigen::Index state = 6, input = 3, output = 6;
    for (std::size_t u = 0; u < 2; ++u) {
      const Model own = linear::linearize(t.units[u].unit, t.units[u].point, firmware);
      const Eigen::Index n = own.a.rows() - 2, joint = u == 0 ? 0 : 4;
      expect_close(m.a.block(state, state, n, n), own.a.bottomRightCorner(n, n), "motors");
      expect_close(m.a.block(state, joint, n, 2), own.a.bottomLeftCorner(n, 2), "motors' shaft");
      expect_close(m.b.block(state, input, n, 2), own.b.bottomRightCorner(n, 2), "voltages");
      expect_close(m.c.block(output, state, 3, n), own.c.bottomRightCorner(3, n), "outputs");
      EXPECT_EQ(m.states[static_cast<std::size_t>(state)].name, std::string(u == 0 ? "a" : "c") + " motor 1 angle");
      state += n;
      input += 2;
      output += 3;
    }
    EXPECT_EQ(m.states.size(), static_cast<std::size_t>(m.a.rows()));
    EXPECT_EQ(m.outputs.size(), static_cast<std::size_t>(m.c.rows()));
    EXPECT_EQ(m.inputs.size(), static_cast<std::size_t>(m.b.cols()));
    EXPECT_EQ(m.states[2].unit, "m");
    EXPECT_EQ(m.inputs[1].unit, "N");
  }
}

TEST(ThreeJoints, GiveWayToASlowTorqueAsTheStaticStiffnessTells) {
  const Three t;
  for (const Firmware firmware : {Firmware::averaged, Firmware::sampled}) {
    const RobotModel m = linear::linearize(t.bodies, t.mounted(), firmware);
    const MatrixXd slow = linear::response(m, 1e-4).compliance.real().inverse();
    EXPECT_LT((slow - m.static_stiffness).norm(), 1e-4 * m.static_stiffness.norm());
    EXPECT_GT(m.held_stiffness(0, 0), m.static_stiffness(0, 0));
  }
}

TEST(ThreeJoints, AnswerAlikeWhicheverIsPushed) {
  const Three t;
  const linear::RobotResponse r = linear::response(linear::linearize(t.bodies, t.mounted(), Firmware::averaged), 4.0);
  EXPECT_LT((r.compliance - r.compliance.transpose()).norm(), 1e-9 * r.compliance.norm()) << "reciprocal";
  for (int j = 0; j < 3; ++j) EXPECT_LT(std::abs(r.driving_point[j] - 1.0 / r.impedance.inverse()(j, j)), 1e-9);
}

TEST(Shapes, BelongToTheirPoles) {
  const Three t;
  const RobotModel m = linear::linearize(t.bodies, t.mounted(), Firmware::averaged);
  const auto poles = linear::poles(m);
  const Eigen::MatrixXcd shapes = linear::shapes(m);
  ASSERT_EQ(shapes.cols(), static_cast<Eigen::Index>(poles.size()));
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const Eigen::VectorXcd v = shapes.col(static_cast<Eigen::Index>(i));
    EXPECT_NEAR(v.norm(), 1, 1e-12);
    EXPECT_LT((m.a * v - poles[i].s * v).norm(), 1e-9 * m.a.norm());
  }
}

void expect_refused(const std::function<void()>& what, const std::vector<std::string>& parts) {
  try {
    what();
    ADD_FAILURE() << "not refused: " << parts.front();
  } catch (const InputError& e) {
    for (const auto& part : parts) EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << " in " << e.what();
  }
}

TEST(Robot, RefusesWhatCantBe) {
  const Three t;
  const auto refused = [&](auto change, const std::vector<std::string>& parts, Firmware firmware = Firmware::averaged) {
    Bodies bodies = t.bodies;
    std::vector<MountedUnit> units = t.mounted();
    change(bodies, units);
    expect_refused([&] { (void)linear::linearize(bodies, units, firmware); }, parts);
  };
  refused([](Bodies& b, auto&) { b.mass(1, 1) = -1; }, {"mass", "positive definite"});
  refused([](Bodies& b, auto&) { b.mass.resize(2, 2); }, {"mass", "3 × 3"});
  refused([](Bodies& b, auto&) { b.gravity_stiffness(0, 2) = NAN; }, {"gravity_stiffness"});
  refused([](Bodies&, auto& u) { u[1].joint = 0; }, {"c", "one unit a joint"});
  refused([](Bodies&, auto& u) { u[1].joint = 3; }, {"c", "one unit a joint"});
  refused([](Bodies&, auto& u) { u.clear(); }, {"units"}, Firmware::sampled);
  refused(
      [](Bodies&, auto& u) {
        u[0].point.preset = 0.9;
        u[1].point.equilibrium_rad = NAN;
      },
      {"a: preset", "c: equilibrium_rad"});
  const auto other = [](Bodies&, auto& u) {
    u[1].unit = test::smooth("sea_example", {{"firmware.generation", "2"}});
    u[1].point = {};
  };
  refused(other, {"c", "2000 µs", "averaged"}, Firmware::sampled);
  Bodies bodies = t.bodies;
  std::vector<MountedUnit> units = t.mounted();
  other(bodies, units);
  EXPECT_NO_THROW((void)linear::linearize(bodies, units, Firmware::averaged));
  EXPECT_NO_THROW((void)linear::linearize(bodies, {}, Firmware::frozen));
}

}  // namespace
