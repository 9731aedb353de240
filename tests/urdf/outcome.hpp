// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a URDF comes to, read by urdfdom alone and, where this build has it, by libsdformat.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sdf/urdf_plainly.hpp"
#include "vsa/physics/mujoco.hpp"
#include "vsa/physics/physics.hpp"
#include "vsa/sdf/read.hpp"

namespace vsa::reader::testing {

/// A description, or what is wrong.
struct Outcome {
  description::World world;
  std::string problems;  ///< empty: none
  std::vector<std::string> warnings;
};

template <class Read>
Outcome outcome_of(Read read, const SdfSource& source, Concave concave, ImpossibleInertia impossible) {
  Outcome out;
  SeenFiles seen;
  const Finder finder(SearchPath({}), seen);
  Problems problems;
  out.world =
      read(source, ReadOptions{physics::mujoco()->capabilities(), concave, impossible}, finder, seen, out.warnings, problems);
  try {
    problems.throw_if_any();
  } catch (const InputError& error) {
    out.problems = error.what();
  }
  return out;
}

/// By urdfdom.
inline Outcome plainly(const SdfSource& source, Concave concave = Concave::refuse,
                       ImpossibleInertia impossible = ImpossibleInertia::refuse) {
  return outcome_of(read_urdf_plainly, source, concave, impossible);
}

/// By the reader that this build has.
inline Outcome ordinarily(const SdfSource& source, Concave concave = Concave::refuse,
                          ImpossibleInertia impossible = ImpossibleInertia::refuse) {
  return outcome_of(read_sdf, source, concave, impossible);
}

/// Robots that no file is worth: name → text.
[[nodiscard]] std::map<std::string, std::string> robots();

}  // namespace vsa::reader::testing
