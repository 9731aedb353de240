// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world's state as numbers, in arrays and in files.
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

py::array state(PyWorld& w, const py::object& out) {
  const engine::World& world = w.get();
  const std::size_t n = world.state_size();
  std::vector<double> numbers(n);  // a save() that fails leaves `out` as it was
  world.save(numbers);
  py::array to = into(out, float64(), {static_cast<py::ssize_t>(n)});
  std::copy(numbers.begin(), numbers.end(), static_cast<double*>(to.mutable_data()));
  return to;
}

void restore_state(PyWorld& w, const py::object& given) {
  const auto numbers = state_numbers(given, w.any_thread().state_size());
  w.get().restore(std::span(numbers.data(), static_cast<std::size_t>(numbers.size())));
  w.sample();
}

py::list state_layout(PyWorld& w) { return layout_list(w.get().state_layout()); }

constexpr const char* kState =
    "The whole state as numbers: ndarray (n,) of float64, good for this world and others of the same file. out: such an array, "
    "which\n"
    "is filled and returned. A copy either way. Not in it: parameters, hands, commands that no step has taken. InputError: more "
    "is\n"
    "under way than the layout has room for (a trajectory of many knots, a long speech on a bus); snapshot() takes that, too.";
constexpr const char* kRestore =
    "Back to the numbers of state(), bit by bit: (n,) of float64. Numbers don't tell whose they are: those of other parameters or "
    "of\n"
    "another actuator type are taken where the layout is the same, and mean something else: springs are where the other's were, "
    "and\n"
    "the ledger is off by the difference. A snapshot() is carried over to a World's own parameters. InputError: another shape, or\n"
    "numbers that no state has, with the name of the first one. TypeError: another dtype. Then nothing has changed.";
constexpr const char* kLayout =
    "What the numbers of state() are, in order and without gaps: list of dicts of name (\"robot[0]/elbow/unit.…\"), unit (\"\": a\n"
    "number), kind (real, single, whole, wide, flag, choice or bytes), offset and count.";
constexpr const char* kSaveFile =
    "Writes state() into a file that tells version, layout, kinds of actuators, and the links' and actuators' parameters, which\n"
    "must be the same where it is read. OutputError: it can't be written; what was there stays.";
constexpr const char* kRestoreFile =
    "Back to the state in a file of save_file(). InputError: a file of another layout or version, of other kinds of actuators (as\n"
    "restore()), of other parameters, with the names of whose they are, a damaged one or none; then nothing has changed.";

}  // namespace

void bind_world_state(WorldClass& c) {
  c.def("state", &state, py::arg("out") = py::none(), kState)
      .def("restore_state", &restore_state, py::arg("state"), kRestore)
      .def_property_readonly("state_layout", &state_layout, kLayout)
      .def(
          "state_hash", [](PyWorld& w) { return w.get().state_hash(); },
          "A hash of all bits of state(): int of 64 bits. Equal states have the same.")
      .def(
          "save_file", [](PyWorld& w, const std::filesystem::path& file) { w.get().save_file(file); }, py::arg("file"), kSaveFile)
      .def(
          "restore_file",
          [](PyWorld& w, const std::filesystem::path& file) {
            w.get().restore_file(file);
            w.sample();
          },
          py::arg("file"), kRestoreFile);
}

}  // namespace vsa::python
