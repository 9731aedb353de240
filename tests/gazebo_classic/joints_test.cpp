// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One joint, two plug-ins: the second is refused.
#include <gtest/gtest.h>

#include <array>

#include "classic_world.hpp"
#include "support/press.hpp"

namespace vsa::test {
namespace {

/// The angles of the bench's shaft over a second, and what was said on the error log since the world was loaded.
std::vector<double> run_bench(const std::string& sdf, const std::string& model, std::string& log) {
  testing::internal::CaptureStderr();
  ClassicWorld w(sdf);
  w.run(1);
  log = testing::internal::GetCapturedStderr();
  const auto found = w.world->ModelByName(model);
  if (!found) throw std::runtime_error("no model " + model);
  return w.record(model, 1000);
}

std::string hanging() {
  std::string model = model_text("qbmove_bench_load");
  return model.insert(model.find('>') + 1, "<pose>" + kLeverLevel + "</pose>");
}

std::string plugin_of(const std::string& model) {
  const auto begin = model.find("<plugin"), end = model.find("</plugin>");
  return model.substr(begin, end - begin) + "</plugin>";
}

TEST(DrivenJoints, OfAPluginGivenTwiceTheSecondIsNamedAndStaysWithoutTorques) {
  const std::string model = hanging();
  std::string log;
  const auto once = run_bench(world_sdf("once", model), "qbmove_bench_load", log);
  EXPECT_EQ(log.find("drives it already"), std::string::npos) << log;
  const std::string twice = replaced(model, "</plugin>", "</plugin>" + plugin_of(model));
  EXPECT_EQ(run_bench(world_sdf("doubled", twice), "qbmove_bench_load", log), once);
  EXPECT_NE(log.find("actuator[shaft]/joint = \"shaft\": another vsa::Robot drives it already"), std::string::npos) << log;
  EXPECT_NE(log.find("stays without torques"), std::string::npos) << log;
}

TEST(LinearActuators, HoldAPlateOnASlideAndAreNamedOnAHinge) {
  RobotWorld w("slide", press_model("prismatic", "linear_sea_example"));
  w.run(5000);
  EXPECT_NEAR(w.angle("press", "slide"), -kPressSag_m, kPressSlack_m);
  EXPECT_NEAR(w.torques()[0], 98, 3);
  for (const auto& [joint, type, says] : {std::array<std::string, 3>{"revolute", "linear_sea_example", "is a linear actuator"},
                                          {"prismatic", "sea_example", "is prismatic: sea_example turns its joint"}}) {
    testing::internal::CaptureStderr();
    ClassicWorld other(world_sdf("other_" + joint, press_model(joint, type)));
    other.run(1);
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_NE(log.find(says), std::string::npos) << log;
  }
}

TEST(DrivenJoints, OfANestedModelDrivenFromInsideAndOutsideAreNoticed) {
  const std::string inner = replaced(hanging(), "\"qbmove_bench_load\"", "\"inner\"");
  const std::string outside = replaced(plugin_of(inner), "<joint>shaft</joint>", "<joint>inner::shaft</joint>");
  const std::string outer = "<model name='outer'><link name='base'/>" + inner + outside + "</model>";
  testing::internal::CaptureStderr();
  ClassicWorld w(world_sdf("nested", outer));
  w.run(1);
  const std::string log = testing::internal::GetCapturedStderr();
  const auto first = log.find("drives it already");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("drives it already", first + 1), std::string::npos) << "one of the two drives it: " << log;
  w.run(2000);
  const double angle = w.world->ModelByName("outer")->NestedModel("inner")->GetJoint("shaft")->Position(0);
  EXPECT_GT(std::abs(angle), 5 * kDegree);
  EXPECT_LT(std::abs(angle), 60 * kDegree) << "and holds it";
}

TEST(DrivenJoints, AreFreeAgainOnceTheirPluginIsGone) {
  const std::string model = hanging();
  ClassicWorld w(world_sdf("again", without(model, "<plugin", "</plugin>")));
  auto first = load_robot(w.world, model);
  ASSERT_NE(first->seat(), nullptr);
  EXPECT_EQ(load_robot(w.world, model)->seat(), nullptr);
  EXPECT_EQ(load_robot(w.world, model)->seat(), nullptr) << "one that was refused holds nothing and frees nothing";
  first.reset();
  EXPECT_NE(load_robot(w.world, model)->seat(), nullptr);
}

TEST(DrivenJoints, OfTheSameModelInTwoWorldsAreDifferentOnes) {
  const std::string model = hanging();
  ClassicWorld a(world_sdf("one", without(model, "<plugin", "</plugin>")));
  const auto first = load_robot(a.world, model);
  const auto b = gazebo::loadWorld(VSA_SOURCE_DIR "/models/worlds/bench_load.sdf");  // goes with a
  ASSERT_TRUE(b);
  EXPECT_NE(load_robot(b, model)->seat(), nullptr);
  EXPECT_NE(first->seat(), nullptr);
}

}  // namespace
}  // namespace vsa::test
