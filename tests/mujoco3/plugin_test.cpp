// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in in a MuJoCo from 3.2 on.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <thread>

#include "plugged.hpp"

namespace vsa::mujoco::test {
namespace {

TEST(Library, SaysWhichMujocoItIsForAndThatItIsThere) {
  void* library = dlopen(VSA_MUJOCO_PLUGIN, RTLD_LAZY | RTLD_NOLOAD);
  ASSERT_NE(library, nullptr);
  const auto ask = [&](const char* name) { return reinterpret_cast<const char* (*)()>(dlsym(library, name))(); };
  EXPECT_STREQ(ask("vsa_mujoco_for"), mj_versionString());
  EXPECT_STREQ(ask("vsa_mujoco_problem"), "");
}

struct Case {
  const char* world;
  double duration_s;
};

/// How far its deflections are from those of the embedded engine, which has another MuJoCo, in rows of 10 ms.
double distance_rms(const Case& of, const mjModel& m) {
  std::istringstream rows(output_of(std::string(VSA_REFERENCE) + " " + of.world + " " + std::to_string(of.duration_s)));
  const DataPtr d(mj_makeData(&m));
  mj_resetDataKeyframe(&m, d.get(), 0);
  const int units = static_cast<int>(m.nu) / 2;
  double sum = 0, worst = 0, largest = 0;
  int count = 0, number = 0;
  for (std::string row; std::getline(rows, row); ++count) {
    std::istringstream words(row);
    double t = 0;
    words >> t;
    EXPECT_NEAR(d->time, t, 1e-9);
    mj_forward(&m, d.get());
    for (int u = 0; u < units; ++u) {
      double theirs = 0;
      words >> theirs;
      const double off = d->sensordata[m.sensor_adr[u] + 8] - theirs;
      sum += off * off;
      worst = std::max(worst, std::abs(off));
      largest = std::max(largest, std::abs(theirs));
    }
    for (int k = 0; k < 10; ++k) step(m, *d, number++);
  }
  EXPECT_GT(count, 100);
  EXPECT_GT(largest, 0.05);
  const double rms = std::sqrt(sum / (std::max(count, 1) * units));
  std::printf("MuJoCo %s, %s, %.1f s, solver's tolerance %.0e: deflections up to %.3f rad; off by %.3g rad RMS, at most %.3g\n",
              mj_versionString(), of.world, of.duration_s, m.opt.tolerance, largest, rms, worst);
  return rms;
}

class AsOwnEngine : public testing::TestWithParam<Case> {};

TEST_P(AsOwnEngine, WhereTheContactsSolverGoesToItsEnd) {
  // Versions differ in where the solver stops, and a snake that crawls makes much of it.
  mjModel m = exported(GetParam().world);
  m.opt.tolerance = 1e-14;
  EXPECT_LT(distance_rms(GetParam(), m), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Worlds, AsOwnEngine, testing::Values(Case{"bench_load", 4}, Case{"snake_flat", 3}),
                         [](const auto& of) { return std::string(of.param.world); });

TEST(OwnEngine, IsNearWithMujocosOwnTolerance) {
  EXPECT_LT(distance_rms({"bench_load", 4}, exported("bench_load")), 1e-9);
  EXPECT_LT(distance_rms({"snake_flat", 3}, exported("snake_flat")), 0.02);
}

std::vector<double> rollout(const mjModel& m, mjData& d, int steps, double phase) {
  mj_resetDataKeyframe(&m, &d, 0);
  for (int k = 0; k < steps; ++k) step(m, d, k, phase);
  return state_of(m, d);
}

TEST(Data, AThousandMadeCopiedAndDeletedInTurns) {
  const mjModel& m = exported("snake_flat");
  const DataPtr pattern(mj_makeData(&m));
  const std::vector<double> at_20 = rollout(m, *pattern, 20, 0);
  std::vector<DataPtr> alive;
  for (int k = 0; k < 1000; ++k) {
    if (k % 3 == 0) {
      alive.emplace_back(mj_makeData(&m));
    } else {
      alive.emplace_back(mj_copyData(nullptr, &m, pattern.get()));
      ASSERT_EQ(state_of(m, *alive.back()), at_20);
    }
    if (k % 7 == 0) step(m, *alive.back(), 20);
    if (alive.size() > 5) alive.erase(alive.begin() + k % 5);
  }
  EXPECT_EQ(state_of(m, *pattern), at_20);
  // A copy into one that is elsewhere.
  const DataPtr other(mj_makeData(&m));
  rollout(m, *other, 33, 0.5);
  mj_copyData(other.get(), &m, pattern.get());
  for (int k = 20; k < 40; ++k) {
    step(m, *other, k);
    step(m, *pattern, k);
  }
  EXPECT_EQ(state_of(m, *other), state_of(m, *pattern));
}

TEST(Data, SixtyFourThreadsRollOutAsOne) {
  const mjModel& m = exported("snake_flat");
  constexpr std::size_t kThreads = 64;
  constexpr int kSteps = 60;
  std::vector<std::vector<double>> serial(kThreads), parallel(kThreads);
  const DataPtr alone(mj_makeData(&m));
  for (std::size_t i = 0; i < kThreads; ++i) serial[i] = rollout(m, *alone, kSteps, 0.1 * static_cast<double>(i));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&, i] {
      const DataPtr d(mj_makeData(&m));
      parallel[i] = rollout(m, *d, kSteps, 0.1 * static_cast<double>(i));
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < kThreads; ++i) EXPECT_EQ(parallel[i], serial[i]) << i;
}

TEST(Data, SetsAndGetsAreAllThatThereIs) {
  const mjModel& m = exported("snake_flat");
  const DataPtr straight(mj_makeData(&m)), around(mj_makeData(&m));
  rollout(m, *straight, 30, 0);
  rollout(m, *around, 30, 0);
  const std::vector<double> here = state_of(m, *around);
  rollout(m, *around, 11, 0.7);
  set_state(m, *around, here);
  mj_forward(&m, around.get());
  set_state(m, *around, here);
  for (int k = 30; k < 60; ++k) {
    step(m, *straight, k);
    step(m, *around, k);
  }
  EXPECT_EQ(state_of(m, *around), state_of(m, *straight));
}

TEST(Data, ANumberOfPluginStateThatSomebodyOverwritesIsSeen) {
  // By units that are at the state before it, after a forward and a sensor too; others have never seen it.
  static std::vector<std::string> told;
  told.clear();
  mju_user_warning = [](const char* text) { told.emplace_back(text); };  // a state that no units have is told
  std::string error;
  const ModelPtr m = load(one_joint(kType, kActuators), error);
  ASSERT_TRUE(m) << error;
  const DataPtr used(mj_makeData(m.get()));
  used->ctrl[0] = 0.4;
  for (int k = 0; k < 40; ++k) mj_step(m.get(), used.get());
  const std::vector<double> here = state_of(*m, *used);
  const auto count = static_cast<int>(used->plugin_state[0]);
  ASSERT_GT(count, 200);
  ASSERT_LE(count, m->npluginstate);
  mj_step(m.get(), used.get());
  const std::vector<double> plain = state_of(*m, *used);
  int moved = 0;
  for (int i = 0; i < count; ++i) {
    set_state(*m, *used, here);
    mj_forward(m.get(), used.get());
    const double was = used->plugin_state[i], now = was == 0 ? 1 : was == 1 ? 0 : was == std::trunc(was) ? was + 1 : was * 1.001;
    set_state(*m, *used, here);
    used->plugin_state[i] = now;
    const DataPtr fresh(mj_makeData(m.get()));
    set_state(*m, *fresh, here);
    fresh->plugin_state[i] = now;
    for (mjData* d : {used.get(), fresh.get()}) mj_step(m.get(), d);
    ASSERT_EQ(state_of(*m, *used), state_of(*m, *fresh)) << "number " << i;
    ASSERT_TRUE(std::equal(used->sensordata, used->sensordata + m->nsensordata, fresh->sensordata)) << "number " << i;
    moved += state_of(*m, *used) == plain ? 0 : 1;
  }
  EXPECT_GT(moved, count / 2);
  mju_user_warning = nullptr;
  EXPECT_GT(told.size(), 20U);
  for (const std::string& text : told)
    EXPECT_TRUE(text.starts_with("vsasim.unit") || text.starts_with("Nan, Inf")) << text << ": whose is that?";
}

TEST(Data, FiniteDifferencesLeaveItWhereItWas) {
  const mjModel& m = exported("bench_load");
  const DataPtr d(mj_makeData(&m)), other(mj_makeData(&m));
  rollout(m, *d, 200, 0);
  rollout(m, *other, 200, 0);
  const auto nx = 2 * static_cast<std::size_t>(m.nv) + static_cast<std::size_t>(m.na), nu = static_cast<std::size_t>(m.nu);
  std::vector<double> a(nx * nx), b(nx * nu);
  mjd_transitionFD(&m, d.get(), 1e-6, 1, a.data(), b.data(), nullptr, nullptr);
  EXPECT_LT(a[nx], 0) << "the springs pull the shaft back: ∂v'/∂q";
  for (int k = 200; k < 230; ++k) {
    step(m, *d, k);
    step(m, *other, k);
  }
  EXPECT_EQ(state_of(m, *d), state_of(m, *other));
}

TEST(Data, WithoutActuationTheUnitsStandStill) {
  std::string error;
  const ModelPtr m = load(one_joint(kType, kActuators), error);
  ASSERT_TRUE(m) << error;
  const DataPtr d(mj_makeData(m.get()));
  d->ctrl[0] = 0.5;
  for (int k = 0; k < 50; ++k) mj_step(m.get(), d.get());
  const std::vector<double> units(d->plugin_state, d->plugin_state + m->npluginstate);
  mj_forward(m.get(), d.get());
  m->opt.disableflags |= mjDSBL_ACTUATION;
  for (int k = 0; k < 50; ++k) mj_step(m.get(), d.get());
  EXPECT_EQ(std::vector<double>(d->plugin_state, d->plugin_state + m->npluginstate), units);
}

TEST(Model, GoesWhereItsControlsSayWithEveryIntegratorThatItTakes) {
  for (const char* integrator : {"Euler", "implicit", "implicitfast"}) {
    std::string error;
    const ModelPtr m = load(one_joint(kType, kActuators, std::string("integrator=\"") + integrator + '"'), error);
    ASSERT_TRUE(m) << error;
    const DataPtr d(mj_makeData(m.get()));
    d->ctrl[0] = 0.5;
    d->ctrl[1] = 0.3;
    for (int k = 0; k < 2000; ++k) mj_step(m.get(), d.get());
    EXPECT_NEAR(d->qpos[0], 0.5, 0.05) << integrator;
    EXPECT_NEAR(d->sensordata[6], 0.3, 0.02) << integrator;
  }
}

TEST(Model, IsTakenOfEveryKindOfBuiltInWorld) {
  for (const char* world : {"bench_pole", "frank_ball", "gripper_soft", "manipulator_3r", "snake_hills", "snake_rubble"}) {
    const mjModel& m = exported(world);
    const DataPtr d(mj_makeData(&m));
    mj_resetDataKeyframe(&m, d.get(), 0);
    for (int k = 0; k < 200; ++k) mj_step(&m, d.get());
    EXPECT_NEAR(d->time, 0.2, 1e-9) << world << " was reset: it blew up";
    for (const mjWarningStat& w : d->warning) EXPECT_EQ(w.number, 0) << world;
  }
}

TEST(Model, AnInstanceWithinItsOnlyActuatorWillDo) {
  std::string error;
  const ModelPtr m = load(R"(<mujoco><extension><plugin plugin="vsasim.unit"/></extension><worldbody><body>
      <joint name="knee" axis="0 1 0"/><inertial pos="0 0 0" mass="0.2" diaginertia="0.002 0.002 0.002"/></body></worldbody>
      <actuator><plugin name="knee" joint="knee" plugin="vsasim.unit"><config key="type" value="maccepa_example"/>
      </plugin></actuator></mujoco>)",
                          error);
  EXPECT_FALSE(m);
  EXPECT_NE(error.find("vsasim.unit knee: actuator = 1 of this instance"), std::string::npos) << error;
}

#if mjVERSION_HEADER >= 3011000
TEST(Controls, StandBehindThoseOfAnActuatorWithThree) {
  std::string mjcf = one_joint(kType, kActuators), error;
  const std::string ball = R"(<body><joint name="ball" type="ball"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>)";
  mjcf.insert(mjcf.find("</worldbody>"), ball);
  mjcf.insert(mjcf.find("<actuator>") + 10, R"(<orientation joint="ball" kp="1"/>)");
  const ModelPtr m = load(mjcf, error), plain = load(one_joint(kType, kActuators), error);
  ASSERT_TRUE(m) << error;
  ASSERT_GT(m->nu, m->nactuator) << "the first actuator has but one control";
  const DataPtr d(mj_makeData(m.get())), other(mj_makeData(plain.get()));
  const int at = m->actuator_ctrladr[1];
  ASSERT_NE(at, 1);
  d->ctrl[at] = other->ctrl[0] = 0.5;
  d->ctrl[at + 1] = other->ctrl[1] = 0.3;
  for (int k = 0; k < 1000; ++k) {
    mj_step(m.get(), d.get());
    mj_step(plain.get(), other.get());
  }
  EXPECT_NEAR(d->qpos[0], 0.5, 0.05);
  EXPECT_NEAR(d->qpos[0], other->qpos[0], 1e-9);
}
#endif

#if mjVERSION_HEADER >= 3005000
TEST(Controls, ComeLateWhereTheModelSaysSo) {
  std::string late = kActuators, error;
  late.insert(late.find("instance="), "delay=\"0.05\" nsample=\"50\" ");
  const ModelPtr m = load(one_joint(kType, late), error), plain = load(one_joint(kType, kActuators), error);
  ASSERT_TRUE(m) << error;
  const DataPtr d(mj_makeData(m.get())), other(mj_makeData(plain.get()));
  d->ctrl[0] = 0.5;
  for (int k = 0; k < 400; ++k) {
    if (k == 50) other->ctrl[0] = 0.5;
    mj_step(m.get(), d.get());
    mj_step(plain.get(), other.get());
    if (k == 48) {
      EXPECT_NEAR(d->qpos[0], 0, 1e-6);
    }
  }
  EXPECT_GT(d->qpos[0], 0.1);
  EXPECT_NEAR(d->qpos[0], other->qpos[0], 0.02);
}
#endif

struct Wrong {
  const char *name, *config, *actuators, *option, *says;
};

class Refused : public testing::TestWithParam<Wrong> {};

TEST_P(Refused, WithAReadableMessageAndTheProgramLives) {
  const Wrong& w = GetParam();
  std::string error;
  const ModelPtr m =
      load(one_joint(w.config, *w.actuators != '\0' ? w.actuators : kActuators, w.option,
                     std::string(w.name) == "TwoInstancesOnAJoint" ? "<instance name=\"other\">" + kType + "</instance>" : ""),
           error);
  EXPECT_FALSE(m);
  EXPECT_NE(error.find(w.says), std::string::npos) << error;
  const ModelPtr good = load(one_joint(kType, kActuators), error);
  EXPECT_TRUE(good) << error;
}

const char* const kTwice = R"(<plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/>
    <plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/><plugin joint="elbow" plugin="vsasim.unit" instance="other"/>
    <plugin joint="elbow" plugin="vsasim.unit" instance="other"/>)";
