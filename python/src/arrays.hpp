// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// NumPy arrays in and out. What comes in is checked: not numbers at all is a TypeError; another shape, NaN and infinity are
// vsasim.InputError with the argument's name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "vsa/state.hpp"

namespace vsa::python {

/// What NumPy makes of it; empty: nothing. TypeError for a masked array, or a list of such: the mask would be lost.
[[nodiscard]] py::array array_of(const py::handle& given, const char* name);

using RealArray = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// Of any shape, from anything that NumPy takes for real numbers. TypeError for what it doesn't: None, texts, bool.
[[nodiscard]] RealArray real_array(const py::handle& given, const char* name);

/// (n,) from anything that NumPy takes for real numbers; `scalar`: one number stands for all. Copies.
[[nodiscard]] std::vector<double> numbers(const py::handle& given, std::size_t n, const char* name, bool scalar = false);
/// The same of any length.
[[nodiscard]] std::vector<double> numbers(const py::handle& given, const char* name);
template <std::size_t N>
[[nodiscard]] std::array<double, N> numbers(const py::handle& given, const char* name) {
  const std::vector<double> all = numbers(given, N, name);
  std::array<double, N> out{};
  std::copy(all.begin(), all.end(), out.begin());
  return out;
}

/// `out`, where it has that dtype and shape, is C-contiguous and writeable (else TypeError, InputError); a new array where it is
/// None.
[[nodiscard]] py::array into(const py::object& out, const py::dtype& dtype, const std::vector<py::ssize_t>& shape);

[[nodiscard]] py::dtype float64();
/// (n,) of float64 bit by bit, NaN and −0 included: numbers of a state, which would mean something else if they were rounded.
/// TypeError for another dtype, InputError for another shape.
[[nodiscard]] py::array_t<double> state_numbers(const py::handle& given, std::size_t n);
/// What those numbers are: list of dicts.
[[nodiscard]] py::list layout_list(const StateLayout& layout);
/// A copy, (n,).
[[nodiscard]] py::array_t<double> copied(const std::vector<double>& values);

/// `value` broadcast to `shape`, by rows. TypeError for what is no real numbers, InputError for another shape.
[[nodiscard]] std::vector<double> spread(const py::object& value, const std::vector<py::ssize_t>& shape, const char* name);

/// One of `count` things by its index, some of them by indices or by a mask, None: all. `one` is what messages call it: "copy".
/// TypeError, IndexError; InputError with `which`.
[[nodiscard]] std::size_t index_of(const py::handle& which, std::size_t count, const std::string& one);
[[nodiscard]] std::vector<std::size_t> chosen(const py::object& which, std::size_t count, const std::string& one);

/// A whole number, 0 … most: int, or what has an __index__. TypeError for anything else, InputError out of range.
[[nodiscard]] std::uint64_t whole_number(const py::handle& given, std::uint64_t most, const char* name);
template <class Number>
[[nodiscard]] Number whole_number(const py::handle& given, const char* name) {
  return static_cast<Number>(whole_number(given, std::numeric_limits<Number>::max(), name));
}

/// Fields of a struct, for a structured dtype: `length` doubles (or whatever `format` says) at an offset.
struct Field {
  const char* name;
  std::size_t offset;
  py::ssize_t length = 1;
  const char* format = "f8";
};
[[nodiscard]] py::dtype record_dtype(const std::vector<Field>& fields, std::size_t size);

/// A view of what `owner` holds, which lives as long as the view or any view of that. Read-only unless `writeable`.
template <class Owner>
[[nodiscard]] py::array view(const py::dtype& dtype, const std::vector<py::ssize_t>& shape, const void* data,
                             std::shared_ptr<Owner> owner, bool writeable = false) {
  using Kept = std::shared_ptr<Owner>;
  py::capsule keeper(new Kept(std::move(owner)), [](void* kept) { delete static_cast<Kept*>(kept); });
  py::array out(dtype, shape, data, keeper);
  if (!writeable) out.attr("flags").attr("writeable") = false;
  return out;
}

}  // namespace vsa::python
