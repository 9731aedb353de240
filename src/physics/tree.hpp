// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links and joints as a forest rooted in the world. SDF allows a joint to point either way; engines want parent → child.
#pragma once

#include <string_view>

#include "physics/description.hpp"
#include "vsa/errors.hpp"

namespace vsa::physics {

struct TreeNode {
  std::size_t link = 0;
  std::optional<std::size_t> parent;  ///< link; none: the world
  std::optional<std::size_t> joint;   ///< none: static (if the link is) or free
  bool reversed = false;              ///< the joint's parent is the tree's child
  bool free = false;
};

/// Parents stand before children. Static links hang on the world. Joints that close a loop aren't in it; other loops are problems.
[[nodiscard]] std::vector<TreeNode> build_tree(const description::World& world, std::string_view file, Problems& problems);

}  // namespace vsa::physics
