// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/mjcf.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "physics/mujoco/rigid.hpp"

namespace vsa::physics {
namespace {

using Back = std::back_insert_iterator<std::string>;

constexpr std::size_t kBodiesDeep = 64;  // in each other, in one file; Debian's tinyxml2 takes some 100 elements
constexpr double kHeightmapBase = 0.1;   // m of ground below the lowest point

std::string text(const Vec3& v) { return fmt::format("{} {} {}", v.X(), v.Y(), v.Z()); }
std::string place(const Pose3& p) {
  const auto& q = p.Rot();
  return fmt::format("pos=\"{}\" quat=\"{} {} {} {}\"", text(p.Pos()), q.W(), q.X(), q.Y(), q.Z());
}

/// MuJoCo's own of a shape: the larger one where there are two (directed_friction.hpp).
double mu_of(const description::Surface& s) { return std::max(s.mu, s.mu2.value_or(0)); }

std::vector<std::array<double, 2>> surfaces(const description::World& world) {
  std::vector<std::array<double, 2>> out;
  for (const Link& l : world.links)
    for (const Collision& c : l.collisions) out.push_back({mu_of(c.surface), c.surface.torsional_m});
  return out;
}

class Writer {
 public:
  /// file: NAME of NAME.xml; empty: in memory.
  Writer(const description::World& world, const std::vector<TreeNode>& tree, std::string file)
      : world_(world),
        tree_(tree),
        file_(std::move(file)),
        names_{world, !file_.empty()},
        children_(world.links.size()),
        kinds_(surfaces(world)) {
    for (std::size_t i = 0; i < tree.size(); ++i)
      (tree[i].parent && !tree[i].free ? children_[*tree[i].parent] : roots_).push_back(i);
  }

  Mjcf write(double step_s, Capacity capacity) {
    std::string bodies;
    for (const std::size_t i : roots_) body(tree_[i], 1, bodies);
    fmt::format_to(out(), "<mujoco model=\"{}\">\n<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n",
                   file_.empty() ? "vsa" : escaped(world_.name));
    fmt::format_to(out(), "<size njmax=\"{}\" nconmax=\"{}\"/>\n", capacity.rows, capacity.contacts);
    fmt::format_to(out(), "<option timestep=\"{}\" gravity=\"{}\" integrator=\"Euler\" cone=\"elliptic\" solver=\"Newton\">",
                   step_s, text(world_.gravity));
    result_.xml += "<flag filterparent=\"disable\"/></option>\n<default><geom solref=\"0.004 1\"/>";
    result_.xml +=
        "<joint armature=\"0\" solreflimit=\"0.004 1\" solimplimit=\"0.9999 0.9999 0.001\" solreffriction=\"0.004 "
        "1\"/></default>\n";
    result_.xml += "<asset>\n" + assets_ + "</asset>\n<worldbody>\n" + ground_ + bodies + "</worldbody>\n<contact>\n";
    excludes();
    result_.xml += "</contact>\n<equality>\n";
    for (const Coupling& k : world_.couplings) {
      fmt::format_to(out(), "<joint joint1=\"{}\" joint2=\"{}\" polycoef=\"{} {} {} {} {}\" solref=\"0.004 1\"/>\n",
                     escaped(names_.joint(k.follower)), escaped(names_.joint(k.leader)), k.offset, k.multiplier, k.higher[0],
                     k.higher[1], k.higher[2]);
    }
    for (const Joint& j : world_.joints)
      if (j.closes) closure(j);
    result_.xml += "</equality>\n</mujoco>\n";
    return std::move(result_);
  }

 private:
  Back out() { return std::back_inserter(result_.xml); }
  [[nodiscard]] std::string prefix() const { return file_.empty() ? "" : file_ + "."; }

  /// Far out on a chain bodies go into a file of their own.
  void child(const TreeNode& node, std::size_t depth, std::string& to) {
    if (depth % kBodiesDeep != 0) return body(node, depth + 1, to);
    const std::size_t index = result_.parts.size();
    result_.parts.push_back({fmt::format("{}part{}.xml", prefix(), index), ""});
    std::string text = "<mujoco>\n";
    body(node, depth + 1, text);
    result_.parts[index].bytes = text + "</mujoco>\n";
    to += fmt::format("<include file=\"{}\"/>\n", escaped(result_.parts[index].name));
  }

