// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a file may hold is for the engine to say: each of these is refused for an engine that can't and described for one that can.
#include "vsa/description/capabilities.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "engine/worlds.hpp"
#include "vsa/physics/mujoco.hpp"
#include "vsa/physics/physics.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader {
namespace {

using description::Capabilities;
using engine::testing::inertial;
using Geometry = description::Geometry;
using Joint = description::Joint;

const std::filesystem::path kFiles = std::filesystem::path(VSA_SOURCE_DIR) / "tests/sdf/robot_files";

struct Outcome {
  description::World world;
  std::string problems;
  std::vector<std::string> warnings;
};

Outcome read(const SdfSource& source, Capabilities engine, Concave concave = Concave::refuse) {
  engine.engine = "our engine";
  Outcome out;
  SeenFiles seen;
  const Finder finder(SearchPath({}), seen);
  Problems problems;
  out.world = read_sdf(source, {engine, concave}, finder, seen, out.warnings, problems);
  try {
    problems.throw_if_any();
  } catch (const InputError& error) {
    out.problems = error.what();
  }
  return out;
}

/// A ball of 1 kg above nothing: `link` besides its collision, `surface` of that, `more` in the model.
Outcome read_ball(const Capabilities& engine, const std::string& link, const std::string& surface, const std::string& more = "") {
  const std::string text = engine::testing::world("<model name='m'><link name='l'>" + inertial(1, 0.01) + link +
                                                  "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
                                                  "<surface>" +
                                                  surface + "</surface></collision></link>" + more + "</model>");
  return read({{}, text}, engine);
}

const std::shared_ptr<const physics::Engine> kMujoco = physics::mujoco();

const Capabilities& mujoco_can() { return kMujoco->capabilities(); }

/// MuJoCo with one more, or one less.
Capabilities with(const std::function<void(Capabilities&)>& change) {
  Capabilities can = mujoco_can();
  change(can);
  return can;
}

void expect_refused(const Outcome& outcome, const std::string& why) {
  EXPECT_NE(outcome.problems.find(why), std::string::npos) << outcome.problems;
}

TEST(EngineThatCollidesConcaveMeshes, GetsThemAsTheyAre) {
  const SdfSource concave{kFiles / "mesh_concave.sdf", {}};
  expect_refused(read(concave, mujoco_can()), "concave");
  const Outcome taken = read(concave, with([](Capabilities& can) { can.concave_meshes = true; }));
  ASSERT_EQ(taken.problems, "");
  const Geometry& mesh = taken.world.links.back().collisions.at(0).geometry;
  EXPECT_TRUE(mesh.mesh);
  EXPECT_FALSE(mesh.hull);
  EXPECT_TRUE(read(concave, with([](Capabilities& can) { can.concave_meshes = true; }), Concave::hull)
                  .world.links.back()
                  .collisions.at(0)
                  .geometry.hull)
      << "its user's wish counts";
}

TEST(EngineWithoutFollowers, RefusesMimicWithTheJoint) {
  const SdfSource mimic{kFiles / "mimic_1_11.sdf", {}};
  EXPECT_EQ(read(mimic, mujoco_can()).world.couplings.size(), 1u);
  expect_refused(read(mimic, with([](Capabilities& can) { can.followers = false; })),
                 "joints that follow others aren't supported by our engine");
}

TEST(EngineWithFewShapes, NamesThoseThatItHas) {
  const auto boxes = with([](Capabilities& can) { can.shapes = {Geometry::Kind::box, Geometry::Kind::mesh}; });
  expect_refused(read_ball(boxes, "", ""), "m::l/collision[c]/geometry/sphere");
  expect_refused(read_ball(boxes, "", ""), "collisions of this kind aren't supported by our engine (allowed: box, convex mesh)");
  const std::string seen = "<visual name='v'><geometry><sphere><radius>0.1</radius></sphere></geometry></visual>";
  const std::string box = "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>";
  const std::string text =
      engine::testing::world("<model name='m'><link name='l'>" + inertial(1, 1) + seen + box + "</link></model>");
  EXPECT_EQ(read({{}, text}, boxes).problems, "") << "what is only seen doesn't collide";
}

TEST(EngineWithFewJoints, NamesThoseThatItHas) {
  const std::string joint = "<joint name='j' type='ball'><parent>world</parent><child>l</child></joint>";
  EXPECT_EQ(read_ball(mujoco_can(), "", "", joint).problems, "");
  const Outcome refused = read_ball(with([](Capabilities& can) {
                                      can.joints = {Joint::Kind::fixed, Joint::Kind::hinge};
                                    }),
                                    "", "", joint);
  expect_refused(refused, "joint type isn't supported by our engine");
  expect_refused(refused, "fixed, revolute, continuous)");
}

TEST(EngineWhoseFrictionHasDirections, GetsBothCoefficients) {
  const std::string two = "<friction><ode><mu>0.5</mu><mu2>0.2</mu2><fdir1>0 1 0</fdir1></ode></friction>";
  expect_refused(read_ball(with([](Capabilities& can) { can.directional_friction = false; }), "", two),
                 "friction that depends on the direction isn't supported by our engine");
  const Outcome taken = read_ball(mujoco_can(), "", two);
  ASSERT_EQ(taken.problems, "");
  const description::Surface& surface = taken.world.links.at(0).collisions.at(0).surface;
  EXPECT_EQ(surface.mu, 0.5);
  EXPECT_EQ(surface.mu2, 0.2);
  EXPECT_EQ(surface.first.Y(), 1);
}

TEST(EngineWithRestitutionSpringsAndMasks, GetsThem) {
  const std::string surface =
      "<bounce><restitution_coefficient>0.4</restitution_coefficient></bounce>"
      "<contact><collide_bitmask>3</collide_bitmask><ode><kp>1000</kp><kd>7</kd></ode></contact>";
  expect_refused(read_ball(mujoco_can(), "", surface), "restitution_coefficient = 0.4: isn't supported by our engine");
  const auto can = with([](Capabilities& c) { c.restitution = c.contact_springs = true; });
  const Outcome taken = read_ball(can, "", surface);
  ASSERT_EQ(taken.problems, "");
  EXPECT_TRUE(taken.warnings.empty()) << "nothing of the contact is left out";
  const description::Surface& s = taken.world.links.at(0).collisions.at(0).surface;
  EXPECT_EQ(s.restitution, 0.4);
  EXPECT_EQ(s.stiffness, 1000);
  EXPECT_EQ(s.damping, 7);
  EXPECT_EQ(s.mask, 3u);
  expect_refused(read_ball(with([](Capabilities& c) { c.restitution = true, c.collision_masks = false; }), "", surface),
                 "collide_bitmask = 3: isn't supported by our engine");
}

TEST(EngineWithoutFrictionAgainstSpin, RefusesIt) {
  const std::string spin =
      "<friction><torsional><coefficient>1</coefficient><patch_radius>0.01</patch_radius></torsional></friction>";
  EXPECT_EQ(read_ball(mujoco_can(), "", spin).problems, "");
  expect_refused(read_ball(with([](Capabilities& can) { can.spin_friction = false; }), "", spin),
                 "friction against spin isn't supported");
}

TEST(EngineWithLinksWithoutWeight, GetsThem) {
  expect_refused(read_ball(with([](Capabilities& can) { can.weightless_links = false; }), "<gravity>false</gravity>", ""),
                 "links without gravity aren't supported by our engine");
  const Outcome taken = read_ball(mujoco_can(), "<gravity>false</gravity>", "");
  EXPECT_TRUE(taken.world.links.at(0).weightless) << taken.problems;
}

TEST(EngineWithLoops, GetsTheJointsThatCloseThem) {
  const SdfSource loop{kFiles / "loop.sdf", {}};
  expect_refused(read(loop, with([](Capabilities& can) { can.loops = false; })), "m::j2: closes a kinematic loop");
  const Outcome taken = read(loop, mujoco_can());
  ASSERT_EQ(taken.problems, "");
  std::string closing, held;
  for (const Joint& j : taken.world.joints) {
    closing += j.closes ? j.name : "";
    for (const std::string& what : j.held) held += j.name + ": " + what + "; ";
  }
  EXPECT_EQ(closing, "m::j2");
  EXPECT_EQ(held, "m::j1: the loop that m::j2 closes; m::j3: the loop that m::j2 closes; ");
}

TEST(EngineWithSoftStops, GetsTheirStiffness) {
  const std::string joint =
      "<joint name='j' type='revolute'><parent>world</parent><child>l</child><axis><xyz>0 0 1</xyz><limit><lower>-1</lower>"
      "<upper>1</upper><stiffness>50</stiffness><dissipation>2</dissipation></limit></axis></joint>";
  EXPECT_EQ(read_ball(mujoco_can(), "", "", joint).warnings.size(), 1u) << "told that the engine has its own";
  const Outcome taken = read_ball(with([](Capabilities& can) { can.stop_springs = true; }), "", "", joint);
  EXPECT_TRUE(taken.warnings.empty());
  EXPECT_EQ(taken.world.joints.at(0).axes.at(0).stop_stiffness, 50) << taken.problems;
  EXPECT_EQ(taken.world.joints.at(0).axes.at(0).stop_damping, 2);
}

TEST(EngineWithMovingTerrain, GetsPlanesOnLinksThatMove) {
  const SdfSource plane{kFiles / "plane_moving.sdf", {}};
  expect_refused(read(plane, mujoco_can()), "can't move");
  EXPECT_EQ(read(plane, with([](Capabilities& can) { can.moving_terrain = true; })).problems, "");
}

/// MuJoCo that says it can't couple joints.
class Uncoupled final : public physics::Engine {
 public:
  Uncoupled() { can_.followers = false; }
  const Capabilities& capabilities() const override { return can_; }
  std::shared_ptr<const physics::CompiledWorld> compile(const std::shared_ptr<const description::World>& world, double step_s,
                                                        std::string_view file, Problems& problems) const override {
    return mujoco_->compile(world, step_s, file, problems);
  }

