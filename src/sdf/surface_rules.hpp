// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <surface>, of whatever element tree: libsdformat 12's Surface has no friction.
//   friction/ode/mu, mu2, fdir1       two that differ: if the engine's friction has directions; without fdir1, or both ≥ 10, the smaller
//   friction/bullet/friction, friction2, fdir1   where there is no ode
//   friction/torsional/coefficient    spin torque = (3π/16)·patch_radius·coefficient·N, ODE's formula
//   bounce/restitution_coefficient, contact/ode/kp, kd (bullet/kp, kd)   if the engine has them
//   contact/collide_bitmask
//
// The context C is a Reading that knows its elements: C::Element, null where there is none, and
//   child(e, name)   attribute(e, name)   has_children(e)   number(e, name, fallback, min, max, key)
//   flag(e)   text(e)   vector(e)   problem(e, key, value, message, allowed)   cannot(e, key, value, what, allowed)
// and what unused.hpp asks of it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/reading.hpp"
#include "sdf/unused.hpp"

namespace vsa::reader {

template <class C>
class SurfaceRules {
 public:
  using Element = typename C::Element;
  explicit SurfaceRules(C& c) : c_(c) {}

  /// Of `<collision>`; `key`: its name.
  [[nodiscard]] Surface read(const Element& collision, const std::string& key) {
    Surface out;
    const Element surface = c_.child(collision, "surface"), friction = c_.child(surface, "friction");
    const std::string friction_key = key + kFriction;
    if (const Element ode = c_.child(friction, "ode")) {
      read_friction(ode, "mu", "mu2", friction_key + "/ode", out);
      refuse_nonzero(ode, "slip1", friction_key + "/ode");
      refuse_nonzero(ode, "slip2", friction_key + "/ode");
    } else if (const Element bullet = c_.child(friction, "bullet")) {
      read_friction(bullet, "friction", "friction2", friction_key + "/bullet", out);
      refuse_nonzero(bullet, "rolling_friction", friction_key + "/bullet");
    }
    out.torsional_m = torsional(c_.child(friction, "torsional"), friction_key + "/torsional");
    out.restitution = restitution(c_.child(surface, "bounce"), key + "/surface/bounce");
    const Element contact = c_.child(surface, "contact");
    read_springs(contact, key, out);
    out.mask = collision_mask(contact, key);
    if (const Element without = c_.child(contact, "collide_without_contact"); without && c_.flag(without)) {
      c_.problem(without, key + "/surface/contact/collide_without_contact", "true", "isn't supported", "false or absent");
    }
    if (c_.child(contact, "category_bitmask")) {
      c_.problem(contact, key + "/surface/contact/category_bitmask", "", "isn't supported", "collide_bitmask");
    }
    if (c_.child(surface, "soft_contact")) c_.notes.add("soft contacts are left out", key);
    tell_unused(c_, collision, key, "collision");
    return out;
  }

 private:
  static constexpr const char* kFriction = "/surface/friction";
  static constexpr double kNeverSlips = 10;  // in a pair the smaller coefficient counts: of two beyond this neither does
  static constexpr double kMuMax = 1e6;      // SDF files write 1e5 and more for "never slips"

