// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator's FMU on bodies: those of bench_load and of the snake, which the engine moves with the FMUs' torques, against the same
// worlds with their own actuators; and what explicit coupling makes of a swing. Figures for docs/howto/fmu.md are printed.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <functional>

#include "importer.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::test {
namespace {

engine::World bodies_of(const char* world) {
  engine::WorldOptions options;
  options.actuators = false;
  return engine::World::load(world, options);
}

/// The world's actuators, each as an FMU of its type.
class Others {
 public:
  explicit Others(const char* world, const engine::World& whole) : bodies_(bodies_of(world)) {
    const auto& config = whole.robot(0).config();
    package_ =
        exported({.type = config.actuators[0].type, .start = {.coupling = fmu::Coupling::implicit, .load_inertia_kgm2 = 1.0}});
    for (std::size_t i = 0; i < whole.actuators().size(); ++i) {
      const host::ActuatorConfig& a = config.actuators[i];
      units_.push_back(std::make_unique<Instance2>(*package_, a.name));
      joints_.push_back(bodies_.joint(whole.joints()[whole.joint(whole.actuators()[i]).index()].name));
      units_.back()->set("equilibrium", a.initial_equilibrium_rad);
      units_.back()->set("preset", a.initial_preset);
      units_.back()->start();
    }
  }

  Instance2& unit(std::size_t i) { return *units_[i]; }
  double angle(std::size_t i) { return bodies_.joint_angle(joints_[i]); }
  engine::World& bodies() { return bodies_; }

  /// The unit first, its mean torque over the same step; the inertia behind each joint is told each time.
  void step(int k) {
    const std::size_t n = bodies_.dof_count();
    Eigen::MatrixXd mass(n, n);
    bodies_.mass_matrix({mass.data(), n * n});
    for (const engine::JointInfo& j : bodies_.joints())
      if (j.dof && j.damping != 0) mass(*j.dof, *j.dof) += bodies_.step_s() * j.damping;
    const Eigen::MatrixXd inverse = mass.inverse();
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const std::size_t dof = *bodies_.joints()[joints_[i].index()].dof;
      Instance2& u = *units_[i];
      u.set("load_inertia_kg_m2", 1 / inverse(dof, dof));
      u.set("shaft_angle", bodies_.joint_angle(joints_[i]));
      u.set("shaft_speed", bodies_.joint_speed(joints_[i]));
      u.step(k * bodies_.step_s(), bodies_.step_s());
      bodies_.apply_torque(joints_[i], u.get("mean_torque"));
    }
    bodies_.step();
  }

 private:
  engine::World bodies_;
  std::unique_ptr<Package> package_;
  std::vector<std::unique_ptr<Instance2>> units_;
  std::vector<engine::JointHandle> joints_;
};

struct Difference {
  double largest = 0, squares = 0;
  int count = 0;
  void add(double d) {
    largest = std::max(largest, std::abs(d));
    squares += d * d;
    ++count;
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / count); }
};

/// Both worlds; a command reaches the FMU when its unit in the engine has it.
Difference compare(const char* name, int steps, const std::function<void(engine::World&, int)>& command, double& moved) {
  auto whole = engine::World::load(name);
  Others others(name, whole);
  const std::size_t n = whole.actuators().size();
  std::vector<std::array<Ticks, 2>> had(n);
  for (std::size_t i = 0; i < n; ++i) had[i] = whole.robot(0).received_inputs(i);
  std::vector<std::vector<std::array<double, 2>>> sent(n);
  Difference out;
  for (int k = 0; k < steps; ++k) {
    command(whole, k);
    whole.step();
    others.step(k);
    for (std::size_t i = 0; i < n; ++i) {
      const auto has = whole.robot(0).received_inputs(i);
      if (has != had[i]) {
        const host::ActuatorReading r = whole.read(whole.actuators()[i]);
        others.unit(i).set("equilibrium", r.equilibrium_command_rad);
        others.unit(i).set("preset", r.preset_command);
        had[i] = has;
      }
      const double q = whole.joint_angle(whole.joint(whole.actuators()[i]));
      moved = std::max(moved, std::abs(q));
      out.add(others.angle(i) - q);
    }
  }
  return out;
}

