// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units on a virtual port as a person at a terminal meets them: vsa emulate in one process, ping, get and set in others.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <regex>

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
using vsa::test::Subprocess;
using vsa::test::write_file;

TEST(Emulate, TellsItsPortAndRemovesItWhenASignalEndsIt) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Emulated units({"--units", "3"});
    ASSERT_TRUE(units.ready);
    EXPECT_TRUE(std::filesystem::is_symlink(units.path));
    const Result ended = units.end(signal);
    expect(ended, 0, {units.path, "ids 1 to 3", "vsa ping " + units.path, "exchanges", "clients gone"});
    EXPECT_EQ(ended.err.find('\r'), std::string::npos) << "in a pipe there is no live line:\n" << ended.err;
    EXPECT_FALSE(std::filesystem::is_symlink(units.path));
  }
}

TEST(Emulate, ADurationEndsItAndASignalThatCutsItShortShows) {
  const Scratch scratch;
  const Arguments arguments{"emulate", "qbmove_maker_pro_6_1", "--port", (scratch / "port").string(), "--duration-s"};
  Arguments brief = arguments;
  brief.emplace_back("0.05");
  expect(run_vsa(brief), 0, {"0.050 s in"});
  Emulated units({"--duration-s", "1000"});
  ASSERT_TRUE(units.ready);
  EXPECT_EQ(units.end(SIGINT).exit_code, 128 + SIGINT);
}

