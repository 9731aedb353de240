// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "world.hpp"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <utility>

#include "arrays.hpp"
#include "vsa/config/text.hpp"
#include "vsa/engine/run.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {

PyWorld::PyWorld(engine::World world) : world_(std::move(world)) {
  for (const engine::ActuatorRef& a : world_.actuators()) actuator_names_.push_back(world_.name_of(a));
  for (const engine::JointInfo& j : world_.joints()) {
    if (!j.one_axis()) continue;
    joint_names_.push_back(j.name);
    joints_.push_back(world_.joint(j.name));
  }
}

engine::World& PyWorld::get() {
  if (stepping_) throw std::runtime_error("the world is being stepped in another thread: wait for that, or clone() before");
  return world_;
}

void PyWorld::step(std::size_t n) {
  const std::vector<Recorder> recorders = recorders_;  // those of its beginning, which live as long as it
  alone([&](engine::World& world, OthersRun& others) {
    for (std::size_t i = 0; i < n; ++i) {
      world.step();
      for (const Recorder& recorder : recorders) recorder->sample(world);
      others.look();
    }
  });
}

void PyWorld::run(double duration_s) {
  const std::vector<Recorder> recorders = recorders_;
  alone([&](engine::World& world, OthersRun& others) {
    (void)engine::run(world, duration_s, [&] {
      for (const Recorder& recorder : recorders) recorder->sample(world);
      others.look();
      return true;
    });
  });
}

void PyWorld::sample() {
  for (const Recorder& recorder : recorders_) recorder->sample(world_);
}

void PyWorld::reset() {
  get().reset();
  sample();
}

void PyWorld::detach(const Recorder& recorder) {
  recorders_.erase(std::remove(recorders_.begin(), recorders_.end(), recorder), recorders_.end());
}

const engine::ActuatorRef& PyWorld::actuator(const py::object& which) {
  if (py::isinstance<py::str>(which)) return world_.actuator(py::cast<std::string>(which));
  if (!py::hasattr(which, "__index__")) throw py::type_error("actuator: neither a name nor an index");
  const auto& all = world_.actuators();
  return all[index_of(which, all.size(), "actuator")];
}

