// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/feature.hpp"

namespace vsa::topics {

Feature topics_feature() { return {"topics", VSA_TOPICS_FOUND_AS, VSA_TOPICS_REMEDY}; }

}  // namespace vsa::topics
