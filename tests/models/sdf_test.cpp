// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <ignition/math/Inertial.hh>
#include <sdf/sdf.hh>

#include "generate/description.hpp"
#include "generate/solid.hpp"

namespace vsa::generate {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(VSA_SOURCE_DIR) / "models";

sdf::ParserConfig config() {
  sdf::ParserConfig c;
  c.SetFindCallback([](const std::string& uri) {
    const std::string scheme = "model://";
    return uri.rfind(scheme, 0) == 0 ? (kModels / uri.substr(scheme.size())).string() : uri;
  });
  c.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  c.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  return c;
}

std::vector<fs::path> sdf_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kModels)) {
    if (entry.path().extension() == ".sdf") files.push_back(entry.path());
  }
  return files;
}

sdf::Root loaded(const std::string& model) {
  sdf::Root root;
  EXPECT_TRUE(root.Load((kModels / model / "model.sdf").string(), config()).empty());
  return root;
}

TEST(ModelFiles, PassTheFullValidationWithoutAWarningAsVersionOneSeven) {
  ASSERT_EQ(sdf_files().size(), 33u);
  for (const fs::path& file : sdf_files()) {
    sdf::Root root;
    for (const sdf::Error& error : root.Load(file.string(), config())) ADD_FAILURE() << file << ": " << error.Message();
    EXPECT_EQ(root.Element()->OriginalVersion(), "1.7") << file << ": Gazebo Classic 11 reads up to 1.7";
  }
}

TEST(ModelFiles, HavePositiveMassesAndInertiasThatABodyCanHave) {
  for (const char* name : {"qbmove", "qbmove_bench_free", "qbmove_bench_load", "qbmove_snake"}) {
    const sdf::Root root = loaded(name);
    const sdf::Model& model = *root.Model();
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const auto& inertial = model.LinkByIndex(i)->Inertial();
      EXPECT_GT(inertial.MassMatrix().Mass(), 0) << name;
      EXPECT_TRUE(inertial.MassMatrix().IsPositive()) << name << " " << model.LinkByIndex(i)->Name();
      EXPECT_TRUE(inertial.MassMatrix().IsValid())
          << name << " " << model.LinkByIndex(i)->Name();  // includes the triangle inequality
    }
  }
}

double mass_of(const char* name) {
  const sdf::Root root = loaded(name);
  double mass = 0;
  for (std::uint64_t i = 0; i < root.Model()->LinkCount(); ++i)
    mass += root.Model()->LinkByIndex(i)->Inertial().MassMatrix().Mass();
  return mass;
}

TEST(ModelFiles, WeighWhatTheDescriptionSays) {
  const Description d = read_description(kModels / "robots.toml");
  EXPECT_NEAR(mass_of("qbmove"), d.module.mass_kg, 1e-9);
  EXPECT_NEAR(mass_of("qbmove_bench_load"), d.module.mass_kg + d.bench.load_mass_kg, 1e-9);
  EXPECT_NEAR(mass_of("qbmove_snake"), d.snake.modules * d.module.mass_kg + d.snake.tail_mass_kg, 1e-8);
}

TEST(Snake, HasTwelveShaftsWithOddOnesUprightAndEvenOnesAcross) {
  const sdf::Root root = loaded("qbmove_snake");
  const sdf::Model& snake = *root.Model();
  ASSERT_EQ(snake.JointCount(), 12u);
  ASSERT_EQ(snake.LinkCount(), 13u);
  for (int n = 0; n < 12; ++n) {
    const sdf::Joint* joint = snake.JointByName("joint_" + std::to_string(n));
    ASSERT_NE(joint, nullptr);
    EXPECT_EQ(joint->Type(), sdf::JointType::REVOLUTE);
    EXPECT_EQ(joint->Axis()->Xyz(), n % 2 == 1 ? ignition::math::Vector3d::UnitZ : ignition::math::Vector3d::UnitY);
    EXPECT_EQ(joint->ParentLinkName(), "module_" + std::to_string(n));
    EXPECT_EQ(joint->ChildLinkName(), n == 11 ? "tail" : "module_" + std::to_string(n + 1));
  }
}