  void body(const TreeNode& node, std::size_t depth, std::string& to) {
    const Link& link = world_.links[node.link];
    const Pose3 pose = node.parent ? world_.links[*node.parent].pose.Inverse() * link.pose : link.pose;
    to += fmt::format("<body name=\"{}\" {}>\n", escaped(names_.body(node.link)), place(pose));
    inertial(link, to);
    if (node.free) to += fmt::format("<freejoint name=\"{}\"/>\n", escaped(names_.free_joint(node.link)));
    if (node.joint) joint(node, to);
    for (std::size_t k = 0; k < link.collisions.size(); ++k) {
      const Collision& c = link.collisions[k];
      if (endless(c)) {
        geom(c, names_.geom(node.link, k), link.pose, ground_);
        continue;
      }
      const bool apart = parts(node.link) > 1;
      if (apart) to += fmt::format("<body name=\"{}\">\n", escaped(part_name(node.link, k)));
      geom(c, names_.geom(node.link, k), Pose3(), to);
      if (apart) to += "</body>\n";
    }
    for (const std::size_t i : children_[node.link]) child(tree_[i], depth, to);
    to += "</body>\n";
  }

  /// In principal axes; the largest moment is lowered to what the triangle inequality allows where rounding went past it.
  static void inertial(const Link& link, std::string& to) {
    if (link.is_static) return;
    double moments[3], axes[9], quat[4], matrix[9];
    for (std::size_t i = 0; i < 9; ++i) matrix[i] = link.inertia(i / 3, i % 3);
    mju_eig3(moments, axes, quat, matrix);
    moments[0] = std::min(moments[0], moments[1] + moments[2]);
    to += fmt::format("<inertial pos=\"{}\" quat=\"{} {} {} {}\" mass=\"{}\" diaginertia=\"{} {} {}\"/>\n", text(link.com), quat[0],
                      quat[1], quat[2], quat[3], link.mass, moments[0], moments[1], moments[2]);
  }

  void joint(const TreeNode& node, std::string& to) const {
    const Joint& joint = world_.joints[*node.joint];
    if (joint.kind == Joint::Kind::fixed) return;
    const Pose3 to_body = world_.links[node.link].pose.Inverse();
    const std::string anchor = text((to_body * joint.pose).Pos());
    if (joint.kind == Joint::Kind::ball) {
      to += fmt::format("<joint name=\"{}\" type=\"ball\" pos=\"{}\"/>\n", escaped(names_.joint(*node.joint)), anchor);
      return;
    }
    const std::size_t n = joint.axes.size();
    for (std::size_t k = 0; k < n; ++k) {
      // Seen from the other side a joint turns the other way about the same line, its axes in the other order.
      const std::size_t i = node.reversed ? n - 1 - k : k;
      const Axis& axis = joint.axes[i];
      const Vec3 direction = to_body.Rot() * (node.reversed ? -axis.xyz : axis.xyz);
      to += fmt::format("<joint name=\"{}\" type=\"{}\" pos=\"{}\" axis=\"{}\" damping=\"{}\" frictionloss=\"{}\"",
                        escaped(names_.joint(*node.joint, i)), joint.kind == Joint::Kind::slide ? "slide" : "hinge", anchor,
                        text(direction), axis.damping, axis.friction);
      if (axis.stiffness > 0) to += fmt::format(" stiffness=\"{}\" springref=\"{}\"", axis.stiffness, axis.rest);
      if (axis.range) to += fmt::format(" limited=\"true\" range=\"{} {}\"", (*axis.range)[0], (*axis.range)[1]);
      to += "/>\n";
    }
  }

  [[nodiscard]] bool moves(std::optional<std::size_t> link) const { return link && !world_.links[*link].is_static; }

  /// One point holds a ball, two of its axis a hinge: as far apart as the masses that hang on it rigidly, or turning would be soft.
  void closure(const Joint& j) {
    const bool by_child = moves(j.child);
    const std::size_t one = by_child ? *j.child : *j.parent;
    const std::optional<std::size_t> other = by_child ? j.parent : j.child;
    std::string bodies = fmt::format("body1=\"{}\"", escaped(names_.body(one)));
    if (moves(other)) bodies += fmt::format(" body2=\"{}\"", escaped(names_.body(*other)));
    const Vec3 at = j.pose.Pos();
    const auto connect = [&](const Vec3& point) {
      fmt::format_to(out(), "<connect {} anchor=\"{}\" solref=\"0.002 1\"/>\n", bodies,
                     text((world_.links[one].pose.Inverse() * Pose3(point, {})).Pos()));
    };
    if (j.kind == Joint::Kind::fixed) {
      fmt::format_to(out(), "<weld {} solref=\"0.002 1\"/>\n", bodies);
    } else if (j.kind == Joint::Kind::ball) {
      connect(at);
    } else {
      const Vec3 apart = j.axes[0].xyz * std::max(rigid_.reach(j.child, at), rigid_.reach(j.parent, at));
      connect(at + apart);
      connect(at - apart);
    }
  }

