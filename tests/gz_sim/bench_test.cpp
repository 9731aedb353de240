// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The bench run in gz-sim against the embedded engine's, which `make test-gz` writes first (VSA_BENCH_DIR).
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "../gazebo_bench/bench_script.hpp"
#include "gz_world.hpp"

namespace vsa::test {
namespace {

class Bench : public testing::TestWithParam<std::pair<double, const char*>> {};

TEST_P(Bench, GivesTheEmbeddedEnginesCurves) {
  const char* directory = std::getenv("VSA_BENCH_DIR");
  if (directory == nullptr) GTEST_SKIP() << "VSA_BENCH_DIR isn't set: the embedded engine's run is missing";
  const auto [step_s, file] = GetParam();
  const auto reference = read_bench(std::string(directory) + "/" + file);
  std::string model = bench(kBenchModel, kHanging);
  OwnRobot own(model, kBenchModel);
  own.first = [](host::Robot& robot) { command_bench(robot); };
  SimWorld w(sdf_text(world_text(model, {.step_s = step_s})));
  std::vector<BenchSample> samples;
  w.probes[0]->before = [&](const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) { own.before_step(info, ecm); };
  w.probes[0]->after = [&](const sim::UpdateInfo& info, const sim::EntityComponentManager&) {
    samples.push_back(sample_bench(own.robot(), std::chrono::duration<double>(info.simTime).count()));
  };
  w.run(static_cast<int>(std::lround(kBenchDuration_s / step_s)));

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
