// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa doctor in made-up surroundings: programs, libraries, paths, addresses, devices and worlds that are fine, missing or wrong.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "subprocess.hpp"

namespace {

using vsa::test::Result;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::write_file;

namespace fs = std::filesystem;

/// A machine with nothing on it but a shell and ldd: no Gazebo, no port, no variable of a transport.
struct Machine {
  Scratch scratch;
  std::vector<std::pair<std::string, std::string>> environment;

  Machine() {
    for (const char* folder : {"bin", "dev", "run"}) fs::create_directories(scratch / folder);
    set("PATH", (scratch / "bin").string() + ":/usr/bin:/bin");
    set("XDG_RUNTIME_DIR", (scratch / "run").string());
    write_file(scratch / "dev" / "cpu_dma_latency", "");
    for (const char* unset : {"GAZEBO_PLUGIN_PATH", "GAZEBO_MODEL_PATH", "GZ_SIM_SYSTEM_PLUGIN_PATH", "GZ_SIM_RESOURCE_PATH",
                              "IGN_GAZEBO_SYSTEM_PLUGIN_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH", "IGN_PARTITION",
                              "GZ_PARTITION", "IGN_IP", "GZ_IP", "VSA_DATA_DIR", "VSA_ACTUATOR_PATH"})
      set(unset, "");
    set("GZ_CONFIG_PATH", (scratch / "share").string());
    set("IGN_CONFIG_PATH", (scratch / "share").string());
  }
  void set(const std::string& name, const std::string& value) { environment.emplace_back(name, value); }
  void add_program(const std::string& name) const {
    write_file(scratch / "bin" / name, "#!/bin/sh\n");
    fs::permissions(scratch / "bin" / name, fs::perms::owner_all);
  }
  Result doctor(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"doctor", "--devices", (scratch / "dev").string()});
    vsa::test::Surroundings around;
    around.environment = environment;
    return run_vsa(more, around);
  }
};

void expect(const Result& result, int exit_code, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
  for (const auto& part : parts) EXPECT_NE(result.out.find(part), std::string::npos) << "no '" << part << "' in:\n" << result.out;
}

void expect_none(const Result& result, const std::string& part) {
  EXPECT_EQ(result.out.find(part), std::string::npos) << "'" << part << "' in:\n" << result.out;
}

TEST(Doctor, FindsNothingWrongWhereOnlyTheCommandIs) {
  const Result result = Machine().doctor();
  expect(result, 0,
         {"ok: embedded engine: by MuJoCo ", ": Python module: ", ": HDF5 tables: ", ": second search of vsa optimize: ",
          ": vsa-mpi: ", "ok: data directory: ", "ok: actuator types: ", "ok: built-in worlds: ", "ok: partition: ",
          "ok: address: ", "ok: serial port: no ttyUSB", "ok: --low-latency: ", "0 problems"});
  EXPECT_EQ(result.err, "");
  expect_none(result, "\033");
}

TEST(Doctor, ADataDirectoryThatIsNoneIsAProblem) {
  Machine machine;
  machine.set("VSA_DATA_DIR", "/nowhere");
  expect(machine.doctor(), 1, {"problem: data directory: ", "/nowhere", "set VSA_DATA_DIR", "1 problem,"});
}

TEST(Doctor, PagesThatAreMissingAreAProblem) {
  Machine machine;
  const fs::path data = machine.scratch / "data";
  fs::create_directories(data / "web");
  for (const char* folder : {"actuators", "models"}) fs::create_directory_symlink(fs::path(VSA_SOURCE_DIR) / folder, data / folder);
  for (const char* page : {"replay.html", "live.html"}) write_file(data / "web" / page, "");
  machine.set("VSA_DATA_DIR", data.string());
  expect(machine.doctor(), 1, {"problem: pages: no web/report.html in the data directory", "vsa_web", "1 problem,"});
  write_file(data / "web" / "report.html", "");
  expect(machine.doctor(), 0, {"ok: pages: "});
}

TEST(Doctor, ABrokenTypeIsToldByItsName) {
  Machine machine;
  write_file(machine.scratch / "broken.toml", "[preset\n");
  machine.set("VSA_ACTUATOR_PATH", (machine.scratch / "").string());
  expect(machine.doctor(), 1, {"problem: actuator type broken: "});
}

