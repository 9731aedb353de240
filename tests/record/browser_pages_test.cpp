// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Writes the pages that the browser test (tests/scripts/page.test.mjs) opens, through the same code as a run.
#include <gtest/gtest.h>

#include "record/fake_snake.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;

const fs::path kOut = fs::path(VSA_BINARY_DIR) / "tests" / "pages";

RecorderOptions options(const std::string& title) {
  RecorderOptions o;
  o.title = title;
  o.page_template = fs::path(VSA_BINARY_DIR) / "share" / "vsa" / "web" / "replay.html";
  return o;
}

TEST(BrowserPages, ASnakeForTwentySecondsStaysSmall) {
  RunRecord record(fake::snake(), kOut / "snake", options("12-module snake"));
  for (std::int64_t t = 0; t <= 20'000; t += 10) record.add(fake::snake_at(t * 1'000'000));
  const fs::path page = record.finish(
      {{"Distance", "4.02 m"}, {"Duration", "20 s"}, {"Energy from the supply", "182 J"}, {"Real-time factor", "18.4"}}, {});
  EXPECT_LT(fs::file_size(page), 5'000'000u) << "data and program together";
}

TEST(BrowserPages, NamesOfAUserArentMarkup) {
  RunInfo info = fake::tiny();
  const std::string evil = "</script><img src=x onerror=\"window.hacked=1\"><b>";
  info.world = info.robots[0].model = info.robots[0].actuators[0].name = info.links[1].name = evil;
  RunRecord record(info, kOut / "hostile", options(evil));
  record.add(fake::tiny_at(0));
  record.add(fake::tiny_at(1'000'000'000));
  EXPECT_TRUE(fs::exists(record.finish({{evil, evil}}, evil)));
}

TEST(BrowserPages, AWorldWithoutActuatorsOrASecondFrame) {
  RunInfo info = fake::tiny();
  info.robots.clear();
  RunRecord record(info, kOut / "bare", options("bare"));
  Sample sample = fake::tiny_at(0);
  sample.actuators.clear();
  record.add(sample);
  EXPECT_TRUE(fs::exists(record.finish({}, {})));
}

}  // namespace
}  // namespace vsa::record
