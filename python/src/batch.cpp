// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsasim.Batch: many copies of a world, their commands and readings as NumPy's views of the C++ memory.
#include "batch.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {
namespace {

using batch::Batch;

std::unique_ptr<Batch> make(PyWorld& world, py::ssize_t copies, py::ssize_t threads) {
  if (copies < 1) throw InputError({"", "copies", std::to_string(copies), "out of range", "1 or more"});
  const auto most = static_cast<py::ssize_t>(Batch::kMostThreads);
  if (threads < 0 || threads > most)
    throw InputError({"", "threads", std::to_string(threads), "out of range", "0 … " + std::to_string(most)});
  return world.alone([&](const engine::World& of, OthersRun&) {
    return std::make_unique<Batch>(of, static_cast<std::size_t>(copies), static_cast<std::size_t>(threads));
  });
}

}  // namespace

PyBatch::PyBatch(PyWorld& world, py::ssize_t copies, py::ssize_t threads)
    : batch_(make(world, copies, threads)), actuators(world.actuator_names()), joints(world.joint_names()) {
  for (const scene::LinkInfo& link : batch_->world().links()) links.push_back(link.name);
}

Batch& PyBatch::get() {
  if (stepping_) throw std::runtime_error("the batch is being stepped in another thread: wait for that");
  return *batch_;
}

void PyBatch::step(py::ssize_t n, const py::object& which) {
  if (n < 1 || n > 1'000'000'000) throw InputError({"", "n", std::to_string(n), "out of range", "1 … 1000000000 steps"});
  const std::vector<std::size_t> those = chosen(which);
  alone([&](Batch& batch, OthersRun& others) { batch.step(static_cast<int>(n), those, [&] { others.look(); }); });
}

std::vector<std::size_t> PyBatch::chosen(const py::object& which) const { return python::chosen(which, batch_->size(), "copy"); }

std::size_t PyBatch::copy(const py::handle& which) const { return index_of(which, batch_->size(), "copy"); }

namespace {

using Shared = std::shared_ptr<PyBatch>;

template <class Span>
py::array view_of(const Shared& b, Span&& numbers, const std::vector<std::size_t>& rest, bool writeable = false) {
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(b->any_thread().size())};
  for (const std::size_t n : rest) shape.push_back(static_cast<py::ssize_t>(n));
  return view(float64(), shape, numbers.data(), b, writeable);
}

py::array state(PyBatch& b, const py::object& which, const py::object& out) {
  const std::size_t copy = b.copy(which);
  py::array to = into(out, float64(), {static_cast<py::ssize_t>(b.any_thread().state(copy).size())});
  const std::span<const double> numbers = b.get().state(copy);
  std::copy(numbers.begin(), numbers.end(), static_cast<double*>(to.mutable_data()));
  return to;
}

void restore(PyBatch& b, const py::object& which, const py::object& given) {
  const std::size_t copy = b.copy(which);
  const auto numbers = state_numbers(given, b.any_thread().state(copy).size());
  b.get().restore(copy, std::span(numbers.data(), static_cast<std::size_t>(numbers.size())));
}

py::array_t<bool> status(PyBatch& b) {
  py::array_t<bool> out(static_cast<py::ssize_t>(b.any_thread().size()));
  const Batch& batch = b.get();
  for (std::size_t c = 0; c < batch.size(); ++c) out.mutable_data()[c] = batch.status(c) == batch::Status::failed;
  return out;
}

std::vector<std::pair<std::size_t, std::string>> take_notices(PyBatch& b) {
  std::vector<std::pair<std::size_t, std::string>> out;
  for (batch::Notice& n : b.get().take_notices()) out.emplace_back(n.copy, std::move(n.text));
  return out;
}

using Commands = std::span<double> (Batch::*)();

void bind_commands(BatchClass& c, const char* name, Commands which, const char* doc) {
  const auto get = [which](const Shared& b) { return view_of(b, (b->get().*which)(), {b->actuators.size()}, true); };
  const auto set = [which, name](const Shared& b, const py::object& value) {
    const auto copies = static_cast<py::ssize_t>(b->any_thread().size()), actuators = static_cast<py::ssize_t>(b->actuators.size());
    const std::vector<double> given = spread(value, {copies, actuators}, name);
    std::copy(given.begin(), given.end(), (b->get().*which)().begin());
  };
  c.def_property(name, get, set, doc);
}

using Readings = std::span<const double> (Batch::*)() const;

void bind_readings(BatchClass& c) {
  const auto add = [&c](const char* name, Readings which, auto&& rest, const char* doc) {
    c.def_property_readonly(
        name, [which, rest](const Shared& b) { return view_of(b, (b->get().*which)(), rest(*b)); }, doc);
  };
  using Shape = std::vector<std::size_t>;
  const auto copies = [](const PyBatch&) { return Shape{}; };
  const auto actuators = [](const PyBatch& b) { return Shape{b.actuators.size()}; };
  const auto motors = [](const PyBatch& b) { return Shape{b.actuators.size(), 2}; };
  const auto joints = [](const PyBatch& b) { return Shape{b.joints.size()}; };
  add("time_s", &Batch::time_s, copies, "Simulated time, s: (copies,), a read-only view.");
  add("shaft_rad", &Batch::shaft_rad, actuators, "Shaft angle, rad: (copies, actuators), a read-only view, as all readings.");
  add("shaft_speed_rad_per_s", &Batch::shaft_speed_rad_per_s, actuators, "Its speed, rad/s: (copies, actuators).");
  add("torque_Nm", &Batch::torque_Nm, actuators, "Torque on the shaft, N·m: (copies, actuators).");
  add("stiffness_Nm_per_rad", &Batch::stiffness_Nm_per_rad, actuators, "Stiffness there, N·m/rad: (copies, actuators).");
  add("motor_rad", &Batch::motor_rad, motors, "Motors' angles behind their gears, rad: (copies, actuators, 2).");
  add("joint_position", &Batch::joint_position, joints, "Of the joints with one axis, rad or m: (copies, joints).");
  add("joint_speed", &Batch::joint_speed, joints, "Their speeds, rad/s or m/s: (copies, joints).");
  c.def_property_readonly(
      "poses",
      [](const Shared& b) {
        return view_of(b, b->get().poses(), {b->links.size(), 7});
      },
      "Poses of the links in the world: (copies, links, 7), x y z in m and the quaternion w x y z.");
}

void bind_names(BatchClass& c) {
  c.def(
       "__len__", [](const PyBatch& b) { return b.any_thread().size(); }, "How many copies there are.")
      .def_property_readonly(
          "threads", [](const PyBatch& b) { return b.any_thread().threads(); },
          "How many threads step, the caller's one of them: int.")
      .def_readonly("actuators", &PyBatch::actuators, "Names of a copy's actuators, as World.actuators: list of str.")
      .def_readonly("joints", &PyBatch::joints, "Names of its joints with one axis, as World.joints: list of str.")
      .def_readonly("links", &PyBatch::links, "Names of its links, as World.links: list of str.")
      .def("__repr__", [](const PyBatch& b) {
        return "<vsasim.Batch of " + std::to_string(b.any_thread().size()) + " × " + b.any_thread().world().name() + ">";
      });
}

constexpr const char* kBatch =
    "Copies of a world as it is, with its hands (pulls, wrenches, torques), stepped by several threads. At first all have its\n"
    "parameters; set() and randomize() give each its own. Each goes bit for bit as a World by itself would that has them. Commands "
    "and readings are NumPy's views of the C++ memory: they show the present, and "
    "keep\n"
    "the Batch alive. Commands that no step has taken aren't copied. While one thread steps, everything else here raises\n"
    "RuntimeError in the others; leave views that they have alone until then. After os.fork() the child has the "
    "copies\n"
    "as they were, and steps them with threads of its own.";
constexpr const char* kInit =
    "copies: 1 or more; threads: how many step, the caller's one of them, 0 … 1024; 0: as many as the machine has. InputError,\n"
    "MemoryError.";
constexpr const char* kStep =
    "n World steps, 1 … 1e9, of every copy or of those in `which`: indices (k,), or a mask (copies,) of bool. `equilibrium` and\n"
    "`preset` are commanded as it begins. A copy that fails (a blow-up) is marked in `status`, stays where it was before that "
    "step\n"
    "and isn't stepped any more until it is set anew; the others go on, and nothing is raised. Other threads of Python run\n"
    "meanwhile. Ctrl-C ends it with KeyboardInterrupt where all chosen copies have made equally many whole World steps; it is "
    "looked\n"
    "for about 20 times a second, but only after each 4096 World steps of all copies together, and 10 of each. InputError: an\n"
    "infinite command, n out of range, a `which` of another dtype or shape, a copy named twice; IndexError: no such copy. Nothing "
    "is\n"
    "stepped then.";
constexpr const char* kNotices =
    "What was clamped or couldn't be resolved, and energy out of nothing, since the last call: list of (copy, str), by copies. "
    "Each is\n"
    "told once until its copy is reset; not what the World had told before. Of a copy that nobody asks of for long the first 32 "
    "are\n"
    "kept, and a line that says so.";
constexpr const char* kRestore =
    "That copy goes on, with its own parameters, from the numbers of World.state() or Batch.state() of a world of this file: (n,) "
    "of\n"
    "float64. InputError and\n"
    "TypeError as World.restore_state, IndexError: no such copy; nothing has changed then.";

}  // namespace

