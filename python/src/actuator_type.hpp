// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bind.hpp"

namespace vsa::python {

/// A type and the values that were put into it. Every change reads the type anew, so that all checks are the library's.
struct PyActuatorType {
  std::string name;
  std::vector<config::Override> overrides;
  config::ActuatorType type;

  [[nodiscard]] static PyActuatorType load(const std::string& name, std::vector<config::Override> overrides);
  /// All or nothing.
  void set(const std::vector<config::Override>& values);
  [[nodiscard]] const config::Entry& entry(const std::string& key) const;  ///< throws InputError with the keys there are
  [[nodiscard]] const elastic::Transmission& law() const { return *type.unit.actuator.transmission; }
};

}  // namespace vsa::python
