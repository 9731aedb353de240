// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "bind.hpp"
#include "vsa/config/text.hpp"

namespace vsa::python {

std::string setting_text(const py::handle& value, const std::string& key) {
  if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value) ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value);
  const py::handle number = py::module_::import("numbers").attr("Real");
  if (py::isinstance(value, number)) return config::number_text(py::cast<double>(value));
  throw py::type_error(key + ": " + std::string(py::str(py::type::handle_of(value))) + " (allowed: int, float, bool, str)");
}

py::dict dict_of(const py::object& mapping, const char* name) {
  if (!py::isinstance(mapping, py::module_::import("collections.abc").attr("Mapping")))
    throw py::type_error(std::string(name) + ": " + std::string(py::str(py::type::of(mapping))) + " (allowed: a dict)");
  return py::dict(mapping);
}

std::vector<config::Override> settings(const py::object& set) {
  std::vector<config::Override> out;
  if (set.is_none()) return out;
  for (const auto& [key, value] : dict_of(set, "set")) {
    const std::string name = py::str(key);
    out.push_back({name, setting_text(value, name)});
  }
  return out;
}

py::dict ledger_dict(const actuator::Ledger& l) {
  py::dict out;
  out["supply_J"] = l.supply;
  out["copper_J"] = l.copper;
  out["bridge_J"] = l.bridge;
  out["conversion_J"] = l.conversion;
  out["viscous_J"] = l.viscous;
  out["motor_friction_J"] = l.motor_friction;
  out["shaft_friction_J"] = l.shaft_friction;
  out["tendon_friction_J"] = l.tendon_friction;
  out["delivered_J"] = l.delivered;
  out["integrator_J"] = l.integrator;
  out["pending_J"] = l.pending;
  out["coupling_J"] = l.coupling;
  out["kinetic_J"] = l.kinetic;
  out["magnetic_J"] = l.magnetic;
  out["elastic_J"] = l.elastic;
  out["bristle_J"] = l.bristle;
  out["shaft_bristle_J"] = l.shaft_bristle;
  out["tendon_bristle_J"] = l.tendon_bristle;
  out["stored_J"] = l.stored();
  out["stored_at_start_J"] = l.stored_at_start;
  out["moved_J"] = l.moved();
  out["imbalance_J"] = l.imbalance();
  return out;
}

void def_static_property(py::handle of, const char* name, const py::cpp_function& get, const char* doc) {
  const py::handle base(reinterpret_cast<PyObject*>(py::detail::get_internals().static_property_type));
  const py::handle type(reinterpret_cast<PyObject*>(&PyType_Type));
  // Made by Python, so that its objects have a dict for the text; the type's own text, None, would hide one given to a property.
  py::object made = type("static_property", py::make_tuple(base), py::dict())(get);
  made.attr("__doc__") = doc;
  py::setattr(of, name, made);
}

}  // namespace vsa::python