  /// One coefficient from two, or two with their direction where the engine's friction has them.
  void read_friction(const Element& e, const char* first, const char* second, const std::string& key, Surface& out) {
    const double mu = c_.number(e, first, 1.0, 0.0, kInfinite, key);
    const double mu2 = c_.number(e, second, mu, 0.0, kInfinite, key);
    out.mu = std::min(mu, kMuMax);
    if (mu2 == mu) return;
    const Element direction = c_.child(e, "fdir1");
    const Vec3 along = direction ? c_.vector(direction) : Vec3::Zero;
    if (!along.IsFinite()) return c_.problem(direction, key + "/fdir1", c_.text(direction), "isn't finite", "finite numbers");
    if (std::min(mu, mu2) >= kNeverSlips) {
      c_.notes.add("of two coefficients of friction that both never slip the smaller is taken", key);
      out.mu = std::min({mu, mu2, kMuMax});
    } else if (along == Vec3::Zero) {
      c_.notes.add("of two coefficients of friction without <fdir1> the smaller is taken", key);
      out.mu = std::min({mu, mu2, kMuMax});
    } else if (c_.engine.directional_friction) {
      out.mu2 = std::min(mu2, kMuMax);
      out.first = along;
      for (const char* name : {"gz:expressed_in", "ignition:expressed_in"})
        if (const auto frame = c_.attribute(direction, name))
          c_.direction_frames.push_back({key.substr(0, key.rfind(kFriction)), *frame, c_.file_of(direction), key});
    } else {
      c_.cannot(e, key + "/" + second, fmt::format("{}", mu2), "friction that depends on the direction isn't",
                fmt::format("the value of {}, {}", first, mu));
    }
  }

  void refuse_nonzero(const Element& e, const char* name, const std::string& key) {
    if (c_.number(e, name, 0.0, 0.0, kInfinite, key) != 0.0) {
      c_.problem(e, key + "/" + name, c_.text(c_.child(e, name)), "isn't supported", "0 or absent");
    }
  }

  double torsional(const Element& e, const std::string& key) {
    if (!e) return 0;
    const double coefficient = c_.number(e, "coefficient", 1.0, 0.0, kInfinite, key);
    const double radius = c_.number(e, "patch_radius", 0.0, 0.0, kInfinite, key);
    if (const Element ode = c_.child(e, "ode")) refuse_nonzero(ode, "slip", key + "/ode");
    const Element use = c_.child(e, "use_patch_radius");
    if (use && !c_.flag(use)) {
      c_.problem(use, key + "/use_patch_radius", "false", "a patch that grows with the depth isn't supported",
                 "true with a patch_radius");
    }
    const double spin = 3 * std::numbers::pi / 16 * radius * coefficient;
    if (spin > 0 && !c_.engine.spin_friction)
      c_.cannot(e, key, fmt::format("{}", spin), "friction against spin isn't", "0 or absent");
    return spin;
  }

  double restitution(const Element& bounce, const std::string& key) {
    constexpr const char* kName = "restitution_coefficient";
    const double value = c_.number(bounce, kName, 0.0, 0.0, 1.0, key);
    if (value != 0 && !c_.engine.restitution) {
      c_.cannot(bounce, key + "/" + kName, c_.text(c_.child(bounce, kName)), "isn't", "0 or absent");
    }
    return value;
  }

  void read_springs(const Element& contact, const std::string& key, Surface& out) {
    for (const char* format : {"bullet", "ode"}) {  // ode's count where both are there
      const Element e = c_.child(contact, format);
      if (!e || !c_.has_children(e)) continue;
      if (!c_.engine.contact_springs) {
        c_.notes.add("contact stiffness and damping of the SDF aren't used (the engine has its own)", key);
        continue;
      }
      const std::string where = key + "/surface/contact/" + format;
      if (c_.child(e, "kp")) out.stiffness = c_.number(e, "kp", 0.0, 0.0, kInfinite, where);
      if (c_.child(e, "kd")) out.damping = c_.number(e, "kd", 0.0, 0.0, kInfinite, where);
    }
  }

  std::uint32_t collision_mask(const Element& contact, const std::string& key) {
    const Element e = c_.child(contact, "collide_bitmask");
    const std::uint32_t mask = e ? c_.whole(e) : description::kAllCollisions;
    if (mask != description::kAllCollisions && !c_.engine.collision_masks) {
      c_.cannot(e, key + "/surface/contact/collide_bitmask", fmt::format("{}", mask), "isn't",
                fmt::format("{} or absent", description::kAllCollisions));
    }
    return mask;
  }

  C& c_;
};

}  // namespace vsa::reader
