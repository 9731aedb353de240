// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa identify`: what it refuses, before it simulates anything; the same bytes by threads, parts and ranks, killed and resumed. Its
// mathematics is tested in tests/identify.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <regex>

#include "pool_runs.hpp"

namespace {

using vsa::test::read_file;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::runs_in;
using vsa::test::Scratch;
using vsa::test::Subprocess;
using vsa::test::wait_for_runs;
using vsa::test::write_file;

const std::string kRecording = std::string(VSA_SOURCE_DIR) + "/data/qbmove_maker_pro/stiffness_preset_0.0000rad_branches.csv";

Result identify(std::vector<std::string> more, const std::string& recording = kRecording) {
  std::vector<std::string> all{"identify", recording};
  all.insert(all.end(), more.begin(), more.end());
  return run_vsa(all);
}

void expect_refused(const Result& r, const std::string& part) {
  EXPECT_EQ(r.exit_code, 2) << r.err;
  EXPECT_NE(r.err.find(part), std::string::npos) << "no '" << part << "' in:\n" << r.err;
}

TEST(Identify, RefusesKeysThatCantBeIdentified) {
  const std::vector<std::string> preset{"--type", "qbmove_maker_pro", "--parameters"};
  const auto with = [&](const std::string& keys) {
    auto all = preset;
    all.push_back(keys);
    return identify(all);
  };
  expect_refused(with("shaft.frictoin_Nm"), "shaft.friction_Nm");
  expect_refused(with("drive.off_mode"), "isn't a real number");
  expect_refused(with("sensor.encoder_bits"), "isn't a real number");
  expect_refused(with("shaft.friction_Nm,shaft.friction_Nm"), "twice");
  expect_refused(with("elastic.k1_Nm=elastic.a1_per_rad"), "another unit");
}

TEST(Identify, RefusesPresetsRecordingsAndNumbersThatArentFine) {
  const std::vector<std::string> fine{"--type", "qbmove_maker_pro", "--parameters", "shaft.friction_Nm"};
  const auto with = [&](std::vector<std::string> more, const std::string& recording = kRecording) {
    more.insert(more.begin(), fine.begin(), fine.end());
    return identify(more, recording);
  };
  expect_refused(run_vsa({"identify", "--type", "qbmove_maker_pro", "--parameters", "shaft.friction_Nm"}), "RECORDING");
  expect_refused(identify({"--type", "qbmove_maker_por", "--parameters", "shaft.friction_Nm"}), "qbmove_maker_por");
  expect_refused(with({}, "no_such_preset_0.1rad.csv"), "no such file");
  expect_refused(with({"--set", "shaft.friction_Nm=-1"}), "shaft.friction_Nm");
  expect_refused(with({"--set", "shaft.friction_Nm"}), "--set");
  expect_refused(with({"--period-s", "0"}), "--period-s");
  expect_refused(with({"--period-s", "nan"}), "--period-s");
  expect_refused(with({"--cycles", "1"}), "1.5");
  expect_refused(with({"--load-kg", "0"}), "--load-kg");
  expect_refused(with({"--starts", "0"}), "--starts");
  expect_refused(with({"--weights", "none"}), "--weights");
  expect_refused(with({"--name", "../x"}), "--name");
  expect_refused(with({"--bootstrap", "1"}), "scatter");
  expect_refused(with({"--bootstrap", "-1"}), "--bootstrap");
  expect_refused(with({"--part", "3/2"}), "--part");
  expect_refused(with({"--threads", "-1"}), "--threads");
  expect_refused(with({"--retry-failed"}), "--resume");
}

TEST(Identify, RefusesAsManyParametersAsPoints) {
  const Scratch scratch;
  const std::string points = scratch / "two_points.csv";
  write_file(points, "load_torque_Nm,deflection_rad\n-1,-0.1\n1,0.1\n");
  const std::vector<std::string> two{"--type", "sea_example",  "--parameters", "elastic.stiffness_Nm_per_rad,sensor.shaft_zero_rad",
                                     "--out",  scratch / "out"};
  expect_refused(identify(two, points), "2 points");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

/// A second pass over the same weights is one more recording of the same experiment.
TEST(Identify, TakesTwoPassesOfOneSpring) {
  const Scratch scratch;
  write_file(scratch / "first_points.csv", "load_torque_Nm,deflection_rad\n-2,-0.1\n-1,-0.051\n1,0.05\n2,0.1\n");
  write_file(scratch / "second_points.csv", "load_torque_Nm,deflection_rad\n-2,-0.1\n-1,-0.05\n1,0.049\n2,0.1\n");
  const auto r =
      run_vsa({"identify", scratch / "first_points.csv", scratch / "second_points.csv", "--type", "sea_example", "--set",
               "elastic.stiffness_Nm_per_rad=11", "--parameters", "elastic.stiffness_Nm_per_rad", "--out", scratch / "out"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const std::string type = vsa::test::read_file(scratch / "out" / "identified.toml");
  EXPECT_NE(type.find("calibrated_on = { value = [\"stiffness.0.0000\"]"), std::string::npos) << type.substr(0, 800);
}

TEST(Identify, FindsTheSpringOfALinearActuator) {
  const Scratch scratch;
  const std::string points = scratch / "ram_points.csv";
  std::string rows = "load_force_N,deflection_m\n";
  for (int i = -10; i <= 10; ++i) rows += std::to_string(40 * i) + ',' + std::to_string(40 * i / 8e4 + (i % 2) * 1e-6) + '\n';
  write_file(points, rows);
  const std::vector<std::string> asked{"--type", "linear_sea_example", "--parameters", "elastic.stiffness_N_per_m",
                                       "--out",  scratch / "out"};
  const Result r = identify(asked, points);
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const std::string json = read_file(std::filesystem::path(std::string(scratch / "out")) / "results.json");
  const std::size_t at = json.find("\"value\"");
  ASSERT_NE(at, std::string::npos) << json;
  EXPECT_NE(r.out.find("N/m"), std::string::npos) << r.out;
  // In an angle's units they are another actuator's.
  write_file(scratch / "arm_points.csv", "load_torque_Nm,deflection_rad\n-1,-0.1\n0,0.001\n1,0.1\n");
  expect_refused(identify(asked, scratch / "arm_points.csv"), "load_force_N");
}

TEST(Identify, FindsTheSpringOfAJointThatWasSweptWithALighterLever) {
  const Scratch scratch;
  const Result swept = run_vsa({"characterize", "maccepa_example", "--experiment", "stiffness", "--preset-rad", "1", "--period-s",
                                "8", "--cycles", "1", "--out", scratch / "swept"});
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  EXPECT_NE(swept.out.find("carries 0.1 kg"), std::string::npos) << swept.out;
  const auto found = [&](const std::string& mass) {
    return identify(
        {"--type", "maccepa_example", "--set", "elastic.spring_N_per_m=400", "--parameters", "elastic.spring_N_per_m", "--period-s",
         "8", "--load-kg", mass, "--no-global", "--starts", "1", "--iterations", "5", "--out", scratch / ("found_" + mass)},
        scratch / "swept/stiffness_preset_1.0000rad.csv");
  };
  expect_refused(found("1"), "doesn't carry it");
  const Result right = found("0.1");
  ASSERT_EQ(right.exit_code, 0) << right.err;
  const std::size_t at = right.out.find("N/m  ");
  ASSERT_NE(at, std::string::npos) << right.out;
  double before = 0, estimate = 0;
  ASSERT_EQ(std::sscanf(right.out.c_str() + at, "N/m %lf %lf", &before, &estimate), 2) << right.out;
  EXPECT_NEAR(estimate, 323, 5) << "the type's own";
}

TEST(Identify, RefusesBadRecordingsAllAtOnceAndWritesNothing) {
  const Scratch scratch;
  const auto empty = scratch / "a_preset_0.1000rad.csv", unit = scratch / "b_preset_0.2000rad.csv",
             far = scratch / "c_preset_9.0000rad_branches.csv";
  write_file(empty, "");
  write_file(unit, "load_torque,deflection_rad\n0,0\n1,1\n");
  const auto r = run_vsa({"identify", empty.string(), unit.string(), "--type", "qbmove_maker_pro", "--parameters",
                          "shaft.friction_Nm,shaft.nothing", "--out", (scratch / "out").string()});
  expect_refused(r, "empty");
  expect_refused(r, "load_torque_Nm");
  expect_refused(r, "shaft.nothing");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  std::filesystem::copy_file(kRecording, far);
  const auto beyond = run_vsa({"identify", far.string(), "--type", "qbmove_maker_pro", "--parameters", "shaft.friction_Nm", "--out",
                               (scratch / "out").string()});
  expect_refused(beyond, "beyond what");
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

TEST(Identify, RefusesAMeasurementThatIsThereTwice) {
  const Scratch scratch;
  const std::string samples = std::regex_replace(kRecording, std::regex("_branches"), "_samples");
  const auto copy = scratch / std::filesystem::path(kRecording).filename();
  std::filesystem::copy_file(kRecording, copy);
  for (const std::string& again : {kRecording, samples, copy.string()}) {
    const auto r = run_vsa({"identify", kRecording, again, "--type", "qbmove_maker_pro", "--parameters", "shaft.friction_Nm",
                            "--out", (scratch / "out").string()});
    expect_refused(r, "is the measurement of");
  }
}

TEST(Identify, WarnsOfALoadThatTheRecordingHardlyReaches) {
  const Scratch scratch;
  const auto with = [&](const std::string& load_kg) {
    return run_vsa({"identify", std::regex_replace(kRecording, std::regex("_branches"), "_samples"), "--type", "qbmove_maker_pro",
                    "--parameters", "shaft.friction_Nm", "--starts", "1", "--iterations", "1", "--no-cross-validation",
                    "--no-global", "--period-s", "2", "--load-kg", load_kg, "--out", (scratch / "out").string()});
  };
  EXPECT_NE(with("20").err.find("points of it count"), std::string::npos);
  EXPECT_EQ(with("1").err.find("points of it count"), std::string::npos);
}

TEST(Identify, NamesARecordingWithoutPoints) {
  const Scratch scratch;
  const auto half = scratch / "half_preset_0.1000rad.csv";
  std::string text = "load_torque_Nm,deflection_rad\n";
  for (int k = 0; k <= 40; ++k) text += std::to_string(0.025 * k) + ',' + std::to_string(0.01 * k) + '\n';
  write_file(half, text);
  for (const bool alone : {true, false}) {
    std::vector<std::string> arguments{"identify", half.string()};
    if (!alone) arguments.push_back(kRecording);
    for (const char* more : {"--type", "qbmove_maker_pro", "--parameters", "shaft.friction_Nm", "--out"}) arguments.push_back(more);
    arguments.push_back((scratch / "out").string());
    const auto r = run_vsa(arguments);
    expect_refused(r, "half_preset_0.1000rad.csv: holds no branch of a load cycle");
  }
}

std::vector<std::string> short_fits(const std::filesystem::path& out, const std::vector<std::string>& more) {
  std::vector<std::string> all{"identify",        kRecording,
                               "--type",          "qbmove_maker_pro",
                               "--parameters",    "shaft.friction_Nm",
                               "--starts",        "1",
                               "--iterations",    "2",
                               "--period-s",      "2",
                               "--amplitude-rad", "1.5",
                               "--profile",       "2",
                               "--bootstrap",     "8",
                               "--out",           out.string()};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}
std::string fits(const std::filesystem::path& folder) {
  return read_file(folder / "results.json") + read_file(folder / "identified.toml");
}
/// What two threads find, made once for all tests.
std::string fits_of_threads() {
  const Scratch scratch;
  const Result r = run_vsa(short_fits(scratch / "threads", {"--threads", "2"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("Bootstrap, 8 draws"), std::string::npos) << r.out;
  EXPECT_FALSE(std::filesystem::exists(scratch / "threads/jobs")) << "what nobody needs any more";
  return fits(scratch / "threads");
}

/// 11 short fits: one start, two profile points, eight draws.
class IdentifyPool : public vsa::test::WithRanks {
 protected:
  void SetUp() override {
    static const std::string once = fits_of_threads();
    expected_ = once;
    ASSERT_FALSE(expected_.empty());
  }
  [[nodiscard]] std::vector<std::string> asked(const std::string& out, const std::vector<std::string>& more) const {
    return short_fits(scratch_ / out, more);
  }
  [[nodiscard]] std::string found(const std::string& out) const { return fits(scratch_ / out); }
  Scratch scratch_;
  std::string expected_;
};

TEST_F(IdentifyPool, OneThreadAndPartsFindTheSame) {
  EXPECT_EQ(run_vsa(asked("one", {"--threads", "1"})).exit_code, 0);
  EXPECT_TRUE(found("one") == expected_);
  {
    Subprocess second(asked("parts", {"--part", "2/2"}));
    EXPECT_EQ(run_vsa(asked("parts", {"--part", "1/2"})).exit_code, 0);
    EXPECT_EQ(second.wait().exit_code, 0);
  }
  EXPECT_TRUE(found("parts") == expected_);
  EXPECT_EQ(runs_in(scratch_ / "parts/jobs"), 11U) << "nothing twice";
}

TEST_F(IdentifyPool, APartAloneEndsAfterItsWaitAndGoesOnWithTheOther) {
  const Result alone = run_vsa(asked("lone", {"--part", "1/2", "--wait-s", "0.5"}));
  EXPECT_EQ(alone.exit_code, 1) << alone.err;
  EXPECT_NE(alone.err.find("no runs of the parts 2/2 for 0.5 s"), std::string::npos) << alone.err;
  {
    Subprocess second(asked("lone", {"--part", "2/2"}));
    EXPECT_EQ(run_vsa(asked("lone", {"--part", "1/2", "--resume"})).exit_code, 0);
    EXPECT_EQ(second.wait().exit_code, 0);
  }
  EXPECT_TRUE(found("lone") == expected_);
}

TEST_F(IdentifyPool, KilledItGoesOnWhereItWas) {
  for (const int signal : {SIGKILL, SIGINT}) {
    const std::string out = "killed_" + std::to_string(signal);
    Subprocess running(asked(out, {"--threads", "1"}));
    ASSERT_TRUE(wait_for_runs(scratch_ / out / "jobs", 3));
    running.send(signal);
    EXPECT_EQ(running.wait().exit_code, 128 + signal);
    EXPECT_FALSE(std::filesystem::exists(scratch_ / out / "results.json"));
    const Result anew = run_vsa(asked(out, {}));
    expect_refused(anew, "--resume");
    const Result other = run_vsa(asked(out, {"--resume", "--seed", "2"}));
    expect_refused(other, "of another");
    EXPECT_EQ(run_vsa(asked(out, {"--resume"})).exit_code, 0);
    EXPECT_TRUE(found(out) == expected_) << signal;
  }
}

TEST_F(IdentifyPool, ASecondOneInItsFolderIsRefusedAndTheFirstGoesOn) {
  Subprocess first(asked("twice", {"--threads", "1"}));
  ASSERT_TRUE(wait_for_runs(scratch_ / "twice/jobs", 1));
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{}, {"--resume"}, {"--part", "2/2"}})
    expect_refused(run_vsa(asked("twice", more)), "at work there");
  EXPECT_EQ(first.wait().exit_code, 0);
  EXPECT_TRUE(found("twice") == expected_);
}

TEST_F(IdentifyPool, RefusesAFolderThatHoldsSomethingElseAndTakesNoDamagedLineForAResult) {
  const std::string log = (scratch_ / "odd/jobs/log").string();
  std::filesystem::create_directories(scratch_ / "odd");
  write_file(scratch_ / "odd/jobs", "a file");
  expect_refused(run_vsa(asked("odd", {})), "jobs");
  std::filesystem::remove(scratch_ / "odd/jobs");
  std::filesystem::create_directories(scratch_ / "odd/jobs");
  write_file(scratch_ / "odd/jobs/mine.txt", "not a log");
  expect_refused(run_vsa(asked("odd", {})), "something else: mine.txt");
  std::filesystem::remove_all(scratch_ / "odd");
  {
    Subprocess running(asked("odd", {"--threads", "1"}));
    ASSERT_TRUE(wait_for_runs(scratch_ / "odd/jobs", 2));
    running.send(SIGKILL);
    EXPECT_EQ(running.wait().exit_code, 128 + SIGKILL);
  }
  for (const auto& entry : std::filesystem::directory_iterator(log)) {
    std::string text = read_file(entry.path());
    text[text.size() - 5] ^= 1;
    write_file(entry.path(), text + "0123abcd\tgarbage\nnan\n");
  }
  EXPECT_EQ(run_vsa(asked("odd", {"--resume"})).exit_code, 0);
  EXPECT_TRUE(found("odd") == expected_);
}

TEST_F(IdentifyPool, RanksFindTheSame) {
  if (const std::string why = no_ranks(); !why.empty()) GTEST_SKIP() << why;
  for (const int ranks : {1, 3}) {
    const std::string out = "ranks_" + std::to_string(ranks);
    const Result r = run_vsa(job(ranks, asked(out, {})), mpirun());
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(found(out) == expected_) << ranks;
  }
  const Result refused = run_vsa(job(2, asked("refused", {"--seed", "-1"})), mpirun());
  expect_refused(refused, "--seed");
  EXPECT_EQ(refused.err.find("--seed"), refused.err.rfind("--seed")) << "told once:\n" << refused.err;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "refused"));
}

}  // namespace
