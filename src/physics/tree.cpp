// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/tree.hpp"

namespace vsa::physics {
namespace {

struct Edge {
  std::size_t joint, other;  // other: a link, or the world's index
  bool reversed;             // walking it goes from the joint's child to its parent
};

/// The graph has one node a link and one for the world; static links are the world.
class Forest {
 public:
  Forest(const description::World& world, std::string_view file, Problems& problems)
      : world_(world),
        file_(file),
        problems_(problems),
        edges_(world.links.size() + 1),
        seen_(world.links.size(), false),
        used_(world.joints.size(), false) {
    for (std::size_t j = 0; j < world.joints.size(); ++j)
      if (!world.joints[j].closes) add(j);
  }

  std::vector<TreeNode> grow() {
    for (std::size_t l = 0; l < world_.links.size(); ++l) {
      if (!world_.links[l].is_static) continue;
      seen_[l] = true;
      nodes_.push_back({l, {}, {}, false, false});
    }
    spread(world_.links.size());
    for (std::size_t l = 0; l < world_.links.size(); ++l) {
      if (seen_[l]) continue;
      seen_[l] = true;
      nodes_.push_back({l, {}, {}, false, true});
      spread(l);
    }
    return std::move(nodes_);
  }

 private:
  [[nodiscard]] std::size_t node(std::optional<std::size_t> link) const {
    return link && !world_.links[*link].is_static ? *link : world_.links.size();
  }

  void add(std::size_t j) {
    const Joint& joint = world_.joints[j];
    const std::size_t a = node(joint.parent), b = node(joint.child);
    if (a == b) {
      problems_.add(
          {std::string(file_), joint.name, "", "both its links are fixed to the world", "a joint with a link that can move"});
      return;
    }
    edges_[a].push_back({j, b, false});
    edges_[b].push_back({j, a, true});
  }

  void spread(std::size_t from) {
    const std::size_t ground = world_.links.size();
    std::vector<std::size_t> open{from};
    for (std::size_t i = 0; i < open.size(); ++i) {
      const std::size_t at = open[i];
      for (const Edge& e : edges_[at]) {
        if (used_[e.joint]) continue;
        used_[e.joint] = true;
        if (e.other == ground || seen_[e.other]) {
          problems_.add(
              {std::string(file_), world_.joints[e.joint].name, "", "closes a kinematic loop", "joints that form a tree"});
          continue;
        }
        seen_[e.other] = true;
        const Joint& joint = world_.joints[e.joint];
        const std::optional<std::size_t> parent = e.reversed ? joint.child : joint.parent;
        nodes_.push_back({e.other, parent, e.joint, e.reversed, false});
        open.push_back(e.other);
      }
    }
  }

  const description::World& world_;
  std::string_view file_;
  Problems& problems_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<bool> seen_, used_;
  std::vector<TreeNode> nodes_;
};

}  // namespace

std::vector<TreeNode> build_tree(const description::World& world, std::string_view file, Problems& problems) {
  return Forest(world, file, problems).grow();
}

}  // namespace vsa::physics