TEST(Bodies, TheBenchGoesAsInTheEngine) {
  double moved = 0;
  const Difference d = compare(
      "bench_load", 3000,
      [](engine::World& w, int k) {
        if (k == 200) w.command("shaft", 0.8, 0.2);
        if (k == 1500) w.command("shaft", -0.3, 0.5);
      },
      moved);
  std::printf("bench_load: 3 s, moved up to %.3g rad, largest difference %.3g rad, rms %.3g rad\n", moved, d.largest, d.rms());
  EXPECT_GT(moved, 0.5);
  EXPECT_LT(d.largest, 1e-6) << "the engine asks what gravity does now, an FMU goes on with what it did";
}

TEST(Bodies, TheSnakeWithEachJointAloneStaysNearTheEngineWhichSolvesThemTogether) {
  double moved = 0;
  // One command, slowly taken: with a wave the references would change within the bus's cycle.
  const Difference d = compare(
      "snake_flat", 1500,
      [](engine::World& w, int k) {
        if (k == 100)
          for (std::size_t j = 0; j < w.actuators().size(); ++j) w.command(w.actuators()[j], j % 2 == 0 ? 0.3 : -0.2, 0.2);
      },
      moved);
  std::printf("snake_flat: 1.5 s, moved up to %.3g rad, largest difference %.3g rad, rms %.3g rad\n", moved, d.largest, d.rms());
  EXPECT_GT(moved, 0.1);
  EXPECT_LT(d.rms(), 0.002);
}

TEST(Path, ThatTheShaftIsTakenToGoIsOfTheOrderThatIsSaid) {
  const auto package = exported();
  constexpr double kAmplitude = 0.3, kOmega = 6;
  for (const double h : {1e-3, 4e-3, 10e-3, 20e-3}) {
    for (const bool told : {false, true}) {
      Instance2 u(*package);
      u.start();
      for (int k = 0; k < 20; ++k) {
        const double t = k * h, phase = kOmega * t;
        u.set("shaft_angle", kAmplitude * std::sin(phase));
        u.set("shaft_speed", kAmplitude * kOmega * std::cos(phase));
        u.set("shaft_acceleration", told ? -kAmplitude * kOmega * kOmega * std::sin(phase) : 0);
        u.step(t, h);
        const double shaft = u.get("deflection") + u.get("equilibrium_attained");
        const double error = shaft - kAmplitude * std::sin(kOmega * (t + h));
        const double second = 0.5 * kAmplitude * kOmega * kOmega * std::sin(phase) * h * h,
                     third = kAmplitude * kOmega * kOmega * kOmega * h * h * h / 6;
        EXPECT_NEAR(error, told ? 0 : second, 1.1 * third + 1e-12) << h << ", step " << k;
      }
    }
  }
}

// What importers do with the torque of an FMU whose shaft they move.
enum class Importer {
  late,   ///< FMU and body step side by side: the torque at a point, foreseen from the one before, is held over the next step
  fresh,  ///< the angle is set and the torque read again before the body's step; v' = v + h a, q' = q + h v'
  first   ///< the FMU steps first, implicit, and its mean torque acts over the same step
};

struct Body {
  Importer importer = Importer::late;
  double inertia = 1, h = 1e-3, q = 0.02, v = 0;
  double torque = 0;  ///< as the importer holds it

  void begin(Instance2& u) {
    if (importer == Importer::first) {
      u.set_word("coupling", 2);
      u.set("load_inertia_kg_m2", inertia);
    }
    u.set("shaft_angle", q);
    u.start();
    torque = u.get("torque");
  }
  void step(Instance2& u, int k) {
    u.set("shaft_angle", q);
    u.set("shaft_speed", v);
    if (importer == Importer::fresh) torque = u.get("torque");
    u.step(k * h, h);
    if (importer == Importer::first) torque = u.get("mean_torque");
    const double before = v;
    v += h * torque / inertia;
    q += importer == Importer::late ? 0.5 * h * (before + v) : h * v;
    if (importer == Importer::late) torque = u.get("torque");
  }
};

