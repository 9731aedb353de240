// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <surface>: libsdformat 12's Surface has no friction, so the element tree is read.
//   friction/ode/mu, mu2              isotropic only: mu2 absent or equal to mu, or both ≥ 10
//   friction/bullet/friction, friction2   where there is no ode
//   friction/torsional/coefficient    spin torque = (3π/16)·patch_radius·coefficient·N, ODE's formula
//   contact/collide_bitmask
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "read_context.hpp"

namespace vsa::engine {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNeverSlips = 10;  // in a pair the smaller coefficient counts: of two beyond this neither does
constexpr double kMuMax = 1e6;      // SDF files write 1e5 and more for "never slips"

/// One isotropic coefficient from two; reports an anisotropic pair.
double isotropic(ReadContext& c, const sdf::ElementPtr& e, const char* first, const char* second, const std::string& key) {
  const double mu = c.number(e, first, 1.0, 0.0, kInfinite, key);
  const double mu2 = c.number(e, second, mu, 0.0, kInfinite, key);
  if (mu2 != mu && std::min(mu, mu2) >= kNeverSlips) {
    c.notes.add("of two coefficients of friction that both never slip the smaller is taken", key);
    return std::min({mu, mu2, kMuMax});
  }
  if (mu2 != mu) {
    c.problem(e, key + "/" + second, fmt::format("{}", mu2), "friction that depends on the direction isn't supported",
              fmt::format("the value of {}, {}", first, mu));
  }
  return std::min(mu, kMuMax);
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
  const sdf::ElementPtr use = child(e, "use_patch_radius");
  if (use && !use->Get<bool>()) {
    c.problem(use, key + "/use_patch_radius", "false", "a patch that grows with the depth isn't supported",
              "true with a patch_radius");
  }
  return 3 * std::numbers::pi / 16 * radius * coefficient;
}

}  // namespace

Surface read_surface(ReadContext& c, const sdf::ElementPtr& collision, const std::string& key) {
  Surface out;
  const sdf::ElementPtr surface = child(collision, "surface");
  const sdf::ElementPtr friction = child(surface, "friction");
  const std::string friction_key = key + "/surface/friction";
  if (const sdf::ElementPtr ode = child(friction, "ode")) {
    out.mu = isotropic(c, ode, "mu", "mu2", friction_key + "/ode");
    refuse_nonzero(c, ode, "slip1", friction_key + "/ode");
    refuse_nonzero(c, ode, "slip2", friction_key + "/ode");
  } else if (const sdf::ElementPtr bullet = child(friction, "bullet")) {
    out.mu = isotropic(c, bullet, "friction", "friction2", friction_key + "/bullet");
    refuse_nonzero(c, bullet, "rolling_friction", friction_key + "/bullet");
  }
  out.torsional_m = torsional(c, child(friction, "torsional"), friction_key + "/torsional");
  refuse_nonzero(c, child(surface, "bounce"), "restitution_coefficient", key + "/surface/bounce");
  const sdf::ElementPtr contact = child(surface, "contact");
  for (const char* engine : {"ode", "bullet"}) {
    if (child(contact, engine)) c.notes.add("contact stiffness and damping of the SDF aren't used (the engine has its own)", key);
  }
  if (const sdf::ElementPtr mask = child(contact, "collide_bitmask")) out.mask = mask->Get<unsigned int>();
  if (const sdf::ElementPtr without = child(contact, "collide_without_contact"); without && without->Get<bool>()) {
    c.problem(without, key + "/surface/contact/collide_without_contact", "true", "isn't supported", "false or absent");
  }
  if (child(contact, "category_bitmask")) {
    c.problem(contact, key + "/surface/contact/category_bitmask", "", "isn't supported", "collide_bitmask");
  }
  if (child(surface, "soft_contact")) c.notes.add("soft contacts are left out", key);
  return out;
}

}  // namespace vsa::engine
