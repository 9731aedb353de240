// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <sdf/Collision.hh>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <utility>

#include "sdf/read_context.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

void read_inertia(ReadContext& c, const sdf::Link& link, const std::string& key, Link& out) {
  const auto& inertial = link.Inertial();
  out.mass = inertial.MassMatrix().Mass();
  out.com = inertial.Pose().Pos();
  out.inertia = inertial.Moi();
  if (out.is_static) return;
  if (!child(link.Element(), "inertial")) c.notes.add("links without <inertial> have SDF's defaults, 1 kg and 1 kg·m²", key);
  const Vec3 d = inertial.MassMatrix().DiagonalMoments(), o = inertial.MassMatrix().OffDiagonalMoments();
  check_inertia(c, c.file_of(link.Element()), key,
                fmt::format("ixx {} iyy {} izz {} ixy {} ixz {} iyz {}", d.X(), d.Y(), d.Z(), o.X(), o.Y(), o.Z()), out);
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
  if (geometry) take_collision(c, c.file_of(collision.Element()), std::move(shape), *geometry, out);
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
