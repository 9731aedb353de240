// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "actuator_type.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "linearization.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/inverse.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {
namespace {

using Class = py::class_<PyActuatorType>;

py::object value_of(const config::Entry& e) {
  switch (e.kind) {
    case config::Kind::toggle:
      return py::bool_(e.number != 0);
    case config::Kind::integer:
      return py::int_(static_cast<long long>(e.number));
    case config::Kind::word:
    case config::Kind::file:
      return py::str(e.value);
    case config::Kind::number:
      break;
  }
  return py::float_(e.number);
}

py::dict entry_dict(const config::Entry& e) {
  py::dict out;
  out["key"] = e.key;
  out["value"] = value_of(e);
  out["unit"] = e.unit;
  out["bounds"] = e.bounds;
  const bool bounded = e.kind == config::Kind::number || e.kind == config::Kind::integer;
  out["min"] = bounded ? py::object(py::float_(e.min)) : py::none();
  out["max"] = bounded ? py::object(py::float_(e.max)) : py::none();
  out["meaning"] = e.meaning;
  out["source"] = e.source;
  return out;
}

elastic::Response at_rest(const PyActuatorType& t, double q, double equilibrium, double preset) {
  const elastic::Transmission& law = t.law();
  return law.evaluate({q, law.references({equilibrium, preset})});
}

py::tuple command_for(const PyActuatorType& t, double q, double torque, double stiffness) {
  const elastic::Command found = elastic::command_for(t.law(), {q, torque, stiffness}, t.type.unit.preset_max);
  if (!found.found()) {
    throw InputError({"", "command_for", config::number_text(stiffness) + " N·m/rad at " + config::number_text(torque) + " N·m",
                      found.text(), ""});
  }
  return py::make_tuple(found.command.equilibrium, found.command.preset);
}

void bind_parameters(Class& c) {
  c.def(
       "keys",
       [](const PyActuatorType& t) {
         std::vector<std::string> out;
         for (const config::Entry& e : t.type.entries) out.push_back(e.key);
         return out;
       },
       "Names of all parameters, as \"drive.friction_Nm\": list of str.")
      .def(
          "entry", [](const PyActuatorType& t, const std::string& key) { return entry_dict(t.entry(key)); }, py::arg("key"),
          "One parameter: dict of key, value, unit, bounds, min, max (None for words and switches), meaning and source.")
      .def(
          "get", [](const PyActuatorType& t, const std::string& key) { return value_of(t.entry(key)); }, py::arg("key"),
          "A parameter's value in the unit that its key ends with: float, int, bool or str. InputError: no such key.")
      .def(
          "set",
          [](PyActuatorType& t, const std::string& key, const py::object& value) {
            t.set({{key, setting_text(value, key)}});
          },
          py::arg("key"), py::arg("value"),
          "Sets a parameter, in its key's unit, with the checks and texts of `vsa run --set`. InputError: no such key, out of its\n"
          "bounds; then nothing has changed.")
      .def(
          "update", [](PyActuatorType& t, const py::object& values) { t.set(settings(dict_of(values, "values"))); },
          py::arg("values"), "Sets several parameters, all or none: dict of key to value.")
      .def("__getitem__", [](const PyActuatorType& t, const std::string& key) { return value_of(t.entry(key)); })
      .def("__setitem__",
           [](PyActuatorType& t, const std::string& key, const py::object& value) {
             t.set({{key, setting_text(value, key)}});
           })
      .def_property_readonly(
          "overrides",
          [](const PyActuatorType& t) {
            py::dict out;
            for (const auto& o : t.overrides) out[py::str(o.key)] = o.value;
            return out;
          },
          "What was set: dict of key to text; World.load(set=...) takes it.");
}

void bind_texts(Class& c) {
  c.def_property_readonly(
       "name", [](const PyActuatorType& t) { return t.type.name; }, "The type's name: str.")
      .def_property_readonly(
          "title", [](const PyActuatorType& t) { return t.type.title; }, "One line: str.")
      .def_property_readonly(
          "description", [](const PyActuatorType& t) { return t.type.description; }, "Some lines, may be empty: str.")
      .def_property_readonly(
          "file", [](const PyActuatorType& t) { return t.type.file.string(); }, "Where it was read: str.")
      .def_property_readonly(
          "law_name", [](const PyActuatorType& t) { return t.type.law; }, "The elastic law's name, as \"two_sinh\": str.")
      .def_property_readonly(
          "preset_unit", [](const PyActuatorType& t) { return std::string(t.type.unit.preset_unit()); },
          "Unit of the stiffness preset: str; empty where there is none.")
      .def_property_readonly(
          "shaft_unit", [](const PyActuatorType& t) { return std::string(t.type.unit.actuator.transmission->shaft_unit()); },
          "\"rad\", or of a linear actuator \"m\", whose readings are in m and N then: str.")
      .def_property_readonly(
          "controller", [](const PyActuatorType& t) { return t.type.controller; },
          "\"qbmove\", \"position_servo\", \"torque_servo\" or \"motor_voltages\": str.")
      .def_property_readonly(
          "preset_max", [](const PyActuatorType& t) { return t.type.unit.preset_max; },
          "Largest stiffness preset that a command may have, in preset_unit: float.")
      .def_property_readonly(
          "reference_range_rad",
          [](const PyActuatorType& t) {
            std::vector<std::array<double, 2>> out;
            for (int i = 0; i < t.law().motor_count(); ++i) {
              const auto range = t.type.unit.reference_range_raw(i);
              out.push_back({radians(Raw{range[0]}), radians(Raw{range[1]})});
            }
            return py::array(py::cast(out));
          },
          "Least and largest reference that the program lets each motor have, rad: ndarray (motors, 2).")
      .def("__repr__", [](const PyActuatorType& t) {
        return "<vsasim.ActuatorType " + t.name + (t.overrides.empty() ? ">" : ", " + std::to_string(t.overrides.size()) + " set>");
      });
}

void check_finite(const char* name, double value) {
  if (!std::isfinite(value)) throw InputError({"", name, config::number_text(value), "not finite", "a finite number"});
}

RealArray finite_array(const py::object& given, const char* name) {
  RealArray out = real_array(given, name);
  for (py::ssize_t i = 0; i < out.size(); ++i) check_finite(name, out.data()[i]);
  return out;
}

void bind_law(Class& c) {
  const auto vectorized = [](double (*of)(const elastic::Response&)) {
    return [of](const PyActuatorType& t, const py::object& shaft, const py::object& equilibrium, const py::object& preset) {
      const auto f = [&t, of](double q, double e, double p) { return of(at_rest(t, q, e, p)); };
      const RealArray q = finite_array(shaft, "shaft_rad"), e = finite_array(equilibrium, "equilibrium_rad"),
                      p = finite_array(preset, "preset");
      const auto shape_of = [](const RealArray& a) { return std::string(py::str(a.attr("shape"))); };
      try {
        return py::vectorize(f)(q, e, p);
      } catch (const std::runtime_error&) {
        throw InputError({"", "shaft_rad, equilibrium_rad, preset", shape_of(q) + ", " + shape_of(e) + ", " + shape_of(p),
                          "don't broadcast", "NumPy's rules"});
      }
    };
  };
  const auto add = [&](const char* name, const char* doc, double (*of)(const elastic::Response&)) {
    c.def(name, vectorized(of), py::arg("shaft_rad"), py::arg("equilibrium_rad") = 0.0, py::arg("preset") = 0.0, doc);
  };
  add("torque_Nm",
      "The law alone, motors at rest on their references: torque on the shaft, N·m. Arguments are numbers or arrays of shapes "
      "that\n"
      "broadcast (shaft and equilibrium in rad, preset in preset_unit); float, or ndarray of the common shape.",
      [](const elastic::Response& r) { return r.torque; });
  add("stiffness_Nm_per_rad", "Stiffness ∂²H/∂q² of the law alone, N·m/rad. Arguments and result as torque_Nm.",
      [](const elastic::Response& r) { return r.curvature.qq; });
  add("energy_J", "Energy H stored in the springs, J. Arguments and result as torque_Nm.",
      [](const elastic::Response& r) { return r.energy; });
  c.def(
       "references",
       [](const PyActuatorType& t, double equilibrium, double preset) {
         for (const auto& [name, value] : {std::pair{"equilibrium_rad", equilibrium}, std::pair{"preset", preset}})
           check_finite(name, value);
         return py::array(py::cast(t.law().references({equilibrium, preset})));
       },
       py::arg("equilibrium_rad"), py::arg("preset"), "Motor references of a command, rad: ndarray (2,).")
      .def(
          "attained",
          [](const PyActuatorType& t, const py::object& motor_rad) {
            const auto found = t.law().attained(numbers<2>(motor_rad, "motor_rad"));
            return py::make_tuple(found.equilibrium, found.preset);
          },
          py::arg("motor_rad"),
          "The inverse of references(): the command (equilibrium in rad, preset) that motors at (2,) rad amount to. Springs that\n"
          "are alike rest there unloaded; of unequal ones it is the pulleys' mean, beside which the shaft rests.")
      .def(
          "command_for", &command_for, py::arg("shaft_rad"), py::arg("torque_Nm"), py::arg("stiffness_Nm_per_rad"),
          "The command (equilibrium in rad, preset) that gives this torque and stiffness with the shaft at that angle. InputError\n"
          "with the range that can be reached, where this can't.")
      .def(
          "equilibrium_for",
          [](const PyActuatorType& t, double q, double torque, double preset) {
            for (const auto& [name, value] :
                 {std::pair{"shaft_rad", q}, std::pair{"torque_Nm", torque}, std::pair{"preset", preset}})
              check_finite(name, value);
            return elastic::equilibrium_for(t.law(), q, torque, preset);
          },
          py::arg("shaft_rad"), py::arg("torque_Nm"), py::arg("preset") = 0.0,
          "The equilibrium, rad, that gives this torque at a preset with the shaft at that angle: float; None where it isn't\n"
          "reached within a turn.");
}

constexpr const char* kLinearize =
    "The type about a point of rest, as `vsa linearize TYPE` does: Linearization. Equilibrium and preset are attained ones; the "
    "shaft\n"
    "stands at shaft_rad, or where load_Nm puts it: one of the two. inertia_kgm2: of all that the shaft turns; None: the type's\n"
    "flange. firmware: \"frozen\" (inputs are the motors' voltages), \"averaged\" or \"sampled\" (their references). friction:\n"
    "\"sliding\" (dry friction left out) or \"stuck\" (its presliding). InputError: what the command refuses, with its texts.";

void bind_linearize(Class& c) {
  c.def(
      "linearize",
      [](const PyActuatorType& t, const std::optional<double>& shaft, double equilibrium, double preset, double load,
         const std::optional<double>& inertia, double damping, const std::string& firmware, const std::string& friction) {
        return linearized(t, {equilibrium, preset, shaft, load, inertia, damping}, firmware, friction);
      },
      py::kw_only(), py::arg("shaft_rad") = py::none(), py::arg("equilibrium_rad") = 0.0, py::arg("preset") = 0.0,
      py::arg("load_Nm") = 0.0, py::arg("inertia_kgm2") = py::none(), py::arg("damping_Nms_per_rad") = 0.0,
      py::arg("firmware") = "averaged", py::arg("friction") = "sliding", kLinearize);
}

}  // namespace

