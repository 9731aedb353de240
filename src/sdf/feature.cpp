// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sdf/feature.hpp"

namespace vsa::reader {

Feature sdf_feature() { return {"reader of SDF and URDF", VSA_SDF_FOUND_AS, VSA_SDF_REMEDY}; }

}  // namespace vsa::reader
