// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <surface>: libsdformat 12's Surface has no friction, so the element tree is read.
//   friction/ode/mu, mu2, fdir1       two that differ: if the engine's friction has directions; without fdir1, or both ≥ 10, the smaller
//   friction/bullet/friction, friction2, fdir1   where there is no ode
//   friction/torsional/coefficient    spin torque = (3π/16)·patch_radius·coefficient·N, ODE's formula
//   bounce/restitution_coefficient, contact/ode/kp, kd (bullet/kp, kd)   if the engine has them
//   contact/collide_bitmask
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sdf/read_context.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

constexpr const char* kFriction = "/surface/friction";
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNeverSlips = 10;  // in a pair the smaller coefficient counts: of two beyond this neither does
constexpr double kMuMax = 1e6;      // SDF files write 1e5 and more for "never slips"

/// One coefficient from two, or two with their direction where the engine's friction has them.
void read_friction(ReadContext& c, const sdf::ElementPtr& e, const char* first, const char* second, const std::string& key,
                   Surface& out) {
  const double mu = c.number(e, first, 1.0, 0.0, kInfinite, key);
  const double mu2 = c.number(e, second, mu, 0.0, kInfinite, key);
  out.mu = std::min(mu, kMuMax);
  if (mu2 == mu) return;
  const sdf::ElementPtr direction = child(e, "fdir1");
  const Vec3 along = direction ? Vec3(direction->Get<SdfVec3>()) : Vec3::Zero;
  if (!along.IsFinite())
    return c.problem(direction, key + "/fdir1", direction->Get<std::string>(), "isn't finite", "finite numbers");
  if (std::min(mu, mu2) >= kNeverSlips) {
    c.notes.add("of two coefficients of friction that both never slip the smaller is taken", key);
    out.mu = std::min({mu, mu2, kMuMax});
  } else if (along == Vec3::Zero) {
    c.notes.add("of two coefficients of friction without <fdir1> the smaller is taken", key);
    out.mu = std::min({mu, mu2, kMuMax});
  } else if (c.engine.directional_friction) {
    out.mu2 = std::min(mu2, kMuMax);
    out.first = along;
    for (const char* name : {"gz:expressed_in", "ignition:expressed_in"})
      if (const auto frame = direction->GetAttribute(name))
        c.direction_frames.push_back({key.substr(0, key.rfind(kFriction)), frame->GetAsString(), direction});
  } else {
    c.cannot(e, key + "/" + second, fmt::format("{}", mu2), "friction that depends on the direction isn't",
             fmt::format("the value of {}, {}", first, mu));
  }
}

void refuse_nonzero(ReadContext& c, const sdf::ElementPtr& e, const char* name, const std::string& key) {
  if (c.number(e, name, 0.0, 0.0, kInfinite, key) != 0.0) {
    c.problem(e, key + "/" + name, child(e, name)->Get<std::string>(), "isn't supported", "0 or absent");
  }
}

double torsional(ReadContext& c, const sdf::ElementPtr& e, const std::string& key) {
  if (!e) return 0;
  const double coefficient = c.number(e, "coefficient", 1.0, 0.0, kInfinite, key);
  const double radius = c.number(e, "patch_radius", 0.0, 0.0, kInfinite, key);
  if (const sdf::ElementPtr ode = child(e, "ode")) refuse_nonzero(c, ode, "slip", key + "/ode");
  const sdf::ElementPtr use = child(e, "use_patch_radius");
  if (use && !use->Get<bool>()) {
    c.problem(use, key + "/use_patch_radius", "false", "a patch that grows with the depth isn't supported",
              "true with a patch_radius");
  }
  const double spin = 3 * std::numbers::pi / 16 * radius * coefficient;
  if (spin > 0 && !c.engine.spin_friction) c.cannot(e, key, fmt::format("{}", spin), "friction against spin isn't", "0 or absent");
  return spin;
}

double restitution(ReadContext& c, const sdf::ElementPtr& bounce, const std::string& key) {
  constexpr const char* kName = "restitution_coefficient";
  const double value = c.number(bounce, kName, 0.0, 0.0, 1.0, key);
  if (value != 0 && !c.engine.restitution) {
    c.cannot(bounce, key + "/" + kName, child(bounce, kName)->Get<std::string>(), "isn't", "0 or absent");
  }
  return value;
}

