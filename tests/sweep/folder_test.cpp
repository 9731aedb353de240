// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <csignal>
#include <limits>
#include <mutex>
#include <random>
#include <thread>

#include "plans.hpp"
#include "vsa/files.hpp"

namespace vsa::sweep::testing {
namespace {

const std::string kPlan = "repetitions = 2\n" + kScenario + kMeasure + R"(
[[measure]]
name = "supply_J"
signal = "supply_J"
[[vary]]
key = "scenario.world"
name = "a \"world\", quoted"
list = ["bench_load", "bench_free"]
[[vary]]
key = "set.drive.friction_Nm"
list = [0.25, 1, 3.5]
)";

Outcome outcome(std::size_t run) {
  Outcome o;
  o.run = run;
  o.values = {0.1 * static_cast<double>(run), run == 3 ? std::nan("") : 1.0 / 3.0};
  o.wall_s = 0.5;
  return o;
}

std::string contents(const fs::path& file) { return read_file(file).value_or("(none)"); }
void overwrite(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

struct Filled {
  Filled() : plan(plan_of(scratch, kPlan)), folder(scratch / "out") {
    claim(folder, plan);
    Log log(folder, plan);
    for (std::size_t r = 0; r < plan.runs(); ++r) log.add(outcome(r));
    file = log.path();
  }
  Scratch scratch;
  Plan plan;
  fs::path folder, file;
};

TEST(Folder, TheTableIsSortedQuotedAndHasAllDigits) {
  const Filled f;
  Results r = read_logs(f.folder, f.plan);
  ASSERT_EQ(r.outcomes.size(), 12U);
  r.outcomes[4].values.clear();
  r.outcomes[4].error = "broke, \"badly\"\nat once";
  r.outcomes.erase(r.outcomes.begin() + 5);
  const std::string table = csv(f.plan, r);
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "point,repetition,\"a \"\"world\"\", quoted\",set.drive.friction_Nm,last_rad,supply_J,notice,error");
  EXPECT_NE(table.find("\n0,1,bench_load,0.25,0.1,0.3333333333333333,,\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\n1,1,bench_load,1,0.30000000000000004,,,\n"), std::string::npos) << "no number is an empty cell";
  EXPECT_NE(table.find("\n2,0,bench_load,3.5,,,,\"broke, \"\"badly\"\"\nat once\"\n"), std::string::npos);
  EXPECT_NE(table.find("\n2,1,bench_load,3.5,,,,not run\n"), std::string::npos);
}

TEST(Folder, NumbersTextsAndErrorsSurviveTheLog) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kPlan);
  claim(scratch / "out", plan);
  Outcome odd = outcome(2), failed;
  odd.values = {-1.0 / 3.0, std::numeric_limits<double>::infinity()};
  odd.notice = "tab\there\nand \\n";
  failed.run = 7;
  failed.error = "ends with \\";
  {
    Log log(scratch / "out", plan);
    log.add(odd);
    log.add(failed);
  }
  const Results r = read_logs(scratch / "out", plan);
  ASSERT_EQ(r.outcomes.size(), 2U);
  EXPECT_EQ(r.outcomes[0].values[0], -1.0 / 3.0);
  EXPECT_EQ(r.outcomes[0].values[1], odd.values[1]);
  EXPECT_EQ(r.outcomes[0].notice, odd.notice);
  EXPECT_EQ(r.outcomes[1].error, failed.error);
}

TEST(Folder, NumbersOfTheLogDoNotDependOnTheLocale) {
  const Filled f;
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "fr_FR.UTF-8") == nullptr)
    GTEST_SKIP() << "this machine has no locale with a comma";
  const Results r = read_logs(f.folder, f.plan);
  std::setlocale(LC_ALL, before.c_str());
  ASSERT_EQ(r.outcomes.size(), 12U);
  EXPECT_EQ(r.outcomes[1].values[1], 1.0 / 3.0);
  EXPECT_TRUE(std::isnan(r.outcomes[3].values[1]));
}

/// Wherever the writer died: what was written whole is there, and nothing else is.
TEST(Folder, ALogCutAnywhereHasItsWholeLines) {
  const Filled f;
  const std::string whole = contents(f.file);
  for (std::size_t cut = 0; cut <= whole.size(); ++cut) {
    overwrite(f.file, whole.substr(0, cut));
    const Results r = read_logs(f.folder, f.plan);
    const auto lines = static_cast<std::size_t>(std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut), '\n'));
    ASSERT_EQ(r.outcomes.size(), lines == 0 ? 0 : lines - 1) << cut;
    for (const Outcome& o : r.outcomes) ASSERT_EQ(o.values[0], outcome(o.run).values[0]);
  }
}