/// One spring of 10 N·m/rad between a motor that can't turn and a shaft without friction.
std::unique_ptr<Package> bare_spring() {
  return exported({.type = "sea_example",
                   .start = {.set = {{"shaft.friction_Nm", "0"}, {"drive.friction_Nm", "10"}, {"drive.presliding_rad", "0"}}}});
}

/// Spectral radius of a step of the late importer on that spring: states q, h v, h² τ/J with τ' = −σ (q + h v), x² = σh²/J.
double late_radius(double x) {
  Eigen::Matrix3d step;
  step << 1, 1, 0.5, 0, 1, 1, -x * x, -x * x, 0;
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(Stability, AnUndampedSpringGrowsAsTheLinearMapHasIt) {
  const auto package = bare_spring();
  for (const double x : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    for (const Importer importer : {Importer::late, Importer::fresh, Importer::first}) {
      Body body{.importer = importer, .inertia = 10.0 * 1e-6 / (x * x), .q = 1e-3};
      Instance2 u(*package);
      body.begin(u);
      const double omega = x / body.h;
      const int steps = static_cast<int>(std::lround(4 * 2 * M_PI / x));  // four swings
      for (int k = 0; k < steps; ++k) body.step(u, k);
      const double amplitude = std::hypot(body.q, body.v / omega) / 1e-3;
      const double wanted = importer == Importer::late ? std::pow(late_radius(x), steps) : 1.0;
      // The others keep it, but for the phase within the step, and implicit coupling for what it resolves no more.
      const double tolerance = importer == Importer::late ? 0.15 * wanted : x;
      EXPECT_NEAR(amplitude, wanted, tolerance) << "x = " << x << ", importer " << static_cast<int>(importer);
      std::printf("x = %.2f, importer %d: amplitude after four swings %.3g, linear map %.3g\n", x, static_cast<int>(importer),
                  amplitude, wanted);
    }
  }
}

/// The largest angle in the second half of half a second, over where the swing began; 1e9: beyond 10 rad.
double peak(const Package& package, Importer importer, double h, double inertia, double preset) {
  Instance2 u(package);
  u.set("preset", preset);
  Body body{.importer = importer, .inertia = inertia, .h = h};
  body.begin(u);
  const int steps = static_cast<int>(std::lround(0.5 / h));
  double out = 0;
  for (int k = 0; k < steps; ++k) {
    body.step(u, k);
    if (!(std::abs(body.q) < 10)) return 1e9;
    if (2 * k >= steps) out = std::max(out, std::abs(body.q));
  }
  return out / 0.02;
}

TEST(Stability, OfExplicitCouplingHasALimitAndImplicitCouplingHasNone) {
  const auto package = exported();
  std::printf("preset, stiffness, inertia, step, x: late, fresh, implicit\n");
  for (const double preset : {0.0, 0.3, 0.6}) {
    for (const double inertia : {1e-4, 1e-3, 1e-2, 1e-1}) {
      for (const double h : {0.5e-3, 1e-3, 2e-3, 5e-3, 10e-3}) {
        Instance2 u(*package);
        u.set("preset", preset);
        u.start();
        const double x = h * std::sqrt(u.get("stiffness") / inertia);
        const double late = peak(*package, Importer::late, h, inertia, preset),
                     fresh = peak(*package, Importer::fresh, h, inertia, preset),
                     first = peak(*package, Importer::first, h, inertia, preset);
        std::printf("%4.1f %7.2f %7.0e %7.4f %6.2f: %9.3g %9.3g %9.3g\n", preset, u.get("stiffness"), inertia, h, x, late, fresh,
                    first);
        const auto where = [&] { return std::to_string(preset) + ", " + std::to_string(inertia) + ", " + std::to_string(h); };
        EXPECT_LT(first, 1.5) << where();
        if (x < fmu::kExplicitLimit) {
          EXPECT_LT(late, 2.5) << where();
        }
        if (x > 0.7) {
          EXPECT_EQ(late, 1e9) << where();
        }
        if (x < 1.5) {
          EXPECT_LT(fresh, 2.5) << where();
        }
        if (x > 1.9) {
          EXPECT_EQ(fresh, 1e9) << where();
        }
      }
    }
  }
}

}  // namespace
}  // namespace vsa::test
