// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "compat.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::plugins {

struct NamedEntity {
  std::string name;  ///< relative to the model that was asked: "module_1::shaft"
  sim::Entity entity = sim::kNullEntity;
};

/// All entities with component Kind in the model and those nested in it.
template <class Kind>
std::vector<NamedEntity> entities_below(sim::Entity model, const sim::EntityComponentManager& ecm, const std::string& scope = "") {
  std::vector<NamedEntity> out;
  const auto name_of = [&](sim::Entity e) { return scoped_name(scope, ecm.ComponentData<sim::components::Name>(e).value_or("")); };
  for (const sim::Entity e : ecm.EntitiesByComponents(sim::components::ParentEntity(model), Kind())) out.push_back({name_of(e), e});
  for (const sim::Entity e : ecm.EntitiesByComponents(sim::components::ParentEntity(model), sim::components::Model())) {
    for (auto& deeper : entities_below<Kind>(e, ecm, name_of(e))) out.push_back(std::move(deeper));
  }
  return out;
}

}  // namespace vsa::plugins
