// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/engine/world.hpp"

namespace vsa::engine {

/// One of the files that a world becomes: a file name without a directory, and what is in it.
struct ExportedFile {
  std::string name,  ///< without a directory
      bytes;         ///< what is in it
};

/// A world in MuJoCo's format, with what else a World needs in a file beside it (vsa/physics/mjcf.hpp): loaded again it moves bit for
/// bit as this one. NAME is the stem of the file, or "world" for a text. Throws InputError with all problems, and for options that ask
/// for another step or other actuators than the file's.
[[nodiscard]] std::vector<ExportedFile> export_mjcf(const std::filesystem::path& world, const WorldOptions& options = {});

/// Whether an MJCF is the NAME.xml of an export_mjcf(), of this version or an earlier one, and nobody's own work.
[[nodiscard]] bool is_exported(std::string_view mjcf);

/// A world for MuJoCo with the plug-in, as export_plugin_mjcf() writes it.
struct PluginMjcf {
  ExportedFile file;               ///< NAME_plugin.xml
  std::vector<std::string> notes;  ///< what of the robots' elements MuJoCo can't be told
};

/// A world for a MuJoCo with vsasim's plug-in (docs/howto/mujoco.md): its MJCF, which names the same files as export_mjcf()'s, and for
/// each actuator an instance of vsasim.unit, its actuators and a sensor; a key "start" with the joints and controls of the first
/// sample. Of an SDF, a URDF or an MJCF. Throws InputError with all problems, and for options that ask for another step than the
/// file's.
/// `mjcf`: the MJCF of export_mjcf(), where that was made already.
[[nodiscard]] PluginMjcf export_plugin_mjcf(const std::filesystem::path& file, const WorldOptions& options = {},
                                            std::string mjcf = {});

/// The MJCF that World::load() reads of this path: the file itself or, in a build without SDF, the one that stands beside the SDF.
/// Empty: it reads SDF or URDF.
[[nodiscard]] std::filesystem::path mjcf_of(const std::filesystem::path& world);

}  // namespace vsa::engine
