// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/feature.hpp"

namespace vsa::topics {

/// Whether this build has topics: with a Gazebo transport. Without them a WorldServer or a CommandClient can't be made (InputError).
[[nodiscard]] Feature topics_feature();

}  // namespace vsa::topics
