// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Owning handles of MuJoCo's objects, and how its global hooks are set: MuJoCo prints warnings, writes MUJOCO_LOG.TXT and ends the
// process on errors unless told otherwise.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

namespace vsa::physics {

struct ModelDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
};
struct DataDeleter {
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;
using DataPtr = std::unique_ptr<mjData, DataDeleter>;

struct VirtualFile {
  std::string name, bytes;
};

/// Compiles XML from memory, with the files that it names. Null and a reason where MuJoCo refuses it; what it warns of goes to
/// `warnings`, if there are any.
[[nodiscard]] ModelPtr compile(const std::string& xml, const std::vector<VirtualFile>& named, std::string& reason,
                               std::vector<std::string>* warnings = nullptr);
/// The same of a file on the disk, with those that it names.
[[nodiscard]] ModelPtr load_file(const std::string& path, std::string& reason, std::vector<std::string>* warnings = nullptr);

}  // namespace vsa::physics
