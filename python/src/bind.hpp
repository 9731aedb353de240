// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the module's files share. Each bind_…() adds its classes and functions; the module has no logic of its own: it asks the
// library, and turns what comes back into what Python knows.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsa/actuator/ledger.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_actuator_type(py::module_& m);
void bind_linearization(py::module_& m);
void bind_unit(py::module_& m);
void bind_unit_batch(py::module_& m);
void bind_world(py::module_& m);
void bind_batch(py::module_& m);
void bind_study(py::module_& m);
void bind_identify(py::module_& m);

/// The library's problems with the names of the function's arguments for the command's flags: {{"--cycles", "cycles"}}.
[[noreturn]] void rethrow_with_arguments(const InputError& error,
                                         std::initializer_list<std::pair<std::string_view, std::string_view>> names);

/// A dict, or its copy of any other Mapping. TypeError for anything else.
[[nodiscard]] py::dict dict_of(const py::object& mapping, const char* name);
/// {"drive.friction_Nm": 0.7} → overrides: numbers as the shortest text that reads back the same, switches as true and false, texts
/// as they are. None: empty. TypeError for anything else.
[[nodiscard]] std::vector<config::Override> settings(const py::object& set);
[[nodiscard]] std::string setting_text(const py::handle& value, const std::string& key);

/// A property of the class and its objects, with its text: pybind11's own loses that before Python 3.12.
void def_static_property(py::handle of, const char* name, const py::cpp_function& get, const char* doc);

/// The ledger's entries by their C++ names with _J behind.
[[nodiscard]] py::dict ledger_dict(const actuator::Ledger& ledger);

}  // namespace vsa::python