PyActuatorType PyActuatorType::load(const std::string& name, std::vector<config::Override> overrides) {
  config::ActuatorType type = config::TypeLibrary().load(name, overrides);
  return {name, std::move(overrides), std::move(type)};
}

void PyActuatorType::set(const std::vector<config::Override>& values) {
  std::vector<config::Override> all = overrides;
  for (const config::Override& v : values) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const config::Override& o) { return o.key == v.key; });
    if (same == all.end()) {
      all.push_back(v);
    } else {
      same->value = v.value;
    }
  }
  *this = load(name, std::move(all));
}

const config::Entry& PyActuatorType::entry(const std::string& key) const {
  for (const config::Entry& e : type.entries)
    if (e.key == key) return e;
  std::vector<std::string> keys;
  for (const config::Entry& e : type.entries) keys.push_back(e.key);
  throw InputError({type.file.string(), key, "", "no such parameter", config::join(keys)});
}

void bind_actuator_type(py::module_& m) {
  Class c(
      m, "ActuatorType",
      "An actuator type: its parameters with units, bounds and sources, and its elastic law (class config::ActuatorType in C++).\n"
      "The unit of a parameter is at the end of its key.");
  c.def_static(
       "load", [](const std::string& name, const py::object& set) { return PyActuatorType::load(name, settings(set)); },
       py::arg("name"), py::arg("set") = py::none(),
       "Reads a type by its name (see list()). set: dict of parameters to replace. InputError: no such type, or all that is wrong\n"
       "with its file and `set`.")
      .def_static(
          "list", [] { return config::TypeLibrary().names(); }, "Names of all types that are found: list of str.");
  bind_parameters(c);
  bind_texts(c);
  bind_law(c);
  bind_linearize(c);
}

}  // namespace vsa::python