 private:
  std::shared_ptr<const physics::Engine> mujoco_ = physics::mujoco();
  Capabilities can_ = mujoco_->capabilities();
};

TEST(WorldWithAnEngineOfItsUsers, IsReadForThatEngineAndNotForTheLastOne) {
  EXPECT_NO_THROW(static_cast<void>(engine::World::load(kFiles / "mimic_1_11.sdf")));
  engine::WorldOptions options;
  options.physics = std::make_shared<Uncoupled>();
  EXPECT_THROW(static_cast<void>(engine::World::load(kFiles / "mimic_1_11.sdf", options)), InputError);
  engine::World spring = engine::World::load(kFiles / "spring.sdf", options);
  spring.run(0.01);
  EXPECT_NEAR(spring.time_s(), 0.01, 1e-12);
}

TEST(Finder, TellsADirectoryOnceThatSeveralVariablesName) {
  SeenFiles seen;
  const Finder finder(SearchPath({"/nowhere/models", "/nowhere/models"}), seen);
  const std::string told = finder.searched("model://arm/arm.stl", "/");
  EXPECT_NE(told.find("/nowhere/models"), std::string::npos) << told;
  EXPECT_EQ(told.find("/nowhere/models"), told.rfind("/nowhere/models")) << told;
}

}  // namespace
}  // namespace vsa::reader
