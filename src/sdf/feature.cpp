// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sdf/feature.hpp"

namespace vsa::reader {

Feature sdf_feature() { return {"reader of SDF", VSA_SDF_FOUND_AS, VSA_SDF_REMEDY}; }

Feature urdf_feature() { return {"reader of URDF", VSA_URDF_FOUND_AS, VSA_URDF_REMEDY}; }

}  // namespace vsa::reader
