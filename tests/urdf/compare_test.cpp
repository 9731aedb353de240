// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Of every URDF here both readers say the same: libsdformat's, by way of an SDF, and urdfdom's alone. In a build without libsdformat
// there is nothing to compare.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "urdf/outcome.hpp"
#include "vsa/files.hpp"
#include "vsa/sdf/feature.hpp"

namespace vsa::reader::testing {
namespace {

namespace fs = std::filesystem;
using description::Axis;
using description::Collision;
using description::Joint;
using description::Link;
using description::Pose3;
using description::Vec3;
using description::World;

constexpr double kSame = 1e-9;  // relative: to the larger of the two, or of the numbers that belong together

/// What differs, by place.
class Differences {
 public:
  void number(const std::string& what, double a, double b, double scale = 0) {
    if (std::abs(a - b) > kSame * std::max({std::abs(a), std::abs(b), scale})) say(what, a, b);
  }
  void vector(const std::string& what, const Vec3& a, const Vec3& b, double scale = 0) {
    for (std::size_t i = 0; i < 3; ++i) number(what, a[i], b[i], std::max(a.Length(), scale));
  }
  void pose(const std::string& what, const Pose3& a, const Pose3& b) {
    vector(what + " position", a.Pos(), b.Pos(), 1);
    const auto off = (a.Inverse() * b).Rot();
    // What libsdformat writes as three angles: near a right pitch these hold half of a double's digits.
    constexpr double kAngles = 1e-7;
    if (Vec3(off.X(), off.Y(), off.Z()).Length() > kAngles) say(what + " rotation", 0, Vec3(off.X(), off.Y(), off.Z()).Length());
  }
  template <class T>
  void equal(const std::string& what, const T& a, const T& b) {
    if (!(a == b)) texts_ += what + " differs\n";
  }
  [[nodiscard]] const std::string& texts() const { return texts_; }

