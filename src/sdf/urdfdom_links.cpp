// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links of a URDF. What a fixed joint joins is one body:
//   m = Σ mᵢ   c = Σ mᵢ cᵢ / m   I = Σ Rᵢ Iᵢ Rᵢᵀ + mᵢ (|dᵢ|²·1 − dᵢ dᵢᵀ) with dᵢ = cᵢ − c
// all in the frame of the link at its top, cᵢ, Rᵢ: the part's <inertial> there.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sdf/shapes.hpp"
#include "sdf/surface_rules.hpp"
#include "sdf/urdfdom_reading.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

Mat3 turned(const urdf::Inertial& i, const Quat& q) {
  const Mat3 own(i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz);
  const std::array<Vec3, 3> axes{q * Vec3(1, 0, 0), q * Vec3(0, 1, 0), q * Vec3(0, 0, 1)};  // the columns of R
  Mat3 out;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t s = 0; s < 3; ++s)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) out(r, s) += axes[k][r] * own(k, l) * axes[l][s];
  return out;
}

void add_point(Mat3& inertia, double mass, const Vec3& d) {
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t s = 0; s < 3; ++s) inertia(r, s) += mass * ((r == s ? d.Dot(d) : 0.0) - d[r] * d[s]);
}

void read_inertia(const UrdfLump& lump, Link& out) {
  out.mass = 0;
  Vec3 moment;
  for (const UrdfPart& part : lump.parts) {
    if (!part.link->inertial) continue;
    out.mass += part.link->inertial->mass;
    moment += (part.at * pose_of(part.link->inertial->origin)).Pos() * part.link->inertial->mass;
  }
  if (out.mass != 0) out.com = moment / out.mass;
  out.inertia = Mat3();
  for (const UrdfPart& part : lump.parts) {
    if (!part.link->inertial) continue;
    const Pose3 at = part.at * pose_of(part.link->inertial->origin);
    const Mat3 own = turned(*part.link->inertial, at.Rot());
    for (std::size_t i = 0; i < 9; ++i) out.inertia(i / 3, i % 3) += own(i / 3, i % 3);
    add_point(out.inertia, part.link->inertial->mass, at.Pos() - out.com);
  }
}

/// As libsdformat calls them: "a_collision", "a_collision_1", and "a_fixed_joint_lump__b_collision_2" of a part b.
std::string shape_name(const std::string& top, const std::string& part, const std::string& own, const char* kind, std::size_t index,
                       bool lumped) {
  std::string name = (!own.empty() ? own : lumped ? part : top) + "_" + kind;
  if (index > 0) name += fmt::format("_{}", index);
  return name.compare(0, top.size(), top) == 0 ? name : top + "_fixed_joint_lump__" + name;
}

std::optional<Geometry> read_shape(UrdfReading& r, const urdf::Geometry* geometry, const std::string& key, bool collides) {
  ShapeReading s{r, r.file, key, collides};
  if (geometry == nullptr) return s.refuse("", "", "holds no shape", "box, cylinder, sphere, mesh");
  using Kind = Geometry::Kind;
  switch (geometry->type) {
    case urdf::Geometry::BOX: {
      const auto& box = static_cast<const urdf::Box&>(*geometry);
      return s.sized(Kind::box, {box.dim.x, box.dim.y, box.dim.z}, 3, "box/size");
    }
    case urdf::Geometry::SPHERE:
      return s.sized(Kind::sphere, {static_cast<const urdf::Sphere&>(*geometry).radius, 0, 0}, 1, "sphere/radius");
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(*geometry);
      return s.sized(Kind::cylinder, {cylinder.radius, cylinder.length, 0}, 2, "cylinder");
    }
    case urdf::Geometry::MESH: {
      const auto& mesh = static_cast<const urdf::Mesh&>(*geometry);
      const std::filesystem::path found = r.finder.find(mesh.filename, r.base);
      if (found.empty()) return s.refuse("mesh/uri", mesh.filename, "file not found", r.finder.searched(mesh.filename, r.base));
      return s.mesh(found, mesh.filename, {mesh.scale.x, mesh.scale.y, mesh.scale.z}, r.concave);
    }
    default:  // of urdfdom's versions to come
      return s.refuse("", "", "this kind of geometry isn't supported", collidable(r.engine));
  }
}

void read_collisions(UrdfReading& r, const UrdfLump& lump, Link& out) {
  std::size_t index = 0;
  const std::string& top = lump.parts.front().link->name;
  for (const UrdfPart& part : lump.parts) {
    if (part.link->collision_array.empty()) continue;
    const auto gazebo = gazebo_collision(r, part.link->name);
    for (const auto& collision : part.link->collision_array) {
      Collision shape;
      const bool lumped = &part != &lump.parts.front();
      shape.name = out.name + "/collision[" + shape_name(top, part.link->name, collision->name, "collision", index++, lumped) + "]";
      shape.pose = part.at * pose_of(collision->origin);
      shape.surface = SurfaceRules<UrdfReading>(r).read(gazebo->RootElement(), shape.name);
      const auto geometry = read_shape(r, collision->geometry.get(), shape.name, true);
      if (!geometry) continue;
      if (!r.engine.takes(geometry->kind)) {
        r.engine_cannot(r.file, shape.name + "/geometry/" + name_of(geometry->kind), "", "collisions of this kind aren't",
                        collidable(r.engine));
        continue;
      }
      take_collision(r, r.file, std::move(shape), *geometry, out);
    }
  }
}

