// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sdf/Root.hh>

#include "sdf/read_context.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader {

/// Parses quietly; what libsdformat reports or prints becomes problems (or, where all went well, warnings).
void parse_sdf(const SdfSource& source, ReadContext& context, sdf::Root& root);

}  // namespace vsa::reader
