// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A complete file of an actuator type with the identified values: every other value, every bound and source as it was.
#pragma once

#include <string>
#include <vector>

#include "vsa/identify/task.hpp"

namespace vsa::identify {

/// A changed value and what its source shall say.
struct Identified {
  std::string key;     ///< "elastic.k1_Nm"
  double value = 0;    ///< the new value
  std::string source;  ///< where it came from, with its interval
};

/// TOML text of a type called `name`. Its [evidence] is the type's with what the identification was
/// `fitted` to. The text has been read back by `library` before it is returned: throws InputError if it isn't a valid type.
[[nodiscard]] std::string type_text(const config::ActuatorType& type, const std::string& name,
                                    const std::vector<Identified>& changes, const config::Evidence& fitted,
                                    const config::TypeLibrary& library);

/// The type's evidence, and what it was now fitted to.
[[nodiscard]] config::Evidence evidence_with(const std::optional<config::Evidence>& before, const config::Evidence& fitted);

}  // namespace vsa::identify