void read_springs(ReadContext& c, const sdf::ElementPtr& contact, const std::string& key, Surface& out) {
  for (const char* format : {"bullet", "ode"}) {  // ode's count where both are there
    const sdf::ElementPtr e = child(contact, format);
    if (!e) continue;
    if (!c.engine.contact_springs) {
      c.notes.add("contact stiffness and damping of the SDF aren't used (the engine has its own)", key);
      continue;
    }
    const std::string where = key + "/surface/contact/" + format;
    if (child(e, "kp")) out.stiffness = c.number(e, "kp", 0.0, 0.0, kInfinite, where);
    if (child(e, "kd")) out.damping = c.number(e, "kd", 0.0, 0.0, kInfinite, where);
  }
}

std::uint32_t collision_mask(ReadContext& c, const sdf::ElementPtr& contact, const std::string& key) {
  const sdf::ElementPtr e = child(contact, "collide_bitmask");
  const std::uint32_t mask = e ? e->Get<unsigned int>() : description::kAllCollisions;
  if (mask != description::kAllCollisions && !c.engine.collision_masks) {
    c.cannot(e, key + "/surface/contact/collide_bitmask", fmt::format("{}", mask), "isn't",
             fmt::format("{} or absent", description::kAllCollisions));
  }
  return mask;
}

}  // namespace

Surface read_surface(ReadContext& c, const sdf::ElementPtr& collision, const std::string& key) {
  Surface out;
  const sdf::ElementPtr surface = child(collision, "surface");
  const sdf::ElementPtr friction = child(surface, "friction");
  const std::string friction_key = key + kFriction;
  if (const sdf::ElementPtr ode = child(friction, "ode")) {
    read_friction(c, ode, "mu", "mu2", friction_key + "/ode", out);
    refuse_nonzero(c, ode, "slip1", friction_key + "/ode");
    refuse_nonzero(c, ode, "slip2", friction_key + "/ode");
  } else if (const sdf::ElementPtr bullet = child(friction, "bullet")) {
    read_friction(c, bullet, "friction", "friction2", friction_key + "/bullet", out);
    refuse_nonzero(c, bullet, "rolling_friction", friction_key + "/bullet");
  }
  out.torsional_m = torsional(c, child(friction, "torsional"), friction_key + "/torsional");
  out.restitution = restitution(c, child(surface, "bounce"), key + "/surface/bounce");
  const sdf::ElementPtr contact = child(surface, "contact");
  read_springs(c, contact, key, out);
  out.mask = collision_mask(c, contact, key);
  if (const sdf::ElementPtr without = child(contact, "collide_without_contact"); without && without->Get<bool>()) {
    c.problem(without, key + "/surface/contact/collide_without_contact", "true", "isn't supported", "false or absent");
  }
  if (child(contact, "category_bitmask")) {
    c.problem(contact, key + "/surface/contact/category_bitmask", "", "isn't supported", "collide_bitmask");
  }
  if (child(surface, "soft_contact")) c.notes.add("soft contacts are left out", key);
  return out;
}

/// As gz-sim has it: a link of the same model.
void find_direction_frames(ReadContext& c) {
  for (const DirectionFrame& d : c.direction_frames) {
    for (Link& link : c.out.links) {
      for (Collision& shape : link.collisions) {
        if (shape.name != d.collision) continue;
        const std::string name = scoped_name(scope_of(link.name), d.frame);
        const auto it = std::find_if(c.out.links.begin(), c.out.links.end(), [&](const Link& l) { return l.name == name; });
        if (it == c.out.links.end())
          return c.problem(d.element,
                           fmt::format("{}{}/{}/fdir1@expressed_in", d.collision, kFriction, d.element->GetParent()->GetName()),
                           d.frame, "no such link in its model", "a link's name");
        shape.surface.first_of = static_cast<std::size_t>(it - c.out.links.begin());
      }
    }
  }
}

}  // namespace vsa::reader
