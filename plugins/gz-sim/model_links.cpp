// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "model_links.hpp"

#include <utility>

#include "entities.hpp"
#include "link_shapes.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::plugins {
namespace {

namespace components = sim::components;

/// The element that a link was made of; null where its model keeps none.
sdf::ElementPtr element_of(sim::Entity link, const sim::EntityComponentManager& ecm) {
  const auto model = ecm.ComponentData<components::ModelSdf>(ecm.ParentEntity(link));
  const auto name = ecm.ComponentData<components::Name>(link);
  if (!model || !name || !model->Element() || !model->Element()->HasElement("link")) return nullptr;
  for (sdf::ElementPtr e = model->Element()->GetElement("link"); e; e = e->GetNextElement("link")) {
    if (e->Get<std::string>("name") == *name) return e;
  }
  return nullptr;
}

}  // namespace

ModelLinks model_links(sim::Entity model, const std::string& name, const sim::EntityComponentManager& ecm) {
  ModelLinks out;
  std::vector<NamedEntity> links = entities_below<components::Link>(model, ecm);
  int left_out = 0;
  for (const NamedEntity& link : links) {
    const auto inertial = ecm.ComponentData<components::Inertial>(link.entity);
    const sdf::ElementPtr element = element_of(link.entity, ecm);
    out.infos.push_back({scoped_name(name, link.name), std::string(outermost(name)), inertial ? inertial->MassMatrix().Mass() : 0,
                         false, element ? link_shapes(element, left_out) : std::vector<scene::Shape>{}});
  }
  out.notices = left_out_notice(left_out);
  out.poses = [links = std::move(links), &ecm](std::span<scene::Pose> poses) {
    for (std::size_t i = 0; i < links.size() && i < poses.size(); ++i) {
      const math::Pose3d pose = sim::worldPose(links[i].entity, ecm);
      const auto& p = pose.Pos();
      const auto& q = pose.Rot();
      poses[i] = {{p.X(), p.Y(), p.Z()}, {q.W(), q.X(), q.Y(), q.Z()}};
    }
  };
  return out;
}

double world_step_s(const sim::EntityComponentManager& ecm) {
  const auto physics = ecm.ComponentData<components::Physics>(sim::worldEntity(ecm));
  return physics ? physics->MaxStepSize() : 0;
}

math::Vector3d world_gravity(const sim::EntityComponentManager& ecm) {
  return ecm.ComponentData<components::Gravity>(sim::worldEntity(ecm)).value_or(math::Vector3d::Zero);
}

std::string world_name(const sim::EntityComponentManager& ecm) {
  return ecm.ComponentData<components::Name>(sim::worldEntity(ecm)).value_or("world");
}

}  // namespace vsa::plugins
