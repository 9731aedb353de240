// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit_state.hpp"

#include <algorithm>

#include "arrays.hpp"
#include "vsa/state_io.hpp"

namespace vsa::python {
namespace {

struct UnitClock {
  std::int64_t time_ns = 0;
  static auto fields(auto& s, auto&& visit) { return visit("time", "ns", s.time_ns); }
  [[nodiscard]] const char* impossible() const noexcept {
    constexpr std::int64_t kLatest = 4'000'000'000'000'000'000;
    return time_ns >= 0 && time_ns <= kLatest ? nullptr : "a time of 0 … 4e18";
  }
};
constexpr std::size_t kClockSize = 2;

std::size_t size() { return kClockSize + device::Unit::state_size(); }

StateLayout layout() {
  StateLayout out = state::layout_of<UnitClock>();
  out.append("unit.", device::Unit::state_layout());
  return out;
}

}  // namespace

py::array unit_state(const device::UnitState& state, std::int64_t time_ns, const py::object& out) {
  std::vector<double> numbers(size());  // a save() that fails leaves `out` as it was
  const UnitClock clock{time_ns};
  state::Writer writer(numbers);
  state::walk_fields(writer, clock);
  device::Unit::save(state, std::span(numbers).subspan(kClockSize));
  py::array to = into(out, float64(), {static_cast<py::ssize_t>(numbers.size())});
  std::copy(numbers.begin(), numbers.end(), static_cast<double*>(to.mutable_data()));
  return to;
}

TimedState unit_state_of(const py::object& given) {
  const auto numbers = state_numbers(given, size());
  const std::span in(numbers.data(), static_cast<std::size_t>(numbers.size()));
  UnitClock clock;
  state::Reader reader(in);
  state::walk_fields(reader, clock);
  throw_if_any(reader.fault(), layout());
  TimedState out{{}, clock.time_ns};
  device::Unit::restore(out.state, in.subspan(kClockSize));
  return out;
}

py::list unit_state_layout() { return layout_list(layout()); }

}  // namespace vsa::python