  std::string shape(const Geometry& g) {
    const Vec3& s = g.size;
    switch (g.kind) {
      case Geometry::Kind::box:
        return fmt::format("type=\"box\" size=\"{}\"", text(s * 0.5));
      case Geometry::Kind::sphere:
        return fmt::format("type=\"sphere\" size=\"{}\"", s.X());
      case Geometry::Kind::cylinder:
        return fmt::format("type=\"cylinder\" size=\"{} {}\"", s.X(), s.Y() / 2);
      case Geometry::Kind::capsule:
        return fmt::format("type=\"capsule\" size=\"{} {}\"", s.X(), s.Y() / 2);
      case Geometry::Kind::ellipsoid:
        return fmt::format("type=\"ellipsoid\" size=\"{}\"", text(s));
      case Geometry::Kind::plane:
        return "type=\"plane\" size=\"0 0 1\"";  // infinite, as in SDF
      case Geometry::Kind::mesh:
        return fmt::format("type=\"mesh\" mesh=\"m{}\"", add_mesh(*g.mesh));
      case Geometry::Kind::heightmap:
        return fmt::format("type=\"hfield\" hfield=\"h{}\"", add_heightmap(g.heightmap));
    }
    return {};
  }

  std::size_t add_mesh(const Mesh& mesh) {
    assets_ += fmt::format("<mesh name=\"m{}\" vertex=\"", meshes_);
    for (const Vec3& v : mesh.vertices) assets_ += text(v) + " ";
    assets_ += "\"/>\n";
    return meshes_++;
  }

  std::size_t add_heightmap(const std::shared_ptr<const Heightmap>& map) {
    const std::size_t index = result_.heightmaps.size();
    const std::string data = file_.empty() ? fmt::format("nrow=\"{}\" ncol=\"{}\"", map->rows, map->columns)
                                           : fmt::format("file=\"{}\"", escaped(fmt::format("{}h{}.bin", prefix(), index)));
    assets_ += fmt::format("<hfield name=\"h{}\" {} size=\"{} {} {} {}\"/>\n", index, data, map->extent_x / 2, map->extent_y / 2,
                           heightmap_scale(*map), kHeightmapBase);
    result_.heightmaps.push_back(map);
    return index;
  }

  void geom(const Collision& c, const std::string& name, const Pose3& at, std::string& to) {
    Pose3 pose = at * c.pose * c.geometry.offset;
    if (c.geometry.heightmap) pose = pose * Pose3(c.geometry.heightmap->centre, description::Quat());
    const ContactKind kind = kinds_.of(mu_of(c.surface), c.surface.torsional_m);
    to += fmt::format(
        "<geom name=\"{}\" {} {} friction=\"{} {} 0\" condim=\"{}\" priority=\"{}\" contype=\"{}\" conaffinity=\"{}\"/>\n",
        escaped(name), shape(c.geometry), place(pose), mu_of(c.surface), c.surface.torsional_m, kind.condim, kind.priority,
        c.surface.mask, c.surface.mask);
  }

  // MuJoCo 2.2.2's broad phase
  //   - pairs a body that has a plane or heightmap with everything, and once more where boxes overlap: contacts come out twice.
  //     Only the world's own body is spared, so these shapes go there;
  //   - sorts bodies, not shapes: the shapes of a static link get a body each, and a field of blocks costs what lies near.
  static bool endless(const Collision& c) {
    return c.geometry.kind == Geometry::Kind::plane || c.geometry.kind == Geometry::Kind::heightmap;
  }
  [[nodiscard]] std::size_t parts(std::size_t link) const {
    return world_.links[link].is_static ? std::max<std::size_t>(1, world_.links[link].collisions.size()) : 1;
  }
  [[nodiscard]] std::string part_name(std::size_t link, std::size_t k) const {
    const Link& l = world_.links[link];
    if (k < l.collisions.size() && endless(l.collisions[k])) return "world";
    return parts(link) > 1 ? names_.part(link, k) : names_.body(link);
  }

