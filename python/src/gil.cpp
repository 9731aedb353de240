// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "gil.hpp"

#include <unistd.h>

namespace vsa::python {

void stay() noexcept {
  for (;;) ::pause();
}

void OthersRun::handle(Clock::time_point now) {
  next_ = now + kEvery;
  const Pause others_wait(*this);
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace vsa::python
