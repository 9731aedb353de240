// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sdf/Collision.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <type_traits>
#include <utility>

#include "sdf/read_context.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

constexpr double kTriangleTolerance = 1e-6;  // relative; engines get the nearest inertia that satisfies it

using SdfInertial = std::decay_t<decltype(std::declval<sdf::Link>().Inertial())>;

constexpr double kLight_kg = 1e-5, kLight_kgm2 = 1e-9;  // told, for a gram weighed in tonnes

/// I − excess·v vᵀ with v the axis of the largest principal moment: that moment less `excess`, about the same axes. I, and so v, in
/// the link's frame: libsdformat gives the principal axes in that of <inertial>, which its <pose> may turn.
Mat3 lowered(const Mat3& inertia, const SdfInertial& inertial, double excess) {
  const SdfVec3 p = inertial.MassMatrix().PrincipalMoments();
  const Vec3 largest = p.Z() >= p.X() && p.Z() >= p.Y() ? Vec3(0, 0, 1) : p.Y() >= p.X() ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  const Vec3 v = Quat(inertial.Pose().Rot() * inertial.MassMatrix().PrincipalAxesOffset()) * largest;
  std::array<double, 9> m{};
  for (std::size_t i = 0; i < 9; ++i) m[i] = inertia(i / 3, i % 3) - excess * v[i / 3] * v[i % 3];
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]};
}

void check_inertia(ReadContext& c, const sdf::ElementPtr& element, const SdfInertial& inertial, const std::string& key,
                   Mat3& inertia) {
  const auto& mass = inertial.MassMatrix();
  if (!std::isfinite(mass.Mass()) || mass.Mass() <= 0) {
    c.problem(element, key + "/inertial/mass", fmt::format("{}", mass.Mass()), "isn't a positive mass", "> 0 kg, finite");
  }
  const Vec3 d = mass.DiagonalMoments(), o = mass.OffDiagonalMoments();
  const std::string shown = fmt::format("ixx {} iyy {} izz {} ixy {} ixz {} iyz {}", d.X(), d.Y(), d.Z(), o.X(), o.Y(), o.Z());
  const SdfVec3 p = d.IsFinite() && o.IsFinite() ? mass.PrincipalMoments() : SdfVec3();
  const double low = p.Min(), high = p.Max(), middle = p.X() + p.Y() + p.Z() - low - high;
  if (!(low > 0)) {
    c.problem(element, key + "/inertial/inertia", shown, "isn't positive definite", "principal moments > 0, finite");
  } else if (low + middle < high * (1 - kTriangleTolerance)) {
    const std::string moments = fmt::format("principal moments {:.6g} + {:.6g} < {:.6g}", low, middle, high);
    if (c.impossible_inertia == ImpossibleInertia::lower) {
      inertia = lowered(inertia, inertial, high - low - middle);
      c.notes.add("inertias that no body can have are lowered to the sum of the two smaller principal moments",
                  fmt::format("{} ({})", key, moments));
    } else {
      c.problem(element, key + "/inertial/inertia", shown, "violates the triangle inequality: " + moments,
                "the sum of two principal moments ≥ the third; or ask for the nearest such: vsa run --impossible-inertia lower, "
                "WorldOptions::impossible_inertia");
    }
  }
}

void read_inertia(ReadContext& c, const sdf::Link& link, const std::string& key, Link& out) {
  const auto& inertial = link.Inertial();
  out.mass = inertial.MassMatrix().Mass();
  out.com = inertial.Pose().Pos();
  out.inertia = inertial.Moi();
  if (out.is_static) return;
  if (!child(link.Element(), "inertial")) c.notes.add("links without <inertial> have SDF's defaults, 1 kg and 1 kg·m²", key);
  if (!inertial.Pose().IsFinite()) c.problem(link.Element(), key + "/inertial/pose", "", "isn't finite", "finite numbers");
  check_inertia(c, link.Element(), inertial, key, out.inertia);
  const double least = inertial.MassMatrix().PrincipalMoments().Min();
  if (out.mass > 0 && (out.mass < kLight_kg || (least > 0 && least < kLight_kgm2)))
    c.notes.add(
        fmt::format("links lighter than {} kg or {} kg·m² answer the smallest torque with blow-ups", kLight_kg, kLight_kgm2), key);
}

