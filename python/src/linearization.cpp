// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What linearize() of a type and of a world give: matrices, signals, poles, responses.
#include "linearization.hpp"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>

#include "arrays.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

py::list signals(const std::vector<linear::Signal>& all) {
  py::list out;
  for (const linear::Signal& s : all) out.append(py::make_tuple(s.name, s.unit));
  return out;
}

py::object loaded(const std::string& json) { return py::module_::import("json").attr("loads")(json); }

/// Read-only: a model is what it is.
py::array matrix(const Eigen::MatrixXd& m) {
  py::array out = py::cast(m);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

template <class Enum>
Enum word_of(const std::string& given, const char* name, std::initializer_list<Enum> all) {
  std::vector<std::string> words;
  for (const Enum e : all) {
    if (given == study::word(e)) return e;
    words.emplace_back(study::word(e));
  }
  throw InputError({"", name, given, "unknown", config::join(words)});
}

linear::Firmware firmware_of(const std::string& given) {
  using linear::Firmware;
  return word_of(given, "firmware", {Firmware::frozen, Firmware::averaged, Firmware::sampled});
}

linear::DryFriction friction_of(const std::string& given) {
  return word_of(given, "friction", {linear::DryFriction::sliding, linear::DryFriction::stuck});
}

constexpr std::array<const char*, 4> kPole{"s", "frequency_Hz", "damping_ratio", "shape"};

py::dict pole_dict(const linear::System& system) {
  const std::vector<linear::Pole> all = linear::poles(system);
  const auto n = static_cast<py::ssize_t>(all.size());
  py::array_t<std::complex<double>> s(n);
  py::array_t<double> frequency(n), ratio(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const linear::Pole& p = all[static_cast<std::size_t>(i)];
    s.mutable_at(i) = p.s;
    frequency.mutable_at(i) = p.frequency_Hz;
    ratio.mutable_at(i) = p.damping_ratio;
  }
  py::dict out;
  const std::array<py::object, 4> values{s, frequency, ratio, py::cast(linear::shapes(system))};
  for (std::size_t i = 0; i < kPole.size(); ++i) out[kPole[i]] = values[i];
  return out;
}

py::dict unit_response(const linear::Model& model, const std::vector<double>& frequencies) {
  const auto n = static_cast<py::ssize_t>(frequencies.size());
  py::array_t<std::complex<double>> impedance(n), compliance(n);
  py::array_t<double> stiffness(n), damping(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const linear::Response r = linear::response(model, frequencies[static_cast<std::size_t>(i)]);
    impedance.mutable_at(i) = r.impedance;
    compliance.mutable_at(i) = r.compliance;
    stiffness.mutable_at(i) = r.stiffness_Nm_per_rad;
    damping.mutable_at(i) = r.damping_Nms_per_rad;
  }
  py::dict out;
  out["frequency_Hz"] = py::array(py::cast(frequencies));
  out["impedance"] = impedance;
  out["compliance"] = compliance;
  out["stiffness_Nm_per_rad"] = stiffness;
  out["damping_Nms_per_rad"] = damping;
  return out;
}

py::dict robot_response(const linear::RobotModel& model, const std::vector<double>& frequencies) {
  const auto n = static_cast<py::ssize_t>(frequencies.size());
  const py::ssize_t joints = model.torques;
  py::array_t<std::complex<double>> impedance({n, joints, joints}), compliance({n, joints, joints}), own({n, joints});
  for (py::ssize_t i = 0; i < n; ++i) {
    const linear::RobotResponse r = linear::response(model, frequencies[static_cast<std::size_t>(i)]);
    for (py::ssize_t j = 0; j < joints; ++j) {
      for (py::ssize_t k = 0; k < joints; ++k) {
        impedance.mutable_at(i, j, k) = r.impedance(j, k);
        compliance.mutable_at(i, j, k) = r.compliance(j, k);
      }
      own.mutable_at(i, j) = r.driving_point[j];
    }
  }
  py::dict out;
  out["frequency_Hz"] = py::array(py::cast(frequencies));
  out["impedance"] = impedance;
  out["compliance"] = compliance;
  out["driving_point"] = own;
  return out;
}

/// What both have; `System`: where the matrices are.
template <class Of, class System>
void bind_system(py::class_<Of>& c, System system) {
  const auto matrix_of = [&](const char* name, auto member, const char* doc) {
    c.def_property_readonly(
        name, [system, member](const Of& l) { return matrix(system(l).*member); }, doc);
  };
  matrix_of("A", &linear::System::a,
            "ndarray (states, states): ẋ = A x + B u; sampled: x(k+1) = A x(k) + B u(k). Read-only, as B, C, D.");
  matrix_of("B", &linear::System::b, "ndarray (states, inputs).");
  matrix_of("C", &linear::System::c, "ndarray (outputs, states): y = C x + D u.");
  matrix_of("D", &linear::System::d, "ndarray (outputs, inputs).");
  c.def_property_readonly(
       "states", [system](const Of& l) { return signals(system(l).states); }, "list of (name, unit), in the order of A's rows.")
      .def_property_readonly(
          "inputs", [system](const Of& l) { return signals(system(l).inputs); },
          "list of (name, unit), in the order of B's columns.")
      .def_property_readonly(
          "outputs", [system](const Of& l) { return signals(system(l).outputs); },
          "list of (name, unit), in the order of C's rows.")
      .def_property_readonly(
          "period_s", [system](const Of& l) { return system(l).period_s; },
          "Sampled: from one row of x(k) to the next, s; else 0: float.")
      .def_property_readonly(
          "notices", [system](const Of& l) { return system(l).notices; },
          "What makes this point special or is left out, as the command prints it: list of str.")
      .def_property_readonly(
          "poles", [system](const Of& l) { return pole_dict(system(l)); },
          "dict of s (n,), complex, 1/s, those with Im s ≥ 0 by frequency (sampled: ln(z)/T); frequency_Hz (n,), |s|/2π; "
          "damping_ratio\n"
          "(n,), −Re s/|s|; shape (states, n), complex: how the states share in each, columns of length 1.")
      .def(
          "results", [](const Of& l) { return loaded(study::to_json(l, "vsasim")); },
          "What the command's results.json holds, with the point: dict.");
}

constexpr const char* kUnitDoc =
    "An actuator type about a point of rest, from ActuatorType.linearize: deviations from the point as a linear system.";
constexpr const char* kUnitResponse =
    "What answers a sinusoidal torque at the shaft, at frequencies (n,) in Hz or one number: dict of arrays (n,): impedance τ/q̇,\n"
    "complex, N·m·s/rad, with the inertia; compliance q/τ, complex, rad/(N·m); stiffness_Nm_per_rad and damping_Nms_per_rad of "
    "the\n"
    "actuator alone; frequency_Hz. InputError for a frequency that isn't above 0, sampled: and below half the loop's rate.";
constexpr const char* kWorldDoc =
    "All joints of a world that move with its actuators about a point of rest, from World.linearize, as a linear system.";
constexpr const char* kWorldResponse =
    "What answers sinusoidal torques at the joints, at frequencies (n,) in Hz or one number: dict of complex arrays: impedance Z\n"
    "(n, joints, joints), τ = Z q̇, N·m·s/rad; compliance (n, joints, joints), q_i over τ_j with the other joints free, rad/(N·m);\n"
    "driving_point (n, joints), what a torque at one joint feels there; and frequency_Hz (n,). InputError as "
    "Linearization.response.";

py::list joints(const study::WorldLinearization& l) {
  py::list out;
  const linear::RobotModel& m = l.world.model;
  for (std::size_t j = 0; j < m.bodies.joints.size(); ++j) {
    const linear::BodyJoint& joint = m.bodies.joints[j];
    out.append(py::dict(py::arg("name") = joint.name, py::arg("prismatic") = joint.prismatic, py::arg("angle_rad") = joint.angle,
                        py::arg("gravity_torque_Nm") = l.world.gravity_torque[j],
                        py::arg("outside_torque_Nm") = l.world.outside_torque[j]));
  }
  return out;
}

template <class Of, class Get>
void matrix_property(py::class_<Of>& c, const char* name, const char* doc, Get get) {
  c.def_property_readonly(
      name, [get](const Of& l) { return matrix(get(l)); }, doc);
}

}  // namespace

