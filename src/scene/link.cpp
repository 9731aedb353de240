// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scene/link.hpp"

namespace vsa::scene {

std::vector<std::size_t> links_of_joint(std::string_view model, std::string_view joint, std::size_t actuator_index,
                                        const std::vector<LinkInfo>& links) {
  const std::string of_model = std::string(model) + "::";
  const std::size_t scope = joint.rfind("::");
  const std::string prefix = scope == std::string_view::npos ? of_model : of_model + std::string(joint.substr(0, scope + 2));
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i].is_static && std::string_view(links[i].name).substr(0, prefix.size()) == prefix) found.push_back(i);
  }
  if (scope != std::string_view::npos) return found;
  if (actuator_index >= found.size()) return {};
  return {found[actuator_index]};
}

}  // namespace vsa::scene
