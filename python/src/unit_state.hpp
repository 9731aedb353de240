// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's state as numbers, in a Unit and out of a UnitBatch: what its program waits for is in a time, so that the time comes first.
#pragma once

#include "bind.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::python {

/// (n,): into `out`, a new one where it is None.
[[nodiscard]] py::array unit_state(const device::UnitState& state, std::int64_t time_ns, const py::object& out);
struct TimedState {
  device::UnitState state;
  std::int64_t time_ns = 0;
};
/// From unit_state()'s numbers. TypeError, InputError.
[[nodiscard]] TimedState unit_state_of(const py::object& given);
[[nodiscard]] py::list unit_state_layout();

constexpr const char* kUnitLayout =
    "What the numbers of state() are, in order and without gaps, as World.state_layout: list of dicts; first \"time\", ns. The "
    "same "
    "for every\n"
    "unit.";

}  // namespace vsa::python
