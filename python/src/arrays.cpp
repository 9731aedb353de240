// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "arrays.hpp"

#include <cmath>
#include <numeric>

#include "vsa/checks.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {
namespace {

constexpr int kFlags = py::array::c_style | py::array::forcecast;

std::string text(const py::handle& thing) { return py::str(thing); }
std::string shape_text(const py::array& a) { return text(a.attr("shape")); }

[[noreturn]] void refuse_type(const char* name, const std::string& found) {
  throw py::type_error(std::string(name) + ": " + found + " (allowed: real numbers)");
}

void check_finite(const std::vector<double>& values, const char* name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    const std::string at = values.size() == 1 ? "" : "[" + std::to_string(i) + "]";
    throw InputError({"", name + at, Checks::text(values[i]), "isn't finite", "finite numbers"});
  }
}

std::vector<std::size_t> masked(const py::array& mask, std::size_t count, const std::string& one) {
  if (mask.shape(0) != static_cast<py::ssize_t>(count))
    throw InputError({"", "which", "a mask of " + std::to_string(mask.shape(0)), "has another length",
                      "one for each " + one + ": " + std::to_string(count)});
  const auto flags = py::array_t<bool, kFlags>(mask);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i)
    if (flags.data()[i]) out.push_back(i);
  return out;
}

bool is_masked(const py::handle& given) {
  if (!py::isinstance<py::array>(given) || Py_TYPE(given.ptr()) == py::detail::npy_api::get().PyArray_Type_) return false;
  return py::isinstance(given, py::module_::import("numpy.ma").attr("MaskedArray"));
}

void refuse_masked(const py::handle& given, const char* name) {
  bool found = is_masked(given);
  if (py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given))
    for (const py::handle one : given) found = found || is_masked(one);
  if (found) throw py::type_error(std::string(name) + ": is masked, and the mask would be lost (allowed: an array without a mask)");
}

}  // namespace

py::array array_of(const py::handle& given, const char* name) {
  refuse_masked(given, name);
  auto out = py::array::ensure(given);
  if (!out) PyErr_Clear();
  return out;
}

RealArray real_array(const py::handle& given, const char* name) {
  const py::array any = array_of(given, name);
  if (!any) refuse_type(name, "isn't an array of numbers");
  const char kind = any.dtype().kind();
  if (any.size() > 0 && kind != 'f' && kind != 'i' && kind != 'u') refuse_type(name, "has dtype " + text(any.dtype()));
  return RealArray(any);
}

std::vector<double> numbers(const py::handle& given, std::size_t n, const char* name, bool scalar) {
  const auto a = real_array(given, name);
  std::vector<double> out;
  if (scalar && a.ndim() == 0) {
    out.assign(n, *a.data());
    check_finite({out.begin(), out.begin() + (n > 0 ? 1 : 0)}, name);
    return out;
  }
  if (a.ndim() != 1 || a.shape(0) != static_cast<py::ssize_t>(n)) {
    throw InputError({"", name, "shape " + shape_text(a), "has another shape",
                      "(" + std::to_string(n) + ",)" + (scalar ? " or one number" : "")});
  }
  out.assign(a.data(), a.data() + n);
  check_finite(out, name);
  return out;
}

std::vector<double> numbers(const py::handle& given, const char* name) {
  const auto a = real_array(given, name);
  if (a.ndim() != 1) throw InputError({"", name, "shape " + shape_text(a), "has another shape", "(n,)"});
  std::vector<double> out(a.data(), a.data() + a.size());
  check_finite(out, name);
  return out;
}

py::array into(const py::object& out, const py::dtype& dtype, const std::vector<py::ssize_t>& shape) {
  if (out.is_none()) return py::array(dtype, shape);
  if (!py::isinstance<py::array>(out)) throw py::type_error("out: isn't a numpy.ndarray");
  refuse_masked(out, "out");
  auto a = py::reinterpret_borrow<py::array>(out);
  if (!a.dtype().equal(dtype)) throw py::type_error("out: has dtype " + text(a.dtype()) + " (allowed: " + text(dtype) + ")");
  const py::tuple wanted = py::cast(shape);
  if (!py::tuple(a.attr("shape")).equal(wanted))
    throw InputError({"", "out", "shape " + shape_text(a), "has another shape", text(wanted)});
  if ((a.flags() & py::array::c_style) == 0 || !a.writeable() || !a.attr("flags").attr("aligned").cast<bool>())
    throw InputError({"", "out", "", "isn't C-contiguous, aligned and writeable", "as numpy.empty() makes it"});
  return a;
}

