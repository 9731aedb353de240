// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scene/link.hpp"

#include "vsa/scoped_name.hpp"

namespace vsa::scene {

std::vector<std::size_t> links_of_joint(std::string_view model, std::string_view joint, std::size_t actuator_index,
                                        const std::vector<LinkInfo>& links) {
  const std::string_view scope = scope_of(joint);
  const std::string around = scope.empty() ? std::string(model) : scoped_name(model, scope);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i].is_static && is_below(links[i].name, around)) found.push_back(i);
  }
  if (!scope.empty()) return found;
  if (actuator_index >= found.size()) return {};
  return {found[actuator_index]};
}

}  // namespace vsa::scene
