// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/csv.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "record/fake_snake.hpp"
#include "record/scratch.hpp"
#include "vsa/errors.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;

TEST(CsvFiles, WriteTheBytesThatTheirHeadersPromise) {
  const Scratch dir;
  CsvFiles csv(fake::tiny(), dir.path() / "new" / "out");
  csv.write(fake::tiny_at(0));
  csv.write(fake::tiny_at(10'000'000));
  csv.close();
  EXPECT_EQ(slurp(dir.path() / "new/out/arm_actuators.csv"),
            "time_s,actuator,shaft_rad,shaft_speed_rad_per_s,equilibrium_command_rad,equilibrium_rad,preset_command_rad,preset_rad,"
            "deflection_rad,stiffness_Nm_per_rad,torque_Nm,motor_1_rad,motor_2_rad,current_1_A,current_2_A\n"
            "0,elbow,0.1,-2,0.25,0.2,0.611,0.6,-0.1,0.3333333333333333,1e-07,0.8,-0.4,1.5,-1e+22\n"
            "0.01,elbow,0.1,-2,0.25,0.2,0.611,0.6,-0.1,0.3333333333333333,1e-07,0.8,-0.4,1.5,-1e+22\n");
  EXPECT_EQ(slurp(dir.path() / "new/out/links.csv"),
            "time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n"
            "0,arm::lever,0.5,0,-1,1,0,0,0\n"
            "0.01,arm::lever,0.5,0,-1,1,0,0,0\n");
  EXPECT_EQ(
      slurp(dir.path() / "new/out/energy.csv"),
      "time_s,supply_J,copper_J,bridge_J,conversion_J,viscous_J,motor_friction_J,shaft_friction_J,tendon_friction_J,delivered_J,"
      "pending_J,integrator_J,coupling_J,motor_kinetic_J,magnetic_J,elastic_J,bristle_J,shaft_bristle_J,tendon_bristle_J,"
      "stored_at_start_J,supply_moved_J,delivered_moved_J,kinetic_J,"
      "gravitational_J,springs_J\n"
      "0,2,1.5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0.25,-9.81,0.5\n"
      "0.01,2,1.5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0.25,-9.81,0.5\n");
}

TEST(CsvFiles, NameThePresetsUnitAndLeaveAMissingMotorEmpty) {
  const Scratch dir;
  RunInfo info = fake::tiny();
  info.robots[0].actuators[0].preset_unit = "m";
  info.robots[0].actuators[0].motors = 1;
  CsvFiles csv(info, dir.path());
  csv.write(fake::tiny_at(0));
  const std::string text = slurp(dir.path() / "arm_actuators.csv");
  EXPECT_NE(text.find(",preset_command_m,preset_m,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0.8,,1.5,\n"), std::string::npos) << text;
}

TEST(CsvFiles, TellThePresetsUnitLineByLineWhereARobotMixesLaws) {
  const Scratch dir;
  RunInfo info = fake::tiny();
  info.robots[0].actuators.push_back({"wrist", "wrist", "sea_example", "", 1, {}});
  Sample sample = fake::tiny_at(0);
  sample.actuators.push_back(sample.actuators[0]);
  CsvFiles csv(info, dir.path());
  csv.write(sample);
  const std::string text = slurp(dir.path() / "arm_actuators.csv");
  EXPECT_NE(text.find(",preset_command,preset,"), std::string::npos) << text;
  EXPECT_NE(text.find(",preset_unit\n"), std::string::npos) << text;
  EXPECT_NE(text.find(",-1e+22,rad\n"), std::string::npos) << text;
  EXPECT_NE(text.find("wrist,0.1"), std::string::npos) << text;
  EXPECT_NE(text.find(",0.8,,1.5,,\n"), std::string::npos) << text;
}

TEST(CsvFiles, QuoteNamesThatWouldBreakTheTable) {
  const Scratch dir;
  RunInfo info = fake::tiny();
  info.robots[0].actuators[0].name = "a,b";
  info.links[1].name = "say \"hi\"\nthere";
  CsvFiles csv(info, dir.path());
  csv.write(fake::tiny_at(0));
  EXPECT_NE(slurp(dir.path() / "arm_actuators.csv").find("\n0,\"a,b\",0.1"), std::string::npos);
  EXPECT_NE(slurp(dir.path() / "links.csv").find("\n0,\"say \"\"hi\"\"\nthere\",0.5"), std::string::npos);
}