const char* const kOne = R"(<plugin joint="elbow" plugin="vsasim.unit" instance="elbow"/>)";

INSTANTIATE_TEST_SUITE_P(
    All, Refused,
    testing::Values(Wrong{"UnknownType", R"(<config key="type" value="qbmove"/>)", "", "",
                          "unknown actuator type, did you mean qbmove_advanced?"},
                    Wrong{"UnknownAttribute", R"(<config key="colour" value="red"/>)", "", "", "colour"},
                    Wrong{"UnknownKey",
                          R"(<config key="type" value="sea_example"/><config key="override" value="drive.wheels=4"/>)", "", "",
                          "drive.wheels"},
                    Wrong{"MissingPresetActuator", kType.c_str(), kOne, "", "equilibrium, then preset"},
                    Wrong{"TwoInstancesOnAJoint", kType.c_str(), kTwice, "", "elbow"},
                    Wrong{"RungeKutta", kType.c_str(), "", "integrator=\"RK4\"", "RK4"}),
    [](const auto& of) { return std::string(of.param.name); });

TEST(Controls, ThatAreNoNumbersAreMujocosWarningAndTheCommandStays) {
  std::string error;
  const ModelPtr m = load(one_joint(kType, kActuators), error);
  const DataPtr d(mj_makeData(m.get()));
  d->ctrl[0] = 0.4;
  for (int k = 0; k < 1500; ++k) {
    if (k == 700) d->ctrl[0] = std::nan("");
    mj_step(m.get(), d.get());
  }
  EXPECT_NEAR(d->qpos[0], 0.4, 0.05);
  EXPECT_GT(d->warning[mjWARN_BADCTRL].number, 0);
}

}  // namespace
}  // namespace vsa::mujoco::test
