// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Mass matrix, forces and energies of a world.
#include <map>

#include "arrays.hpp"
#include "linearization.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

using Fill = void (engine::World::*)(std::span<double>) const;

py::array filled(PyWorld& w, const py::object& out, Fill fill, bool matrix) {
  const auto n = static_cast<py::ssize_t>(w.any_thread().dof_count());
  py::array to = into(out, float64(), matrix ? std::vector<py::ssize_t>{n, n} : std::vector<py::ssize_t>{n});
  (w.get().*fill)({static_cast<double*>(to.mutable_data()), static_cast<std::size_t>(to.size())});
  return to;
}

py::array jacobian(PyWorld& w, const std::string& link, const py::object& point, const py::object& out) {
  const auto at = numbers<3>(point, "point_m");
  py::array to = into(out, float64(), {6, static_cast<py::ssize_t>(w.any_thread().dof_count())});
  const engine::World& world = w.get();
  world.jacobian(world.link(link), at, {static_cast<double*>(to.mutable_data()), static_cast<std::size_t>(to.size())});
  return to;
}

void apply_wrench(PyWorld& w, const std::string& link, const py::object& force, const py::object& torque, const py::object& point) {
  const engine::Wrench wrench{numbers<3>(force, "force_N"), numbers<3>(torque, "torque_Nm"), numbers<3>(point, "point_m")};
  engine::World& world = w.get();
  world.apply_wrench(world.link(link), wrench);
}

py::dict energy(PyWorld& w) {
  const scene::Energy e = w.get().energy();
  return py::dict(py::arg("kinetic_J") = e.kinetic, py::arg("gravitational_J") = e.gravitational, py::arg("springs_J") = e.springs);
}

py::tuple zeros() { return py::make_tuple(0.0, 0.0, 0.0); }

void bind_matrices(WorldClass& c) {
  c.def_property_readonly(
       "dof_count", [](PyWorld& w) { return w.get().dof_count(); },
       "Degrees of freedom: int. joint_info() and free_dof() tell whose they are; in all below M v̇ + bias = torques.")
      .def(
          "free_dof", [](PyWorld& w, const std::string& link) { return w.get().free_dof(w.get().link(link)); }, py::arg("link"),
          "The first of six of a link that flies free (velocity in world axes, angular velocity in its own): int, or None.")
      .def(
          "mass_matrix", [](PyWorld& w, const py::object& out) { return filled(w, out, &engine::World::mass_matrix, true); },
          py::arg("out") = py::none(), "M: ndarray (dof_count, dof_count), symmetric. out: such an array, which is filled. A copy.")
      .def(
          "bias_torques", [](PyWorld& w, const py::object& out) { return filled(w, out, &engine::World::bias_torques, false); },
          py::arg("out") = py::none(),
          "What has to be given for v̇ = 0 against gravity and the motion's own forces, without springs and contacts: ndarray\n"
          "(dof_count,). out as above.")
      .def(
          "gravity_torques",
          [](PyWorld& w, const py::object& out) { return filled(w, out, &engine::World::gravity_torques, false); },
          py::arg("out") = py::none(), "The bias at rest: ndarray (dof_count,). out as above.")
      .def("jacobian", &jacobian, py::arg("link"), py::arg("point_m") = zeros(), py::arg("out") = py::none(),
           "ndarray (6, dof_count): velocity of a point (3,) of the link, m in its frame, then angular velocity, both in world "
           "axes.");
}

double number_of(const py::handle& given, const char* name) {
  py::detail::make_caster<double> number;
  if (!number.load(given, true))
    throw py::type_error(std::string(name) + ": " + std::string(py::str(py::type::handle_of(given))) + " (allowed: a number)");
  return py::detail::cast_op<double>(number);
}

linear_world::Named named(const py::object& given, const char* name) {
  std::map<std::string, double> out;  // in the order of names, whatever the dict's
  if (given.is_none()) return {};
  for (const auto& [key, value] : dict_of(given, name)) {
    if (!py::isinstance<py::str>(key)) throw py::type_error(std::string(name) + ": " + std::string(py::str(key)) + " is no name");
    out.emplace(py::cast<std::string>(key), number_of(value, name));
  }
  return {out.begin(), out.end()};
}

constexpr const char* kLinearize =
    "All joints that move with the world's actuators about a point of rest, as `vsa linearize WORLD` does: WorldLinearization. "
    "angles:\n"
    "dict of joint or actuator to rad (prismatic: m), where they don't stand as now. preset: of all, or dict of actuator to "
    "preset;\n"
    "None: as attained now. equilibrium_rad: dict of actuator to rad; of the others the one that carries the joint's weight. "
    "firmware,\n"
    "friction: as ActuatorType.linearize. The world isn't changed. InputError: what the command refuses; SimulationError.";

study::WorldLinearization linearize(PyWorld& w, const py::object& angles, const py::object& preset, const py::object& equilibria,
                                    const std::string& firmware, const std::string& friction) {
  linear_world::WorldPoint point;
  point.angles = named(angles, "angles");
  point.equilibria_rad = named(equilibria, "equilibrium_rad");
  if (py::hasattr(preset, "keys")) {
    point.presets = named(preset, "preset");
  } else if (!preset.is_none()) {
    point.preset = number_of(preset, "preset");
  }
  return linearized(w.get(), point, firmware, friction);
}

}  // namespace

void bind_world_dynamics(WorldClass& c) {
  bind_matrices(c);
  c.def("apply_wrench", &apply_wrench, py::arg("link"), py::arg("force_N") = zeros(), py::arg("torque_Nm") = zeros(),
        py::arg("point_m") = zeros(),
        "Force (3,) at a point (3,) of the link and torque (3,), both in world axes, in every step from the next on until set "
        "anew;\n"
        "zero ends it. No part of the state.")
      .def(
          "apply_torque",
          [](PyWorld& w, const std::string& joint, double torque) { w.get().apply_torque(w.get().joint(joint), torque); },
          py::arg("joint"), py::arg("torque_Nm"),
          "The same on a joint with one axis, N·m (N on a prismatic one), beside its actuator.")
      .def("linearize", &linearize, py::kw_only(), py::arg("angles") = py::none(), py::arg("preset") = py::none(),
           py::arg("equilibrium_rad") = py::none(), py::arg("firmware") = "averaged", py::arg("friction") = "sliding", kLinearize)
      .def("energy", &energy, "Of all bodies, J: dict of kinetic_J, gravitational_J and springs_J (the file's own joint springs).");
}

}  // namespace vsa::python
