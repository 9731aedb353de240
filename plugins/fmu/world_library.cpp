// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// libvsa-fmu-world.so: a whole world. What the reader of worlds takes for its data directory is the FMU's own resources/, two folders
// above this library; no vsasim need be installed.
#include <dlfcn.h>

#include "component.hpp"
#include "vsa/config/installed.hpp"
#include "vsa/fmu_world/world_model.hpp"

namespace vsa::fmu {
namespace {

std::string own_resources() {
  Dl_info info;
  const auto* here = reinterpret_cast<const void*>(&own_resources);
  if (dladdr(here, &info) == 0 || info.dli_fname == nullptr) return {};
  return (std::filesystem::absolute(info.dli_fname).parent_path() / "../../resources").lexically_normal().string();
}

// Of this library, not of an instance: all that one unzipped FMU makes have the same resources.
const std::string kResources = own_resources();  // NOLINT(cert-err58-cpp): out of memory while a library is loaded ends the program
[[maybe_unused]] const bool kTold = [] {
  std::error_code error;
  if (std::filesystem::is_directory(kResources, error)) config::loaded_with(kResources.c_str());
  return true;
}();

}  // namespace

std::unique_ptr<Model> open_model(const std::filesystem::path& resources) { return open_world(resources); }

}  // namespace vsa::fmu
