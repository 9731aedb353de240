// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../record/scratch.hpp"
#include "generate/generate.hpp"
#include "generate/gripper.hpp"
#include "generate/png.hpp"
#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::generate {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(VSA_SOURCE_DIR) / "models";

Files generated() { return generate(read_description(kModels / "robots.toml")); }

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string problems_of(const std::string& from, const std::string& to) {
  std::string text = content(kModels / "robots.toml");
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const record::Scratch scratch;
  const fs::path file = scratch.path() / "vsa_generate_description.toml";
  std::ofstream(file) << text;
  try {
    (void)read_description(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Generator, WritesExactlyTheCommittedFiles) {
  for (const auto& [name, expected] : generated()) {
    ASSERT_TRUE(fs::exists(kModels / name)) << name << " isn't committed: run vsa-generate models/robots.toml models";
    EXPECT_TRUE(content(kModels / name) == expected) << name << " differs: run vsa-generate models/robots.toml models";
  }
}

TEST(Generator, WritesExactlyTheCommittedBridges) {
  const fs::path ros2 = fs::path(VSA_SOURCE_DIR) / "ros2";
  const Files files = bridges(generated());
  EXPECT_TRUE(files.contains("config/qbmove_snake/bridge.yaml"));
  for (const auto& [name, expected] : files)
    EXPECT_TRUE(content(ros2 / name) == expected) << name << " differs: run vsa-generate models/robots.toml models ros2";
  for (const auto& entry : fs::recursive_directory_iterator(ros2 / "config")) {
    const std::string name = fs::relative(entry.path(), ros2).generic_string();
    EXPECT_TRUE(!entry.is_regular_file() || files.contains(name)) << name << " isn't generated";
  }
}

TEST(Generator, NothingElseLiesAmongTheModels) {
  const Files files = generated();
  for (const auto& entry : fs::recursive_directory_iterator(kModels)) {
    const std::string name = fs::relative(entry.path(), kModels).generic_string();
    if (!entry.is_regular_file() || name == "robots.toml" || name.rfind("gaits/", 0) == 0 || name.rfind("stand_ins/", 0) == 0)
      continue;
    const std::string stem = name.substr(0, name.find('.'));  // of vsa export --mjcf: tests/mjcf compares them
    if (name != stem + ".sdf" && files.contains(stem + ".sdf") && name.rfind("worlds/", 0) == 0) continue;
    EXPECT_TRUE(files.contains(name)) << name << " is neither generated nor a source";
  }
}

TEST(Generator, GivesTheSameBytesTwice) { EXPECT_TRUE(generated() == generated()); }

TEST(Generator, NamesAMissingKey) { EXPECT_NE(problems_of("edge_m = 0.066", "").find("module.edge_m"), std::string::npos); }

TEST(Generator, NamesAnUnknownKey) {
  EXPECT_NE(problems_of("edge_m = 0.066", "edge_m = 0.066\nweight = 1").find("module.weight: unknown key"), std::string::npos);
}

TEST(Generator, RefusesNotANumber) {
  EXPECT_NE(problems_of("friction = 0.8", "friction = nan").find("module.friction"), std::string::npos);
}

TEST(Generator, RefusesANegativeMassAndABadSampleCountTogether) {
  const std::string text = problems_of("mass_kg = 0.45\n", "mass_kg = -1\n");
  EXPECT_NE(text.find("module.mass_kg = -1: out of range"), std::string::npos) << text;
  EXPECT_NE(problems_of("samples = 257", "samples = 256").find("hills.samples"), std::string::npos);
}

TEST(Generator, RefusesRangesThatGoBackwardsAndHillsThatBeginAtOnce) {
  EXPECT_NE(problems_of("flat_radius_m = [0.7, 2.5]", "flat_radius_m = [2.5, 2.5]").find("hills.flat_radius_m = [2.5, 2.5]"),
            std::string::npos);
  EXPECT_NE(problems_of("side_m = [0.040, 0.140]", "side_m = [0.140, 0.040]").find("rubble.side_m = [0.14, 0.04]"),
            std::string::npos);
  EXPECT_EQ(problems_of("side_m = [0.040, 0.140]", "side_m = [0.140, 0.140]"), "");
  EXPECT_EQ(problems_of("step_size_m = [0.50, 8.00]", "step_size_m = [8.00, 0.50]"), "") << "along and across, no range";
}

TEST(Generator, RefusesPartsWithoutRoomByTheirKeys) {
  const auto told = [](const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
    const std::string text = problems_of(from, to);
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " isn't in: " << text;
  };
  told("edge_m = 0.066", "edge_m = 0.1",
       {"manipulator.shoulder_m = 0.095: no room", "module.edge_m = 0.1", "frank.head_tilt_m = 0.09"});
  told("forearm_m = 0.140", "forearm_m = 0.05", {"manipulator.forearm_m = 0.05: no room for the tube", "module.edge_m / 2"});
  told("chamfer_m = 0.011", "chamfer_m = 0.1", {"module.edge_m / 2 = 0.033: no room", "more than chamfer_m = 0.1"});
  told("travel_m = 0.015", "travel_m = 0.05", {"gripper.opening_m = 0.04: no room", "bench_object.travel_m + 0.008 = 0.058"});
  told("opening_m = 0.040", "opening_m = 0.005", {"gripper.opening_m / 2 = 0.0025: no room for the moving finger"});
  told("pad_size_m = [0.006,", "pad_size_m = [0.036,", {"gripper.pad_size_m[1] = 0.024: no room"});
}

TEST(Generator, RefusesTypesThatArentThereControlCharactersAndSeedsWithAFraction) {
  const std::string text = problems_of("type = \"qbmove_maker_pro_6_1\"", "type = \"no such type\"");
  EXPECT_NE(text.find("actuator.type = no such type: no such actuator type"), std::string::npos) << text;
  EXPECT_NE(text.find("qbmove_maker_pro_6_1"), std::string::npos) << text;
  EXPECT_NE(problems_of("bus = \"spine\"", "bus = \"sp\\u0001ine\"").find("snake.bus: has a control character"), std::string::npos);
  EXPECT_NE(problems_of("seed = 20150928", "seed = 20150928.7").find("rubble.seed"), std::string::npos);
  EXPECT_NE(problems_of("baud_Hz = 2000000", "baud_Hz = 2000000.5").find("actuator.baud_Hz"), std::string::npos);
}

TEST(Generator, ThePalmsFingerIsWideAlongTheGrippersAxisAsItIsDrawn) {
  Description d = read_description(kModels / "robots.toml");
  const Inertial as_it_is = palm(d, -1, 0);
  d.gripper.pad_size_m[1] = 0.1;
  const Inertial wider = palm(d, -1, 0);
  const double more = d.gripper.finger_mass_kg / 12 * (0.1 * 0.1 - 0.024 * 0.024);
  EXPECT_NEAR(wider.inertia_kgm2[0], as_it_is.inertia_kgm2[0], 1e-15) << "about the axis itself, x";
  EXPECT_NEAR(wider.inertia_kgm2[1], as_it_is.inertia_kgm2[1] + more, 1e-15);
  EXPECT_NEAR(wider.inertia_kgm2[2], as_it_is.inertia_kgm2[2] + more, 1e-15);
}

TEST(Generator, PutsASnakeWithLargeContactsOnTheGround) {
  Description d = read_description(kModels / "robots.toml");
  d.module.contact_radius_m = 0.05;
  const std::string world = generate(d).at("worlds/snake_flat.sdf");
  EXPECT_NE(world.find("<pose>0 0 0.1005 0 0 0</pose>"), std::string::npos) << "twice the radius, and the clearance";
}

TEST(Generator, RefusesBrokenToml) { EXPECT_NE(problems_of("[bench]", "[bench").find("description.toml:"), std::string::npos); }

TEST(Hills, AreNoSteeperThanTheSnakeCanClimb) {
  const Hills h = hills(read_description(kModels / "robots.toml").hills);
  EXPECT_LE(h.steepest_rad, 25 * kPi / 180);
  EXPECT_GE(h.steepest_rad, 12 * kPi / 180) << "hardly hills";
}

TEST(Hills, UseTheWholeRangeOfGreyAndStartLevel) {
  const HillsSpec spec = read_description(kModels / "robots.toml").hills;
  const Hills h = hills(spec);
  const auto [low, high] = std::minmax_element(h.pixels.begin(), h.pixels.end());
  EXPECT_EQ(*low, 0);
  EXPECT_EQ(*high, 255);
  const auto middle = static_cast<std::size_t>(spec.samples / 2);
  const double center = h.pixels[middle * static_cast<std::size_t>(spec.samples) + middle] / 255.0 * h.height_m;
  EXPECT_NEAR(center, h.start_m, h.height_m / 255);
}

TEST(Rubble, IsOfOneToFourCentimetresInTheWayOfTravel) {
  const RubbleSpec spec = read_description(kModels / "robots.toml").rubble;
  const auto blocks = rubble(spec);
  EXPECT_EQ(blocks.size(), 25u + spec.steps_m.size());
  for (const Block& b : blocks) {
    EXPECT_GE(b.height, 0.0099);
    EXPECT_LE(b.height, 0.0401);
    const double along = b.x * std::cos(spec.travel_deg * kPi / 180) + b.y * std::sin(spec.travel_deg * kPi / 180);
    EXPECT_GT(along, 0.5);
  }
}

TEST(Png, HasTheBytesThatTheStandardAsksFor) {
  // A single black pixel, worked out by hand; the CRCs and the Adler sum are those that zlib gives.
  const std::string expected(
      "\x89PNG\r\n\x1a\n"
      "\0\0\0\x0dIHDR\0\0\0\x01\0\0\0\x01\x08\0\0\0\0\x3a\x7e\x9b\x55"
      "\0\0\0\x0dIDAT\x78\x01\x01\x02\0\xfd\xff\0\0\0\x02\0\x01"
      "\x7e\x05\x0d\xd2"
      "\0\0\0\0IEND\xae\x42\x60\x82",
      8 + 25 + 25 + 12);
  EXPECT_EQ(grey_png(1, 1, {0}), expected);
}

}  // namespace
}  // namespace vsa::generate