study::Linearization linearized(const PyActuatorType& type, const linear::OperatingPoint& point, const std::string& firmware,
                                const std::string& friction) {
  if (point.shaft_rad && point.load_Nm != 0)
    throw InputError({"", "load_Nm", config::number_text(point.load_Nm),
                      "isn't free: what holds the shaft at shaft_rad is the load", "0, or no shaft_rad"});
  study::LinearizationOptions options;
  options.specimen.type = type.name;
  options.specimen.overrides = type.overrides;
  options.point = point;
  options.firmware = firmware_of(firmware);
  options.friction = friction_of(friction);
  return study::linearize(options);
}

study::WorldLinearization linearized(const engine::World& world, const linear_world::WorldPoint& point, const std::string& firmware,
                                     const std::string& friction) {
  return study::linearize(world, point, firmware_of(firmware), friction_of(friction));
}

void bind_linearization(py::module_& m) {
  py::class_<study::Linearization> unit(m, "Linearization", kUnitDoc);
  bind_system(unit, [](const study::Linearization& l) -> const linear::System& { return l.model; });
  unit.def(
          "response",
          [](const study::Linearization& l, const py::object& f) {
            return unit_response(l.model, numbers(py::array(py::module_::import("numpy").attr("atleast_1d")(f)), "frequency_Hz"));
          },
          py::arg("frequency_Hz"), kUnitResponse)
      .def_property_readonly(
          "held_stiffness_Nm_per_rad", [](const study::Linearization& l) { return l.model.held_stiffness_Nm_per_rad; },
          "At the shaft with the pulleys held: float.")
      .def_property_readonly(
          "static_stiffness_Nm_per_rad", [](const study::Linearization& l) { return l.model.static_stiffness_Nm_per_rad; },
          "At the shaft at rest, with motors that yield as the firmware lets them: float; 0 where it is frozen.")
      .def_property_readonly(
          "rest", [](const study::Linearization& l) -> py::object { return loaded(study::to_json(l, ""))["point"]; },
          "The point: dict of shaft_rad, equilibrium_rad, preset, load_torque_Nm that holds the shaft, inertia, damping, and of "
          "each\n"
          "motor pulley_rad, motor_V, motor_A. Keys as in results.json.");
  py::class_<study::WorldLinearization> world(m, "WorldLinearization", kWorldDoc);
  bind_system(world, [](const study::WorldLinearization& l) -> const linear::System& { return l.world.model; });
  world
      .def(
          "response",
          [](const study::WorldLinearization& l, const py::object& f) {
            return robot_response(l.world.model,
                                  numbers(py::array(py::module_::import("numpy").attr("atleast_1d")(f)), "frequency_Hz"));
          },
          py::arg("frequency_Hz"), kWorldResponse)
      .def_property_readonly("joints", &joints,
                             "The model's joints: list of dicts of name (its actuator's, if it has one), prismatic, angle_rad,\n"
                             "gravity_torque_Nm that its weight asks for, outside_torque_Nm that has to be given that it stays.");
  const auto model = [](auto member) { return [member](const study::WorldLinearization& l) { return l.world.model.*member; }; };
  matrix_property(world, "mass", "M: ndarray (joints, joints), kg·m². Read-only, as those below.",
                  [](const study::WorldLinearization& l) { return l.world.model.bodies.mass; });
  matrix_property(world, "gravity_stiffness", "∂/∂q of the joints' gravity torques: ndarray (joints, joints), N·m/rad.",
                  [](const study::WorldLinearization& l) { return l.world.model.bodies.gravity_stiffness; });
  matrix_property(world, "held_stiffness", "Gravity's, springs' and units' with pulleys held: ndarray (joints, joints), N·m/rad.",
                  model(&linear::RobotModel::held_stiffness));
  matrix_property(world, "static_stiffness", "The same at rest, with motors that yield: ndarray (joints, joints), N·m/rad.",
                  model(&linear::RobotModel::static_stiffness));
}

}  // namespace vsa::python