TEST(Emulate, BadInputIsToldBeforeThereIsAPort) {
  const Scratch scratch;
  const std::string path = (scratch / "port").string();
  const auto with = [&path](Arguments more) {
    more.insert(more.begin(), {"emulate", "qbmove_maker_pro_6_1", "--port", path});
    return run_vsa(more);
  };
  expect(with({"--units", "0"}), 2, {"ids"});
  expect(with({"--units", "10", "--first-id", "250"}), 2, {"1 to 254"});
  expect(with({"--fault", "all lost_byte=1.5"}), 2, {"lost"});
  expect(with({"--fault", "7 off"}), 2, {"--fault", "no such unit"});
  expect(with({"--fault", "1"}), 2, {"names no fault"});
  expect(with({"--dialect", "8"}), 2, {"--dialect"});
  expect(run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", "x y"}), 2, {"--port", "x y", "letters, digits"});
  expect(run_vsa({"emulate", "walker", "--port", path}), 2, {"walker"});
  expect(run_vsa({"emulate", "anydrive_ad119e20", "--port", path}), 2, {"anydrive_ad119e20", "speaks no qbmove protocol"});
  write_file(path, "mine");
  expect(with({}), 2, {"left alone"});
}

TEST(Emulate, SaysWhereAnEquilibriumIsntASumAndADifference) {
  for (const auto& [type, antagonists] : {std::pair{"qbmove_maker_pro_6_1", true}, std::pair{"bi_stiffness_example", false}}) {
    Emulated units({}, type);
    ASSERT_TRUE(units.ready);
    const Result result = units.end();
    EXPECT_EQ(result.err.find("aren't equilibrium ± preset; use vsa set") == std::string::npos, antagonists) << type << result.err;
  }
}

TEST(Emulate, APortThatIsServedIsRefused) {
  Emulated units;
  ASSERT_TRUE(units.ready);
  expect(run_vsa({"emulate", "qbmove_maker_pro_6_1", "--port", units.path}), 2, {"another program serves"});
}

TEST(Emulate, AClientAtAnotherRateGetsNothingAndTheUserIsTold) {
  Emulated units;
  ASSERT_TRUE(units.ready);
  const Arguments slow{"--id", "1", "--baud-Hz", "460800", "--timeout-ms", "20"};
  Arguments ping{"ping", units.path};
  ping.insert(ping.end(), slow.begin(), slow.end());
  expect(run_vsa(ping), 1, {"no answer from unit 1"});
  expect(units.vsa({"ping", "--id", "1"}), 0, {"1     6"});
  const Result ended = units.end();
  expect(ended, 0, {"warning: the client's serial port is set to 460800 bit/s, the units listen at 2000000", " at another rate"});
  EXPECT_EQ(ended.out.find(" 0 at another rate"), std::string::npos) << ended.out;
  Emulated patient({"--any-rate"});
  ASSERT_TRUE(patient.ready);
  expect(patient.vsa({"ping", "--id", "1", "--baud-Hz", "460800"}), 0, {"1     6"});
  expect(patient.vsa({"ping", "--id", "1", "--dialect", "7"}), 0, {"1     7"});  // as it was told, whatever the unit's
  EXPECT_EQ(patient.end().err, "");
}

TEST(Ping, ListsTheUnitsThatAnswerAndFailsForOthers) {
  Emulated units({"--units", "2", "--first-id", "7"});
  ASSERT_TRUE(units.ready);
  const Result both = units.vsa({"ping", "--id", "7-8"});
  expect(both, 0, {"7 ", "8 ", "6"});
  expect(run_vsa({"ping", units.path, "--id", "7,9"}), 1, {"no answer from unit 9"});
  Emulated seven({"--dialect", "7"});
  expect(seven.vsa({"ping", "--id", "1"}), 0, {"1     7"});
  Emulated of_its_type({"--set", "firmware.dialect=7"});
  expect(of_its_type.vsa({"ping", "--id", "1"}), 0, {"1     7"});
}

TEST(Ping, NeedsAPortThatExistsAndIdsThatCanBe) {
  expect(run_vsa({"ping", "/nowhere/port"}), 2, {"no such port"});
  expect(run_vsa({"ping", "/dev/null"}), 2, {"no serial port"});
  expect(run_vsa({"ping", "/dev/null", "--id", "1-300"}), 2, {"--id", "1 to 254"});
  const Scratch empty;
  vsa::test::Surroundings alone;
  alone.environment = {{"XDG_RUNTIME_DIR", (empty / "").string()}};
  expect(run_vsa({"ping"}, alone), 2, {"no virtual port runs"});
}

TEST(Ping, WithoutAPortTakesTheOnlyVirtualOne) {
  const Scratch runtime;
  vsa::test::Surroundings alone;
  alone.environment = {{"XDG_RUNTIME_DIR", (runtime / "").string()}};
  Subprocess units({"emulate", "qbmove_maker_pro_6_1", "--port", "arm"}, alone);
  ASSERT_TRUE(units.read_until([](const Result& r) { return r.out.find("Ctrl-C") != std::string::npos; }));
  expect(run_vsa({"ping", "--id", "1", "--timeout-ms", "20000"}, alone), 0, {"vsa-arm"});
  expect(run_vsa({"get", "arm", "active", "--timeout-ms", "20000"}, alone), 0, {"off"});
  units.send(SIGTERM);
  EXPECT_EQ(units.wait().exit_code, 0);
  EXPECT_TRUE(std::filesystem::is_empty(runtime / ""));
}

TEST(GetAndSet, MoveAUnitAndReadWhereItIs) {
  Emulated units({"--units", "2"});
  ASSERT_TRUE(units.ready);
  expect(units.vsa({"set", "active", "on"}, {"--id", "1-2"}), 0, {"unit 1: motors on", "unit 2: motors on"});
  expect(units.vsa({"get", "active"}, {"--id", "2"}), 0, {"on"});
  expect(units.vsa({"set", "equilibrium", "10", "5"}, {"--id", "2"}), 0, {"motor 1 15.", "motor 2 5."});
  expect(units.vsa({"set", "inputs", "-910ticks", "910ticks"}), 0, {"motor 1 -10.00° (-910 ticks)"});
  expect(units.vsa({"get"}), 0, {"active", "inputs", "measurements", "currents", "mA", "shaft"});
  expect(units.vsa({"get", "active"}, {"--id", "2-3"}), 1, {"on", "unit 3"});  // what unit 2 said isn't lost
  // The shaft is pulled to 10°; how fast is the motors' affair.
  const std::regex shaft("shaft ([0-9.-]+)°");
  double at = 0;
  for (const auto end = std::chrono::steady_clock::now() + vsa::test::kPatience;
       at < 7 && std::chrono::steady_clock::now() < end;) {
    const Result now = units.vsa({"get", "measurements"}, {"--id", "2"});
    std::smatch match;
    ASSERT_TRUE(std::regex_search(now.out, match, shaft)) << now.out << now.err;
    at = std::stod(match[1]);
  }
  EXPECT_NEAR(at, 10, 3);
  expect(units.vsa({"set", "active", "off"}), 0, {"motors off"});
}

TEST(GetAndSet, ParametersAreCheckedSentStoredAndReadBack) {
  Emulated units({"--units", "2"});
  ASSERT_TRUE(units.ready);
  expect(units.vsa({"get", "parameters"}), 0, {"position_pid", "control_mode", "position", "limits", "1500 mA"});
  expect(units.vsa({"set", "position_pid", "0.25", "0", "0.5"}, {"--store"}), 0, {"P 0.25", "D 0.5", "stored"});
  expect(units.vsa({"get", "position_pid"}), 0, {"P 0.25"});
  expect(units.vsa({"set", "control_mode", "deflection"}, {"--store"}), 0, {"deflection, stored"});
  expect(units.vsa({"set", "equilibrium", "10", "5"}), 0, {"warning: unit 1: its control_mode is deflection"});
  expect(units.vsa({"set", "limits", "-90", "90", "-45", "45"}, {"--store"}), 0, {"-90.00°", "45.00°"});
  expect(units.vsa({"set", "id", "1"}, {"--id", "2", "--store"}), 2, {"unit that answers", "nobody has"});
  expect(units.vsa({"ping"}, {"--id", "1-2"}), 0, {"1 ", "2 "});
  expect(units.vsa({"set", "id", "9"}, {"--id", "2", "--store"}), 0, {"id = 9"});
  expect(units.vsa({"ping"}, {"--id", "9"}), 0, {"9 "});
  expect(units.vsa({"get", "info"}), 0, {"Firmware version: QBMMP v6.1.0", "Control Mode: Deflection"});
}

TEST(GetAndSet, DefaultsAreStoredAndRestoredInBothDialects) {
  for (const char* dialect : {"6", "7"}) {
    Emulated units({"--dialect", dialect});
    ASSERT_TRUE(units.ready);
    expect(units.vsa({"set", "position_pid", "0.25", "0", "0.5"}, {"--store"}), 0, {"stored"});
    expect(units.vsa({"set", "restore"}), 0, {"unit 1: has its defaults, stored\n"});
    expect(units.vsa({"get", "position_pid"}), 0, {"P 0.0999"});
    expect(units.vsa({"set", "position_pid", "0.25", "0", "0.5"}), 0, {"sent"});
    expect(units.vsa({"set", "store_defaults"}), 0, {"stored as its defaults"});
    expect(units.vsa({"set", "position_pid", "0.75", "0", "0.5"}, {"--store"}), 0, {"stored"});
    expect(units.vsa({"set", "restore"}), 0, {"has its defaults"});
    expect(units.vsa({"get", "position_pid"}), 0, {"P 0.25"});
    expect(units.vsa({"set", "id", "9"}, {"--store"}), 0, {"stored"});
    expect(units.vsa({"set", "restore"}, {"--id", "9"}), 0, {"another id: vsa ping", "unless another unit has that id too"});
    expect(units.vsa({"get", "active"}), 0, {"off"});
    expect(units.vsa({"set", "restore"}, {"--id", "1-2"}), 2, {"one unit"});
    expect(units.vsa({"set", "restore", "now"}), 2, {"restore"});
  }
}

TEST(Ping, SaysWhichRatesThereAre) {
  Emulated units({"--units", "1"});
  ASSERT_TRUE(units.ready);
  for (const std::string rate : {"-1", "0", "100000001"})
    expect(units.vsa({"ping", "--baud-Hz", rate}), 2, {"--baud-Hz = " + rate + ": out of range (allowed: 1 to 100000000)"});
}

TEST(GetAndSet, ABaudrateActsAtOnceForTheUnitThatIsTold) {
  Emulated units({"--units", "2"});
  ASSERT_TRUE(units.ready);
  expect(units.vsa({"set", "baudrate", "115200"}), 2, {"460800, 2000000"});
  expect(units.vsa({"set", "baudrate"}), 2, {"baudrate"});
  expect(units.vsa({"set", "baudrate", "2000000"}), 0, {"as before"});
  expect(units.vsa({"set", "baudrate", "460800"}, {"--id", "2"}), 0,
         {"unit 2: was told to listen at 460800 bit/s: --baud-Hz 460800"});
  expect(units.vsa({"get", "active"}, {"--id", "2", "--baud-Hz", "460800"}), 0, {"off"});
  expect(units.vsa({"get", "active"}), 0, {"off"});
  expect(units.vsa({"set", "baudrate", "2000000"}, {"--id", "2", "--baud-Hz", "460800"}), 0, {"was told"});
  expect(units.vsa({"get", "active"}, {"--id", "2"}), 0, {"off"});
}

/// Its list has a slot more, and its references come back with the other sign.
TEST(GetAndSet, AnAdvancedUnitAsAnyOther) {
  Emulated unit({}, "qbmove_advanced");
  ASSERT_TRUE(unit.ready);
  expect(unit.vsa({"set", "active", "on"}), 0, {"motors on"});
  expect(unit.vsa({"set", "inputs", "10", "-10"}), 0, {"motor 1 10.00° (910 ticks), motor 2 -10.00° (-910 ticks)"});
  expect(unit.vsa({"get", "inputs", "measurements"}), 0, {"motor 1 10.00°", "shaft"});
  expect(unit.vsa({"get", "parameters"}), 0, {"position_pid", "P -0.0999"});
  expect(unit.vsa({"set", "control_mode", "deflection"}, {"--store"}), 0, {"deflection, stored"});
}

TEST(GetAndSet, ANewIdIsStoredAtOnceInBothDialects) {
  for (const char* dialect : {"6", "7"}) {
    Emulated unit({"--dialect", dialect});
    ASSERT_TRUE(unit.ready);
    expect(unit.vsa({"set", "id", "9"}), 2, {"--store"});
    expect(unit.vsa({"set", "id", "9"}, {"--store"}), 0, {"id = 9, stored"});
    expect(unit.vsa({"get", "id"}, {"--id", "9"}), 0, {"9"});
  }
}

TEST(GetAndSet, AnEquilibriumIsInDegreesWhateverTheMotorsTicks) {
  Emulated unit;
  ASSERT_TRUE(unit.ready);
  expect(unit.vsa({"set", "resolutions", "1", "3", "1"}, {"--store"}), 0, {"stored"});
  expect(unit.vsa({"set", "active", "on"}), 0, {"motors on"});
  expect(unit.vsa({"set", "equilibrium", "20", "15"}), 0, {"motor 1 34.99° (3185 ticks)", "motor 2 5.01° (114 ticks)"});
}

TEST(GetAndSet, WhatAUnitDoesNotTakeFailsAndTheOthersAreAskedAllTheSame) {
  Emulated units({"--units", "3", "--fault", "2 off"});
  ASSERT_TRUE(units.ready);
  const Result on = run_vsa({"set", units.path, "active", "on", "--id", "1-3", "--timeout-ms", "300"});
  expect(on, 1, {"unit 1: motors on", "unit 3: motors on", "unit 2, a ping: no answer within 300 ms"});
  expect(units.vsa({"set", "inputs", "170", "0"}), 1, {"not what was asked for"});  // beyond its limits
  const Result all = run_vsa({"ping", units.path, "--id", "1-3", "--dialect", "6", "--timeout-ms", "300"});
  expect(all, 1, {"1     6", "3     6", "no answer from unit 2"});
}

TEST(GetAndSet, DialectSevenAcknowledgesWhatSixOnlyHears) {
  Emulated units({"--dialect", "7"});
  ASSERT_TRUE(units.ready);
  expect(units.vsa({"set", "rate_limiter", "20"}, {"--store"}), 0, {"rate_limiter = 20"});
  expect(units.vsa({"get", "serial_number"}), 0, {"serial_number"});
}

TEST(GetAndSet, BadValuesAreToldAllAtOnceAndNothingIsSent) {
  Emulated units;
  ASSERT_TRUE(units.ready);
  expect(units.vsa({"set", "inputs", "900", "north"}), 2, {"out of range", "no angle", "degrees"});
  expect(units.vsa({"set", "inputs", "1"}), 2, {"takes 2 values"});
  expect(units.vsa({"set", "control_mode", "walk"}), 2, {"position, pwm"});
  expect(units.vsa({"set", "limits", "10", "-10", "0", "0"}), 2, {"above the upper"});
  expect(units.vsa({"set", "resolutions", "1", "1", "9"}), 2, {"0 to 8"});
  expect(units.vsa({"set", "position_pid", "1", "nan", "1e9"}), 2, {"no number", "out of range"});
  expect(units.vsa({"set", "max_steps", "5", "5"}, {"--store"}), 2, {"above 0", "lowest ≤ 0, highest ≥ 0"});
  expect(units.vsa({"set", "rate_limiter", "1"}), 2, {"nothing that this unit has"});
  expect(units.vsa({"set", "colour", "red"}), 2, {"colour"});
  expect(units.vsa({"get", "colour"}), 2, {"colour", "measurements"});
  expect(units.vsa({"set", "active", "on"}, {"--store"}), 2, {"--store"});
  expect(units.vsa({"set", "id", "3"}, {"--id", "1-2"}), 2, {"same id"});
  expect(run_vsa({"get", units.path, "active", "--id", "5"}), 1, {"unit 5", "no answer"});
  expect(units.vsa({"get", "inputs"}), 0, {"motor 1 0.00° (0 ticks), motor 2 0.00° (0 ticks)"});
}

TEST(Faults, AreOnTheUnitsThatAreNamed) {
  Emulated units({"--units", "3", "--fault", "2 off"});
  ASSERT_TRUE(units.ready);
  expect(units.vsa({"ping", "--id", "1,3"}), 0, {});
  expect(run_vsa({"ping", units.path, "--id", "2"}), 1, {"no answer from unit 2"});
  Emulated noisy({"--fault", "all lost_byte=1"});
  ASSERT_TRUE(noisy.ready);
  expect(run_vsa({"ping", noisy.path, "--id", "1"}), 1, {"no answer"});
  Emulated low({"--fault", "1 supply_V=7"});
  ASSERT_TRUE(low.ready);
  expect(low.vsa({"get", "info"}), 0, {"PWM Limit: 100"});
}

/// The bench's world with a serial port on its robot's bus.
std::string world_with_port(const std::string& port) {
  const std::string model = vsa::test::read_file(std::string(VSA_SOURCE_DIR) + "/models/qbmove_bench_free/model.sdf");
  const std::size_t begin = model.find("<model ");
  std::string robot = model.substr(begin, model.rfind("</model>") + 8 - begin);
  const std::string bus = "cycle_s=\"auto\"/>";
  const std::size_t at = robot.find(bus);
  if (begin == std::string::npos || at == std::string::npos) throw std::runtime_error("the model's text has changed");
  robot.replace(at, bus.size(), "cycle_s=\"auto\"><serial_port>" + port + "</serial_port></bus>");
  return "<sdf version='1.7'><world name='w'><physics name='step' type='ode'><max_step_size>0.001</max_step_size></physics>" +
         robot + "</world></sdf>";
}

TEST(RunWithAPort, AClientMovesTheRobotInTheSimulator) {
  const Scratch scratch;
  const std::string port = (scratch / "arm").string();
  const std::string world = (scratch / "world.sdf").string();
  write_file(world, world_with_port(port));
  Subprocess run({"run", world, "--no-topics", "--realtime"});
  ASSERT_TRUE(run.read_until([](const Result& r) { return r.err.find("vsa ping") != std::string::npos; }));
  expect(run_vsa({"set", port, "equilibrium", "30", "10", "--timeout-ms", "20000"}), 0, {"motor 1 40."});
  double at = 0;
  std::string last;
  for (const auto end = std::chrono::steady_clock::now() + vsa::test::kPatience;
       at < 25 && std::chrono::steady_clock::now() < end;) {
    last = run_vsa({"get", port, "measurements", "--timeout-ms", "20000"}).out;
    std::smatch match;
    if (std::regex_search(last, match, std::regex("shaft ([0-9.-]+)°"))) at = std::stod(match[1]);
  }
  EXPECT_NEAR(at, 30, 5) << last;
  expect(run_vsa({"run", world, "--no-topics", "--duration-s", "0.1"}), 2, {"another program serves"});
  run.send(SIGTERM);
  const Result ended = run.wait();
  expect(ended, 0, {"serial port", port, "exchanges"});
  EXPECT_FALSE(std::filesystem::is_symlink(port));
  EXPECT_EQ((ended.out + ended.err).find("aren't equilibrium"), std::string::npos) << ended.out << ended.err;
  expect(run_vsa({"run", world, "--no-topics", "--duration-s", "0.1", "--type", "bi_stiffness_example"}), 0,
         {"the references of unit", "aren't equilibrium ± preset; use vsa set " + port + " inputs"});
}

/// Opens the port, says half a frame, waits to be killed.
void connect_and_die(const std::string& path) {
  const pid_t client = fork();
  if (client == 0) {
    const int fd = open(path.c_str(), O_RDWR | O_NOCTTY);
    termios settings{};
    bool said = tcgetattr(fd, &settings) == 0 && cfsetspeed(&settings, B2000000) == 0 && tcsetattr(fd, TCSANOW, &settings) == 0;
    said = said && write(fd, "::\x01\x02", 4) == 4;
    _exit(said ? 0 : 1);
  }
  int status = 0;
  waitpid(client, &status, 0);
  EXPECT_EQ(status, 0);
}

/// What the emulation says of itself after a thousand such clients: nothing, or that it was late.
std::string said_after_a_thousand() {
  Emulated units;
  EXPECT_TRUE(units.ready);
  for (int i = 0; i < 1000; ++i) connect_and_die(units.path);
  expect(units.vsa({"get", "active"}), 0, {"off"});
  const Result ended = units.end();
  expect(ended, 0, {"0 of answers that nobody read"});
  return ended.err;
}

TEST(Emulate, AThousandClientsThatDieInMidFrameCostNoStep) {
  // A busy machine can be late by itself, but hardly each time.
  std::string said;
  for (int attempt = 0; attempt < 5; ++attempt) {
    said = said_after_a_thousand();
    if (said.find("can't keep up") == std::string::npos) return;
  }
  ADD_FAILURE() << said;
}

}  // namespace