TEST(CsvFiles, GiveEachRobotAFileThatStaysInTheDirectory) {
  const Scratch dir;
  RunInfo info = fake::tiny();
  info.robots[0].model = "../evil";
  info.robots.push_back({"lab::arm", {}});
  info.robots.push_back({"lab/arm", {}});
  const CsvFiles csv(info, dir.path());
  const auto files = csv.files();
  ASSERT_EQ(files.size(), 5u);
  EXPECT_EQ(files[0].filename(), "_._evil_actuators.csv");
  EXPECT_EQ(files[1].filename(), "lab_arm_actuators.csv");
  EXPECT_EQ(files[2].filename(), "lab_arm_2_actuators.csv");
  for (const fs::path& f : files) EXPECT_TRUE(fs::exists(f) && f.parent_path() == dir.path()) << f;
}

TEST(CsvFiles, RefuseAPlaceThatIsAFile) {
  const Scratch dir;
  spew(dir.path() / "out", "mine");
  const std::string message = message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path() / "out"); });
  EXPECT_NE(message.find((dir.path() / "out").string()), std::string::npos) << message;
  EXPECT_NE(message.find("it is a file, not a directory"), std::string::npos) << message;
  EXPECT_EQ(slurp(dir.path() / "out"), "mine");
  const std::string below = message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path() / "out" / "deeper"); });
  EXPECT_NE(below.find("Not a directory"), std::string::npos) << below;
}

TEST(CsvFiles, NameEveryFileThatCantBeOpenedAndWhy) {
  const Scratch dir;
  fs::create_directory(dir.path() / "energy.csv");
  fs::create_symlink(dir.path() / "nowhere" / "links", dir.path() / "links.csv");
  const std::string message = message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path()); });
  EXPECT_NE(message.find("energy.csv: can't open for writing: Is a directory"), std::string::npos) << message;
  EXPECT_NE(message.find("links.csv: can't open for writing: No such file or directory"), std::string::npos) << message;
}

TEST(CsvFiles, StayAsTheyAreWhereOneOfAllCantBeOpened) {
  const Scratch dir;
  CsvFiles earlier(fake::tiny(), dir.path());
  earlier.write(fake::tiny_at(0));
  earlier.close();
  earlier.release();
  const std::string before = slurp(dir.path() / "links.csv");
  fs::create_directory(dir.path() / "run.mcap");
  const std::string message = message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path(), {"run.mcap"}); });
  EXPECT_NE(message.find("run.mcap: can't open for writing: Is a directory"), std::string::npos) << message;
  EXPECT_EQ(slurp(dir.path() / "links.csv"), before);
  fs::remove(dir.path() / "energy.csv");
  fs::create_directory(dir.path() / "energy.csv");
  message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path()); });
  EXPECT_EQ(slurp(dir.path() / "links.csv"), before);
}

TEST(CsvFiles, GiveADirectoryToOneRecordingAtATime) {
  const Scratch dir;
  {
    const CsvFiles first(fake::tiny(), dir.path());
    const std::string message = message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path()); });
    EXPECT_NE(message.find("another run is recording there"), std::string::npos) << message;
  }
  EXPECT_NO_THROW(CsvFiles(fake::tiny(), dir.path()));
}

TEST(CsvFiles, SayAtOnceThatTheDiskIsFull) {
  const Scratch dir;
  fs::create_symlink("/dev/full", dir.path() / "energy.csv");
  const std::string message = message_of<InputError>([&] { CsvFiles(fake::tiny(), dir.path()); });
  EXPECT_NE(message.find((dir.path() / "energy.csv").string() + ": can't write: No space left on device"), std::string::npos)
      << message;
}

TEST(CsvFiles, StopTheRecordWithPathAndReasonAndKeepWholeLinesOnAFullDisk) {
  const Scratch dir;
  CsvFiles csv(fake::tiny(), dir.path());
  int written = 0;
  const std::string message = message_of<RecordError>([&] {
    const FileSizeLimit disk(2001);
    for (; written < 1000; ++written) csv.write(fake::tiny_at(written * 10'000'000LL));
  });
  EXPECT_NE(message.find("arm_actuators.csv: can't write: File too large"), std::string::npos) << message;
  csv.close();
  const std::string text = slurp(dir.path() / "arm_actuators.csv");
  EXPECT_LE(text.size(), 2001u);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), written + 1);
  EXPECT_GT(written, 5);
}

TEST(CsvFiles, KeepWhatWasWrittenWhenTheProgramEndsWithoutClosing) {
  const Scratch dir;
  CsvFiles csv(fake::tiny(), dir.path());
  csv.write(fake::tiny_at(0));
  EXPECT_EQ(slurp(dir.path() / "links.csv"), "time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n0,arm::lever,0.5,0,-1,1,0,0,0\n");
}

}  // namespace
}  // namespace vsa::record
