// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "elastic/laws/laws.hpp"

#include <array>

namespace vsa::elastic {

std::span<const Law* const> laws() noexcept {
  static constexpr std::array kAll{&kBiStiffness, &kCamRoller, &kLeverCardan,     &kLeverPivot,   &kLeverSpring,
                                   &kMaccepa,     &kMaccepa2,  &kSeriesHardening, &kSeriesSpring, &kTable,
                                   &kTwoCams,     &kTwoExp,    &kTwoQuadratic,    &kTwoSinh,      &kTwoSinhLinear};
  return kAll;
}

}  // namespace vsa::elastic
