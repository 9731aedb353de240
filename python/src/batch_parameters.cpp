// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Parameters of a Batch's copies: set, drawn, told.
#include <cmath>
#include <set>

#include "arrays.hpp"
#include "batch.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::python {
namespace {

using batch::Batch;
using batch::Distribution;

std::string who_of(const PyBatch& b, const py::object& who) {
  if (who.is_none()) return {};
  if (py::isinstance<py::str>(who)) {
    auto name = py::cast<std::string>(who);
    if (name.empty())
      throw InputError({"", "who", "''", "is no name", "a name, an index into actuators, None: all that have the key"});
    return name;
  }
  if (!py::hasattr(who, "__index__"))
    throw py::type_error("who: " + std::string(py::str(py::type::of(who))) + " (allowed: a name, an index into actuators, None)");
  const py::object index = who.attr("__index__")();
  if (index < py::int_(0) || index >= py::int_(b.actuators.size()))
    throw py::index_error("actuator " + std::string(py::str(index)) + ": there are " + std::to_string(b.actuators.size()));
  return b.actuators[py::cast<std::size_t>(index)];
}

/// One copy by its index, or several.
std::vector<std::size_t> copies_of(const PyBatch& b, const py::object& which) {
  if (!which.is_none() && py::hasattr(which, "__index__") && !py::hasattr(which, "__len__")) return {b.copy(which)};
  return b.chosen(which);
}

/// (copies, owners) by rows.
std::vector<double> spread_out(const py::object& value, std::size_t copies, std::size_t owners, bool one) {
  const py::array given = array_of(value, "value");
  const char kind = given ? given.dtype().kind() : 'O';
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw py::type_error("value: " + std::string(py::str(py::type::of(value))) + " (allowed: numbers, one text, one bool)");
  if (!one && given.ndim() == 1 && given.size() > 1)  // NumPy's rule would give it to the owners, unasked
    throw InputError(
        {"", "value", "shape " + std::string(py::str(given.attr("shape"))), "could be for copies as well as for owners",
         "a number, or an array of shape (copies, owners): (" + std::to_string(copies) + ", " + std::to_string(owners) + ")"});
  const auto k = static_cast<py::ssize_t>(copies), n = static_cast<py::ssize_t>(owners);
  return spread(given, one ? std::vector{k} : std::vector{k, n}, "value");
}

void set(PyBatch& b, const py::object& which, const py::object& who, const std::string& key, const py::object& value) {
  const std::vector<std::size_t> copies = copies_of(b, which);
  std::set<std::size_t> seen;
  for (const std::size_t c : copies)
    if (!seen.insert(c).second) throw InputError({"", "which", std::to_string(c), "is named twice", "each copy once"});
  const std::string name = who_of(b, who);
  std::vector<batch::Setting> settings;
  if (py::isinstance<py::str>(value) || py::isinstance<py::bool_>(value)) {
    for (const std::size_t c : copies) settings.push_back({c, name, key, setting_text(value, key)});
  } else {
    const std::vector<std::string> owners = b.get().owners(name, key);
    const std::vector<double> all = spread_out(value, copies.size(), owners.size(), !name.empty());
    for (std::size_t k = 0; k < copies.size(); ++k)
      for (std::size_t o = 0; o < owners.size(); ++o)
        settings.push_back({copies[k], name.empty() ? owners[o] : name, key, all[k * owners.size() + o]});
  }
  b.alone([&](Batch& batch, OthersRun&) { batch.set(settings); });
}

py::array values(PyBatch& b, const std::string& key, const py::object& who) {
  const std::string name = who_of(b, who);
  const auto copies = static_cast<py::ssize_t>(b.any_thread().size()),
             owners = static_cast<py::ssize_t>(b.get().owners(name, key).size());
  py::array_t<double> out(name.empty() ? std::vector<py::ssize_t>{copies, owners} : std::vector<py::ssize_t>{copies});
  const Batch& batch = b.get();
  double* to = out.mutable_data();
  for (std::size_t c = 0; c < batch.size(); ++c)
    for (const double v : batch.values(c, name, key)) *to++ = v;
  return out;
}

batch::Spread spread_of(const PyBatch& b, const py::handle& key, const py::handle& draw) {
  if (!py::isinstance<Distribution>(draw))
    throw py::type_error(std::string(py::str(key)) + ": isn't a vsasim.uniform(…), log_uniform(…) or normal(…)");
  batch::Spread out;
  out.draw = py::cast<Distribution>(draw);
  if (py::isinstance<py::str>(key)) {
    out.key = py::cast<std::string>(key);
  } else if (py::isinstance<py::tuple>(key) && py::len(key) == 2) {
    out.who = who_of(b, py::reinterpret_borrow<py::tuple>(key)[0]);
    out.key = py::str(py::reinterpret_borrow<py::tuple>(key)[1]);
  } else {
    throw py::type_error(std::string(py::str(key)) + ": isn't a key, nor (who, key)");
  }
  return out;
}

void randomize(PyBatch& b, const py::object& given_seed, const py::dict& what, const py::object& which) {
  const auto seed = whole_number<std::uint64_t>(given_seed, "seed");
  std::vector<batch::Spread> spreads;
  for (const auto& [key, draw] : what) spreads.push_back(spread_of(b, key, draw));
  const std::vector<std::size_t> copies = b.chosen(which);
  b.alone([&](Batch& batch, OthersRun&) { batch.randomize(seed, spreads, copies); });
}

void reset(PyBatch& b, const py::object& which, bool parameters) {
  const std::vector<std::size_t> copies = b.chosen(which);
  b.alone([&](Batch& batch, OthersRun&) {
    if (parameters) batch.reset_parameters(copies);
    batch.reset(copies);
  });
}

template <Distribution::Kind kind>
Distribution make(double a, double b, bool times_nominal, bool shared) {
  return {kind, a, b, times_nominal, shared};
}

std::string text(const Distribution& d) {
  constexpr std::array<const char*, 3> kNames{"uniform", "log_uniform", "normal"};
  std::string out = std::string("vsasim.") + kNames[static_cast<std::size_t>(d.kind)] + "(" + config::number_text(d.a) + ", " +
                    config::number_text(d.b);
  if (d.times_nominal) out += ", times_nominal=True";
  return out + (d.shared ? ", shared=True)" : ")");
}

constexpr const char* kSet =
    "Parameters of copies from the next step on. which: a copy, indices (k,), a mask (copies,) of bool, None: all. who: an "
    "actuator\n"
    "(name or index) or a link (name); None: every one that has the key, as owners(key) tells (drive_2.…: that gives it).\n"
    "key: of the actuator's type (ActuatorType.keys), or\n"
    "link.mass_kg (the inertia goes in proportion), link.inertia_factor (on top, 1e-6 … 1e6), link.friction (of all its shapes).\n"
    "value: a number, (k,) or, where who is None, (k, owners), (k, 1), (1, owners); or one text (\"coast\") or bool. Motion goes\n"
    "on as after World.set_parameters. InputError with copy, name, key and what is allowed; nothing has changed then.";
constexpr const char* kRandomize =
    "A draw for each parameter and copy (all, or those in `which`, as in step): what is a dict of key, or (who, key), to "
    "uniform(),\n"
    "log_uniform() or normal(). Each depends on seed (0 … 2**64 - 1), copy, who and key alone: not on threads, nor on which other\n"
    "copies and parameters are drawn. values() tells them. InputError as in set().";
constexpr const char* kValues =
    "A parameter as it is now: ndarray (copies, owners), or (copies,) where `who` is given. A switch is 0 or 1, a word its place "
    "in\n"
    "the list of words, NaN an optional one that isn't given. A copy.";
constexpr const char* kReset =
    "Every copy, or those in `which` (as in step), back to where the Batch began, with the parameters that it has; "
    "parameters=True:\n"
    "with the World's again. Commands stay.";
constexpr const char* kDraw = "times_nominal: the draw times what the Batch began with. shared: one draw for all of a copy's.";

}  // namespace