TEST(Doctor, AGazeboWithoutThePluginInIsToldWhatToSource) {
  Machine machine;
  machine.add_program("gzserver");
  machine.set("GAZEBO_PLUGIN_PATH", "/empty/one:/empty/two");
  expect(machine.doctor(), 1,
         {"ok: Gazebo Classic: " + (machine.scratch / "bin" / "gzserver").string(),
          "problem: plug-in for Gazebo Classic: no libvsa-robot.so on GAZEBO_PLUGIN_PATH (/empty/one:/empty/two)",
          "problem: GAZEBO_MODEL_PATH: vsasim's models aren't on it", ". PREFIX/share/vsa/setup.sh"});
}

TEST(Doctor, IgnOrGzWithoutGazeboIsNone) {
  Machine machine;
  machine.add_program("ign");
  machine.add_program("gz");
  expect(machine.doctor(), 0, {"note: Gazebo: neither gzserver, nor gz or ign with gz-sim"});
  fs::create_directories(machine.scratch / "share");
  write_file(machine.scratch / "share" / "sim8.yaml", "");
  expect(machine.doctor(), 1,
         {"ok: gz-sim: ", "sim8.yaml", "problem: plug-in for gz-sim: no libvsa-robot.so on GZ_SIM_SYSTEM_PLUGIN_PATH (unset)",
          "problem: GZ_SIM_RESOURCE_PATH"});
  write_file(machine.scratch / "share" / "gazebo6.yaml", "");
  expect(machine.doctor(), 1, {"ok: gz-sim (Fortress): ", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH"});
}

TEST(Doctor, TheNewestGazeboIsTheNewestByItsNameWhereverItIs) {
  Machine machine;
  machine.add_program("gz");
  const fs::path longer = machine.scratch / "a_much_longer_folder";
  for (const fs::path& folder : {longer, machine.scratch / "s"}) fs::create_directories(folder);
  for (const char* old : {"sim8.yaml", "sim9.yaml"}) write_file(longer / old, "");
  write_file(machine.scratch / "s" / "sim10.yaml", "");
  machine.set("GZ_CONFIG_PATH", longer.string() + ":" + (machine.scratch / "s").string());
  expect(machine.doctor(), 1, {"ok: gz-sim: ", "s/sim10.yaml"});
}

TEST(Doctor, FoldersOfTypesThatAreNoneAreTold) {
  Machine machine;
  machine.set("VSA_ACTUATOR_PATH", (machine.scratch / "").string() + ":/nowhere/types");
  expect(machine.doctor(), 0, {"note: VSA_ACTUATOR_PATH: /nowhere/types is no directory"});
}

TEST(Doctor, ALibraryThatIsNoneOrLacksAnotherOrIsAnotherGazebosIsAProblem) {
  const auto with = [](const std::string& directory, const std::string& program = "") {
    Machine machine;
    if (!program.empty()) machine.add_program(program);
    machine.set("GAZEBO_PLUGIN_PATH", directory);
    return machine.doctor();
  };
  const Scratch scratch;
  write_file(scratch / "libvsa-robot.so", "no library");
  const std::string made = std::string(VSA_BINARY_DIR) + "/tests/doctor/";
  expect(with((scratch / "").string()), 1,
         {"problem: plug-in for Gazebo Classic: ", "can't be loaded", "build the plug-in against"});
  expect(with(made + "lacking"), 1, {"problem: plug-in for Gazebo Classic: ", "lacks libgazebo_physics-absent.so"});
  expect(with(made + "foreign", "gzserver"), 1, {"is another Gazebo's plug-in", "first in GAZEBO_PLUGIN_PATH"});
  const Result without_classic = with(made + "foreign");
  expect(without_classic, 0, {"0 problems"});
  expect_none(without_classic, "plug-in for Gazebo Classic");
  expect(with(made + "undefined"), 1, {"was built for other versions of its libraries: none has vsa_doctor_nowhere"});
  expect(with(made + "whole"), 0, {"ok: plug-in for Gazebo Classic: " + made + "whole/libvsa-robot.so"});
}

TEST(Doctor, ModelPathsAreLookedThrough) {
  Machine machine;
  machine.set("SDF_PATH", std::string(VSA_SOURCE_DIR) + "/models:/nowhere");
  expect(machine.doctor(), 0, {"ok: SDF_PATH: has vsasim's models", "note: SDF_PATH: /nowhere is no directory"});
}

TEST(Doctor, AddressesMustBeThisMachines) {
  const auto with = [](const std::string& ip) {
    Machine machine;
    machine.set("IGN_IP", ip);
    return machine.doctor();
  };
  expect(with("127.0.0.1"), 0, {"ok: IGN_IP: 127.0.0.1: this machine alone"});
  expect(with("localhost"), 1, {"problem: IGN_IP: 'localhost' is no IPv4 address"});
  expect(with("192.0.2.77"), 1, {"problem: IGN_IP: 192.0.2.77 is no address of this machine", "127.0.0.1"});
  Machine two;
  two.set("IGN_IP", "127.0.0.1");
  two.set("GZ_IP", "127.0.0.2");
  expect(two.doctor(), 0, {"note: address: IGN_IP = 127.0.0.1, but GZ_IP = 127.0.0.2"});
}

TEST(Doctor, PartitionsMustBeNamesAndTheSameForBoth) {
  Machine machine;
  machine.set("IGN_PARTITION", "lab");
  machine.set("GZ_PARTITION", "my lab");
  expect(machine.doctor(), 1,
         {"ok: IGN_PARTITION: lab", "problem: GZ_PARTITION: 'my lab' can't be a partition",
          "note: partition: IGN_PARTITION = lab, but GZ_PARTITION = my lab"});
}

TEST(Doctor, PortsThatCannotBeOpenedAreProblemsAndDeadOnesNotes) {
  Machine machine;
  write_file(machine.scratch / "dev" / "ttyUSB0", "");
  fs::create_symlink("/nowhere", machine.scratch / "dev" / "ttyACM0");
  fs::remove(machine.scratch / "dev" / "cpu_dma_latency");
  fs::create_symlink("/dev/pts/99999", machine.scratch / "run" / "vsa-dead");
  fs::create_symlink("/dev/null", machine.scratch / "run" / "vsa-somebody-elses");
  const Result result = machine.doctor();
  expect(result, 1,
         {"ok: serial port: " + (machine.scratch / "dev" / "ttyUSB0").string(), "problem: serial port: ", "ttyACM0",
          "note: virtual port: ", "vsa-dead was left behind", "note: --low-latency: "});
  expect_none(result, "somebody-elses");
}

TEST(Doctor, ADeviceOfAnotherGroupIsToldWithTheGroupToJoin) {
  if (geteuid() == 0) GTEST_SKIP() << "root may open everything";
  Machine machine;
  write_file(machine.scratch / "dev" / "ttyUSB0", "");
  fs::permissions(machine.scratch / "dev" / "ttyUSB0", fs::perms::none);
  expect(machine.doctor(), 1, {"problem: serial port: ", "usermod -aG dialout"});
}

TEST(Doctor, ABuiltInWorldIsFine) {
  expect(Machine().doctor({"snake_flat"}), 0,
         {"ok: world: ", "snake_flat.sdf loads, 0.001 s a step", "ok: robot: qbmove_snake with 12 actuators",
          "ok: gz-sim's physics: "});
}

std::string world(const std::string& inside, const std::string& step = "0.001") {
  return "<sdf version='1.7'><world name='w'><physics name='p' type='ode'><max_step_size>" + step + "</max_step_size></physics>" +
         inside + "</world></sdf>";
}

constexpr const char* kModel = "<include><uri>model://qbmove_bench_free</uri></include>";

TEST(Doctor, AWorldsOwnSystemsNeedPhysicsAmongThem) {
  Machine machine;
  const std::string file = (machine.scratch / "w.sdf").string();
  const std::string other = "<plugin filename='gz-sim-user-commands-system' name='gz::sim::systems::UserCommands'/>";
  write_file(file, world(kModel + other));
  expect(machine.doctor({file}), 0, {"note: gz-sim's physics: not among the world's systems", "gz-sim-physics-system"});
  machine.add_program("gz");
  fs::create_directories(machine.scratch / "share");
  write_file(machine.scratch / "share" / "sim8.yaml", "");
  expect(machine.doctor({file}), 1,
         {"problem: gz-sim's physics: ", "problem: gz-sim: model://qbmove_bench_free isn't on GZ_SIM_RESOURCE_PATH"});
  write_file(file, world(kModel + other + "<plugin filename='gz-sim-physics-system' name='gz::sim::systems::Physics'/>"));
  expect(machine.doctor({file}), 1, {"ok: gz-sim's physics: is among"});
}

TEST(Doctor, AStepInMillisecondsIsAProblem) {
  const Machine machine;
  const std::string file = (machine.scratch / "w.sdf").string();
  write_file(file, world(kModel, "1"));
  expect(machine.doctor({file}), 1, {"problem: time step: <max_step_size> of 1 s", "0.001 is 1 ms"});
}

TEST(Doctor, AWorldWithoutARobotOrThatDoesNotLoadIsAProblem) {
  const Machine machine;
  const std::string file = (machine.scratch / "w.sdf").string();
  write_file(file, world("<model name='m'><link name='l'/></model>"));
  expect(machine.doctor({file}), 1, {"problem: robot: no model has a <plugin name=\"vsa::Robot\">"});
  write_file(file, "<sdf version='1.7'><world name='w'><model></world>");
  expect(machine.doctor({file}), 1, {"problem: world: "});
}

TEST(Doctor, WhatIsWrongWithTheWorldComesFirst) {
  const Machine machine;
  const std::string file = (machine.scratch / "w.sdf").string();
  write_file(file, world(kModel, "1"));
  const std::string out = machine.doctor({file}).out;
  EXPECT_LT(out.find("problem: time step"), out.find("data directory")) << out;
}

TEST(Doctor, ElementsOfOlderPluginsAreWrittenAnew) {
  const Machine machine;
  const std::string file = (machine.scratch / "w.sdf").string();
  write_file(file, world("<model name='m'><link name='l'/>\n<plugin name='c' filename='libsea_plugin.so'><joint>j</joint>"
                         "<spring_k>12</spring_k><pub_state>true</pub_state></plugin></model>"));
  expect(machine.doctor({file}), 1,
         {"problem: older plug-in: line 2: plugin libsea_plugin.so", "<joint>j</joint><type>sea_example</type>",
          "<override key=\"elastic.stiffness_Nm_per_rad\" value=\"12\"/>", "plugin/pub_state true", "joint_state"});
}

/// The program for machines without the embedded engine.
Result doctor_alone(const Machine& machine, const std::vector<std::string>& arguments) {
  vsa::test::Surroundings around;
  around.program = "vsa-doctor";
  around.environment = machine.environment;
  return run_vsa(arguments, around);
}

TEST(DoctorAlone, LooksAtTheSameAndReadsTheElementsOfAWorld) {
  Machine machine;
  machine.set("IGN_IP", "localhost");
  expect(doctor_alone(machine, {}), 1, {"ok: data directory: ", "ok: actuator types: ", "problem: IGN_IP: "});
  machine.set("IGN_IP", "127.0.0.1");
  const std::string model = std::string(VSA_SOURCE_DIR) + "/models/qbmove_snake/model.sdf";
  expect(doctor_alone(machine, {model}), 0, {"ok: robot: " + model + ":", "12 actuators"});
  const std::string file = (machine.scratch / "w.sdf").string();
  write_file(file, world("<model name='m'><plugin name='vsa::Robot'><actuator><joint>j</joint><type>qbmov</type></actuator>"
                         "</plugin></model>"));
  expect(doctor_alone(machine, {file}), 1, {"problem: robot: " + file + ":1", "unknown actuator type"});
}

TEST(DoctorAlone, AStepThatNoRobotTakesIsAProblem) {
  const Machine machine;
  const std::string file = (machine.scratch / "w.sdf").string();
  for (const char* step : {"0", "-0.001", "nan", "inf", "1e-7", "0.02", "fast", ""}) {
    write_file(file, world(kModel, step));
    expect(doctor_alone(machine, {file}), 1, {"problem: time step: <max_step_size> of ", "from 1e-6 to 0.016"});
  }
  for (const char* step : {"1e-6", "0.001", " 0.016 "}) {
    write_file(file, world(kModel, step));
    expect_none(doctor_alone(machine, {file}), "time step");
  }
}

TEST(DoctorAlone, ReadsSdfAndNothingElse) {
  const Machine machine;
  const std::string file = std::string(VSA_SOURCE_DIR) + "/models/worlds/snake_flat.xml";
  const Result r = doctor_alone(machine, {file});
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_EQ(r.out, "");
  EXPECT_NE(r.err.find(file + ": <mujoco>: is no SDF"), std::string::npos) << r.err;
}

TEST(DoctorAlone, RefusesWhatItDoesNotKnow) {
  const Machine machine;
  EXPECT_EQ(doctor_alone(machine, {"--fast"}).exit_code, 2);
  EXPECT_EQ(doctor_alone(machine, {"a", "b"}).exit_code, 2);
  EXPECT_EQ(doctor_alone(machine, {""}).exit_code, 2);
  EXPECT_EQ(doctor_alone(machine, {"atlantis"}).exit_code, 2);
  EXPECT_EQ(doctor_alone(machine, {"--help"}).exit_code, 0);
}

TEST(Doctor, AWorldThatIsNotThereIsBadInput) {
  const Result result = Machine().doctor({"atlantis"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("atlantis"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

}  // namespace
