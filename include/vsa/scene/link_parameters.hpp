// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What of a link may change between steps, and differ from copy to copy of a world.
#pragma once

#include <array>
#include <optional>

namespace vsa::scene {

/// What a link weighs and how it rubs.
struct LinkParameters {
  double mass_kg = 0;                    ///< 1e-9 … 1e9; of a static link nothing but 0
  std::array<double, 3> inertia_kgm2{};  ///< principal moments about the centre of mass, as the engine orders them; their axes stay
  /// Coulomb's coefficient of its collision shapes, 0 … 1e6; where they differ, the largest, and setting it sets all. None: it has none.
  std::optional<double> friction{};
  bool operator==(const LinkParameters&) const = default;
};

}  // namespace vsa::scene