TEST(Folder, AFlippedByteCostsItsLineOnly) {
  const Filled f;
  const std::string whole = contents(f.file);
  const std::size_t head = whole.find('\n') + 1;
  std::mt19937 dice(5);
  for (int n = 0; n < 2000; ++n) {
    std::string damaged = whole;
    const std::size_t at = head + dice() % (whole.size() - head);
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << dice() % 8));
    overwrite(f.file, damaged);
    const Results r = read_logs(f.folder, f.plan);
    // A line end that is none any more takes two lines along.
    ASSERT_GE(r.outcomes.size(), 10U);
    ASSERT_GE(r.damaged, 1U);
    for (const Outcome& o : r.outcomes) ASSERT_EQ(o.values[0], outcome(o.run).values[0]);
  }
}

TEST(Folder, AnotherPlansFolderAndLogAreRefused) {
  const Filled f;
  const Plan other = plan_of(f.scratch, "seed = 9\n" + kPlan);
  EXPECT_THROW(claim(f.folder, other), InputError);
  EXPECT_THROW(static_cast<void>(read_logs(f.folder, other)), InputError);
  EXPECT_EQ(contents(f.folder / "plan.toml"), f.plan.text());
  claim(f.folder, f.plan);
  fs::create_directories(f.scratch / "full");
  f.scratch.write("full/thesis.tex", "x");
  EXPECT_THROW(claim(f.scratch / "full", f.plan), InputError);
  EXPECT_FALSE(fs::exists(f.scratch / "full/sweep.id"));
  EXPECT_THROW(claim("/proc/nothing/here", f.plan), InputError);
}

TEST(Folder, TwoLogsOfARunMustSayTheSameButAFailureGivesWay) {
  const Filled f;
  {
    Log again(f.folder, f.plan);
    again.add(outcome(4));
    Outcome failed;
    failed.run = 6;
    failed.error = "out of memory";
    again.add(failed);
  }
  EXPECT_EQ(read_logs(f.folder, f.plan).outcomes[6].error, "");
  EXPECT_EQ(read_logs(f.folder, f.plan).outcomes.size(), 12U);
  Outcome other = outcome(4);
  other.values[1] += 1e-16;
  {
    Log log(f.folder, f.plan);
    log.add(other);
  }
  EXPECT_THROW(static_cast<void>(read_logs(f.folder, f.plan)), InputError);
}

TEST(Folder, WhoeverWritesTheTablesTheyAreTheSameBytes) {
  const Filled f;
  const Results r = read_logs(f.folder, f.plan);
  const auto files = write_tables(f.folder, f.plan, r);
  std::vector<std::string> first;
  for (const auto& file : files) first.push_back(contents(file));
  std::vector<std::thread> writers;  // two merges at once
  for (int i = 0; i < 4; ++i) {
    writers.emplace_back([&] {
      for (int n = 0; n < 20; ++n) {
        // HDF5 as Debian has it isn't for several threads; two processes are another matter.
        static std::mutex lock;
        const std::scoped_lock guard(lock);
        static_cast<void>(write_tables(f.folder, f.plan, read_logs(f.folder, f.plan)));
      }
    });
  }
  for (std::thread& w : writers) w.join();
  for (std::size_t k = 0; k < files.size(); ++k) EXPECT_TRUE(contents(files[k]) == first[k]) << files[k];
  for (const auto& entry : fs::directory_iterator(f.folder)) EXPECT_EQ(entry.path().string().find(".part"), std::string::npos);
}

/// HDF5's names have no '/', so another letter stands for it, whoever has that name already.
TEST(Folder, ColumnsWhoseNamesDifferInASlashAreTwoInEachTable) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kScenario + R"(
[[measure]]
name = "a/b"
signal = "shaft_rad"
actuator = "shaft"
[[measure]]
name = "a_b"
signal = "shaft_rad"
actuator = "shaft"
)");
  const auto files = write_tables(scratch / ".", plan, {});
  EXPECT_NE(contents(files[0]).find("a/b,a_b,"), std::string::npos);
  if (!has_hdf5()) return;
  EXPECT_NE(contents(files[1]).find(std::string("a_b_\0", 5)), std::string::npos);
}

/// A limit on a file's size is what a full disk is to a writer.
TEST(Folder, AFullDiskIsToldAndWhatWasThereStays) {
  const Filled f;
  std::signal(SIGXFSZ, SIG_IGN);
  Log log(f.folder, f.plan);
  log.add(outcome(0));
  const std::string before = contents(log.path());
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit full{before.size() + 10, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_THROW(log.add(outcome(1)), OutputError);
  setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_EQ(contents(log.path()), before);
  log.add(outcome(1));
  EXPECT_EQ(read_logs(f.folder, f.plan).outcomes.size(), 12U);
}

}  // namespace
}  // namespace vsa::sweep::testing
