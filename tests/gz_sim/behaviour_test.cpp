// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in in a gz-sim server, without rendering. A physics system that fails to load leaves a world that steps and doesn't
// move, so every test looks at motion.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sdf/sdf.hh>

#include "../gazebo_bench/bench_script.hpp"
#include "entities.hpp"
#include "robot_system.hpp"
#ifdef VSA_GZ_TRANSPORT
#include <gz/sim/SdfEntityCreator.hh>
#include <gz/sim/Server.hh>
#include <gz/sim/TestFixture.hh>
#define VSA_SIM_LIBRARY "gz-sim"
#define VSA_SIM_CLASS "gz::sim::systems::"
#define VSA_PATH_VARIABLE "GZ_SIM_SYSTEM_PLUGIN_PATH"
#else
#include <ignition/gazebo/SdfEntityCreator.hh>
#include <ignition/gazebo/Server.hh>
#include <ignition/gazebo/TestFixture.hh>
#define VSA_SIM_LIBRARY "ignition-gazebo"
#define VSA_SIM_CLASS "ignition::gazebo::systems::"
#define VSA_PATH_VARIABLE "IGN_GAZEBO_SYSTEM_PLUGIN_PATH"
#endif

namespace vsa::test {
namespace {

namespace sim = plugins::sim;
namespace components = sim::components;

std::string read_file(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

const std::string kHanging = "0 0 0.4 -1.57079633 0 0";
/// The lever level: gravity's torque on the shaft is largest.
const std::string kLevel = "0 0 0.4 -1.57079633 1.57079633 0";

/// The bench model's own text under another name and at a pose.
std::string bench_model(const std::string& name, const std::string& pose) {
  const std::string file = read_file(VSA_SOURCE_DIR "/models/qbmove_bench_load/model.sdf");
  const auto begin = file.find("<model"), end = file.find("</sdf>");
  std::string text = replaced(file.substr(begin, end - begin), "\"qbmove_bench_load\"", '"' + name + '"');
  return text.insert(text.find('>') + 1, "<pose>" + pose + "</pose>");
}

std::string world_sdf(const std::string& inside, double step_s = 1e-3) {
  return "<sdf version='1.7'><world name='test'><gravity>0 0 -9.81</gravity><physics name='step' type='dart'><max_step_size>" +
         std::to_string(step_s) +
         "</max_step_size><real_time_factor>0</real_time_factor></physics><plugin filename='" VSA_SIM_LIBRARY
         "-physics-system' name='" VSA_SIM_CLASS "Physics'/>" +
         inside + "</world></sdf>";
}

void prepare() {
  setenv(VSA_PATH_VARIABLE, VSA_SIM_PLUGIN_DIR, 1);
  setenv("IGN_IP", "127.0.0.1", 1);
  setenv("GZ_IP", "127.0.0.1", 1);
  const std::string partition = "vsa_test_" + std::to_string(getpid());
  setenv("IGN_PARTITION", partition.c_str(), 1);
  setenv("GZ_PARTITION", partition.c_str(), 1);
}

/// A server with one world; joint "shaft" of every model is watched.
class SimWorld {
 public:
  explicit SimWorld(const std::string& sdf) {
    prepare();
    sim::ServerConfig config;
    config.SetSdfString(sdf);
    fixture_ = std::make_unique<sim::TestFixture>(config);
    fixture_->OnPreUpdate([this](const sim::UpdateInfo&, sim::EntityComponentManager& ecm) {
      if (before) before(ecm);
    });
    fixture_->OnPostUpdate([this](const sim::UpdateInfo& info, const sim::EntityComponentManager& ecm) {
      if (after) after(info, ecm);
    });
    fixture_->Finalize();
  }
  void run(int steps) { fixture_->Server()->Run(true, static_cast<std::uint64_t>(steps), false); }

  /// The shaft's angle after each of so many steps.
  std::vector<double> record(const std::string& model, int steps) {
    std::vector<double> out;
    after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager& ecm) { out.push_back(angle(model, ecm)); };
    run(steps);
    after = nullptr;
    return out;
  }
  static double angle(const std::string& model, const sim::EntityComponentManager& ecm) {
    const auto found = sim::entitiesFromScopedName(model + "::shaft", ecm);
    if (found.empty()) return std::nan("");
    const auto* position = ecm.Component<components::JointPosition>(*found.begin());
    return position == nullptr || position->Data().empty() ? 0.0 : position->Data().front();
  }

  std::function<void(sim::EntityComponentManager&)> before;
  std::function<void(const sim::UpdateInfo&, const sim::EntityComponentManager&)> after;

 private:
  std::unique_ptr<sim::TestFixture> fixture_;
};

TEST(GzSim, ALoadHangsFromTheModulesSpringsAndNotFromNothing) {
  SimWorld w(world_sdf(bench_model("bench", kLevel)));
  const auto q = w.record("bench", 2000);
  ASSERT_EQ(q.size(), 2000u);
  for (const double angle : q) ASSERT_TRUE(std::isfinite(angle));
  EXPECT_GT(std::abs(q.back()), 0.087);
  EXPECT_LT(std::abs(q.back()), 1.05);
  EXPECT_NEAR(q.back(), q[q.size() - 200], 0.01) << "at rest by now";
}

TEST(GzSim, TheSameRunTwiceGivesTheSameBits) {
  const std::string sdf = world_sdf(bench_model("bench", kLevel));
  const auto first = SimWorld(sdf).record("bench", 500);
  const auto second = SimWorld(sdf).record("bench", 500);
  EXPECT_GT(std::abs(first.back()), 0.01);
  EXPECT_EQ(first, second);
}

TEST(GzSim, TwoModelsOfAWorldDontKnowOfEachOther) {
  SimWorld w(world_sdf(bench_model("one", kLevel) + bench_model("two", "3 0 0.4 -1.57079633 1.57079633 0")));
  std::vector<double> one, two;
  w.after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager& ecm) {
    one.push_back(SimWorld::angle("one", ecm));
    two.push_back(SimWorld::angle("two", ecm));
  };
  w.run(1000);
  EXPECT_GT(std::abs(one.back()), 0.01);
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], two[i], 1e-6) << i;
}

