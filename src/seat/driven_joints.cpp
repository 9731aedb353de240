// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/seat/driven_joints.hpp"

#include <map>
#include <mutex>
#include <utility>

#include "vsa/errors.hpp"

namespace vsa::seat {
namespace {

struct Registry {
  std::mutex mutex;
  std::map<JointKey, std::string> owners;
};

// Never destroyed: a host may destroy its models after this library's statics.
Registry& registry = *new Registry;

}  // namespace

DrivenJoints::DrivenJoints(std::string owner, const std::vector<Joint>& joints) {
  const std::lock_guard lock(registry.mutex);
  Problems problems;
  for (const Joint& joint : joints) {
    const auto at = registry.owners.find(joint.key);
    if (at == registry.owners.end()) continue;
    problems.add({owner, "actuator[" + joint.actuator + "]/joint", '"' + joint.name + '"',
                  "another vsa::Robot drives it already, that of " + at->second, "one plug-in a joint"});
  }
  problems.throw_if_any();
  for (const Joint& joint : joints) {
    registry.owners.emplace(joint.key, owner);
    mine_.push_back(joint.key);
  }
}

DrivenJoints::~DrivenJoints() {
  const std::lock_guard lock(registry.mutex);
  for (const JointKey& key : mine_) registry.owners.erase(key);
}

}  // namespace vsa::seat
