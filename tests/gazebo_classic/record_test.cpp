// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <record> and <view> of the element in Gazebo Classic.
#include <gtest/gtest.h>

#include "classic_world.hpp"
#include "support/model_watch.hpp"

namespace vsa::test {
namespace {

/// The bench with this in its <plugin>, on its way to another angle.
std::string ordered(const std::string& name, const std::string& element) {
  std::string model = replaced(model_text("qbmove_bench_load"), "</plugin>", element + "</plugin>");
  model = replaced(model, "equilibrium_rad=\"0\"", "equilibrium_rad=\"0.8\"");
  return world_sdf(name, replaced(model, "name=\"qbmove_bench_load\"", "name=\"bench\""));
}

TEST(ClassicRecord, HoldsTheModelsMotionFromItsFirstMoment) {
  WatchedDirectory out;
  std::vector<double> q;
  {
    ClassicWorld w(ordered("recorded", out.record_element(50)));
    q = w.record("bench", 1000);
    EXPECT_NE(q.back(), 0);
  }
  expect_recording(out.path(), "bench", q, 1e-3, 50);
}

TEST(ClassicRecord, ADirectoryThatCantBeWrittenLeavesTheModelWithoutTorques) {
  WatchedDirectory out;
  testing::internal::CaptureStderr();
  {
    ClassicWorld w(ordered("refused", "<record directory='" + out.file() + "'/>"));
    w.run(10);
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find(" stays without torques"), std::string::npos) << told;  // colours between the words
  EXPECT_NE(told.find("record@directory"), std::string::npos) << told;
  EXPECT_NE(told.find(out.file()), std::string::npos) << told;
}

TEST(ClassicRecord, ThePageIsServedWhileItRunsAndOffersWhatThereIs) {
  WatchedDirectory out;
  const int port = free_port();
  ClassicWorld w(ordered("viewed", "<view port='" + std::to_string(port) + "'/>"));
  w.run(5);
  const PageHello hello = hello_of(port, [&] { w.run(5); });
  EXPECT_NE(hello.page.find("bench"), std::string::npos);
  EXPECT_NE(hello.text.find(R"("offers":{"contacts":false,"control":false,"hands":false})"), std::string::npos) << hello.text;
  EXPECT_TRUE(hello.frame) << "a step brings one";
}

}  // namespace
}  // namespace vsa::test
