// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The reader of a build with neither libsdformat nor urdfdom: it says so.
#include "vsa/sdf/feature.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader {

description::World read_sdf(const SdfSource& source, const ReadOptions&, const Finder&, SeenFiles&, std::vector<std::string>&,
                            Problems& problems) {
  problems.add({source.label(), "", "", sdf_feature().missing(),
                "MJCF, NAME.xml or, beside NAME.sdf, what vsa export --mjcf wrote of it elsewhere"});
  return {};
}

}  // namespace vsa::reader
