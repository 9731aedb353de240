// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs that somebody looks into.
#include "vsa/engine/run.hpp"

#include <sstream>
#include <string>

#include "arm.hpp"
#include "vsa/errors.hpp"

namespace vsa::engine::testing {
namespace {

TEST(Run, ThatIsLookedIntoAfterEachStepIsTheSameRun) {
  World one = World::load_string(arm()), other = World::load_string(arm());
  for (World* w : {&one, &other}) w->command("shoulder", 0.4, 0.2);
  one.run(0.0505);
  std::vector<std::int64_t> seen;
  EXPECT_TRUE(run(other, 0.0505, [&] {
    seen.push_back(other.time_ns());
    return true;
  }));
  EXPECT_EQ(one.time_ns(), other.time_ns());
  EXPECT_EQ(one.joint_angle("arm::shoulder"), other.joint_angle("arm::shoulder"));
  ASSERT_EQ(static_cast<std::int64_t>(seen.size()), std::llround(static_cast<double>(other.time_ns()) * 1e-9 / other.step_s()));
  EXPECT_EQ(seen.back(), other.time_ns());
}

TEST(Run, EndsBetweenTwoStepsWhereItIsToldToOrWhereTheLookerThrows) {
  World w = World::load_string(arm());
  int left = 3;
  EXPECT_FALSE(run(w, 1.0, [&] { return --left > 0; }));
  EXPECT_NEAR(w.time_s(), 3 * w.step_s(), 1e-12);
  EXPECT_THROW(run(w, 1.0, []() -> bool { throw std::runtime_error("mine"); }), std::runtime_error);
  EXPECT_NEAR(w.time_s(), 4 * w.step_s(), 1e-12);
  EXPECT_THROW(run(w, -1.0, [] { return true; }), InputError);
  EXPECT_THROW(run(w, std::nan(""), [] { return true; }), InputError);
  EXPECT_NEAR(w.time_s(), 4 * w.step_s(), 1e-12);
}

TEST(Run, TimesAreThoseThatPeopleWrite) {
  World w = World::load_string(arm());
  for (int step = 1; step <= 200; ++step) {
    w.step();
    std::ostringstream text;
    text << step << "e-3";
    ASSERT_EQ(w.time_s(), std::stod(text.str())) << "a command at that time is of this step, and records have it so";
  }
}

}  // namespace
}  // namespace vsa::engine::testing
