// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "record/fake_snake.hpp"
#include "record/mcap_reader.hpp"
#include "record/scratch.hpp"
#include "vsa/errors.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;
constexpr std::int64_t kMs = 1'000'000;

class RunRecordTest : public testing::Test {
 protected:
  void SetUp() override {
    options_.page_template = dir_.path() / "template.html";
    spew(options_.page_template, "<html>@VSA_PAGE_DATA@</html>");
  }
  [[nodiscard]] RunRecord start() const { return {fake::tiny(), out(), options_}; }
  [[nodiscard]] fs::path out() const { return dir_.path() / "out"; }
  static void feed(RunRecord& record, std::int64_t from_ms, std::int64_t to_ms) {
    for (std::int64_t t = from_ms; t < to_ms; ++t) {
      if (record.due(t * kMs)) record.add(fake::tiny_at(t * kMs));
    }
  }
  [[nodiscard]] std::string links() const { return slurp(out() / "links.csv"); }
  [[nodiscard]] mcap_reader::File log() const { return mcap_reader::read(slurp(out() / "run.mcap")); }

  Scratch dir_;
  RecorderOptions options_;
};

constexpr const char* kLinksAt0And10And20 =
    "time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n0,arm::lever,0.5,0,-1,1,0,0,0\n0.01,arm::lever,0.5,0,-1,1,0,0,0\n"
    "0.02,arm::lever,0.5,0,-1,1,0,0,0\n";

TEST_F(RunRecordTest, SamplesAtItsRateFromTimeZero) {
  RunRecord record = start();
  feed(record, 0, 30);
  record.finish({}, {});
  EXPECT_EQ(links(), kLinksAt0And10And20);
  EXPECT_TRUE(log().whole);
  EXPECT_EQ(log().on("/world/bench/links").size(), 3u);
}

TEST_F(RunRecordTest, TakesEveryStepWhenTheRateIsAboveTheSteps) {
  options_.rate_Hz = 1e5;
  RunRecord record = start();
  feed(record, 0, 30);
  const std::string text = links();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 31);
}

TEST(CadenceTest, DoesntDriftWhenStepsAndPeriodDontDivide) {
  Cadence at_100_Hz(100);
  std::vector<std::int64_t> taken;
  for (std::int64_t t = 0; t < 100 * kMs; t += 3 * kMs) {
    if (!at_100_Hz.due(t)) continue;
    at_100_Hz.taken(t);
    taken.push_back(t / kMs);
  }
  EXPECT_EQ(taken, (std::vector<std::int64_t>{0, 12, 21, 30, 42, 51, 60, 72, 81, 90}));
}

TEST_F(RunRecordTest, SameSamplesGiveTheSameBytes) {
  std::array<std::string, 2> pages;
  for (std::string& page : pages) {
    RunRecord record = start();
    feed(record, 0, 100);
    page = slurp(record.finish({{"a", "b"}}, {}));
  }
  EXPECT_EQ(pages[0], pages[1]);
  EXPECT_GT(pages[0].size(), 100u);
}

TEST_F(RunRecordTest, ShowsWhyARunEndedEarlyAndKeepsTheRecordSoFar) {
  RunRecord record = start();
  feed(record, 0, 25);
  const fs::path page = record.finish({{"distance", "0.1 m"}}, "Blow-up at 0.025 s: joint elbow");
  EXPECT_EQ(page, out() / "replay.html");
  const std::string text = slurp(page);
  EXPECT_NE(text.find(R"("notes":["Blow-up at 0.025 s: joint elbow"])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("title":"bench")"), std::string::npos);
  EXPECT_EQ(links(), kLinksAt0And10And20);
}

TEST_F(RunRecordTest, StartsOverWhenTheWorldIsResetAndSaysSo) {
  RunRecord record = start();
  feed(record, 0, 500);
  feed(record, 0, 25);
  const std::string text = slurp(record.finish({}, {}));
  EXPECT_EQ(links(), kLinksAt0And10And20);
  EXPECT_EQ(log().on("/world/bench/links").size(), 3u);
  EXPECT_NE(text.find("The world went back from 0.499 s to 0.000 s"), std::string::npos) << text;
  EXPECT_NE(text.find("\"frames\":2"), std::string::npos);
}

