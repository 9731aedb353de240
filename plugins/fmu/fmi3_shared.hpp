// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the functions of FMI 3.0 stand on.
#pragma once

#include "component.hpp"
#include "fmi3.hpp"

namespace vsa::fmu {

struct Component3 {
  std::unique_ptr<Instance> instance;
};

inline fmi3Status word3(Status status) noexcept { return static_cast<fmi3Status>(static_cast<int>(status)); }

/// Runs `work` on the instance; without one there is nobody to tell.
template <class Work>
fmi3Status with3(fmi3Instance c, const Work& work) noexcept {
  return c == nullptr ? fmi3Error : word3(work(*static_cast<Component3*>(c)->instance));
}

/// A function for something that this FMU hasn't got.
inline fmi3Status absent3(fmi3Instance c, const char* call, const char* why) noexcept {
  return with3(c, [&](Instance& i) { return i.refuse(call, why); });
}

}  // namespace vsa::fmu
