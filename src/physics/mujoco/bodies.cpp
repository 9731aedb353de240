// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/bodies.hpp"

#include <algorithm>
#include <array>

#include "physics/mujoco/mjcf.hpp"

namespace vsa::physics {
namespace {

struct Field {
  mjtNum* begin = nullptr;
  std::ptrdiff_t count = 0;
};

/// Where the masses and what follows from them stand. A template, so that what only some of MuJoCo's versions have can be asked for.
template <class Model>
std::array<Field, 14> fields_of(Model& m) {
  std::ptrdiff_t outputs = m.nu;
  if constexpr (requires { m.nout; }) outputs = m.nout;
  Field edges{}, metric{};
  if constexpr (requires { m.flexedge_invweight0; }) edges = {m.flexedge_invweight0, m.nflexedge};
  if constexpr (requires { m.flex_vertmetric; }) metric = {m.flex_vertmetric, 4 * m.nflexvert};
  return {{{m.body_mass, m.nbody},
           {m.body_inertia, 3 * m.nbody},
           {m.body_subtreemass, m.nbody},
           {m.body_invweight0, 2 * m.nbody},
           {m.dof_M0, m.nv},
           {m.dof_invweight0, m.nv},
           {m.tendon_invweight0, m.ntendon},
           {m.actuator_acc0, outputs},
           {m.cam_poscom0, 3 * m.ncam},
           {m.light_poscom0, 3 * m.nlight},
           edges,
           metric,
           {&m.stat.meanmass, 1},
           {&m.stat.meaninertia, 1}}};
}

bool same_body(const scene::LinkParameters& a, const scene::LinkParameters& b) {
  return a.mass_kg == b.mass_kg && a.inertia_kgm2 == b.inertia_kgm2;
}

/// Others are only seen.
bool collides(const mjModel& m, std::size_t geom) { return m.geom_contype[geom] != 0 || m.geom_conaffinity[geom] != 0; }

}  // namespace

std::shared_ptr<const MujocoBodies::Masses> MujocoBodies::masses_of(const mjModel& model) {
  auto out = std::make_shared<Masses>();
  for (const Field& f : fields_of(const_cast<mjModel&>(model))) out->insert(out->end(), f.begin, f.begin + f.count);
  return out;
}

MujocoBodies::MujocoBodies(const mjModel& m, const LinkObjects& objects)
    : links_(objects.body.size()),
      masses_(masses_of(m)),
      surfaces_(std::make_shared<const Surfaces>(
          Surfaces{{}, {m.geom_condim, m.geom_condim + m.ngeom}, {m.geom_priority, m.geom_priority + m.ngeom}})) {
  auto surfaces = std::make_shared<Surfaces>(*surfaces_);
  for (int g = 0; g < m.ngeom; ++g) {
    surfaces->mu.push_back(m.geom_friction[3 * g]);
    if (!collides(m, static_cast<std::size_t>(g))) continue;
    std::optional<double>& most = links_[objects.geoms[static_cast<std::size_t>(g)]].friction;
    most = std::max(most.value_or(0.0), m.geom_friction[3 * g]);
  }
  surfaces_ = std::move(surfaces);
  for (std::size_t l = 0; l < links_.size(); ++l) {
    if (objects.is_static[l]) continue;
    links_[l].mass_kg = m.body_mass[objects.body[l]];
    std::copy_n(m.body_inertia + 3 * objects.body[l], 3, links_[l].inertia_kgm2.begin());
  }
}

MujocoBodies::MujocoBodies(const MujocoBodies& base, std::span<const scene::LinkParameters> links, const LinkObjects& objects,
                           mjModel& model, mjData& scratch)
    : links_(links.begin(), links.end()), masses_(base.masses_), surfaces_(base.surfaces_) {
  bool masses = false, surfaces = false;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    masses = masses || !same_body(links_[l], base.links_[l]);
    surfaces = surfaces || links_[l].friction != base.links_[l].friction;
  }
  if (surfaces) surfaces_ = surfaces_with(base, objects, model);
  if (!masses) return;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    if (objects.is_static[l]) continue;
    model.body_mass[objects.body[l]] = links_[l].mass_kg;
    std::copy_n(links_[l].inertia_kgm2.begin(), 3, model.body_inertia + 3 * objects.body[l]);
  }
  mj_setConst(&model, &scratch);
  masses_ = masses_of(model);
}

/// Kinds of contact as a world of ours has them.
MujocoBodies::Surfaces MujocoBodies::with_kinds(Surfaces s, const mjModel& model) {
  std::vector<std::array<double, 2>> all;
  for (std::size_t g = 0; g < s.mu.size(); ++g) all.push_back({s.mu[g], model.geom_friction[3 * g + 1]});
  const ContactKinds kinds(all);
  for (std::size_t g = 0; g < s.mu.size(); ++g) {
    const ContactKind kind = kinds.of(all[g][0], all[g][1]);
    s.condim[g] = kind.condim;
    s.priority[g] = kind.priority;
  }
  return s;
}

/// What a world would have whose file says so.
std::shared_ptr<const MujocoBodies::Surfaces> MujocoBodies::surfaces_with(const MujocoBodies& base, const LinkObjects& objects,
                                                                          const mjModel& model) const {
  auto out = std::make_shared<Surfaces>(*base.surfaces_);
  for (std::size_t g = 0; g < out->mu.size(); ++g) {
    const std::size_t link = objects.geoms[g];
    if (collides(model, g) && links_[link].friction != base.links_[link].friction) out->mu[g] = links_[link].friction.value_or(0.0);
  }
  // A file that says otherwise what kinds of contact it has keeps them.
  const Surfaces by_friction = with_kinds(*base.surfaces_, model);
  const bool ours = by_friction.condim == base.surfaces_->condim && by_friction.priority == base.surfaces_->priority;
  if (ours) *out = with_kinds(*out, model);
  return out;
}

bool MujocoBodies::fits(const mjModel& m) const {
  std::ptrdiff_t masses = 0;
  for (const Field& f : fields_of(const_cast<mjModel&>(m))) masses += f.count;
  return static_cast<std::ptrdiff_t>(masses_->size()) == masses && static_cast<int>(surfaces_->mu.size()) == m.ngeom;
}

void MujocoBodies::put_masses_into(mjModel& m) const {
  const mjtNum* from = masses_->data();
  for (const Field& f : fields_of(m)) {
    std::copy_n(from, f.count, f.begin);
    from += f.count;
  }
}

void MujocoBodies::put_into(mjModel& m, const MujocoBodies& now) const {
  if (masses_ != now.masses_) put_masses_into(m);
  if (surfaces_ == now.surfaces_) return;
  for (std::size_t g = 0; g < surfaces_->mu.size(); ++g) m.geom_friction[3 * g] = surfaces_->mu[g];
  std::copy(surfaces_->condim.begin(), surfaces_->condim.end(), m.geom_condim);
  std::copy(surfaces_->priority.begin(), surfaces_->priority.end(), m.geom_priority);
}

}  // namespace vsa::physics