TEST_F(RunRecordTest, StartsOverWhenTheWorldWentBackBetweenTwoSamples) {
  RunRecord record = start();
  feed(record, 0, 29);
  feed(record, 21, 25);  // later than the last sample
  record.finish({}, {});
  EXPECT_EQ(links(), "time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n0.021,arm::lever,0.5,0,-1,1,0,0,0\n");
  EXPECT_NE(slurp(out() / "replay.html").find("went back from 0.028 s to 0.021 s"), std::string::npos);
}

TEST_F(RunRecordTest, FreesItsDirectoryOnceItIsFinished) {
  RunRecord first = start();
  feed(first, 0, 30);
  EXPECT_THROW(static_cast<void>(start()), InputError) << "is recording";
  first.finish({}, {});
  RunRecord second = start();
  feed(second, 0, 20);
  second.finish({}, {});
  EXPECT_EQ(links(), std::string(kLinksAt0And10And20).substr(0, links().size()));
}

TEST_F(RunRecordTest, FreesItsDirectoryWhereThePageCantBeWrittenToo) {
  RunRecord first = start();
  feed(first, 0, 30);
  fs::create_directory(out() / "replay.html");
  EXPECT_THROW(first.finish({}, {}), RecordError);
  EXPECT_TRUE(log().whole);
  EXPECT_NO_THROW(static_cast<void>(start()));
}

TEST(CadenceTest, TakesTheLowestRatesForWhatTheyAre) {
  Cadence seldom(1e-12);
  EXPECT_TRUE(seldom.due(0));
  seldom.taken(0);
  EXPECT_FALSE(seldom.due(1'000'000'000'000'000'000));
}

TEST_F(RunRecordTest, StillMakesThePageAfterTheDiskRefusedTheFiles) {
  RunRecord record = start();
  const std::string message = message_of<RecordError>([&] {
    const FileSizeLimit disk(1000);
    feed(record, 0, 1000);
  });
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  feed(record, 1000, 1100);
  const std::string files = links();
  const std::string text = slurp(record.finish({}, {}));
  EXPECT_TRUE(log().whole) << "there was room again";
  EXPECT_EQ(links(), files) << "nothing more is written to the files";
  EXPECT_NE(text.find("The data files end at 0.0"), std::string::npos) << text;
  EXPECT_NE(text.find("File too large"), std::string::npos) << text;
}

TEST_F(RunRecordTest, StillMakesThePageWhereTheLogCantBeFinished) {
  RunRecord record = start();
  feed(record, 0, 25);
  const std::string message = message_of<RecordError>([&] {
    const FileSizeLimit disk(4000);  // more than this page, less than the log's schemas
    record.finish({}, {});
  });
  EXPECT_NE(message.find("run.mcap: can't write: File too large"), std::string::npos) << message;
  EXPECT_TRUE(log().whole && log().messages.empty()) << "what there was room for";
  EXPECT_GT(fs::file_size(out() / "replay.html"), 500u);
}

TEST_F(RunRecordTest, RefusesRatesThatAreNone) {
  options_.rate_Hz = 0;
  options_.page_rate_Hz = -1;
  options_.page_frames_max = 1;
  const std::string message = message_of<InputError>([&] { (void)start(); });
  for (const char* key : {"rate_Hz = 0", "page_rate_Hz = -1", "page_frames_max = 1"}) {
    EXPECT_NE(message.find(key), std::string::npos) << message;
  }
}

TEST_F(RunRecordTest, NoticesAMissingTemplateBeforeTheRunAndTouchesNothing) {
  options_.page_template = dir_.path() / "none.html";
  EXPECT_NE(message_of<InputError>([&] { (void)start(); }).find("none.html"), std::string::npos);
  EXPECT_FALSE(fs::exists(out()));
}

}  // namespace
}  // namespace vsa::record
