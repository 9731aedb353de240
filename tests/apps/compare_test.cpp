// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa identify --compare`: what it keeps, what it goes on from, what it refuses. The fits are short and coarse.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "pool_runs.hpp"

namespace {

using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::write_file;

const std::string kData = std::string(VSA_SOURCE_DIR) + "/data/qbmove_maker_pro/";

std::string hypothesis(const std::string& name, const std::string& set) {
  return "[[hypothesis]]\nname = \"" + name + "\"\nbase = \"qbmove_maker_pro\"\nset = {" + set + "}\nfree = []\n";
}

std::string comparison(const std::string& hypotheses, const std::string& period_s = "2") {
  return "[compare]\ntitle = \"Two\"\nstarts = 1\niterations = 1\nrecordings = [\"" + kData +
         "stiffness_preset_0.0000rad_branches.csv\", \"" + kData +
         "stiffness_preset_0.6903rad_branches.csv\"]\n[bench]\namplitude_rad = 2\nperiod_s = " + period_s + "\n" + hypotheses;
}

Result compare(const Scratch& scratch, std::vector<std::string> more = {}) {
  std::vector<std::string> all{"identify", "--compare", (scratch / "two.toml").string(), "--out", (scratch / "out").string()};
  all.insert(all.end(), more.begin(), more.end());
  return run_vsa(all);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Compare, PrintsATableAndGoesOnFromTheFitsThatAreThere) {
  const Scratch scratch;
  write_file(scratch / "two.toml", comparison(hypothesis("one", "") + hypothesis("other", "\"tendon.friction\" = 0.05")));
  const Result first = compare(scratch, {"--jobs", "2"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(count(first.err, "kept:"), 0u);
  EXPECT_NE(first.out.find("predicted 0.6903"), std::string::npos) << first.out;
  const std::string json = read_file(scratch / "out" / "comparison.json"), table = read_file(scratch / "out" / "comparison.md");
  EXPECT_NE(table.find("| other |"), std::string::npos) << table;

  const std::filesystem::path fits = scratch / "out" / "fits";
  write_file(fits / "one.json", "{\"asked\": \"half of a file");
  const Result second = compare(scratch, {"--threads", "1"});
  EXPECT_EQ(count(second.err, "kept:"), 5u) << "all but the one that is spoilt:\n" << second.err;
  EXPECT_EQ(count(second.err, "kept: one\n"), 0u);

  write_file(scratch / "two.toml", comparison(hypothesis("one", "") + hypothesis("other", "\"tendon.friction\" = 0.06")));
  const Result third = compare(scratch);
  EXPECT_EQ(count(third.err, "kept: one"), 3u) << third.err;
  EXPECT_EQ(count(third.err, "kept: other"), 0u) << "it is another hypothesis now:\n" << third.err;
}

/// The rows of the table without what lasted how long.
std::string rows_of(const Result& r) {
  EXPECT_EQ(r.exit_code, 0) << r.err;
  std::string out;
  for (const char* name : {"\none ", "\nother "}) {
    const std::size_t at = r.out.find(name);
    EXPECT_NE(at, std::string::npos) << r.out;
    out += r.out.substr(at, r.out.find("all", at) - at);
  }
  return out;
}

TEST(Compare, RefusesAMeasurementThatIsThereTwice) {
  const Scratch scratch;
  std::string text = comparison(hypothesis("one", ""));
  text.replace(text.find("0.0000rad_branches"), 18, "0.6903rad_samples");
  write_file(scratch / "two.toml", text);
  const Result r = compare(scratch);
  EXPECT_EQ(r.exit_code, 2) << r.err;
  EXPECT_NE(r.err.find("is the measurement of"), std::string::npos) << r.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

class CompareRanks : public vsa::test::WithRanks {};

TEST_F(CompareRanks, AndPartsJudgeTheSame) {
  const Scratch scratch;
  write_file(scratch / "two.toml", comparison(hypothesis("one", "") + hypothesis("other", "\"tendon.friction\" = 0.05")));
  const auto to = [&](const char* out) {
    return std::vector<std::string>{"identify", "--compare", scratch / "two.toml", "--out", scratch / out};
  };
  const std::string alone = rows_of(run_vsa(to("alone")));
  std::vector<std::string> first = to("parts"), second = to("parts");
  first.insert(first.end(), {"--part", "1/2"});
  second.insert(second.end(), {"--part", "2/2"});
  {
    Subprocess other(second);
    EXPECT_EQ(rows_of(run_vsa(first)), alone);
    EXPECT_EQ(other.wait().exit_code, 0);
  }
  if (const std::string why = no_ranks(); !why.empty()) GTEST_SKIP() << why;
  EXPECT_EQ(rows_of(run_vsa(job(3, to("ranks")), mpirun())), alone);
}

TEST(Compare, APartThatNobodyElseWorksBesideEndsAndSaysWhatIsMissing) {
  const Scratch scratch;
  write_file(scratch / "two.toml", comparison(hypothesis("one", "") + hypothesis("other", "\"tendon.friction\" = 0.05")));
  const Result alone = compare(scratch, {"--part", "1/2", "--wait-s", "0.5"});
  EXPECT_EQ(alone.exit_code, 1) << alone.err;
  EXPECT_NE(alone.err.find("no fits of the parts 2/2 for 0.5 s, which owe 3"), std::string::npos) << alone.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "out" / "comparison.json"));
  EXPECT_EQ(compare(scratch, {"--part", "2/2"}).exit_code, 0);
  EXPECT_EQ(rows_of(compare(scratch, {"--part", "1/2", "--wait-s", "0"})), rows_of(compare(scratch)));
  EXPECT_EQ(compare(scratch, {"--part", "1/2", "--wait-s", "-1"}).exit_code, 2);
  EXPECT_EQ(compare(scratch, {"--wait-s", "1"}).exit_code, 2) << "without --part nobody is waited for";
}

TEST(Compare, AFitThatFailsInAnotherPartEndsTheWaitForItAndOneThatHadFailedBeforeDoesNot) {
  const Scratch scratch;
  write_file(scratch / "two.toml", comparison(hypothesis("one", "") + hypothesis("other", "\"tendon.friction\" = 0.05")));
  const std::string rows = rows_of(compare(scratch));
  const std::filesystem::path fits = scratch / "out" / "fits";
  const std::string name = "one.without.stiffness_preset_0.0000rad_branches";  // the second: part 2's
  const std::string stored = read_file(fits / (name + ".json"));
  const std::size_t at = stored.find("\"asked\": \"") + 10;
  const auto fails = [&](const std::string& why) {
    write_file(fits / (name + ".failed"), stored.substr(at, stored.find('"', at) - at) + '\n' + why + '\n');
  };
  fails("fell over");
  std::filesystem::remove(fits / (name + ".json"));
  const std::string before = name + " failed in another part before this one began, which waits for another try: fell over\n";
  const Result brief = compare(scratch, {"--part", "1/2", "--wait-s", "0"});
  EXPECT_EQ(brief.exit_code, 1) << brief.err;
  EXPECT_NE(brief.err.find("no fits of the parts 2/2"), std::string::npos) << brief.err;
  Subprocess running({"identify", "--compare", scratch / "two.toml", "--out", scratch / "out", "--part", "1/2"});
  ASSERT_TRUE(running.read_until([&](const Result& r) { return r.err.find(before) != std::string::npos; }));
  fails("and again");
  const Result waiting = running.wait();
  EXPECT_EQ(waiting.exit_code, 1) << waiting.err;
  EXPECT_EQ(count(waiting.err, before), 1u) << waiting.err;
  EXPECT_NE(waiting.err.find(name + " failed in another part: and again"), std::string::npos) << waiting.err;
  EXPECT_EQ(compare(scratch, {"--part", "2/2"}).exit_code, 0) << "tried again";
  EXPECT_FALSE(std::filesystem::exists(fits / (name + ".failed")));
  EXPECT_EQ(rows_of(compare(scratch, {"--part", "1/2"})), rows);
}

TEST(Compare, KeepsWhatWasDoneWhenItIsInterrupted) {
  const Scratch scratch;
  write_file(scratch / "two.toml", comparison(hypothesis("one", "") + hypothesis("other", "\"tendon.friction\" = 0.05"), "19"));
  Subprocess running(
      {"identify", "--compare", (scratch / "two.toml").string(), "--out", (scratch / "out").string(), "--threads", "1"});
  ASSERT_TRUE(running.read_until([](const Result& r) { return r.err.find("1 of 6: one in") != std::string::npos; }));
  running.send(SIGINT);
  const Result stopped = running.wait();
  EXPECT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.err;
  EXPECT_NE(stopped.err.find("goes on from"), std::string::npos) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "out" / "comparison.json"));
  const Result second = compare(scratch);
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_GE(count(second.err, "kept:"), 1u);
}

TEST(Compare, RefusesWhatDoesntGoTogetherAndWritesNothing) {
  const Scratch scratch;
  const auto refused = [&](const Result& r, const std::string& part) {
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << "no '" << part << "' in:\n" << r.err;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  };
  refused(compare(scratch), "can't be read");
  write_file(scratch / "two.toml", comparison(hypothesis("one", "\"tendon.friction\" = 5")));
  refused(compare(scratch), "tendon.friction");
  write_file(scratch / "two.toml", comparison(hypothesis("one", "")));
  refused(compare(scratch, {"--type", "qbmove_maker_pro"}), "--type");
  refused(compare(scratch, {"--threads", "-1"}), "--threads");
  refused(compare(scratch, {"--threads", ""}), "--threads");
  refused(compare(scratch, {"--resume"}), "--resume");
}

}  // namespace
