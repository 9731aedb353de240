// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "link_shapes.hpp"

#include <optional>
#ifdef VSA_GZ_TRANSPORT
#include <gz/math/Color.hh>
#include <gz/math/Pose3.hh>
#include <gz/math/Vector2.hh>
#else
#include <ignition/math/Color.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector2.hh>
#endif

namespace vsa::plugins {
namespace {

#ifdef VSA_GZ_TRANSPORT
namespace math = gz::math;
#else
namespace math = ignition::math;
#endif
using scene::Shape;
using Kind = Shape::Kind;

scene::Pose pose_of(const math::Pose3d& pose) {
  const auto& p = pose.Pos();
  const auto& q = pose.Rot();
  return {{p.X(), p.Y(), p.Z()}, {q.W(), q.X(), q.Y(), q.Z()}};
}

std::optional<Shape> geometry(const sdf::ElementPtr& e) {
  const auto of = [&](const char* kind) { return e->HasElement(kind) ? e->GetElement(kind) : nullptr; };
  Shape out;
  if (const auto box = of("box")) {
    const auto size = box->Get<math::Vector3d>("size");
    out.kind = Kind::box;
    out.size = {size.X(), size.Y(), size.Z()};
  } else if (const auto sphere = of("sphere")) {
    out.kind = Kind::sphere;
    out.size = {sphere->Get<double>("radius"), 0, 0};
  } else if (const auto cylinder = of("cylinder")) {
    out.kind = Kind::cylinder;
    out.size = {cylinder->Get<double>("radius"), cylinder->Get<double>("length"), 0};
  } else if (const auto capsule = of("capsule")) {
    out.kind = Kind::capsule;
    out.size = {capsule->Get<double>("radius"), capsule->Get<double>("length"), 0};
  } else if (const auto plane = of("plane"); plane && plane->Get<math::Vector3d>("normal") == math::Vector3d::UnitZ) {
    const auto size = plane->Get<math::Vector2d>("size");
    out.kind = Kind::plane;
    out.size = {size.X(), size.Y(), 0};
  } else {
    return std::nullopt;
  }
  return out;
}

void colour(const sdf::ElementPtr& visual, Shape& shape) {
  if (visual->HasElement("material") && visual->GetElement("material")->HasElement("diffuse")) {
    const auto d = visual->GetElement("material")->Get<math::Color>("diffuse");
    shape.rgba = {d.R(), d.G(), d.B(), d.A()};
  }
  if (visual->HasElement("transparency")) shape.rgba[3] *= 1 - visual->Get<float>("transparency");
}

/// A pose that is given in another frame than the link's isn't worked out.
bool is_elsewhere(const sdf::ElementPtr& e) {
  if (!e->HasElement("pose")) return false;
  const sdf::ElementPtr pose = e->GetElement("pose");
  return pose->HasAttribute("relative_to") && !pose->Get<std::string>("relative_to").empty();
}

std::optional<Shape> shape_of(const sdf::ElementPtr& e) {
  std::optional<Shape> out;
  if (e->HasElement("geometry") && !is_elsewhere(e)) out = geometry(e->GetElement("geometry"));
  if (!out) return out;
  if (e->HasElement("pose")) out->pose = pose_of(e->Get<math::Pose3d>("pose"));
  colour(e, *out);
  return out;
}

}  // namespace

std::vector<Shape> link_shapes(const sdf::ElementPtr& link, int& left_out) {
  std::vector<Shape> out;
  const char* kind = link->HasElement("visual") ? "visual" : "collision";
  if (!link->HasElement(kind)) return out;
  for (sdf::ElementPtr e = link->GetElement(kind); e; e = e->GetNextElement(kind)) {
    if (auto shape = shape_of(e)) {
      out.push_back(std::move(*shape));
    } else {
      ++left_out;
    }
  }
  return out;
}

std::vector<std::string> left_out_notice(int left_out) {
  if (left_out == 0) return {};
  return {"of its shapes " + std::to_string(left_out) +
          " aren't shown: only boxes, spheres, cylinders, capsules and level planes with poses in their links are"};
}

}  // namespace vsa::plugins
