// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A recording of a world that no engine of ours moves.
#include <gtest/gtest.h>

#include "record/scratch.hpp"
#include "support/fake_simulation.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::record {
namespace {

TEST(AnySimulation, IsRecordedAndWhatItDoesntTellIsLeftEmpty) {
  const Scratch dir;
  RecorderOptions options;
  options.page_template = dir.path() / "template.html";
  spew(options.page_template, "@VSA_PAGE_DATA@");
  test::FakeSimulation world;
  Recorder recorder(world, dir.path() / "out", options);
  for (int i = 0; i < 20; ++i) {
    world.step();
    recorder.sample(world);
  }
  recorder.finish();
  EXPECT_EQ(slurp(dir.path() / "out" / "links.csv"),
            "time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n0,arm::link,0,0,0,1,0,0,0\n0.01,arm::link,0,0,0.01,1,0,0,0\n"
            "0.02,arm::link,0,0,0.02,1,0,0,0\n");
  const std::string energy = slurp(dir.path() / "out" / "energy.csv");
  EXPECT_EQ(energy.substr(energy.size() - 3), ",,\n") << energy;
  const std::string readings = slurp(dir.path() / "out" / "arm_actuators.csv");
  EXPECT_NE(readings.find("\n0.02,elbow,"), std::string::npos) << readings;
  EXPECT_NE(slurp(dir.path() / "out" / "replay.html").find("\"type\":\"made_up\""), std::string::npos);
}

}  // namespace
}  // namespace vsa::record
