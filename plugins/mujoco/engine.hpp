// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The MuJoCo of the program that loads the plug-in. Its library isn't linked: programs have it under many names and places (a wheel,
// an installation, in themselves), and one of another version must be refused with a word, not by a linker's error. So the functions
// that the units call are found in what is loaded already, and only if its version is the one that this library was compiled for,
// since the layout of mjModel and mjData is.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

namespace vsa::mujoco {

struct Engine {
  int (*mjp_registerPlugin)(const mjpPlugin*) = nullptr;
  const mjpPlugin* (*mjp_getPlugin)(const char*, int*) = nullptr;
  const char* (*mj_getPluginConfig)(const mjModel*, int, const char*) = nullptr;
  void (*mju_warning)(const char*, ...) = nullptr;
};

/// Of find_engine(); null functions before it, and where it found none.
[[nodiscard]] const Engine& engine() noexcept;

/// Empty: engine() and what the units call is there. Else why not, as one line.
[[nodiscard]] std::string find_engine();

/// "3.2.3" of 323, "3.12.1" of 3012001.
[[nodiscard]] std::string version_text(int version);

}  // namespace vsa::mujoco