TEST(Snake, PutsItsShaftsOnePitchApartMidwayBetweenTheHousings) {
  const Description d = read_description(kModels / "robots.toml");
  const sdf::Root root = loaded("qbmove_snake");
  for (int n = 0; n < 12; ++n) {
    ignition::math::Pose3d pose, parent;
    const sdf::Joint* joint = root.Model()->JointByName("joint_" + std::to_string(n));
    ASSERT_TRUE(joint->SemanticPose().Resolve(pose, "__model__").empty());
    ASSERT_TRUE(root.Model()->LinkByName(joint->ParentLinkName())->SemanticPose().Resolve(parent, "__model__").empty());
    EXPECT_NEAR(parent.X() - pose.X(), d.snake.pitch_m / 2, 1e-12);
    EXPECT_NEAR(pose.X(), (5.5 - n) * d.snake.pitch_m, 1e-9);
  }
}

TEST(Bench, HangsItsLoadStraightDownAtRestAndTurnsAboutAHorizontalAxis) {
  sdf::Root root;
  ASSERT_TRUE(root.Load((kModels / "worlds/bench_load.sdf").string(), config()).empty());
  const sdf::Model* bench = root.WorldByIndex(0)->ModelByName("qbmove_bench_load");
  ASSERT_NE(bench, nullptr);
  const auto rotation = bench->RawPose().Rot();
  const auto axis = rotation * bench->JointByName("shaft")->Axis()->Xyz();
  EXPECT_NEAR(axis.Y(), 1, 1e-9);
  const auto inertial = bench->LinkByName("flange")->Inertial();
  const auto load = rotation * inertial.Pose().Pos();
  EXPECT_NEAR(load.X(), 0, 1e-9);
  EXPECT_NEAR(load.Z() * inertial.MassMatrix().Mass(), -1.0 * 0.15, 1e-9) << "first moment of 1 kg at 0.15 m";
}

TEST(Solid, BoxAndCylinderHaveTheirClosedFormInertia) {
  const Inertial box = solid_box(2, {0.1, 0.2, 0.3}, {});
  EXPECT_DOUBLE_EQ(box.inertia_kgm2[0], 2.0 / 12 * (0.04 + 0.09));
  EXPECT_DOUBLE_EQ(box.inertia_kgm2[2], 2.0 / 12 * (0.01 + 0.04));
  const Inertial disc = solid_cylinder(0.05, 0.03, 0.01, Axis::z, {});
  EXPECT_DOUBLE_EQ(disc.inertia_kgm2[2], 0.5 * 0.05 * 0.03 * 0.03);
  EXPECT_DOUBLE_EQ(disc.inertia_kgm2[0], 0.05 / 12 * (3 * 0.03 * 0.03 + 0.01 * 0.01));
}

TEST(Solid, TwoHalvesOfABoxMakeTheWholeBox) {
  const Inertial whole = solid_box(3, {0.2, 0.3, 0.4}, {0.5, -0.1, 0.2});
  const Inertial joined =
      combine({solid_box(1.5, {0.1, 0.3, 0.4}, {0.45, -0.1, 0.2}), solid_box(1.5, {0.1, 0.3, 0.4}, {0.55, -0.1, 0.2})});
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(joined.inertia_kgm2[i], whole.inertia_kgm2[i], 1e-15);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(joined.center_m[i], whole.center_m[i], 1e-15);
}

TEST(Solid, TwoPointsOffTheAxesHaveAProductOfInertia) {
  const Inertial pair = combine({solid_box(1, {0, 0, 0}, {1, 1, 0}), solid_box(1, {0, 0, 0}, {-1, -1, 0})});
  EXPECT_DOUBLE_EQ(pair.inertia_kgm2[3], -2.0);
  EXPECT_DOUBLE_EQ(pair.inertia_kgm2[2], 4.0);
}

}  // namespace
}  // namespace vsa::generate
