// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include <filesystem>

#include "bind.hpp"
#include "vsa/config/installed.hpp"

namespace vsa::python {
namespace {

namespace fs = std::filesystem;

std::string data_directory;  // what loaded_with() keeps a pointer to

/// The module's own data: share/vsa in the package's folder (pip, the build tree), or below the prefix that it was installed to
/// (PREFIX/lib/python3/dist-packages/vsasim). Neither: what the program that loads it finds.
void find_data() {
  Dl_info self{};
  if (dladdr(reinterpret_cast<const void*>(&find_data), &self) == 0 || self.dli_fname == nullptr) return;
  std::error_code none;
  const fs::path package = fs::absolute(self.dli_fname, none).parent_path();
  for (const char* place : {"share/vsa", "../../../../share/vsa"}) {
    const fs::path data = (package / place).lexically_normal();
    if (!fs::is_directory(data / "actuators", none)) continue;
    data_directory = data.string();
    config::loaded_with(data_directory.c_str());
    return;
  }
}

void* refuse_unmade(std::size_t) { throw py::type_error("isn't made yet: its __init__ wasn't called, or failed"); }

/// Of an object that C.__new__(C) gave, pybind11 hands methods fresh memory, with nothing in it, from its class's operator new.
void refuse_what_was_never_made(const py::module_& m) {
  for (const auto& [name, value] : m.attr("__dict__").cast<py::dict>()) {
    if (!py::isinstance<py::type>(value)) continue;
    if (auto* const info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr())))
      info->operator_new = refuse_unmade;
  }
}

}  // namespace
}  // namespace vsa::python

PYBIND11_MODULE(_vsasim, m) {
  using namespace vsa::python;
  m.doc() = "The compiled part of vsasim.";
  m.attr("__version__") = VSA_VERSION;
  find_data();
  bind_errors(m);
  bind_linearization(m);
  bind_actuator_type(m);
  bind_unit(m);
  bind_unit_batch(m);
  bind_world(m);
  bind_batch(m);
  bind_study(m);
  bind_identify(m);
  for (const py::module_& of : {m, m.attr("study").cast<py::module_>(), m.attr("identify").cast<py::module_>()})
    refuse_what_was_never_made(of);
}
