// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/page.hpp"

#include <gtest/gtest.h>

#include "record/fake_snake.hpp"
#include "record/scratch.hpp"
#include "vsa/page/json.hpp"

namespace vsa::record {
namespace {

TEST(PageData, HoldsNamesGeometryAndFrames) {
  PageData page(fake::tiny(), 50, 100);
  page.add(fake::tiny_at(0));
  const std::string json = page.json(fake::tiny(), {"A <title>", {{"distance", "1 m"}}, {"ended early"}});
  for (const char* part :
       {R"("title":"A \u003ctitle\u003e")", R"("notes":["ended early"])", R"("summary":[["distance","1 m"]])",
        R"("robots":[{"model":"arm","actuators":[{"name":"elbow","joint":"elbow","type":"qbmove_maker_pro_6_1")",
        R"("name":"wall::link","model":"wall","mass_kg":0,"pose":[5,5,5,1,0,0,0],"visuals":[{"kind":"box")",
        R"("name":"arm::lever","model":"arm","mass_kg":0.2,"visuals":[{"kind":"sphere")", R"("rgba":[1,0,0,1])", R"("frames":1)"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
  }
  EXPECT_NE(json.find("\"poses\":\"" + page::base64({0.5f, 0, -1, 1, 0, 0, 0}) + '"'), std::string::npos) << json;
  EXPECT_NE(json.find(page::base64({0.1f, -2, 0.25f, 0.2f, 0.611f, 0.6f, static_cast<float>(1.0 / 3), 1e-7f, 1.5f, -1e22f})),
            std::string::npos)
      << json;
}

TEST(PageData, PutsAnActuatorsChannelsOneAfterTheOther) {
  PageData page(fake::tiny(), 50, 100);
  Sample s = fake::tiny_at(0);
  s.actuators[0] = {};
  s.actuators[0].shaft_rad = 1;
  page.add(s);
  s.time_ns = 20'000'000;
  s.actuators[0].shaft_rad = 2;
  s.actuators[0].shaft_speed_rad_per_s = 3;
  page.add(s);
  std::vector<float> expected(20, 0.0f);
  expected[0] = 1;
  expected[1] = 2;
  expected[3] = 3;
  const std::string json = page.json(fake::tiny(), {});
  EXPECT_NE(json.find("\"actuators\":\"" + page::base64(expected) + '"'), std::string::npos) << json;
}

TEST(PageData, WritesAMeshOnceHoweverManyLinksShowIt) {
  RunInfo info = fake::tiny();
  scene::Shape mesh;
  mesh.kind = scene::Shape::Kind::mesh;
  mesh.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  mesh.indices = {0, 1, 2};
  info.links[0].visuals = {mesh};
  info.links[1].visuals = {mesh, mesh};
  const std::string json = PageData(info, 50, 10).json(info, {});
  const std::string bytes = page::base64(mesh.vertices);
  EXPECT_NE(json.find(bytes), std::string::npos);
  EXPECT_EQ(json.find(bytes), json.rfind(bytes));
}

TEST(PageData, DropsEveryOtherFrameInsteadOfGrowingWithoutBound) {
  PageData page(fake::tiny(), 100, 8);
  for (int ms = 0; ms < 1000; ++ms) {
    if (page.due(ms * 1'000'000LL)) page.add(fake::tiny_at(ms * 1'000'000LL));
  }
  EXPECT_LE(page.frames(), 8u);
  EXPECT_GE(page.frames(), 4u);
  const std::string json = page.json(fake::tiny(), {});
  // 1 s at 100 Hz in at most 8 frames: 160 ms apart.
  EXPECT_NE(json.find(page::base64_wide({0, 0.16, 0.32, 0.48, 0.64, 0.80, 0.96})), std::string::npos) << json;
}

}  // namespace
}  // namespace vsa::record
