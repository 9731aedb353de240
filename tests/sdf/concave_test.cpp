// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Collision meshes that aren't convex, by choice, and COLLADA. The mesh is an L, 0.1 m thick; a ball of 2 cm fits into its notch.
#include <algorithm>
#include <cmath>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

const std::filesystem::path kFiles = std::filesystem::path(VSA_SOURCE_DIR) / "tests/sdf/robot_files";

WorldOptions with(Concave concave) {
  WorldOptions options;
  options.concave = concave;
  return options;
}

/// The height of a ball that was dropped over the notch, after a second.
double ball_over_notch(const std::string& mesh_attributes, Concave concave) {
  World w = World::load_string(
      world(
          "<model name='l'><static>true</static><link name='l'><collision name='c'><geometry><mesh " + mesh_attributes + "><uri>" +
          (kFiles / "parts/concave.stl").string() +
          "</uri></mesh></geometry></collision></link></model><model name='ball'><pose>0.13 0.13 0.2 0 0 0</pose><link name='b'>" +
          inertial(0.1, 1e-4) + "<collision name='c'><geometry><sphere><radius>0.02</radius></sphere></geometry></collision>" +
          "</link></model>"),
      with(concave));
  w.run(1);
  return pose_of(w, "ball::b").position[2];
}

TEST(ConcaveMesh, FilledToItsHullItCarriesABallOverTheNotchAndSaysSo) {
  EXPECT_NEAR(ball_over_notch("", Concave::hull), 0.12, 2e-3);
  World w = World::load(kFiles / "mesh_concave.sdf", with(Concave::hull));
  ASSERT_EQ(w.warnings().size(), 1u);
  EXPECT_NE(w.warnings()[0].find("filled to their convex hulls: m::base/collision[c]"), std::string::npos) << w.warnings()[0];
}

TEST(ConcaveMesh, CutIntoConvexPartsItLetsTheBallThroughTheNotch) {
  EXPECT_LT(ball_over_notch("", Concave::decompose), -1);
  World w = World::load(kFiles / "mesh_concave.sdf", with(Concave::decompose));
  ASSERT_EQ(w.warnings().size(), 1u);
  EXPECT_NE(w.warnings()[0].find("m::base/collision[c] into 2 of 1 times its volume"), std::string::npos) << w.warnings()[0];
}

TEST(ConcaveMesh, TheFilesOwnOptimizationCounts) {
  EXPECT_NEAR(ball_over_notch("optimization='convex_hull'", Concave::refuse), 0.12, 2e-3);
  EXPECT_LT(ball_over_notch("optimization='convex_decomposition'", Concave::refuse), -1);
  EXPECT_EQ(World::load(kFiles / "mesh_concave_hull_asked.sdf").links().size(), 1u);
}

TEST(ConcaveMesh, AChoiceThatIsNoneIsRefused) {
  for (const int choice : {-1, 3, 9}) {
    try {
      static_cast<void>(World::load(kFiles / "mesh_stl.sdf", with(static_cast<Concave>(choice))));
      ADD_FAILURE() << choice << " loads";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().key, "concave");
      EXPECT_EQ(error.problems().front().allowed, "refuse, hull, decompose");
    }
  }
}

TEST(Collada, IsReadInMetres) {
  World w = World::load(kFiles / "mesh_dae.sdf");
  EXPECT_TRUE(w.warnings().empty());
  const Shape& shape = w.links().front().visuals.front();
  ASSERT_FALSE(shape.vertices.empty());
  EXPECT_EQ(shape.indices.size(), 36u);
  const auto [low, high] = std::minmax_element(shape.vertices.begin(), shape.vertices.end());
  EXPECT_NEAR(*low, -0.05, 1e-6);
  EXPECT_NEAR(*high, 0.1, 1e-6);
}

TEST(Collada, ThatIsBrokenIsRefused) {
  const TempDir dir("dae");
  const auto file = dir.write("broken.dae", "<COLLADA><library_geometries>");
  const std::string text =
      problems_of(world("<model name='m'><link name='a'>" + inertial(1, 1) + "<collision name='c'><geometry><mesh><uri>" +
                        file.string() + "</uri></mesh></geometry></collision></link></model>"));
  EXPECT_NE(text.find("broken COLLADA"), std::string::npos) << text;
}

}  // namespace
}  // namespace vsa::engine::testing