py::dtype float64() { return py::dtype::of<double>(); }

py::array_t<double> state_numbers(const py::handle& given, std::size_t n) {
  const py::array any = array_of(given, "state");
  if (!any) refuse_type("state", "isn't an array of numbers");
  if (!any.dtype().equal(float64())) throw py::type_error("state: has dtype " + text(any.dtype()) + " (allowed: float64)");
  if (any.ndim() != 1 || any.shape(0) != static_cast<py::ssize_t>(n))
    throw InputError({"", "state", "shape " + shape_text(any), "has another shape", "(" + std::to_string(n) + ",)"});
  return RealArray(any);
}

py::list layout_list(const StateLayout& layout) {
  py::list out;
  for (const StateEntry& e : layout.entries()) {
    out.append(py::dict(py::arg("name") = e.name, py::arg("unit") = e.unit, py::arg("kind") = std::string(name_of(e.kind)),
                        py::arg("offset") = e.offset, py::arg("count") = e.count));
  }
  return out;
}

py::array_t<double> copied(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

std::vector<double> spread(const py::object& value, const std::vector<py::ssize_t>& shape, const char* name) {
  const py::array given = array_of(value, name);
  const char kind = given ? given.dtype().kind() : 'O';
  if (kind != 'f' && kind != 'i' && kind != 'u') throw py::type_error(std::string(name) + ": isn't real numbers");
  const py::array_t<double> to(shape);
  try {
    to[py::ellipsis()] = given;
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw InputError({"", name, "shape " + text(given.attr("shape")), "has another shape",
                      text(to.attr("shape")) + " or what broadcasts to it"});
  }
  return {to.data(), to.data() + to.size()};
}

std::size_t index_of(const py::handle& which, std::size_t count, const std::string& one) {
  if (!py::hasattr(which, "__index__")) throw py::type_error(one + ": " + text(py::type::handle_of(which)) + " is no index");
  const py::object index = which.attr("__index__")();
  if (index < py::int_(0) || index >= py::int_(count))
    throw py::index_error(one + " " + text(index) + ": there are " + std::to_string(count) + ", from 0");
  return py::cast<std::size_t>(index);
}

std::uint64_t whole_number(const py::handle& given, std::uint64_t most, const char* name) {
  if (!py::hasattr(given, "__index__"))
    throw py::type_error(std::string(name) + ": " + text(py::type::handle_of(given)) + " (allowed: int)");
  const py::object number = given.attr("__index__")();
  if (number < py::int_(0) || number > py::int_(most))
    throw InputError({"", name, text(number), "out of range", "0 … " + std::to_string(most)});
  return py::cast<std::uint64_t>(number);
}

std::vector<std::size_t> chosen(const py::object& which, std::size_t count, const std::string& one) {
  std::vector<std::size_t> out;
  if (which.is_none()) {
    out.resize(count);
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
  }
  const py::array any = array_of(which, "which");
  const std::string allowed = "integers (k,), or a mask of bool with one for each " + one;
  if (!any) throw InputError({"", "which", text(py::type::of(which)), "isn't an array", allowed});
  if (any.ndim() != 1) throw InputError({"", "which", "shape " + text(any.attr("shape")), "has another shape", allowed});
  const char kind = any.dtype().kind();
  if (kind == 'b') return masked(any, count, one);
  if (any.size() == 0) return out;
  if (kind != 'i' && kind != 'u') throw InputError({"", "which", "dtype " + text(any.dtype()), "names none", allowed});
  for (const py::handle index : any) out.push_back(index_of(index, count, one));
  return out;
}

py::dtype record_dtype(const std::vector<Field>& fields, std::size_t size) {
  py::list names, formats, offsets;
  for (const Field& f : fields) {
    names.append(f.name);
    formats.append(f.length == 1 ? py::dtype(f.format) : py::dtype::from_args(py::make_tuple(f.format, py::make_tuple(f.length))));
    offsets.append(f.offset);
  }
  return py::dtype(std::move(names), std::move(formats), std::move(offsets), static_cast<py::ssize_t>(size));
}

}  // namespace vsa::python
