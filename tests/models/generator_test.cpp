// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../record/scratch.hpp"
#include "generate/generate.hpp"
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
