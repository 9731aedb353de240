// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The reader of a build with neither libsdformat nor urdfdom: it says so.
#include "vsa/sdf/feature.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader {

description::World read_sdf(const SdfSource& source, const ReadOptions&, const Finder&, SeenFiles&, std::vector<std::string>&,
                            Problems& problems) {
  const bool urdf = source.path.empty() ? source.text.find("<robot") != std::string_view::npos : source.path.extension() == ".urdf";
  problems.add({source.label(), "", "", (urdf ? urdf_feature() : sdf_feature()).missing(),
                "MJCF, NAME.xml or, beside NAME.sdf, what vsa export --mjcf wrote of it elsewhere"});
  return {};
}

}  // namespace vsa::reader