 private:
  void say(const std::string& what, double a, double b) {
    texts_ +=
        what + ": " + std::to_string(a) + " and " + std::to_string(b) + ", " + std::to_string((b - a) / kSame) + "e-9 apart\n";
  }
  std::string texts_;
};

void compare(Differences& d, const Collision& a, const Collision& b) {
  d.equal(a.name, a.name, b.name);
  d.pose(a.name, a.pose, b.pose);
  d.equal(a.name + " kind", a.geometry.kind, b.geometry.kind);
  d.equal(a.name + " hull", a.geometry.hull, b.geometry.hull);
  d.vector(a.name + " size", a.geometry.size, b.geometry.size);
  d.equal(a.name + " mesh", a.geometry.mesh != nullptr, b.geometry.mesh != nullptr);
  if (a.geometry.mesh && b.geometry.mesh) {
    d.equal(a.name + " triangles", a.geometry.mesh->triangles, b.geometry.mesh->triangles);
    d.equal(a.name + " vertices", a.geometry.mesh->vertices.size(), b.geometry.mesh->vertices.size());
    for (std::size_t i = 0; i < std::min(a.geometry.mesh->vertices.size(), b.geometry.mesh->vertices.size()); ++i)
      d.vector(a.name + " vertex", a.geometry.mesh->vertices[i], b.geometry.mesh->vertices[i]);
  }
  d.number(a.name + " mu", a.surface.mu, b.surface.mu);
  d.number(a.name + " mu2", a.surface.mu2.value_or(-1), b.surface.mu2.value_or(-1));
  d.vector(a.name + " fdir1", a.surface.first, b.surface.first);
  d.number(a.name + " torsional", a.surface.torsional_m, b.surface.torsional_m);
  d.number(a.name + " restitution", a.surface.restitution, b.surface.restitution);
  d.equal(a.name + " stiffness", a.surface.stiffness, b.surface.stiffness);
  d.equal(a.name + " damping", a.surface.damping, b.surface.damping);
  d.equal(a.name + " mask", a.surface.mask, b.surface.mask);
}

void compare(Differences& d, const Link& a, const Link& b) {
  d.equal(a.name, std::tie(a.name, a.model, a.is_static, a.self_collide, a.weightless),
          std::tie(b.name, b.model, b.is_static, b.self_collide, b.weightless));
  d.pose(a.name, a.pose, b.pose);
  d.number(a.name + " mass", a.mass, b.mass);
  d.vector(a.name + " centre", a.com, b.com, 0.01);
  const double size = std::max({a.inertia(0, 0), a.inertia(1, 1), a.inertia(2, 2)});
  for (std::size_t i = 0; i < 9; ++i) d.number(a.name + " inertia", a.inertia(i / 3, i % 3), b.inertia(i / 3, i % 3), size);
  d.equal(a.name + " collisions", a.collisions.size(), b.collisions.size());
  for (std::size_t i = 0; i < std::min(a.collisions.size(), b.collisions.size()); ++i) compare(d, a.collisions[i], b.collisions[i]);
}

void compare(Differences& d, const std::string& joint, const Axis& a, const Axis& b) {
  d.vector(joint + " axis", a.xyz, b.xyz, 1);
  d.equal(joint + " limited", a.range.has_value(), b.range.has_value());
  for (std::size_t i = 0; i < 2; ++i)
    if (a.range && b.range) d.number(joint + " limit", (*a.range)[i], (*b.range)[i]);
  d.number(joint + " damping", a.damping, b.damping);
  d.number(joint + " friction", a.friction, b.friction);
  d.number(joint + " stiffness", a.stiffness, b.stiffness);
  d.number(joint + " rest", a.rest, b.rest);
  d.number(joint + " start", a.start.value_or(0), b.start.value_or(0));
}

void compare(Differences& d, const Joint& a, const Joint& b) {
  d.equal(a.name, std::tie(a.name, a.kind, a.parent, a.child, a.closes, a.held, a.pulled),
          std::tie(b.name, b.kind, b.parent, b.child, b.closes, b.held, b.pulled));
  d.pose(a.name, a.pose, b.pose);
  d.equal(a.name + " axes", a.axes.size(), b.axes.size());
  for (std::size_t i = 0; i < std::min(a.axes.size(), b.axes.size()); ++i) compare(d, a.name, a.axes[i], b.axes[i]);
}

void compare_looks(Differences& d, const scene::LinkInfo& a, const scene::LinkInfo& b) {
  d.equal(a.name + " info", std::tie(a.name, a.model, a.is_static), std::tie(b.name, b.model, b.is_static));
  d.equal(a.name + " visuals", a.visuals.size(), b.visuals.size());
  for (std::size_t i = 0; i < std::min(a.visuals.size(), b.visuals.size()); ++i) {
    const scene::Shape &x = a.visuals[i], &y = b.visuals[i];
    d.equal(a.name + " visual", std::tie(x.kind, x.indices), std::tie(y.kind, y.indices));
    d.equal(a.name + " vertices", x.vertices.size(), y.vertices.size());
    for (std::size_t k = 0; k < 3; ++k) d.number(a.name + " visual size", x.size[k], y.size[k]);
    for (std::size_t k = 0; k < 3; ++k) d.number(a.name + " visual position", x.pose.position[k], y.pose.position[k], 1);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(x.rgba[k], y.rgba[k], 1e-6) << a.name;
  }
}

std::string differences(const World& a, const World& b) {
  Differences d;
  d.equal("world", a.name, b.name);
  d.vector("gravity", a.gravity, b.gravity);
  d.equal("links", a.links.size(), b.links.size());
  for (std::size_t i = 0; i < std::min(a.links.size(), b.links.size()); ++i) compare(d, a.links[i], b.links[i]);
  d.equal("joints", a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < std::min(a.joints.size(), b.joints.size()); ++i) compare(d, a.joints[i], b.joints[i]);
  d.equal("couplings", a.couplings.size(), b.couplings.size());
  for (std::size_t i = 0; i < std::min(a.couplings.size(), b.couplings.size()); ++i) {
    const auto &x = a.couplings[i], &y = b.couplings[i];
    d.equal("coupling", std::tie(x.follower, x.leader), std::tie(y.follower, y.leader));
    d.number("multiplier", x.multiplier, y.multiplier);
    d.number("offset", x.offset, y.offset);
  }
  d.equal("plugins", a.plugins.size(), b.plugins.size());
  for (std::size_t i = 0; i < std::min(a.plugins.size(), b.plugins.size()); ++i)
    d.equal("plugin", std::tie(a.plugins[i].model, a.plugins[i].top_model), std::tie(b.plugins[i].model, b.plugins[i].top_model));
  d.equal("infos", a.infos.size(), b.infos.size());
  for (std::size_t i = 0; i < std::min(a.infos.size(), b.infos.size()); ++i) compare_looks(d, a.infos[i], b.infos[i]);
  return d.texts();
}

/// What one of the two has to say and the other not: of a <gazebo> that libsdformat alone reads, and of several values of one thing.
std::multiset<std::string> physical(const std::vector<std::string>& warnings) {
  std::multiset<std::string> out;
  for (const std::string& w : warnings) {
    if (w.starts_with("multiple inconsistent <mu>") || w.starts_with("of several <mu> for one link") ||
        w.starts_with("what a <gazebo> says of a link's looks"))
      continue;
    out.insert(w);
  }
  return out;
}

/// Robots that libsdformat takes with more than a URDF has: in it a <gazebo> may hold SDF of any kind.
const std::set<std::string> kSdfInIt{"gazebo_robot_link"};

void expect_same(const std::string& name, const SdfSource& source, bool lenient = false) {
  const auto concave = lenient ? Concave::hull : Concave::refuse;
  const auto impossible = lenient ? ImpossibleInertia::lower : ImpossibleInertia::refuse;
  const Outcome sdf = ordinarily(source, concave, impossible), plain = plainly(source, concave, impossible);
  if (kSdfInIt.contains(name)) {
    EXPECT_EQ(sdf.problems, "") << name;
    EXPECT_NE(plain.problems.find("isn't known of a URDF's <gazebo> to a build without libsdformat"), std::string::npos) << name;
    return;
  }
  EXPECT_EQ(sdf.problems.empty(), plain.problems.empty())
      << name << "\nby libsdformat: " << sdf.problems << "\nby urdfdom:     " << plain.problems;
  if (!sdf.problems.empty() || !plain.problems.empty()) return;
  EXPECT_EQ(differences(sdf.world, plain.world), "") << name;
  EXPECT_EQ(physical(sdf.warnings), physical(plain.warnings)) << name;
}

std::vector<fs::path> urdfs_below(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".urdf") out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

class BothReaders : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!sdf_feature().is_in()) GTEST_SKIP() << sdf_feature().missing();
  }
};

