// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A Batch for Python. While one thread steps it, without the GIL, everything else is refused in the others.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gil.hpp"
#include "vsa/batch/batch.hpp"
#include "world.hpp"

namespace vsa::python {

class PyBatch {
 public:
  PyBatch(PyWorld& world, py::ssize_t copies, py::ssize_t threads);

  /// Throws Python's RuntimeError while another thread steps. To be asked after the arguments are converted, as PyWorld's.
  [[nodiscard]] batch::Batch& get();
  [[nodiscard]] const batch::Batch& any_thread() const noexcept { return *batch_; }
  void step(py::ssize_t n, const py::object& which);
  /// work(Batch&, OthersRun&) without the GIL; all else is refused meanwhile.
  template <class Work>
  void alone(Work&& work) {
    (void)get();
    const Mark stepping(stepping_);
    OthersRun others;
    work(*batch_, others);
  }

  /// None: all; integers; a mask.
  [[nodiscard]] std::vector<std::size_t> chosen(const py::object& which) const;
  [[nodiscard]] std::size_t copy(const py::handle& which) const;

 private:
  std::unique_ptr<batch::Batch> batch_;
  bool stepping_ = false;  // read and written with the GIL

 public:
  std::vector<std::string> actuators, joints, links;
};

using BatchClass = py::class_<PyBatch, std::shared_ptr<PyBatch>>;
void bind_batch_parameters(py::module_& m, BatchClass& c);

}  // namespace vsa::python
