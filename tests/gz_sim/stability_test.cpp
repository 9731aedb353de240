// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Light flanges at the stiffest preset, kicked: bounded in gz-sim as the coupling promises (docs/explanation/7-host.md).
#include <gtest/gtest.h>

#include <cmath>

#include "gz_world.hpp"
#include "vsa/config/actuator_type.hpp"

namespace vsa::test {
namespace {

/// The bench without a load, with another actuator at its stiffest.
std::string flange(const std::string& type) {
  const bool has_preset = type != "sea_example";
  std::string model = model_text("qbmove_bench_free", "flange");
  model = replaced(model, "preset_rad=\"0.2\"", has_preset ? "preset_rad=\"0.785\"" : "");
  return replaced(model, "<type>qbmove_maker_pro_6_1<", "<type>" + type + "<");
}

/// Of 1e-4 kg·m².
std::string light(std::string model) {
  model = replaced(model, "<ixx>1.16666667e-05</ixx>", "<ixx>6e-05</ixx>");
  model = replaced(model, "<iyy>1.16666667e-05</iyy>", "<iyy>6e-05</iyy>");
  return replaced(model, "<izz>2.25e-05</izz>", "<izz>1e-04</izz>");
}

/// As the coupling sees the shaft: the angle that the engine shows swings further.
double seen(const SimWorld& w, double step_s) { return w.angle("flange") - 0.5 * step_s * w.speed("flange"); }

double largest_in(SimWorld& w, double seconds, double step_s) {
  double largest = 0;
  w.probes[0]->after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager&) {
    ASSERT_TRUE(std::isfinite(seen(w, step_s)));
    largest = std::max(largest, std::abs(seen(w, step_s)));
  };
  w.run(static_cast<int>(seconds / step_s));
  w.probes[0]->after = nullptr;
  return largest;
}

class Presets : public testing::TestWithParam<std::string> {};

TEST_P(Presets, ALightFlangeKickedFarAtItsStiffestStaysBounded) {
  SimWorld w(sdf_text(world_text(light(flange(GetParam())), {.gravity = false})));
  w.run(1);
  w.set_angle("flange", 0.8);
  // The springs' kilonewton metres drag the pulleys along, and the shaft swings about where these are then.
  const double first = largest_in(w, 0.5, 1e-3), then = largest_in(w, 0.5, 1e-3);
  EXPECT_GT(first, 0.1) << "it moves";
  EXPECT_LT(first, 2.0);
  EXPECT_LE(then, first) << "it doesn't grow";
}

TEST_P(Presets, ABareFlangeThrownAtItsStiffestStaysBounded) {
  SimWorld w(sdf_text(world_text(flange(GetParam()), {.gravity = false})));
  w.run(1);
  w.set_speed("flange", 20);
  const double largest = largest_in(w, 1.0, 1e-3);
  EXPECT_GT(largest, 1e-3) << "it moves";
  EXPECT_LT(largest, 0.05);
  EXPECT_LT(std::abs(w.speed("flange")), 3.0);
}

/// Those that stand by themselves and run the qbmove's program. One on a base has the motors of another, a servo's gains are made for
/// other loads; their presets and their reach aren't those that these tests ask for.
std::vector<std::string> whole_types() {
  const config::TypeLibrary library;
  std::vector<std::string> names = library.names();
  std::erase_if(names, [&](const std::string& name) {
    const config::ActuatorType type = library.load(name);
    return !type.base.empty() || type.controller != "qbmove";
  });
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Presets, testing::ValuesIn(whole_types()), [](const auto& c) { return c.param; });

TEST(GzSimStability, AFlangeThrownAgainstItsJointsLimitStaysBounded) {
  std::string model = light(flange("qbmove_maker_pro_6_1"));
  model = replaced(model, "preset_rad=\"0.785\"", "preset_rad=\"0\"");
  model = replaced(model, "<lower>-1e16</lower>", "<lower>-0.2</lower>");
  model = replaced(model, "<upper>1e16</upper>", "<upper>0.2</upper>");
  SimWorld w(sdf_text(world_text(model, {.gravity = false})));
  w.run(1);
  w.set_speed("flange", 20);
  const double largest = largest_in(w, 1.0, 1e-3);
  EXPECT_GT(largest, 0.19) << "it gets there";
  EXPECT_LT(largest, 0.25);
  EXPECT_LT(std::abs(w.speed("flange")), 1.0);
}

}  // namespace
}  // namespace vsa::test
