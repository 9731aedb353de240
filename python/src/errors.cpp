// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The library's exceptions as Python's, with the same text.
#include "vsa/errors.hpp"

#include "bind.hpp"
#include "vsa/output_file.hpp"
#include "vsa/physics/error.hpp"

namespace vsa::python {
namespace {

constexpr const char* kInputError =
    "Bad input. The text is the library's, one line a problem; `problems` is a list of dicts with the keys file, key, value, why "
    "and\n"
    "allowed, all str, empty where there is nothing to say.";
constexpr const char* kSimulationError =
    "A run blew up: a state is no longer finite. The text names time, joint and value. The world is where it was before that step.";
constexpr const char* kOutputError = "Writing a recording failed after it had begun: path and reason.";

// Never given back: they are needed as long as any thread may throw.
PyObject* input_error = nullptr;
PyObject* simulation_error = nullptr;
PyObject* output_error = nullptr;

/// Bytes that aren't UTF-8, a file's name may have some, as Python's own file names have them.
py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape"));
}

py::list problem_list(const InputError& error) {
  py::list out;
  for (const Problem& p : error.problems()) {
    out.append(py::dict(py::arg("file") = text(p.file), py::arg("key") = text(p.key), py::arg("value") = text(p.value),
                        py::arg("why") = text(p.message), py::arg("allowed") = text(p.allowed)));
  }
  return out;
}

void raise(const InputError& error) {
  py::object made = py::reinterpret_borrow<py::object>(input_error)(text(error.what()));
  made.attr("problems") = problem_list(error);
  PyErr_SetObject(input_error, made.ptr());
}

PyObject* add(py::module_& m, const char* name, const char* doc, PyObject* base) {
  PyObject* made = PyErr_NewExceptionWithDoc((std::string("vsasim.") + name).c_str(), doc, base, nullptr);
  m.attr(name) = py::reinterpret_borrow<py::object>(made);
  return made;
}

}  // namespace

void rethrow_with_arguments(const InputError& error, std::initializer_list<std::pair<std::string_view, std::string_view>> names) {
  std::vector<Problem> problems = error.problems();
  for (Problem& p : problems)
    for (std::string* const text : {&p.file, &p.key, &p.allowed})
      for (const auto& [flag, argument] : names)
        for (std::size_t at = 0; (at = text->find(flag, at)) != std::string::npos; at += argument.size())
          text->replace(at, flag.size(), argument);
  throw InputError(std::move(problems));
}

void bind_errors(py::module_& m) {
  input_error = add(m, "InputError", kInputError, PyExc_ValueError);
  py::handle(input_error).attr("problems") = py::tuple();
  simulation_error = add(m, "SimulationError", kSimulationError, PyExc_RuntimeError);
  output_error = add(m, "OutputError", kOutputError, PyExc_OSError);
  // pybind11 asks for a function that takes it by value.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise(error);
    } catch (const physics::SimulationError& error) {
      PyErr_SetObject(simulation_error, text(error.what()).ptr());
    } catch (const OutputError& error) {
      PyErr_SetObject(output_error, text(error.what()).ptr());
    }
  });
}

}  // namespace vsa::python