  void excludes() {
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const Joint& j : world_.joints) {
      if (j.parent && j.child) pairs.insert(std::minmax(*j.parent, *j.child));
    }
    const std::vector<Link>& links = world_.links;
    for (std::size_t a = 0; a < links.size(); ++a) {
      if (links[a].is_static || links[a].self_collide || links[a].collisions.empty()) continue;
      for (std::size_t b = a + 1; b < links.size(); ++b) {
        // What stands still holds up what moves, whichever of them the file has first.
        if (!links[b].is_static && links[b].model == links[a].model && !links[b].self_collide && !links[b].collisions.empty())
          pairs.insert({a, b});
      }
    }
    std::set<std::string> lines;
    for (const auto& [a, b] : pairs) {
      for (std::size_t i = 0; i < parts(a); ++i) {
        for (std::size_t k = 0; k < parts(b); ++k) {
          lines.insert(fmt::format("<exclude body1=\"{}\" body2=\"{}\"/>\n", escaped(part_name(a, i)), escaped(part_name(b, k))));
        }
      }
    }
    for (const std::string& line : lines) result_.xml += line;
  }

  const description::World& world_;
  const std::vector<TreeNode>& tree_;
  std::string file_;
  MjcfNames names_;
  RigidGroups rigid_{world_};
  std::vector<std::vector<std::size_t>> children_;  // of a link, into tree_
  std::vector<std::size_t> roots_;
  ContactKinds kinds_;
  std::string assets_;
  std::string ground_;
  std::size_t meshes_ = 0;
  Mjcf result_;
};

}  // namespace

ContactKinds::ContactKinds(std::vector<std::array<double, 2>> mu_and_torsional) : classes_(std::move(mu_and_torsional)) {
  std::sort(classes_.begin(), classes_.end());
  classes_.erase(std::unique(classes_.begin(), classes_.end()), classes_.end());
}

ContactKind ContactKinds::of(double mu, double torsional_m) const {
  const auto at = std::lower_bound(classes_.begin(), classes_.end(), std::array{mu, torsional_m});
  return {mu < kSmallestMu ? 1 : torsional_m > 0 ? 4 : 3, static_cast<int>(classes_.end() - at)};
}

std::vector<FrictionDirection> directions_of(const description::World& world) {
  std::vector<FrictionDirection> out;
  for (std::size_t l = 0; l < world.links.size(); ++l) {
    const Link& link = world.links[l];
    for (std::size_t k = 0; k < link.collisions.size(); ++k) {
      const Collision& c = link.collisions[k];
      if (!c.surface.mu2) continue;
      FrictionDirection d{l, k, l, {}, c.surface.mu, *c.surface.mu2};
      Vec3 along = c.surface.first;
      if (c.surface.first_of) {
        d.of = c.surface.first_of;
      } else {
        along = c.pose.Rot() * along;
        if (link.is_static) {  // a plane is the world's own
          d.of.reset();
          along = link.pose.Rot() * along;
        }
      }
      const double most = std::max({std::abs(along.X()), std::abs(along.Y()), std::abs(along.Z())});
      along = (along / most).Normalized();  // of any length, without overflow
      d.along = {along.X(), along.Y(), along.Z()};
      out.push_back(d);
    }
  }
  return out;
}

double heightmap_scale(const Heightmap& map) { return std::max(map.highest(), 1e-6); }

namespace {

/// Of constraints that are there at every moment, or may be: loops, mimics, dry friction, limits.
int standing_rows(const description::World& world) {
  auto rows = static_cast<int>(world.couplings.size());
  for (const Joint& j : world.joints) {
    if (j.closes) {
      rows += j.kind == Joint::Kind::ball ? 3 : 6;
      continue;
    }
    for (const Axis& axis : j.axes) rows += (axis.friction > 0 ? 1 : 0) + (axis.range ? 1 : 0);
  }
  return rows;
}

}  // namespace

Capacity capacity_for(const description::World& world) {
  constexpr int kSpareRows = 50;
  int moving = 0;
  for (const Link& l : world.links) moving += l.is_static ? 0 : static_cast<int>(l.collisions.size());
  const int contacts = 16 + 2 * std::min(moving, 100);
  return {contacts, 3 * contacts + std::max(100, standing_rows(world) + kSpareRows)};
}

Mjcf write_mjcf(const description::World& world, const std::vector<TreeNode>& tree, double step_s, Capacity capacity) {
  return Writer(world, tree, {}).write(step_s, capacity);
}

Mjcf write_mjcf_file(const description::World& world, const std::vector<TreeNode>& tree, double step_s, Capacity capacity,
                     const std::string& name) {
  return Writer(world, tree, name).write(step_s, capacity);
}

}  // namespace vsa::physics
