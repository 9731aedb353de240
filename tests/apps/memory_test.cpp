// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa emulate --memory: what units have stored, in a file.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <thread>

#include "emulated.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/bus/parameters.hpp"

namespace {

using vsa::test::Arguments;
using vsa::test::Emulated;
using vsa::test::expect;
using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::write_file;

/// Whether the file is there in time, with this text.
bool comes(const std::string& file, const std::string& text = "") {
  const auto begun = std::chrono::steady_clock::now();
  while (!std::filesystem::exists(file) || vsa::test::read_file(file).find(text) == std::string::npos) {
    if (std::chrono::steady_clock::now() - begun > vsa::test::kPatience) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

TEST(Memory, AMemoryInAFileOutlivesTheProgram) {
  const Scratch scratch;
  const std::string file = (scratch / "units.toml").string();
  {
    Emulated units({"--units", "2", "--memory", file});
    ASSERT_TRUE(units.ready);
    expect(units.vsa({"set", "position_pid", "0.25", "0", "0.5"}, {"--id", "2", "--store"}), 0, {"stored"});
    expect(units.vsa({"set", "position_pid", "0.75", "0", "0.5"}), 0, {"sent"});
    expect(units.vsa({"set", "id", "9"}, {"--id", "2", "--store"}), 0, {"stored"});
    units.end();
  }
  const std::string kept = vsa::test::read_file(file);
  {
    Emulated units({"--units", "2", "--memory", file});
    ASSERT_TRUE(units.ready);
    expect(units.vsa({"get", "position_pid"}, {"--id", "9"}), 0, {"P 0.25"});
    expect(units.vsa({"get", "position_pid"}), 0, {"P 0.0999"});
    expect(units.vsa({"set", "restore"}, {"--id", "9"}), 0, {"another id"});
    expect(units.vsa({"get", "position_pid"}, {"--id", "2"}), 0, {"P 0.0999"});
    units.end();
  }
  EXPECT_NE(vsa::test::read_file(file), kept);
  const auto refused = [&](const Arguments& more, const std::string& part) {
    Arguments all{"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory", file};
    all.insert(all.end(), more.begin(), more.end());
    expect(run_vsa(all), 2, {part});
  };
  refused({}, "aren't as many as --units");
  refused({"--active"}, "--active");
  write_file(file, kept.substr(0, kept.find("\"limit_low\"")));
  refused({"--units", "2"}, "limit_low");
  std::string wide = kept;
  wide.replace(wide.find("\"id\" = [") + 8, 1, "7777");
  write_file(file, wide);
  refused({"--units", "2"}, "unit[0].user.id");
  write_file(file, "type = \"qbmove_advanced\"\n");
  refused({"--units", "2"}, "qbmove_advanced");
}

TEST(Memory, AMemoryThatCantBeWrittenIsToldBeforeThereIsAPort) {
  const Scratch scratch;
  const Result r = run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory", "/nosuch/x"});
  expect(r, 2, {"vsa: --memory = /nosuch/x: can't open for writing: No such file or directory (allowed: a file in a directory"});
  EXPECT_EQ(r.out, "") << "no port is announced";
  std::filesystem::create_symlink("loop", scratch / "loop");
  std::filesystem::create_symlink("nowhere/x", scratch / "dangling");
  for (const std::string& name : {std::string("loop"), std::string("dangling"), std::string(250, 'n')}) {
    const Result bad = run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory",
                                (scratch / name).string(), "--duration-s", "0.05"});
    expect(bad, 2, {"vsa: --memory = " + (scratch / name).string() + ": can't open for writing: "});
    EXPECT_EQ(bad.out, "") << name;
  }
}

TEST(Memory, AMemoryIsKeptByOneProgramAtATime) {
  const Scratch scratch;
  const std::string file = (scratch / "units.toml").string();
  std::filesystem::create_symlink("units.toml", scratch / "other_name");
  Emulated first({"--memory", file});
  ASSERT_TRUE(first.ready);
  ASSERT_TRUE(comes(file));
  for (const std::string& name : {file, (scratch / "other_name").string()}) {
    const Result second = run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory", name});
    expect(second, 2, {"another program keeps this memory (process "});
    EXPECT_EQ(second.out, "");
  }
  first.end();
  expect(
      run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory", file, "--duration-s", "0.05"}),
      0, {"simulated time"});
}

TEST(Memory, UnitsOutliveAMemoryThatCantBeWrittenForAWhile) {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "folder", away = scratch / "away";
  std::filesystem::create_directory(folder);
  const std::string file = (folder / "units.toml").string();
  Emulated units({"--memory", file});
  ASSERT_TRUE(units.ready);
  ASSERT_TRUE(comes(file));
  std::filesystem::rename(folder, away);
  expect(units.vsa({"set", "position_pid", "0.25", "0", "0.5"}, {"--store"}), 0, {"stored"});
  for (int i = 0; i < 20; ++i) expect(units.vsa({"get", "position_pid"}), 0, {"P 0.25"});
  std::filesystem::rename(away, folder);
  EXPECT_TRUE(comes(file, "\"position.p\" = [16384]")) << vsa::test::read_file(file);
  std::filesystem::rename(folder, away);
  expect(units.vsa({"set", "position_pid", "0.5", "0", "0.5"}, {"--store"}), 0, {"stored"});
  expect(units.end(), 1, {"exchanges"});
}

TEST(Memory, WhatAMemoryOverrulesIsTold) {
  const Scratch scratch;
  const std::string file = (scratch / "units.toml").string();
  const auto run = [&](Arguments more) {
    Arguments all{"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory",
                  file,      "--duration-s",         "0.05"};
    all.insert(all.end(), more.begin(), more.end());
    return run_vsa(all);
  };
  const Arguments of_memory{"--first-id", "5", "--set", "firmware.limit_low_raw=-100"};
  EXPECT_EQ(run(of_memory).err, "") << "the units begin with these";
  EXPECT_EQ(run({"--set", "drive.friction_Nm=0.1"}).err, "") << "no unit stores it";
  expect(run(of_memory), 0, {"warning: --first-id = 5: left out", "warning: --set: of what a unit stores, " + file + " counts"});
}

TEST(Memory, UnitsAreKnownByTheIdsThatTheirMemoryHas) {
  const Scratch scratch;
  const Arguments memory{"--units", "3", "--memory", (scratch / "units.toml").string()};
  {
    Emulated units(memory);
    ASSERT_TRUE(units.ready);
    expect(units.vsa({"set", "startup_activation", "on"}, {"--id", "3", "--store"}), 0, {"stored"});
    expect(units.vsa({"set", "id", "5"}, {"--id", "1", "--store"}), 0, {"stored"});
    expect(units.end(), 0, {"3 units, ids 1 to 3, dialect 6, motors off"});
  }
  Arguments broken = memory;
  broken.insert(broken.end(), {"--fault", "5 off"});
  {
    Emulated units(broken);
    ASSERT_TRUE(units.ready);
    const Result all = run_vsa({"ping", units.path, "--id", "2,3,5", "--dialect", "6", "--timeout-ms", "300"});
    expect(all, 1, {"2     6", "3     6", "no answer from unit 5"});
    expect(units.end(), 0, {"3 units, ids 5,2,3, dialect 6, motors on of 3)", "--id 5"});
  }
  broken.back() = "1 off";
  broken.insert(broken.begin(), {"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string()});
  expect(run_vsa(broken), 2, {"--fault", "no such unit", "all, 5,2,3"});
}

TEST(Memory, AMemoryThatVsaSetWouldNotStoreIsTold) {
  const Scratch scratch;
  const std::string file = (scratch / "units.toml").string();
  const Arguments emulate{"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--memory",
                          file,      "--duration-s",         "0.05"};
  expect(run_vsa(emulate), 0, {"simulated time"});
  const std::string kept = vsa::test::read_file(file);
  const auto with = [&](const std::string& key, const std::string& values) {
    std::string text = kept;
    const std::size_t at = text.find("\"" + key + "\" = [") + key.size() + 6;
    write_file(file, text.replace(at, text.find(']', at) - at, values));
    return run_vsa(emulate);
  };
  // A client can, and the unit goes on with it.
  expect(with("resolution", "200, 1, 1"), 0, {"warning: " + file, "unit[0].user.resolution", "200", "0 … 8"});
  expect(with("multiplier", "1, nan, 1"), 0, {"warning: " + file, "unit[0].user.multiplier", "nan", "finite"});
  expect(with("limit_low", "-30000, 40000"), 0,
         {"warning: " + file, "unit[0].user.limit_low", "40000", "limit_high", "below 30000"});
  expect(with("limit_low", "30000, -30000"), 0, {"simulated time"});  // vsa set limits takes them so
  // No page can have these.
  expect(with("id", "\"x\""), 2, {file, "unit[0].user.id[0]: isn't a number"});
  write_file(file, "foo = 1\n" + kept);
  expect(run_vsa(emulate), 2, {file, "foo: unknown key", "type, unit"});
  write_file(file, kept + "[unit.third]\n");
  expect(run_vsa(emulate), 2, {file, "unit[0].third: unknown key", "user, factory"});
}

/// As a client of its own does; without waiting for an answer.
bool tell(const std::string& path, const vsa::bus::Request& request) {
  const int fd = open(path.c_str(), O_RDWR | O_NOCTTY);
  termios settings{};
  const bool there =
      tcgetattr(fd, &settings) == 0 && cfsetspeed(&settings, B2000000) == 0 && tcsetattr(fd, TCSANOW, &settings) == 0;
  const vsa::bus::FrameBytes frame = vsa::bus::encode_request({}, 1, request);
  const bool said = there && write(fd, frame.bytes.data(), frame.size) == frame.size;
  close(fd);
  return said;
}

TEST(Memory, AStoredMultiplierThatIsNoNumberHasTheFileWrittenOnce) {
  const Scratch scratch;
  const std::string file = (scratch / "units.toml").string();
  Emulated unit({"--memory", file});
  ASSERT_TRUE(unit.ready);
  const std::array<float, 3> none{std::numeric_limits<float>::quiet_NaN(), 1, 1};
  const auto request = vsa::bus::encode_value(vsa::bus::ParameterId::multipliers, none);
  ASSERT_TRUE(request && tell(unit.path, *request));
  expect(unit.vsa({"set", "store"}), 0, {"stored"});
  ASSERT_TRUE(comes(file, "\"multiplier\" = [nan, 1, 1]"));
  const auto written = std::filesystem::last_write_time(file);
  // It looks each 0.1 s; the commands take longer.
  for (int i = 0; i < 20; ++i) expect(unit.vsa({"get", "active"}), 0, {"off"});
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  unit.end();
  expect(run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", unit.path, "--memory", file, "--duration-s", "0.05"}), 0,
         {"warning: ", "unit[0].user.multiplier", "nan"});
}

}  // namespace
