// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa experiments`: the table, what it leaves behind, what it refuses.
#include <gtest/gtest.h>

#include <csignal>

#include "subprocess.hpp"

namespace {

using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;

std::vector<std::string> quick(std::vector<std::string> more) {
  std::vector<std::string> all{"experiments", "--step-s", "0.001"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(Experiments, WriteOneTableOnePageAndResults) {
  const Scratch scratch;
  const Result result = run_vsa(quick({"--types", "sea_example", "qbmove_maker_pro_paper", "--out", scratch / "out"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "") << "no progress in a pipe";
  for (const char* part :
       {"throws [m]", "settles in [s]", "per N·m [J]", "\nsea_example ", "\nqbmove_maker_pro_paper ", "report.html"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " in\n" << result.out;
  const std::string json = read_file(scratch / "out/results.json");
  for (const char* part : {"\"throw_distance_m\"", "\"settled_s\"", "\"hold_energy_J\"", "\"preset_rad\"", "\"swing_back_s\"",
                           "vsa experiments --types sea_example qbmove_maker_pro_paper --step-s 0.001"})
    EXPECT_NE(json.find(part), std::string::npos) << part;
  EXPECT_NE(read_file(scratch / "out/report.html").find("\"Throws farthest\""), std::string::npos);
}

TEST(Experiments, AskTheSameOfAllWhereLinkAndLoadAreGiven) {
  const Scratch scratch;
  const Result result = run_vsa(quick(
      {"--types", "sea_example", "anydrive_ad119e20", "--inertia-kgm2", "0.02", "--load-Nm", "0.7", "--out", scratch / "out"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string json = read_file(scratch / "out/results.json");
  const auto times = [&](const std::string& what) {
    int count = 0;
    for (std::size_t at = json.find(what); at != std::string::npos; at = json.find(what, at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(times("\"inertia_kgm2\": 0.02"), 2);
  EXPECT_EQ(times("\"load_Nm\": 0.7"), 2);
}

TEST(Experiments, RefuseBadInputBeforeTheyRun) {
  const Scratch scratch;
  const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& parts) {
    more.insert(more.end(), {"--out", scratch / "out"});
    more.insert(more.begin(), "experiments");
    const Result result = run_vsa(more);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    for (const auto& part : parts) EXPECT_NE(result.err.find(part), std::string::npos) << part << " in " << result.err;
  };
  refused({"--types", "qbmove_9000"}, {"qbmove_9000", "sea_example"});
  refused({"--inertia-kgm2", "0", "--load-Nm", "-1"}, {"--inertia-kgm2", "--load-Nm", "out of range"});
  refused({"--step-s", "0.1"}, {"--step-s"});
  refused({"--types", "sea_example", "--inertia-kgm2", "200"}, {"--inertia-kgm2 = 200", "125"});
  refused({"--types", "sea_example", "sea_example"}, {"--types = sea_example", "twice"});
  refused({"--types", "sea_example", "--set", "drive.supply_V"}, {"--set", "key=value"});
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST(Experiments, SayWhyNothingWasMeasured) {
  const Scratch scratch;
  const Result off = run_vsa({"experiments", "--types", "sea_example", "--set", "drive.supply_V=0.1", "--out", scratch / "out"});
  EXPECT_EQ(off.exit_code, 0) << off.err;
  EXPECT_NE(off.err.find("sea_example: its motors move no load"), std::string::npos) << off.err;
}

TEST(Experiments, LeaveNoFolderWhereASignalEndsThem) {
  const Scratch scratch;
  vsa::test::Surroundings terminal;
  terminal.terminal = true;
  vsa::test::Subprocess all({"experiments", "--step-s", "0.00001", "--out", scratch / "out"}, terminal);
  ASSERT_TRUE(all.read_until([](const Result& r) { return r.err.find("real time") != std::string::npos; }));
  all.send(SIGINT);
  const Result stopped = all.wait();
  EXPECT_EQ(stopped.exit_code, 128 + SIGINT) << stopped.err;
  EXPECT_NE(stopped.err.find("stopped: nothing was written"), std::string::npos) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
