// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The bench run in Gazebo Classic against the embedded engine's, which `make test-gazebo` writes first (VSA_BENCH_DIR).
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "../gazebo_bench/bench_script.hpp"
#include "classic_world.hpp"

namespace vsa::test {
namespace {

std::vector<BenchSample> run_bench(const std::string& engine, double step_s) {
  std::string model = model_text("qbmove_bench_load");
  model.insert(model.find('>') + 1, "<pose>0 0 0.4 -1.57079633 0 0</pose>");
  RobotWorld w("bench_" + engine, model, engine);
  w.world->Physics()->SetMaxStepSize(step_s);
  command_bench(w.robot());

  std::vector<BenchSample> samples;
  const auto connection = gazebo::event::Events::ConnectWorldUpdateEnd(
      [&] { samples.push_back(sample_bench(w.robot(), w.world->SimTime().Double())); });
  w.run(static_cast<int>(std::lround(kBenchDuration_s / step_s)));
  return samples;
}

struct Case {
  const char* engine;
  double step_s;
  const char* reference;
  double rise_time_bound;
};

class Bench : public testing::TestWithParam<Case> {};

TEST_P(Bench, GivesTheEmbeddedEnginesCurves) {
  const char* directory = std::getenv("VSA_BENCH_DIR");
  if (directory == nullptr) GTEST_SKIP() << "VSA_BENCH_DIR isn't set: the embedded engine's run is missing";
  const Case& c = GetParam();
  const auto reference = read_bench(std::string(directory) + "/" + c.reference);
  const auto samples = run_bench(c.engine, c.step_s);
  write_bench(std::string(directory) + "/classic_" + c.engine + "_" + c.reference, samples);
  const BenchDifference d = compare_bench(reference, samples);
  std::cout << "| Gazebo Classic, " << c.engine << " | " << c.step_s * 1e3 << " ms | " << d.deflection_rms_rad << " | "
            << d.deflection_max_rad << " | " << d.torque_rms_Nm << " | " << 100 * d.rise_time_max << " % |\n";
  EXPECT_LE(d.deflection_rms_rad, 0.002);
  EXPECT_LE(d.rise_time_max, c.rise_time_bound);
}

INSTANTIATE_TEST_SUITE_P(Engines, Bench,
                         testing::Values(Case{"ode", 1e-3, "embedded_1ms.csv", 0.05}, Case{"dart", 1e-3, "embedded_1ms.csv", 0.05},
                                         Case{"ode", 0.25e-3, "embedded_025ms.csv", 0.01},
                                         Case{"dart", 0.25e-3, "embedded_025ms.csv", 0.01}),
                         [](const auto& c) {
                           return std::string(c.param.engine) + (c.param.step_s < 1e-3 ? "_quarter_ms" : "_1ms");
                         });

}  // namespace
}  // namespace vsa::test
