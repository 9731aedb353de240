// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// libvsa-fmu.so: one actuator.
#include "component.hpp"

namespace vsa::fmu {

std::unique_ptr<Model> open_model(const std::filesystem::path& resources) { return open_unit(resources); }

}  // namespace vsa::fmu