TEST(GzSim, ABadElementLeavesAModelWithoutTorquesAndAServerThatLives) {
  const std::string bad = replaced(bench_model("bad", kLevel), "<joint>shaft</joint>", "<joint>shift</joint>");
  SimWorld w(world_sdf(bad + bench_model("good", "3 0 0.4 -1.57079633 1.57079633 0")));
  bool commanded = false;
  double good = 0;
  w.after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager& ecm) {
    const auto shaft = sim::entitiesFromScopedName("bad::shaft", ecm);
    commanded = commanded || shaft.empty() || ecm.Component<components::JointForceCmd>(*shaft.begin()) != nullptr;
    good = SimWorld::angle("good", ecm);
  };
  w.run(1000);
  EXPECT_FALSE(commanded);
  EXPECT_GT(std::abs(good), 0.087);
  EXPECT_LT(std::abs(good), 1.05);
}

TEST(GzSim, ARemovedModelTakesItsRobotWithItAndTheOthersGoOn) {
  SimWorld w(world_sdf(bench_model("stays", kLevel) + bench_model("goes", "3 0 0.4 -1.57079633 1.57079633 0")));
  w.run(100);
  w.before = [](sim::EntityComponentManager& ecm) {
    for (const auto model : sim::entitiesFromScopedName("goes", ecm)) ecm.RequestRemoveEntity(model, true);
  };
  w.run(1);
  w.before = nullptr;
  double gone = 0, stays = 0;
  w.after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager& ecm) {
    gone = SimWorld::angle("goes", ecm);
    stays = SimWorld::angle("stays", ecm);
  };
  w.run(1500);
  EXPECT_TRUE(std::isnan(gone));
  EXPECT_GT(std::abs(stays), 0.087);
  EXPECT_LT(std::abs(stays), 1.05);
}

class Bench : public testing::TestWithParam<std::pair<double, const char*>> {};

/// The system is made here and driven by the fixture's callbacks, so that its robot can be told its whole trajectory before the
/// first step.
TEST_P(Bench, GivesTheEmbeddedEnginesCurves) {
  const char* directory = std::getenv("VSA_BENCH_DIR");
  if (directory == nullptr) GTEST_SKIP() << "VSA_BENCH_DIR isn't set: the embedded engine's run is missing";
  const auto [step_s, file] = GetParam();
  const auto reference = read_bench(std::string(directory) + "/" + file);
  std::string model = bench_model(kBenchModel, kHanging);
  const auto from = model.find("<plugin"), to = model.find("</plugin>") + 9;
  sdf::SDFPtr parsed(new sdf::SDF);
  sdf::init(parsed);
  ASSERT_TRUE(sdf::readString("<sdf version='1.7'>" + model + "</sdf>", parsed));
  model.erase(from, to - from);

  prepare();
  plugins::SimRobot system;
  std::vector<BenchSample> samples;
  sim::EventManager events;
  sim::ServerConfig config;
  config.SetSdfString(world_sdf(model, step_s));
  sim::TestFixture fixture(config);
  fixture.OnPreUpdate([&](const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
    if (system.robot() == nullptr) {
      system.Configure(*sim::entitiesFromScopedName(kBenchModel, ecm).begin(),
                       parsed->Root()->GetElement("model")->GetElement("plugin"), ecm, events);
      command_bench(system.robot()->robot());
    }
    system.PreUpdate(info, ecm);
  });
  fixture.OnPostUpdate([&](const sim::UpdateInfo& info, const sim::EntityComponentManager&) {
    samples.push_back(sample_bench(system.robot()->robot(), std::chrono::duration<double>(info.simTime).count()));
  });
  fixture.Finalize();
  fixture.Server()->Run(true, static_cast<std::uint64_t>(std::lround(kBenchDuration_s / step_s)), false);

  const BenchDifference d = compare_bench(reference, samples);
  std::cout << "| gz-sim, dart | " << step_s * 1e3 << " ms | " << d.deflection_rms_rad << " | " << d.deflection_max_rad << " | "
            << d.torque_rms_Nm << " | " << 100 * d.rise_time_max << " % |\n";
  EXPECT_LE(d.deflection_rms_rad, 0.002);
  EXPECT_LE(d.rise_time_max, step_s < 1e-3 ? 0.01 : 0.05);
}

INSTANTIATE_TEST_SUITE_P(Steps, Bench,
                         testing::Values(std::pair{1e-3, "embedded_1ms.csv"}, std::pair{0.25e-3, "embedded_025ms.csv"}));

}  // namespace
}  // namespace vsa::test