void read_flags(ReadContext& c, const sdf::Link& link, const std::string& key, Link& out) {
  const sdf::ElementPtr e = link.Element();
  if (const sdf::ElementPtr flag = child(e, "self_collide")) out.self_collide = flag->Get<bool>();
  if (const sdf::ElementPtr flag = child(e, "kinematic"); flag && flag->Get<bool>() && !out.is_static) {
    c.problem(flag, key + "/kinematic", "true", "isn't supported", "false or absent");
  }
  if (const sdf::ElementPtr flag = child(e, "gravity"); flag && !flag->Get<bool>() && !out.is_static) {
    if (!c.engine.weightless_links) c.cannot(flag, key + "/gravity", "false", "links without gravity aren't", "true or absent");
    out.weightless = true;
  }
  const sdf::ElementPtr decay = child(e, "velocity_decay");
  for (const char* name : {"linear", "angular"}) {
    const sdf::ElementPtr d = child(decay, name);
    if (d && d->Get<double>() != 0 && !out.is_static) {
      c.problem(d, key + "/velocity_decay/" + name, d->Get<std::string>(), "isn't supported", "0 or absent");
    }
  }
  if (link.SensorCount() > 0 || child(e, "vsa:sensor")) c.notes.add("sensors are left out", key);
  if (link.ParticleEmitterCount() > 0) c.notes.add("particle emitters are left out", key);
  for (const char* name : {"audio_sink", "audio_source", "battery", "projector"}) {
    if (child(e, name)) c.notes.add("batteries, projectors and audio are left out", key);
  }
}

void read_collision(ReadContext& c, const sdf::Collision& collision, Link& out) {
  Collision shape;
  shape.name = out.name + "/collision[" + collision.Name() + "]";
  shape.pose = c.resolve(collision.SemanticPose(), "", collision.Element(), shape.name);
  shape.surface = read_surface(c, collision.Element(), shape.name);
  const std::optional<Geometry> geometry = read_geometry(c, *collision.Geom(), shape.name, true);
  if (!geometry) return;
  using Kind = Geometry::Kind;
  const bool terrain = geometry->kind == Kind::plane || geometry->kind == Kind::heightmap;
  if (terrain && !out.is_static && !c.engine.moving_terrain) {
    c.problem(collision.Element(), shape.name, geometry->kind == Kind::plane ? "plane" : "heightmap", "can't move",
              "a model with <static>true</static>");
    return;
  }
  shape.geometry = *geometry;
  if (geometry->parts.empty()) {
    out.collisions.push_back(std::move(shape));
    return;
  }
  shape.geometry.parts.clear();
  for (const auto& part : geometry->parts) {
    shape.geometry.mesh = part;
    out.collisions.push_back(shape);
  }
}

}  // namespace

void read_link(ReadContext& c, const sdf::Link& link, const ModelScope& scope) {
  Link out;
  out.name = scoped_name(scope.name, link.Name());
  out.model = scope.top;
  out.is_static = scope.is_static;
  out.self_collide = scope.self_collide;
  out.pose = scope.pose * c.resolve(link.SemanticPose(), "__model__", link.Element(), out.name);
  read_inertia(c, link, out.name, out);
  read_flags(c, link, out.name, out);
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) read_collision(c, *link.CollisionByIndex(i), out);
  c.out.infos.push_back({out.name, out.model, out.mass, out.is_static, read_visuals(c, link, out)});
  c.out.links.push_back(std::move(out));
}

}  // namespace vsa::reader