void bind_batch(py::module_& m) {
  BatchClass c(m, "Batch", kBatch);
  c.def(py::init<PyWorld&, py::ssize_t, py::ssize_t>(), py::arg("world"), py::arg("copies"), py::arg("threads") = 0, kInit)
      .def("step", &PyBatch::step, py::arg("n") = 1, py::arg("which") = py::none(), kStep)
      .def("restore", &restore, py::arg("copy"), py::arg("state"), kRestore)
      .def("state", &state, py::arg("copy"), py::arg("out") = py::none(),
           "A copy's state as numbers, as World.state: ndarray (n,). out: such an array, which is filled and returned. A copy.")
      .def_property_readonly("status", &status, "Which copies have failed: ndarray (copies,) of bool, True: failed. A copy.")
      .def(
          "failure",
          [](PyBatch& b, const py::object& which) {
            const std::size_t copy = b.copy(which);
            return b.get().failure(copy);
          },
          py::arg("copy"), "Why that copy failed: str; empty: it didn't.")
      .def("take_notices", &take_notices, kNotices);
  bind_batch_parameters(m, c);
  bind_names(c);
  bind_commands(
      c, "equilibrium", &Batch::equilibrium,
      "Equilibria that each step() commands as it begins, rad: (copies, actuators), a writeable view. NaN, as it begins: what\n"
      "was commanded before stays. Assigning fills it with what broadcasts.");
  bind_commands(c, "preset", &Batch::preset, "Presets, in the law's unit: as `equilibrium`.");
  bind_readings(c);
}

}  // namespace vsa::python
