// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsasim.UnitBatch: units with a lever on each shaft (device::LeverBatch), as NumPy's views of the C++ memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "actuator_type.hpp"
#include "arrays.hpp"
#include "gil.hpp"
#include "unit_state.hpp"
#include "vsa/device/lever_batch.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {
namespace {

using device::Lever;
using device::LeverBatch;

struct PyUnitBatch {
  LeverBatch levers;
  device::Unit unit;      // reads states
  bool stepping = false;  // read and written with the GIL

  /// To be asked after the arguments are converted: that runs Python, and another thread may step then.
  [[nodiscard]] LeverBatch& get() {
    if (stepping) throw std::runtime_error("the units are being stepped in another thread: wait for that");
    return levers;
  }
};

using Shared = std::shared_ptr<PyUnitBatch>;
using Class = py::class_<PyUnitBatch, Shared>;

std::string text(const py::handle& thing) { return py::str(thing); }

void set_levers(PyUnitBatch& b, const py::object& inertia, const py::object& damping, const py::object& gravity) {
  const std::size_t n = b.levers.size();
  const auto j = numbers(inertia, n, "inertia_kgm2", true), d = numbers(damping, n, "damping_Nms_per_rad", true),
             g = numbers(gravity, n, "gravity_Nm", true);
  LeverBatch& to = b.get();
  std::vector<Lever> before;
  for (std::size_t i = 0; i < to.size(); ++i) before.push_back(to.lever(i));
  for (std::size_t i = 0; i < to.size(); ++i) {
    try {
      to.set_lever(i, {j[i], d[i], g[i]});
    } catch (...) {  // nothing half done
      for (std::size_t k = 0; k < i; ++k) to.set_lever(k, before[k]);
      throw;
    }
  }
}

Shared make(const PyActuatorType& type, py::ssize_t units, const py::object& inertia, const py::object& damping,
            const py::object& gravity, const std::string& instructions) {
  constexpr py::ssize_t kMost = 10'000'000;
  if (units < 1 || units > kMost)
    throw InputError({"", "units", std::to_string(units), "out of range", "1 … " + std::to_string(kMost)});
  const device::UnitConfig config = type.type.unit;  // another thread may set the type's meanwhile
  Shared made;
  {
    const OthersRun others_run;
    made = std::make_shared<PyUnitBatch>(
        PyUnitBatch{LeverBatch(config, static_cast<std::size_t>(units), Lever{}, instructions), device::Unit(config)});
  }
  set_levers(*made, inertia, damping, gravity);
  return made;
}

void step(PyUnitBatch& b, py::ssize_t n, double dt_s) {
  LeverBatch& levers = b.get();
  if (n < 1 || n > 1'000'000'000) throw InputError({"", "n", std::to_string(n), "out of range", "1 … 1000000000 steps"});
  if (!(dt_s >= 1e-9 && dt_s <= 0.016)) throw InputError({"", "dt_s", text(py::float_(dt_s)), "out of range", "1e-09 … 0.016 s"});
  const Mark stepping(b.stepping);
  OthersRun others;
  levers.step(static_cast<int>(n), std::llround(dt_s * 1e9), [&] { others.look(); });
}

void reset(PyUnitBatch& b, const py::object& which, const py::object& equilibrium, const py::object& preset,
           const py::object& shaft, const py::object& speed) {
  const std::vector<std::size_t> those = chosen(which, b.levers.size(), "unit");
  std::vector<bool> seen(b.levers.size());
  for (const std::size_t i : those) {
    if (seen[i]) throw InputError({"", "which", std::to_string(i), "is named twice", "each unit once"});
    seen[i] = true;
  }
  const auto q = numbers(equilibrium, those.size(), "equilibrium_rad", true), p = numbers(preset, those.size(), "preset", true);
  const auto at = shaft.is_none() ? q : numbers(shaft, those.size(), "shaft_rad", true);
  const auto v = numbers(speed, those.size(), "shaft_speed_rad_per_s", true);
  LeverBatch& levers = b.get();
  for (std::size_t k = 0; k < those.size(); ++k) levers.check_reset(those[k], q[k], p[k], at[k], v[k]);
  for (std::size_t k = 0; k < those.size(); ++k) levers.reset(those[k], q[k], p[k], at[k], v[k]);
}

void restore(PyUnitBatch& b, const py::object& which, const py::object& given) {
  const std::size_t unit = index_of(which, b.levers.size(), "unit");
  const TimedState at = unit_state_of(given);
  b.get().restore(unit, at.state, at.time_ns);
}

/// Of read(): what device::read() tells, and what Unit.readings() adds to that.
struct Row {
  device::UnitReading now;
  double deflection_rad = 0;
  std::array<std::int16_t, 3> measured{};
  std::int16_t padding = 0;  // so that equal rows are equal bytes
};

py::dtype reading_dtype() {
  using device::UnitReading;
#define FIELD(name) \
  { #name, offsetof(UnitReading, name) }
#define PAIR(name) \
  { #name, offsetof(UnitReading, name), 2 }
  return record_dtype({FIELD(equilibrium_rad),
                       FIELD(preset),
                       FIELD(shaft_rad),
                       FIELD(shaft_speed_rad_per_s),
                       {"deflection_rad", offsetof(Row, deflection_rad)},
                       FIELD(stiffness_Nm_per_rad),
                       FIELD(torque_Nm),
                       FIELD(mean_torque_Nm),
                       PAIR(motor_rad),
                       PAIR(motor_speed_rad_per_s),
                       PAIR(motor_torque_Nm),
                       PAIR(current_A),
                       {"measured_ticks", offsetof(Row, measured), 3, "i2"}},
                      sizeof(Row));
#undef FIELD
#undef PAIR
}
static_assert(offsetof(Row, now) == 0 && sizeof(Row) == sizeof(device::UnitReading) + 16, "offsets of `now` are the row's");

py::array read(PyUnitBatch& b, const py::object& out) {
  py::array rows = into(out, reading_dtype(), {static_cast<py::ssize_t>(b.levers.size())});
  const LeverBatch& levers = b.get();
  auto* to = static_cast<Row*>(rows.mutable_data());
  for (std::size_t i = 0; i < levers.size(); ++i) {
    const device::UnitState state = levers.state(i);
    const device::UnitReading now = device::read(b.unit, state);
    const auto ticks = device::measured(b.unit, state);
    to[i] = {now, now.shaft_rad - now.equilibrium_rad, {ticks[0].value, ticks[1].value, ticks[2].value}};
  }
  return rows;
}

template <class Get>
void bind_commands(Class& c, const char* name, Get which, const char* doc) {
  const auto get = [which](const Shared& b) {
    const std::span<double> numbers = (b->get().*which)();
    return view(float64(), {static_cast<py::ssize_t>(numbers.size())}, numbers.data(), b, true);
  };
  const auto set = [which, name](const Shared& b, const py::object& value) {
    const std::vector<double> given = spread(value, {static_cast<py::ssize_t>(b->levers.size())}, name);
    std::copy(given.begin(), given.end(), (b->get().*which)().begin());
  };
  c.def_property(name, get, set, doc);
}

template <class Get>
void bind_readings(Class& c, const char* name, Get which, const char* doc) {
  c.def_property_readonly(
      name,
      [which](const Shared& b) {
        const std::span<const double> numbers = (b->get().*which)();
        return view(float64(), {static_cast<py::ssize_t>(numbers.size())}, numbers.data(), b);
      },
      doc);
}

constexpr const char* kClass =
    "Many units of one type, each with a lever on its shaft: no bodies, no bus (device::LeverBatch in C++).\n\n"
    "    J q'' = torque - d q' - G sin q + push\n\n"
    "They go side by side in the machine's vectors, and each bit for bit as it would alone. Commands and readings are NumPy's "
    "views\n"
    "of the C++ memory, (units,), which keep the UnitBatch alive. While one thread steps, others get RuntimeError.";
constexpr const char* kInit =
    "type: ActuatorType; units: 1 … 1e7. inertia_kgm2 (J > 0), damping_Nms_per_rad (d >= 0), gravity_Nm (G = m g l): (units,) or "
    "one\n"
    "number. instructions: '', the fastest here, or one of UnitBatch.instruction_sets(): the bits are the same. All begin at rest "
    "at "
    "0,\n"
    "preset 0.";
constexpr const char* kReset =
    "Every unit, or those in `which` (indices or a mask): at rest on its references for equilibrium_rad and preset, on for long, "
    "the\n"
    "shaft at shaft_rad (default: the equilibrium) with that speed. (k,) or one number each. What stands in `equilibrium` and "
    "`preset`\n"
    "is commanded with the next step as ever. InputError, IndexError: none of them was reset.";

constexpr const char* kRead =
    "What the units are doing at the end of the last step, as Unit.readings() tells of one: structured ndarray (units,), with two\n"
    "numbers for each motor's angles (rad), speeds (rad/s), torques by their springs (N·m) and currents (A): read()[\"current_A\"] "
    "is\n"
    "(units, 2). Its dtype is UnitBatch.reading_dtype. out: such an array, which is filled and returned. A copy.";
constexpr const char* kState =
    "A unit's state, with the batch's time, as numbers: ndarray (n,) of float64, which restore() and Unit.restore_state() take. "
    "out:\n"
    "such an array, which is filled and returned. A copy. Not in it: the lever, and commands that no step has taken. IndexError: "
    "no such unit.";
constexpr const char* kRestore =
    "A unit back to the numbers of state(), or of Unit.state(), of a unit with these parameters: (n,) of float64. The batch's "
    "time\n"
    "stays; the motion is the same bit by bit where steps meet the ticks of 1 ms as they did. What stands in `equilibrium`, "
    "`preset`\n"
    "and `push` is given with the next step as ever; what it was (NaN) is what the unit's references stand for, of a command "
    "beyond\n"
    "its range no more than it holds: such a one, where it still stands there, is given once more. InputError, TypeError as\n"
    "Unit.restore_state, IndexError: no such unit; nothing has changed then.";

}  // namespace

void bind_unit_batch(py::module_& m) {
  Class c(m, "UnitBatch", kClass);
  c.def(py::init(&make), py::arg("type"), py::arg("units"), py::arg("inertia_kgm2") = 1e-3, py::arg("damping_Nms_per_rad") = 0.0,
        py::arg("gravity_Nm") = 0.0, py::arg("instructions") = "", kInit)
      .def("step", &step, py::arg("n") = 1, py::arg("dt_s") = 1e-3,
           "n steps of dt_s (1 ns to 16 ms); `equilibrium`, `preset` and `push` are taken as it begins. Other threads of Python "
           "run\n"
           "meanwhile; Ctrl-C ends it between two steps of all. InputError: out of range, commands beyond ±1e6; and where a lever\n"
           "would fly beyond 1e6 rad or rad/s: it stays where it was, the others have made that step, and none follows.")
      .def("reset", &reset, py::arg("which") = py::none(), py::arg("equilibrium_rad") = 0.0, py::arg("preset") = 0.0,
           py::arg("shaft_rad") = py::none(), py::arg("shaft_speed_rad_per_s") = 0.0, kReset)
      .def("set_levers", &set_levers, py::arg("inertia_kgm2"), py::arg("damping_Nms_per_rad") = 0.0, py::arg("gravity_Nm") = 0.0,
           "Other levers from the next step on: (units,) or one number each.")
      .def("read", &read, py::arg("out") = py::none(), kRead)
      .def(
          "state",
          [](PyUnitBatch& b, const py::object& unit, const py::object& out) {
            const std::size_t which = index_of(unit, b.levers.size(), "unit");
            const LeverBatch& levers = b.get();
            return unit_state(levers.state(which), levers.units().time_ns(), out);
          },
          py::arg("unit"), py::arg("out") = py::none(), kState)
      .def("restore", &restore, py::arg("unit"), py::arg("state"), kRestore)
      .def("__len__", [](const PyUnitBatch& b) { return b.levers.size(); })
      .def_property_readonly(
          "instructions", [](const PyUnitBatch& b) { return b.levers.units().instructions(); }, "The instruction set in use: str.")
      .def_property_readonly(
          "width", [](const PyUnitBatch& b) { return b.levers.units().width(); },
          "How many units go side by side: int; 1 where the type has no lanes.")
      .def_property_readonly(
          "time_s", [](PyUnitBatch& b) { return b.get().time_s(); }, "Simulated time, s.")
      .def_static("instruction_sets", &device::UnitBatch::instruction_sets, "Those that this machine has: list of str.");
  def_static_property(
      c, "reading_dtype", [](const py::object&) { return reading_dtype(); }, "The dtype of read(): numpy.dtype.");
  def_static_property(
      c, "state_layout", [](const py::object&) { return unit_state_layout(); }, kUnitLayout);
  bind_commands(c, "equilibrium", &LeverBatch::equilibrium,
                "Equilibria that step() commands, rad: (units,), writeable. NaN, as at first: what was commanded before stays.");
  bind_commands(c, "preset", &LeverBatch::preset, "Presets, in the law's unit: as `equilibrium`.");
  bind_commands(c, "push", &LeverBatch::push, "External torques about +q, N·m: (units,), writeable; at first 0.");
  bind_readings(c, "shaft_rad", &LeverBatch::shaft_rad, "Shaft angle, rad: (units,), a read-only view, as all readings.");
  bind_readings(c, "shaft_speed_rad_per_s", &LeverBatch::shaft_speed_rad_per_s, "Its speed, rad/s.");
  bind_readings(c, "torque_Nm", &LeverBatch::torque_Nm, "The unit's mean torque on the shaft over the last step, N·m.");
}

}  // namespace vsa::python