/// Gazebo's colour of a URDF's, a little brighter.
void colour(const urdf::Material* material, scene::Shape& shape) {
  if (material == nullptr) return;
  const auto bright = [](float x) { return static_cast<float>(std::clamp(static_cast<double>(x) / 0.8, 0.0, 1.0)); };
  shape.rgba = {bright(material->color.r), bright(material->color.g), bright(material->color.b), material->color.a};
}

std::vector<scene::Shape> read_visuals(UrdfReading& r, const UrdfLump& lump, const Link& described) {
  std::vector<scene::Shape> out;
  std::size_t index = 0;
  const std::string& top = lump.parts.front().link->name;
  for (const UrdfPart& part : lump.parts) {
    for (const auto& visual : part.link->visual_array) {
      const bool lumped = &part != &lump.parts.front();
      const std::string key =
          described.name + "/visual[" + shape_name(top, part.link->name, visual->name, "visual", index++, lumped) + "]";
      const auto geometry = read_shape(r, visual->geometry.get(), key, false);
      if (!geometry) continue;
      out.push_back(to_shape(*geometry, part.at * pose_of(visual->origin)));
      colour(visual->material.get(), out.back());
    }
  }
  if (!out.empty()) return out;
  for (const Collision& collision : described.collisions) out.push_back(to_shape(collision.geometry, collision.pose));
  return out;
}

void read_flags(UrdfReading& r, const tinyxml2::XMLElement* e, Link& out) {
  if (const auto* flag = r.child(e, "self_collide")) out.self_collide = r.flag(flag);
  if (out.is_static) return;
  if (const auto* flag = r.child(e, "kinematic"); flag != nullptr && r.flag(flag))
    r.problem(flag, out.name + "/kinematic", "true", "isn't supported", "false or absent");
  if (const auto* flag = r.child(e, "gravity"); flag != nullptr && !r.flag(flag)) {
    if (!r.engine.weightless_links)
      r.cannot(flag, out.name + "/gravity", "false", "links without gravity aren't", "true or absent");
    out.weightless = true;
  }
  const auto* decay = r.child(e, "velocity_decay");
  for (const char* name : {"linear", "angular"})
    if (r.number(decay, name, 0, -kInfinite, kInfinite, out.name + "/velocity_decay") != 0)
      r.problem(decay, out.name + "/velocity_decay/" + name, r.text(r.child(decay, name)), "isn't supported", "0 or absent");
}

struct Visit {
  urdf::LinkConstSharedPtr link;
  std::optional<std::size_t> lump;  ///< of the link above
  Pose3 at;                         ///< of the link above in its lump; without one in the world
};

}  // namespace

std::vector<UrdfLump> lump_links(UrdfReading& r, const urdf::ModelInterface& model, const Pose3& at) {
  std::vector<UrdfLump> out;
  std::set<std::string> seen;
  std::vector<Visit> open{{model.getRoot(), {}, at}};
  while (!open.empty()) {
    const Visit v = open.back();
    open.pop_back();
    if (!seen.insert(v.link->name).second) continue;  // a child of several joints, which mend_urdf refuses
    const UrdfJoint* above = r.urdf.joint_above(v.link->name);
    const Pose3 pose = v.link->parent_joint ? v.at * pose_of(v.link->parent_joint->parent_to_joint_origin_transform) : v.at;
    Visit here{nullptr, v.lump, pose};
    if (!v.link->parent_joint && v.link->name == "world") {
      // The ground: what hangs on it hangs on the world.
    } else if (above != nullptr && above->lumped && v.lump) {
      out[*v.lump].parts.push_back({v.link, pose});
    } else {
      out.push_back({{{v.link, {}}}, v.lump, v.lump ? out[*v.lump].pose * pose : pose});
      here = {nullptr, out.size() - 1, {}};
    }
    for (auto child = v.link->child_links.rbegin(); child != v.link->child_links.rend(); ++child) {
      here.link = *child;
      open.push_back(here);
    }
  }
  for (const std::string& link : r.urdf.links)
    if (!seen.contains(link))
      r.problems.add({r.file, "link[" + link + "]", "", "hangs on no joints that lead to the root", "a tree of links"});
  return out;
}

void read_urdf_link(UrdfReading& r, const UrdfLump& lump, const ModelScope& scope) {
  Link out;
  out.name = scoped_name(scope.name, lump.parts.front().link->name);
  out.model = scope.top;
  out.is_static = scope.is_static;
  out.self_collide = scope.self_collide;
  out.pose = lump.pose;
  read_inertia(lump, out);
  const Mat3& i = out.inertia;
  if (!out.is_static)
    check_inertia(r, r.file, out.name,
                  fmt::format("ixx {} iyy {} izz {} ixy {} ixz {} iyz {}", i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)),
                  out);
  const auto gazebo = gazebo_link(r, lump);
  read_flags(r, gazebo->RootElement(), out);
  read_collisions(r, lump, out);
  r.out.infos.push_back({out.name, out.model, out.mass, out.is_static, read_visuals(r, lump, out)});
  r.out.links.push_back(std::move(out));
}

}  // namespace vsa::reader
