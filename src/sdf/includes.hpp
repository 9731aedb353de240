// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A look at the files before libsdformat reads them. It follows circular includes until memory ends, throws a bare std::exception
// at a version that isn't a number, refuses SDF after 1.9, and reads URDF with losses; see input_files.hpp.
#pragma once

#include "sdf/read_context.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader {

/// Mends what libsdformat would lose, in the world's file and those that it includes. Adds a problem for a circle of <include>s, a
/// version that can't be read, unexpanded xacro; true where there is none.
[[nodiscard]] bool prepare_files(const SdfSource& source, ReadContext& context);

/// The file that libsdformat is to read for what an <include> names.
[[nodiscard]] std::filesystem::path model_file(const std::filesystem::path& found, SeenFiles& seen);

}  // namespace vsa::reader
