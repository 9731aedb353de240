// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <record> and <view> of the element in gz-sim.
#include <gtest/gtest.h>

#include "gz_world.hpp"
#include "support/model_watch.hpp"

namespace vsa::test {
namespace {

std::string ordered(const std::string& element) {
  return sdf_text(world_text(replaced(bench("bench", kLevel), "</plugin>", element + "</plugin>")));
}

TEST(GzSimRecord, HoldsTheModelsMotionFromItsFirstMoment) {
  WatchedDirectory out;
  std::vector<double> q;
  {
    SimWorld w(ordered(out.record_element(50)));
    q = w.record("bench", 1000);
    EXPECT_NE(q.back(), 0);
  }
  expect_recording(out.path(), "bench", q, 1e-3, 50);
}

TEST(GzSimRecord, ADirectoryThatCantBeWrittenLeavesTheModelWithoutTorques) {
  WatchedDirectory out;
  testing::internal::CaptureStderr();
  {
    SimWorld w(ordered("<record directory='" + out.file() + "'/>"));
    w.run(10);
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("bench stays without torques"), std::string::npos) << told;
  EXPECT_NE(told.find("record@directory"), std::string::npos) << told;
  EXPECT_NE(told.find(out.file()), std::string::npos) << told;
}

TEST(GzSimRecord, ThePageIsServedWhileItRunsAndOffersWhatThereIs) {
  WatchedDirectory out;
  const int port = free_port();
  SimWorld w(ordered("<view port='" + std::to_string(port) + "'/>"));
  w.run(5);
  const PageHello hello = hello_of(port, [&] { w.run(5); });
  EXPECT_NE(hello.page.find("bench"), std::string::npos);
  EXPECT_NE(hello.text.find(R"("offers":{"contacts":false,"control":false,"hands":false})"), std::string::npos) << hello.text;
  EXPECT_TRUE(hello.frame) << "a step brings one";
}

}  // namespace
}  // namespace vsa::test
