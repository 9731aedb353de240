// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Parameters of a World's actuators and links, one by one and as a whole.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/world_impl.hpp"

namespace vsa::engine {
namespace {

constexpr double kLeastMass_kg = 1e-9, kMostMass_kg = 1e9, kMostFriction = 1e6;
constexpr double kLeastInertia_kgm2 = 1e-15, kMostInertia_kgm2 = 1e12;
constexpr double kRounding = 1e-9;  ///< by which the largest moment may be above the sum of the others

class LinkCheck {
 public:
  LinkCheck(const LinkInfo& link, Problems& problems) : link_(link), problems_(problems) {}

  void look(const LinkParameters& now, const LinkParameters& to) {
    if (link_.is_static) {
      if (to.mass_kg != now.mass_kg) say("mass_kg", to.mass_kg, "is static and has no mass", "a link that moves");
      if (to.inertia_kgm2 != now.inertia_kgm2) say("inertia_kgm2", to.inertia_kgm2[0], "is static", "a link that moves");
    } else {
      within("mass_kg", to.mass_kg, kLeastMass_kg, kMostMass_kg);
      for (const double moment : to.inertia_kgm2) within("inertia_kgm2", moment, kLeastInertia_kgm2, kMostInertia_kgm2);
      const auto [a, b, c] = to.inertia_kgm2;
      const double most = std::max({a, b, c});
      if (2 * most > (a + b + c) * (1 + kRounding))
        say("inertia_kgm2", most, "no body has such moments", "each up to the sum of the other two");
    }
    if (to.friction) within("friction", *to.friction, 0, kMostFriction);
    if (to.friction && !now.friction) say("friction", *to.friction, "has no collision shape", "a link with one");
    if (!to.friction && now.friction) say("friction", *now.friction, "can't be taken away", "a coefficient");
  }

 private:
  void within(const char* key, double value, double low, double high) {
    if (!(value >= low && value <= high)) say(key, value, "is out of range", fmt::format("{} … {}", low, high));
  }
  void say(const char* key, double value, const char* message, std::string allowed) {
    problems_.add({"", link_.name + ": " + key, fmt::format("{}", value), message, std::move(allowed)});
  }

  const LinkInfo& link_;
  Problems& problems_;
};

}  // namespace

struct World::Parameters {
  std::shared_ptr<const description::World> world;  ///< that they are of
  std::vector<std::shared_ptr<const host::RobotConfig>> robots;
  std::shared_ptr<const physics::Bodies> bodies;
};

const config::TypeLibrary& World::types() const { return impl_->options.types; }

std::shared_ptr<const World::Parameters> World::parameters() const {
  auto out = std::make_shared<Parameters>();
  out->world = impl_->world;
  for (const RobotSlot& slot : impl_->robots) out->robots.push_back(slot.robot().parameters());
  out->bodies = impl_->physics->bodies();
  return out;
}

LinkParameters World::link_parameters(LinkHandle link) const { return impl_->physics->bodies()->links()[at(link)]; }
LinkParameters World::link_parameters(const Parameters& of, LinkHandle link) const {
  check_of_this_world(of);
  return of.bodies->links()[at(link)];
}
const host::ActuatorConfig& World::actuator_parameters(const Parameters& of, const ActuatorRef& actuator) const {
  check_of_this_world(of);
  static_cast<void>(at(actuator));
  return of.robots[actuator.robot]->actuators[actuator.index];
}

void World::check_of_this_world(const Parameters& parameters) const {
  check_same_world("parameters", *parameters.world, *impl_->world);
  if (parameters.robots.size() != impl_->robots.size())
    throw InputError(Problem{"", "parameters", fmt::format("{} robots", parameters.robots.size()), "another world's",
                             fmt::format("{}", impl_->robots.size())});
  for (std::size_t r = 0; r < impl_->robots.size(); ++r) impl_->robots[r].robot().check(parameters.robots[r]);
}

std::shared_ptr<const World::Parameters> World::parameters_with(const Parameters& base, const ParameterChanges& changes) const {
  check_of_this_world(base);
  auto out = std::make_shared<Parameters>(base);
  Problems problems;
  for (std::size_t r = 0; r < impl_->robots.size(); ++r) {
    std::vector<std::pair<std::size_t, host::ActuatorConfig>> own;
    for (const auto& [actuator, to] : changes.actuators) {
      static_cast<void>(at(actuator));
      if (actuator.robot == r) own.emplace_back(actuator.index, to);
    }
    if (own.empty()) continue;
    try {
      out->robots[r] = impl_->robots[r].robot().parameters_with(*base.robots[r], own, impl_->substep_ns());
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  const std::span<const LinkParameters> before = base.bodies->links();
  std::vector<LinkParameters> links(before.begin(), before.end());
  for (const auto& [link, to] : changes.links) {
    const std::size_t l = at(link);
    LinkCheck(impl_->world->infos[l], problems).look(before[l], to);
    links[l] = to;
  }
  problems.throw_if_any();
  if (!std::equal(links.begin(), links.end(), before.begin())) out->bodies = impl_->physics->bodies_with(*base.bodies, links);
  return out;
}

void World::set_link_parameters(LinkHandle link, const LinkParameters& to) {
  const std::shared_ptr<const Parameters> now = parameters();
  set_parameters(*parameters_with(*now, {{}, {{link, to}}}));
}

void World::set_parameters(const Parameters& to) {
  check_of_this_world(to);
  if (to.bodies != impl_->physics->bodies()) {
    impl_->physics->use(to.bodies);
    impl_->forget_mobility();
  }
  for (std::size_t r = 0; r < impl_->robots.size(); ++r) impl_->robots[r].robot().set_parameters(to.robots[r]);
  impl_->join_trees_anew();
}

void World::use(const Parameters& to) {
  check_of_this_world(to);
  impl_->physics->use(to.bodies);
  for (std::size_t r = 0; r < impl_->robots.size(); ++r) impl_->robots[r].robot().use(to.robots[r]);
}

}  // namespace vsa::engine