void bind_batch_parameters(py::module_& m, BatchClass& c) {
  py::class_<Distribution>(m, "Distribution", "What uniform(), log_uniform() and normal() give, for Batch.randomize().")
      .def("__repr__", &text);
  using Kind = Distribution::Kind;
  const auto add = [&m](const char* name, Distribution (*function)(double, double, bool, bool), const char* a, const char* b,
                        const std::string& doc) {
    m.def(name, function, py::arg(a), py::arg(b), py::kw_only(), py::arg("times_nominal") = false, py::arg("shared") = false,
          (doc + kDraw).c_str());
  };
  add("uniform", &make<Kind::uniform>, "low", "high", "From low to high. ");
  add("log_uniform", &make<Kind::log_uniform>, "low", "high", "From low to high, its logarithm uniform; 0 < low. ");
  add("normal", &make<Kind::normal>, "mean", "deviation", "Normal, cut off at three standard deviations. ");
  c.def("set", &set, py::arg("which"), py::arg("who"), py::arg("key"), py::arg("value"), kSet)
      .def("randomize", &randomize, py::arg("seed"), py::arg("what"), py::arg("which") = py::none(), kRandomize)
      .def("values", &values, py::arg("key"), py::arg("who") = py::none(), kValues)
      .def(
          "owners", [](PyBatch& b, const std::string& key) { return b.get().owners("", key); }, py::arg("key"),
          "Names of the actuators or links that have a key, in the order of values(): list of str.")
      .def(
          "text",
          [](PyBatch& b, const py::object& which, const py::object& who, const std::string& key) {
            const std::size_t copy = b.copy(which);
            if (who.is_none()) throw py::type_error("who: None (allowed: a name, an index into actuators)");
            const std::string name = who_of(b, who);
            return b.get().text(copy, name, key);
          },
          py::arg("copy"), py::arg("who"), py::arg("key"), "A parameter of one actuator or link as text: str.")
      .def(
          "give_parameters",
          [](PyBatch& b, const py::object& which, PyWorld& world) {
            const std::size_t copy = b.copy(which);
            world.get().set_parameters(*b.get().parameters(copy));
          },
          py::arg("copy"), py::arg("world"), "A World of the same file gets all parameters that the copy has.")
      .def("reset", &reset, py::arg("which") = py::none(), py::arg("parameters") = false, kReset);
}

}  // namespace vsa::python
