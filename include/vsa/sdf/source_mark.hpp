// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an MJCF beside an SDF was written of: a hash of the SDF and of all that it names by <uri>, of a model's directory every SDF, and
// of what those name. Of their bytes, without line ends of another system; no path counts, so it is the same on every machine.
// What isn't found counts by its name, and so do materials' scripts, found or not.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "vsa/sdf/finder.hpp"

namespace vsa::reader {

/// 16 hexadecimal digits. None: a file can't be read. What is read goes to `seen`.
[[nodiscard]] std::optional<std::string> source_mark(const std::filesystem::path& sdf, const Finder& finder, SeenFiles& seen);

/// `mjcf` with the mark in a comment behind its first line.
[[nodiscard]] std::string with_source_mark(std::string mjcf, std::string_view mark);
/// The mark in there, if there is one.
[[nodiscard]] std::optional<std::string> source_mark_in(std::string_view mjcf);

}  // namespace vsa::reader