namespace {

using Snapshot = engine::World::Snapshot;

/// Held by a class of its own, as World::Snapshot is incomplete here.
struct PySnapshot {
  std::shared_ptr<const Snapshot> held;
  double time_s = 0;
};

std::ptrdiff_t word_of(const char* key, const std::string& given, const std::vector<std::string>& words) {
  const auto word = std::find(words.begin(), words.end(), given);
  if (word == words.end()) throw InputError({"", key, given, "unknown", config::join(words)});
  return word - words.begin();
}

engine::WorldOptions options_of(const std::optional<double>& step_s, const std::optional<std::string>& type, const py::object& set,
                                const std::string& concave, const std::string& impossible_inertia) {
  engine::WorldOptions out;
  out.step_s = step_s;
  out.actuator.type = type;
  out.actuator.overrides = settings(set);
  out.actuator.flag = "set";
  out.concave = static_cast<engine::Concave>(word_of("concave", concave, {"refuse", "hull", "decompose"}));
  out.impossible_inertia =
      static_cast<engine::ImpossibleInertia>(word_of("impossible_inertia", impossible_inertia, {"refuse", "lower"}));
  if (type) (void)out.types.load(*type, out.actuator.overrides);  // its problems, once and by their own names
  return out;
}

template <class Source, class Load>
std::shared_ptr<PyWorld> load(const Source& source, engine::WorldOptions options, const Load& how) {
  std::optional<engine::World> world;
  {
    const OthersRun others_run;
    world.emplace(how(source, std::move(options)));
  }
  return std::make_shared<PyWorld>(std::move(*world));
}

constexpr const char* kLoad =
    "Loads an SDF or URDF file, or a built-in world by its name (\"bench_load\").\n"
    "step_s: length of a step, s; default: the file's. type: puts this actuator type on every actuator. set: dict of parameters "
    "to\n"
    "replace (\"drive.friction_Nm\": 0.7), checked as `vsa run --set` does. concave: what to do with collision meshes that aren't\n"
    "convex: \"refuse\", \"hull\" or \"decompose\". impossible_inertia: what to do with inertias whose largest principal moment is "
    "more\nthan the sum of the others: \"refuse\" or \"lower\" it. InputError with every problem at once.";

template <class Source, class Load>
auto loader(Load how) {
  return [how](const Source& source, const std::optional<double>& step_s, const std::optional<std::string>& type,
               const py::object& set, const std::string& concave, const std::string& impossible_inertia) {
    return load(source, options_of(step_s, type, set, concave, impossible_inertia), how);
  };
}

void bind_load(WorldClass& c) {
  const auto with = [&](const char* name, auto loads, const char* source, const char* doc) {
    c.def_static(name, loads, py::arg(source), py::kw_only(), py::arg("step_s") = py::none(), py::arg("type") = py::none(),
                 py::arg("set") = py::none(), py::arg("concave") = "refuse", py::arg("impossible_inertia") = "refuse", doc);
  };
  with("load", loader<std::filesystem::path>(engine::World::load), "file", kLoad);
  with("load_string", loader<std::string>(engine::World::load_string), "sdf", "The same from the text of an SDF or URDF.");
}

void bind_time(WorldClass& c) {
  c.def(
       "step",
       [](PyWorld& w, py::ssize_t n) {
         if (n < 0) throw InputError({"", "n", std::to_string(n), "out of range", "0 or more steps"});
         w.step(static_cast<std::size_t>(n));
       },
       py::arg("n") = 1,
       "n steps. Other threads of Python run meanwhile; Ctrl-C ends it between two steps. SimulationError where it blows up: the\n"
       "world is then where it was before that step.")
      .def("run", &PyWorld::run, py::arg("duration_s"),
           "Whole steps until duration_s more has passed, 0 to 1e9 s; a part of a step counts as one. As step() otherwise.")
      .def("reset", &PyWorld::reset, "Back to the first sample; hands, wrenches and torques end.")
      .def(
          "make_initial", [](PyWorld& w) { w.get().make_initial(); }, "Makes the present state the one that reset() returns to.")
      .def_property_readonly(
          "time_s", [](PyWorld& w) { return w.get().time_s(); }, "Simulated time, s: float.")
      .def_property_readonly(
          "time_ns", [](PyWorld& w) { return w.get().time_ns(); }, "Simulated time, ns: int, exact.")
      .def_property_readonly(
          "step_s", [](PyWorld& w) { return w.any_thread().step_s(); }, "Length of a step, s: float.")
      .def_property_readonly(
          "substeps", [](PyWorld& w) { return w.any_thread().substeps(); }, "Substeps of a step: int, see <substeps>.");
}

void bind_state(py::module_& m, WorldClass& c) {
  py::class_<PySnapshot>(m, "Snapshot", "A world's state at a moment; see World.snapshot.")
      .def_readonly("time_s", &PySnapshot::time_s, "Simulated time that it was taken at, s: float.");
  c.def(
       "snapshot",
       [](PyWorld& w) {
         return PySnapshot{w.get().snapshot(), w.get().time_s()};
       },
       "The whole state as a value, good for this world and others of the same file: Snapshot.")
      .def(
          "restore",
          [](PyWorld& w, const PySnapshot& s) {
            w.get().restore(*s.held);
            w.sample();
          },
          py::arg("snapshot"), "Back to a snapshot, bit by bit. InputError for one of another world; then nothing has changed.")
      .def(
          "clone", [](PyWorld& w) { return std::make_shared<PyWorld>(w.get().clone()); },
          "Another World that goes on just as this one would; each may have a thread. Recorders don't go along, nor do commands\n"
          "that no step has taken yet: give them after it.")
      .def_property_readonly(
          "name", [](PyWorld& w) { return w.any_thread().name(); }, "The world's name: str.")
      .def_property_readonly(
          "warnings", [](PyWorld& w) { return w.any_thread().warnings(); },
          "What the file has and the engine leaves out: list of str.")
      .def("__repr__", [](PyWorld& w) {
        return "<vsasim.World " + w.any_thread().name() + ", " + std::to_string(w.actuator_names().size()) + " actuators>";
      });
}

}  // namespace

void bind_world(py::module_& m) {
  WorldClass c(
      m, "World",
      "A world in the embedded simulator (engine::World in C++). It owns time; the same calls give the same bits. A World\n"
      "belongs to one thread at a time: while one steps it, the others may command it, and get RuntimeError else.");
  bind_load(c);
  bind_time(c);
  bind_state(m, c);
  bind_world_actuators(c);
  bind_world_parameters(c);
  bind_world_bodies(m, c);
  bind_world_dynamics(c);
  bind_world_state(c);
  bind_recorder(m, c);
}

}  // namespace vsa::python
