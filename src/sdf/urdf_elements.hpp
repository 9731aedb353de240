// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What URDF's elements may hold. urdfdom passes over what it doesn't look for, a misspelt <colision> as well as a second <axis>.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "sdf/notes.hpp"

namespace vsa::reader {

/// Warns of elements and attributes of a <robot> that nobody reads, and of those given again that count once.
void check_urdf_elements(const tinyxml2::XMLElement& robot, const std::string& file, Notes& notes);

}  // namespace vsa::reader