TEST_F(BothReaders, MakeTheSameOfEveryFileOfTheRepository) {
  std::size_t count = 0;
  for (const char* folder : {"tests", "examples", "models", "docs"}) {
    for (const fs::path& file : urdfs_below(fs::path(VSA_SOURCE_DIR) / folder)) {
      expect_same(file.filename().string(), {file, {}});
      ++count;
    }
  }
  EXPECT_GE(count, 50u);
}

TEST_F(BothReaders, MakeTheSameOfTheManualsRobot) {
  const std::string page = read_file(fs::path(VSA_SOURCE_DIR) / "docs/howto/your-robot.md").value_or("");
  const std::size_t begin = page.find("<robot name=\"my_arm\">"), end = page.find("</robot>", begin);
  ASSERT_NE(end, std::string::npos);
  const std::string text = page.substr(begin, end + 8 - begin);
  expect_same("my_arm", {{}, text});
  EXPECT_EQ(plainly({{}, text}).world.plugins.size(), 1u);
}

TEST_F(BothReaders, MakeTheSameOfEveryRobotOfTheTable) {
  for (const auto& [name, text] : robots()) {
    expect_same(name, {{}, text});
    if (name == "impossible" || name == "mesh_concave") expect_same(name, {{}, text}, true);
  }
}

/// What the joints and links of a world do in a second.
std::vector<double> motion(const World& world) {
  constexpr double kStep_s = 1e-3;
  Problems problems;
  const auto compiled = physics::mujoco()->compile(std::make_shared<const World>(world), kStep_s, "robot", problems);
  problems.throw_if_any();
  const auto run = compiled->start();
  for (std::size_t j = 0; j < world.joints.size(); ++j)
    if (world.joints[j].one_axis()) run->set_joint(j, {world.joints[j].axes[0].start.value_or(0), 0.1});
  std::vector<double> out;
  std::vector<scene::Pose> poses(world.links.size());
  for (int i = 0; i < 1000; ++i) {
    run->prepare();
    EXPECT_FALSE(run->advance());
    run->poses(poses);
    for (const scene::Pose& p : poses) out.insert(out.end(), p.position.begin(), p.position.end());
    for (std::size_t j = 0; j < world.joints.size(); ++j)
      if (world.joints[j].one_axis()) out.push_back(run->joint(j).position);
  }
  return out;
}

TEST_F(BothReaders, LetRobotsMoveTheSameWay) {
  const auto all = robots();
  for (const char* name : {"moving_arm", "moving_mimic", "falling_box", "rotated_chain", "lump_order", "massless_between", "gimbal",
                           "gazebo_gravity_off", "gazebo_joint_spring", "dynamics", "moving_from_world", "mimic_chain"}) {
    const std::vector<double> a = motion(ordinarily({{}, all.at(name)}).world), b = motion(plainly({{}, all.at(name)}).world);
    ASSERT_EQ(a.size(), b.size()) << name;
    double worst = 0, moved = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      worst = std::max(worst, std::abs(a[i] - b[i]));
      moved = std::max(moved, std::abs(a[i] - a[i % (a.size() / 1000)]));
    }
    EXPECT_LT(worst, 1e-6) << name;
    EXPECT_GT(moved, 0.01) << name << " stands still";
  }
}

}  // namespace
}  // namespace vsa::reader::testing
