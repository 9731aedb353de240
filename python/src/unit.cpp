// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One emulated unit without a line or a world: device::Unit with its state and a clock.
#include "vsa/device/unit.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "actuator_type.hpp"
#include "arrays.hpp"
#include "gil.hpp"
#include "unit_state.hpp"
#include "vsa/config/text.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {
namespace {

constexpr double kLongestStep_s = 1e-3 * (device::kMaxTicksPerStep - 1);

struct UnitSnapshot {
  device::UnitConfig config;
  device::UnitState state;
  std::int64_t time_ns = 0;
};

struct PyUnit {
  device::Unit unit;
  device::UnitState state;
  std::int64_t time_ns = 0;
  bool stepping = false;  ///< read and written with the GIL

  /// To be called after the arguments are converted: that runs Python, and another thread may step then.
  void refuse_others() const {
    if (stepping) throw std::runtime_error("the unit is being stepped in another thread: wait for that");
  }
  double step(std::int64_t dt_ns, const device::ShaftIn& in) {
    const double torque = unit.step(state, time_ns, dt_ns, in);
    time_ns += dt_ns;
    return torque;
  }
};

using Class = py::class_<PyUnit>;

void check(Problems& problems, const char* name, double value, double min, double max, const char* unit) {
  if (value >= min && value <= max) return;
  problems.add({"", name, config::number_text(value), "out of range", config::range_text(min, max) + unit});
}

std::int64_t step_ns(double dt_s, Problems& problems) {
  check(problems, "dt_s", dt_s, 1e-9, kLongestStep_s, " s");
  return problems.empty() ? std::llround(dt_s * 1e9) : 0;
}

constexpr double kFar = 1e6;  // rad, rad/s: beyond any shaft, and far from where an encoder's turns overflow

void check_inertia(double inverse, Problems& problems) { check(problems, "inverse_inertia", inverse, 0, 1e12, " 1/(kg·m²)"); }

PyUnit make(const PyActuatorType& type, double equilibrium, double preset, const std::optional<double>& shaft, bool powered) {
  Problems problems;
  const double q = shaft.value_or(equilibrium);
  check(problems, "equilibrium_rad", equilibrium, -kFar, kFar, " rad");
  check(problems, "preset", preset, -kFar, kFar, "");
  check(problems, "shaft_rad", q, -kFar, kFar, " rad");
  problems.throw_if_any();
  device::Unit unit(type.type.unit);
  auto state = powered ? unit.initial(equilibrium, preset, q) : unit.switched_on(q, 1, 0);
  return {std::move(unit), state};
}

double step(PyUnit& u, double dt_s, double q, double v, double inverse_inertia) {
  u.refuse_others();
  Problems problems;
  const std::int64_t dt_ns = step_ns(dt_s, problems);
  check(problems, "shaft_rad", q, -kFar, kFar, " rad");
  check(problems, "shaft_speed_rad_per_s", v, -kFar, kFar, " rad/s");
  check_inertia(inverse_inertia, problems);
  problems.throw_if_any();
  return u.step(dt_ns, {q, v, inverse_inertia});
}

/// One step an entry; Ctrl-C ends it between two.
py::array_t<double> follow(PyUnit& u, double dt_s, const py::object& shaft, const py::object& speed) {
  Problems problems;
  const std::int64_t dt_ns = step_ns(dt_s, problems);
  problems.throw_if_any();
  const std::vector<double> q = numbers(shaft, "shaft_rad");
  const std::vector<double> v = numbers(speed, q.size(), "shaft_speed_rad_per_s", true);
  for (std::size_t i = 0; i < q.size() && problems.empty(); ++i) {
    check(problems, "shaft_rad", q[i], -kFar, kFar, " rad");
    check(problems, "shaft_speed_rad_per_s", v[i], -kFar, kFar, " rad/s");
  }
  problems.throw_if_any();
  std::vector<double> torque(q.size());
  u.refuse_others();
  {
    const Mark stepping(u.stepping);
    OthersRun others;
    for (std::size_t i = 0; i < q.size(); ++i) {
      torque[i] = u.step(dt_ns, {q[i], v[i], 0});
      others.look();
    }
  }
  return copied(torque);
}

py::array pair(const std::array<double, 2>& values) { return py::array(py::cast(values)); }

py::dict readings(const PyUnit& u) {
  u.refuse_others();
  const device::UnitReading r = device::read(u.unit, u.state);
  const auto measured = device::measured(u.unit, u.state);
  py::dict out;
  out["equilibrium_rad"] = r.equilibrium_rad;
  out["preset"] = r.preset;
  out["shaft_rad"] = r.shaft_rad;
  out["shaft_speed_rad_per_s"] = r.shaft_speed_rad_per_s;
  out["deflection_rad"] = r.shaft_rad - r.equilibrium_rad;
  out["stiffness_Nm_per_rad"] = r.stiffness_Nm_per_rad;
  out["torque_Nm"] = r.torque_Nm;
  out["mean_torque_Nm"] = r.mean_torque_Nm;
  out["motor_rad"] = pair(r.motor_rad);
  out["motor_speed_rad_per_s"] = pair(r.motor_speed_rad_per_s);
  out["motor_torque_Nm"] = pair(r.motor_torque_Nm);
  out["current_A"] = pair(r.current_A);
  out["measured_ticks"] = py::array_t<std::int16_t>(3, std::array{measured[0].value, measured[1].value, measured[2].value}.data());
  return out;
}

std::array<int, 2> inputs_for(const PyUnit& u, double equilibrium, double preset) {
  Problems problems;
  check(problems, "equilibrium_rad", equilibrium, -kFar, kFar, " rad");
  check(problems, "preset", preset, -kFar, kFar, "");
  problems.throw_if_any();
  const auto ticks = u.unit.inputs_for(equilibrium, preset);
  return {ticks[0].value, ticks[1].value};
}

void set_inputs(PyUnit& u, const std::array<int, 2>& ticks) {
  u.refuse_others();
  Problems problems;
  for (const int t : ticks) check(problems, "ticks", t, INT16_MIN, INT16_MAX, "");
  if (u.unit.servo() != nullptr)
    problems.add(
        {"", "set_inputs", std::string(control::name_of(u.unit.servo()->params().kind)), "a servo has no SET_INPUTS", "command()"});
  problems.throw_if_any();
  u.unit.set_inputs(u.state, {Ticks{static_cast<std::int16_t>(ticks[0])}, Ticks{static_cast<std::int16_t>(ticks[1])}});
}

void command(PyUnit& u, double equilibrium, double preset) {
  u.refuse_others();
  static_cast<void>(inputs_for(u, equilibrium, preset));  // which checks them
  u.unit.command(u.state, equilibrium, preset);
}

void restore(PyUnit& u, const UnitSnapshot& s) {
  u.refuse_others();
  if (!device::alike(u.unit.config(), s.config))
    throw InputError({"", "snapshot", "", "is of a unit with other parameters", "one of this unit or of one alike"});
  u.state = s.state;
  u.time_ns = s.time_ns;
}

constexpr const char* kState =
    "The whole state with the unit's time as numbers: ndarray (n,) of float64, good for this unit and others with the same "
    "parameters.\n"
    "out: such an array, which is filled and returned. A copy either way.";
constexpr const char* kRestoreState =
    "Back to the numbers of state(), or of UnitBatch.state(), of a unit with these parameters, bit by bit: (n,) of float64.\n"
    "InputError: another shape, or numbers that no state has, with the name of the first one. TypeError: another dtype. Then\n"
    "nothing has changed.";

void bind_step(Class& c) {
  c.def("command", &command, py::arg("equilibrium_rad"), py::arg("preset") = 0.0,
        "References for equilibrium (rad) and stiffness preset (clamped to preset_max), as if SET_INPUTS had just arrived;\n"
        "a servo's command.")
      .def("set_inputs", &set_inputs, py::arg("ticks"), "The two references in the unit's ticks, int16, as SET_INPUTS brings them.")
      .def("inputs_for", &inputs_for, py::arg("equilibrium_rad"), py::arg("preset") = 0.0,
           "The ticks that command() would send: list of two int.")
      .def("step", &step, py::arg("dt_s"), py::arg("shaft_rad"), py::arg("shaft_speed_rad_per_s") = 0.0,
           py::arg("inverse_inertia") = 0.0,
           "One host step of dt_s (1 ns to 16 ms) with the shaft at that angle and speed at its start, and 1/(inertia behind the\n"
           "joint) in 1/(kg·m²), 0 where the motion is prescribed. Returns the mean torque on the shaft over the step, N·m; the "
           "host\n"
           "then moves by v += dt·τ/J, q += dt·v.")
      .def("follow", &follow, py::arg("dt_s"), py::arg("shaft_rad"), py::arg("shaft_speed_rad_per_s") = 0.0,
           "Steps of dt_s along a prescribed motion: shaft_rad (n,) and its speed, (n,) or one number, at the start of each. "
           "Returns\n"
           "the mean torques on the shaft, N·m: ndarray (n,). Other threads of Python run meanwhile; Ctrl-C ends it between two "
           "steps.");
}

void bind_state(Class& c) {
  c.def("readings", &readings,
        "What the unit is doing at the end of its last step: dict of floats, and of ndarray (2,) for the motors' angles (rad),\n"
        "speeds (rad/s), torques by their springs (N·m) and currents (A); measured_ticks (3,) int16 is what it would tell on its\n"
        "bus. Copies.")
      .def(
          "ledger",
          [](const PyUnit& u) {
            u.refuse_others();
            const actuator::Ledger now = u.state.actuator.ledger;
            return ledger_dict(now);
          },
          "Energy ledger since the start, J: dict, see World.ledger.")
      .def(
          "snapshot",
          [](const PyUnit& u) {
            u.refuse_others();
            return UnitSnapshot{u.unit.config(), u.state, u.time_ns};
          },
          "The whole state, as a value: UnitSnapshot.")
      .def("restore", &restore, py::arg("snapshot"),
           "Back to a snapshot of this unit or one with the same parameters, bit by bit. InputError for another's.")
      .def(
          "state",
          [](const PyUnit& u, const py::object& out) {
            u.refuse_others();
            return unit_state(u.state, u.time_ns, out);
          },
          py::arg("out") = py::none(), kState)
      .def(
          "restore_state",
          [](PyUnit& u, const py::object& state) {
            const TimedState at = unit_state_of(state);
            u.refuse_others();
            u.state = at.state;
            u.time_ns = at.time_ns;
          },
          py::arg("state"), kRestoreState)
      .def_property_readonly(
          "time_s",
          [](const PyUnit& u) {
            u.refuse_others();
            return seconds_of(u.time_ns);
          },
          "Its own time, s: the steps' sum.")
      .def("__repr__", [](const PyUnit& u) {
        return u.stepping ? std::string("<vsasim.Unit, being stepped>")
                          : "<vsasim.Unit at " + config::number_text(seconds_of(u.time_ns)) + " s>";
      });
}

}  // namespace

void bind_unit(py::module_& m) {
  const py::class_<UnitSnapshot> snapshot(m, "UnitSnapshot", "A unit's state at a moment; see Unit.snapshot.");
  Class c(
      m, "Unit",
      "One actuator with its firmware, without a bus and without a world (device::Unit in C++): the host's side is yours. It has\n"
      "a clock of its own, which each step moves on. A Unit belongs to one thread at a time: while one is in follow(), others get\n"
      "RuntimeError.");
  c.def(py::init(&make), py::arg("type"), py::arg("equilibrium_rad") = 0.0, py::arg("preset") = 0.0,
        py::arg("shaft_rad") = py::none(), py::arg("powered") = true,
        "type: ActuatorType. At rest on its references for equilibrium (rad) and preset, on for long, motors enabled, with the "
        "shaft\n"
        "at shaft_rad (default: the equilibrium). powered=False: just switched on, motors off, pulleys at 0.");
  bind_step(c);
  bind_state(c);
  def_static_property(
      c, "state_layout", [](const py::object&) { return unit_state_layout(); }, kUnitLayout);
}

}  // namespace vsa::python
