// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "model_robots.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace vsa::plugins {
namespace {

struct Registry {
  std::mutex mutex;
  std::map<seat::JointKey, std::weak_ptr<ModelRobots>> models;
};

// Never destroyed: a host may destroy its models after this library's statics.
Registry& registry = *new Registry;

}  // namespace

std::shared_ptr<ModelRobots> ModelRobots::of(const seat::JointKey& model) {
  const std::lock_guard lock(registry.mutex);
  std::erase_if(registry.models, [](const auto& known) { return known.second.expired(); });
  std::weak_ptr<ModelRobots>& known = registry.models[model];
  std::shared_ptr<ModelRobots> out = known.lock();
  if (!out) known = out = std::make_shared<ModelRobots>();
  return out;
}

void ModelRobots::add(ModelRobot& robot) {
  members_.push_back({&robot, false});
  joined_ = false;
}

void ModelRobots::remove(ModelRobot& robot) {
  std::erase_if(members_, [&](const Member& m) { return m.robot == &robot; });
  joined_ = false;
}

/// Numbers the trees' actuators as the group does, from the links' first on.
void ModelRobots::take(Links links, seat::SeatGroup::Trees& trees) {
  const auto& theirs = links.trees->trees();
  for (std::size_t t = 0; t < theirs.size(); ++t) {
    trees_.push_back({links.trees.get(), t});
    trees.push_back(theirs[t]);
    for (std::size_t& k : trees.back()) k += links.first;
  }
  if (theirs.empty()) links.count = 0;
  links_.push_back(std::move(links));
}

/// Where the whole model is no tree, a robot's own may be one.
void ModelRobots::join() {
  using Of = ModelRobot::Links;
  std::vector<seat::Seat*> seats;
  ModelRobot::Joints driven;
  for (const Member& m : members_) {
    seats.push_back(m.robot->seat());
    driven.insert(driven.end(), m.robot->driven().begin(), m.robot->driven().end());
  }
  links_.clear();
  trees_.clear();
  seat::SeatGroup::Trees trees;
  in_.resize(driven.size());
  take({members_.front().robot->link_trees(Of::of_outermost_model, driven), 0, driven.size()}, trees);
  const bool whole = !trees.empty();
  std::size_t first = 0;
  for (const Member& m : members_) {
    const std::size_t count = m.robot->driven().size();
    if (!whole) take({m.robot->link_trees(Of::of_own_model, m.robot->driven()), first, count}, trees);
    first += count;
  }
  group_ = seat::SeatGroup(std::move(seats), trees);
  joined_ = true;
}

/// Tells the joints how they are accelerated by all but their actuators.
void ModelRobots::foresee(double dt_s) {
  auto next = in_.begin();
  for (const Member& m : members_) {
    for (host::JointIn& in : m.robot->seat()->in()) {
      in.free_acceleration_rad_per_s2.reset();
      *next++ = &in;
    }
  }
  for (const Links& links : links_)
    if (links.count > 0) links.trees->foresee(std::span(in_).subspan(links.first, links.count), dt_s);
}

void ModelRobots::forget() noexcept {
  for (const Links& links : links_) links.trees->forget();
}

void ModelRobots::step(const ModelRobot& asking, std::int64_t time_ns, std::int64_t dt_ns) {
  for (Member& m : members_)
    if (m.robot == &asking && std::exchange(m.stepped, false)) return;
  for (Member& m : members_) m.stepped = m.robot != &asking;
  // A nested model without a plug-in goes without a word.
  joined_ = joined_ && std::all_of(links_.begin(), links_.end(), [](const Links& links) { return links.trees->are_there(); });
  if (!joined_) join();
  for (const Member& m : members_) m.robot->tell(time_ns);
  double turned = 0;
  for (const Links& links : links_) turned = std::max(turned, links.trees->turned_rad());
  for (const Member& m : members_) m.robot->seat()->turned(turned);
  LinkTrees* looked = nullptr;
  group_.update([&](std::size_t tree, std::span<double> out) {
    const Tree& t = trees_[tree];
    if (std::exchange(looked, t.links) != t.links) t.links->look();
    t.links->mobility(t.tree, out);
  });
  foresee(static_cast<double>(dt_ns) * 1e-9);
  group_.step(dt_ns);
  for (const Member& m : members_) m.robot->apply();
}

}  // namespace vsa::plugins
