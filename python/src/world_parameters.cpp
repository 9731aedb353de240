// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a World's actuators and links may change between steps.
#include <array>
#include <optional>

#include "actuator_type.hpp"
#include "arrays.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

void set_parameters(PyWorld& w, const py::object& which, const PyActuatorType& type) {
  const engine::ActuatorRef& a = w.actuator(which);
  auto changed = std::make_shared<host::Settings>();
  for (const config::Override& o : type.overrides) changed->emplace_back(o.key, o.value);
  w.get().robot(a.robot).set_parameters(a.index, type.type.unit, type.name, std::move(changed));
}

py::dict link_parameters(PyWorld& w, const std::string& link) {
  const engine::LinkParameters p = w.get().link_parameters(w.get().link(link));
  return py::dict(py::arg("mass_kg") = p.mass_kg, py::arg("inertia_kgm2") = copied({p.inertia_kgm2.begin(), p.inertia_kgm2.end()}),
                  py::arg("friction") = p.friction);
}

void set_link_parameters(PyWorld& w, const std::string& name, std::optional<double> mass_kg, const py::object& inertia_kgm2,
                         std::optional<double> friction) {
  std::optional<std::array<double, 3>> moments;
  if (!inertia_kgm2.is_none()) moments = numbers<3>(inertia_kgm2, "inertia_kgm2");
  engine::World& world = w.get();
  const engine::LinkHandle link = world.link(name);
  engine::LinkParameters p = world.link_parameters(link);
  if (mass_kg) p.mass_kg = *mass_kg;
  if (moments) p.inertia_kgm2 = *moments;
  if (friction) p.friction = friction;
  world.set_link_parameters(link, p);
}

}  // namespace

void bind_world_parameters(WorldClass& c) {
  c.def("set_parameters", &set_parameters, py::arg("actuator"), py::arg("type"),
        "Other parameters from the next step on, from an ActuatorType with the same firmware and number of motors. reset() and\n"
        "restore() keep them.")
      .def("link_parameters", &link_parameters, py::arg("link"),
           "What a link weighs and how it rubs now: dict of mass_kg, inertia_kgm2 (ndarray (3,), principal moments) and friction "
           "(of its\n"
           "collision shapes; where they differ, the largest; None: it has none).")
      .def("set_link_parameters", &set_link_parameters, py::arg("link"), py::kw_only(), py::arg("mass_kg") = py::none(),
           py::arg("inertia_kgm2") = py::none(), py::arg("friction") = py::none(),
           "Others from the next step on; None keeps. A mass leaves the inertia as it is. reset() and restore() keep them.\n"
           "InputError: out of range, moments that no body has, mass of a static link, friction of one without shapes.");
}

}  // namespace vsa::python
