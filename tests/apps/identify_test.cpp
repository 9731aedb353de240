// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa identify`: what it refuses, before it simulates anything. Its mathematics is tested in tests/identify.
#include <gtest/gtest.h>

#include <filesystem>

#include "subprocess.hpp"

namespace {

using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
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
  expect_refused(with({"--starts", "0"}), "--starts");
  expect_refused(with({"--weights", "none"}), "--weights");
  expect_refused(with({"--name", "../x"}), "--name");
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

}  // namespace
