// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Reading a file takes libsdformat some hundred milliseconds, looking whether it has changed some ten microseconds: what was read
// is kept, for the next World of the same file in this process, and so is what the engine made of it. Not the world itself: presets
// are read and robots built anew.
//
// The same file: the same name or text in the same working directory, the same search path (finder.hpp), the same engine and
// wish for concave meshes; nothing of what was read or looked for on the way has changed (seen_files.hpp). What had problems isn't kept, nor
// what was written within the last moment before it was read. Safe from several threads.
#pragma once

#include <memory>
#include <mutex>

#include "vsa/engine/world.hpp"
#include "vsa/physics/physics.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::engine {

class ReadWorld {
 public:
  std::shared_ptr<const physics::Engine> engine;  ///< that it was read for
  std::shared_ptr<const description::World> world;
  std::vector<std::string> warnings;

  /// As the engine's compile(); of steps the last is kept.
  [[nodiscard]] std::shared_ptr<const physics::CompiledWorld> compiled(double step_s, std::string_view file, Problems& problems);

 private:
  std::mutex compiling_;
  double step_s_ = 0;
  std::shared_ptr<const physics::CompiledWorld> compiled_;
};

/// As read_sdf() for the options' engine; never null.
[[nodiscard]] std::shared_ptr<ReadWorld> read_world(const reader::SdfSource& source, const WorldOptions& options,
                                                    Problems& problems);

}  // namespace vsa::engine
