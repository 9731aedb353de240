// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An arm and the hand at its end, a plug-in each, are one kinematic tree: left alone it comes to rest as with one plug-in.
#include "chain/shared_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "gz_world.hpp"

namespace vsa::test {
namespace {

LateSpeed left_alone(const std::string& model, const std::vector<std::string>& names, double step_s) {
  SimWorld w(sdf_text(world_text(model, {.step_s = step_s, .gravity = false})));
  for (const std::string& name : names) w.set_angle("m", kAside_rad, name);
  LateSpeed out(kLateFrom_s);
  int step = 0;
  w.probes[0]->after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager&) {
    if (++step < 3) return;  // not there yet
    for (const std::string& name : names) out.add(step * step_s, w.angle("m", name), w.speed("m", name));
  };
  w.run(static_cast<int>(std::lround(kSharedTree_s / step_s)));
  return out;
}

TEST(GzSimSharedTree, WithAPlugInAPartRestsAsWithOneForAll) { expect_rest_whatever_drives(left_alone); }

}  // namespace
}  // namespace vsa::test
