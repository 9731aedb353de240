// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/unit_batch.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "device/unit_batch_impl.hpp"
#include "vsa/checks.hpp"
#include "vsa/errors.hpp"

namespace vsa::device {
namespace {

constexpr std::int64_t kLongest_ns = 16'000'000;

}  // namespace

UnitBatch::UnitBatch(const UnitConfig& config, std::size_t units, std::string_view instructions) {
  if (units == 0) throw InputError({"", "units", "0", "out of range", "1 or more"});
  impl_ = std::make_unique<Impl>(config, units, lane_table(instructions));
}
UnitBatch::~UnitBatch() = default;
UnitBatch::UnitBatch(UnitBatch&&) noexcept = default;
UnitBatch& UnitBatch::operator=(UnitBatch&&) noexcept = default;

std::vector<std::string_view> UnitBatch::instruction_sets() {
  std::vector<std::string_view> names;
  for (const LaneTable& table : lane_tables()) names.emplace_back(table.name);
  return names;
}

std::size_t UnitBatch::size() const noexcept { return impl_->count; }
const UnitConfig& UnitBatch::config() const noexcept { return impl_->unit.config(); }
std::string_view UnitBatch::instructions() const noexcept { return impl_->table.name; }
int UnitBatch::width() const noexcept { return impl_->laned ? impl_->table.width : 1; }
std::int64_t UnitBatch::time_ns() const noexcept { return impl_->now_ns; }
std::size_t UnitBatch::unsettled() const noexcept { return impl_->unsettled; }

void UnitBatch::Impl::check(std::size_t i) const {
  if (i >= count) throw InputError({"", "unit", std::to_string(i), "there is no such unit", "0 … " + std::to_string(count - 1)});
}

UnitState UnitBatch::state(std::size_t i) const {
  impl_->check(i);
  UnitState s = impl_->states[i];
  const std::size_t b = i / impl_->width;
  if (impl_->in_lanes[b] != 0) impl_->table.take(impl_->block(b), static_cast<int>(i % impl_->width), s);
  if (impl_->ticks_in_lanes[b] != 0) impl_->take_loop(i, s);
  return s;
}

void UnitBatch::set(std::size_t i, const UnitState& state) {
  impl_->check(i);
  impl_->to_states(i / impl_->width);
  impl_->states[i] = state;
}

void UnitBatch::command(std::size_t i, double equilibrium_rad, double preset) {
  impl_->check(i);
  for (const auto& [key, value] : {std::pair{"equilibrium", equilibrium_rad}, std::pair{"preset", preset}})
    if (!std::isfinite(value)) throw InputError({"", key, Checks::text(value), "not finite", "any finite number"});
  UnitState& s = impl_->states[i];
  impl_->unit.command(s, equilibrium_rad, preset);
  const std::size_t b = i / impl_->width;
  if (impl_->ticks_in_lanes[b] != 0)
    impl_->table.refer(impl_->loop(b), static_cast<int>(i % impl_->width), s.program.loop.ref_new.data());
}

void UnitBatch::check_step(std::int64_t dt_ns) {
  if (dt_ns <= 0 || dt_ns > kLongest_ns)
    throw InputError({"", "dt_ns", std::to_string(dt_ns), "out of range", "1 … " + std::to_string(kLongest_ns)});
}

void UnitBatch::step(std::int64_t dt_ns, std::span<const double> angle, std::span<const double> speed,
                     std::span<const double> inverse_inertia, std::span<double> torque) {
  Impl& m = *impl_;
  check_step(dt_ns);
  Problems problems;
  const auto sized = [&](const char* key, std::size_t size) {
    if (size != m.count) problems.add({"", key, std::to_string(size) + " numbers", "one per unit", std::to_string(m.count)});
  };
  sized("angle", angle.size());
  sized("speed", speed.size());
  sized("inverse_inertia", inverse_inertia.size());
  sized("torque", torque.size());
  const auto finite = [&](const char* key, std::span<const double> values) {
    const auto bad = std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (bad != values.end())
      problems.add({"", std::string(key) + "[" + std::to_string(bad - values.begin()) + "]", Checks::text(*bad), "not finite",
                    "any finite number"});
  };
  finite("angle", angle);
  finite("speed", speed);
  finite("inverse_inertia", inverse_inertia);
  const auto negative = std::find_if(inverse_inertia.begin(), inverse_inertia.end(), [](double v) { return v < 0; });
  if (negative != inverse_inertia.end())
    problems.add({"", "inverse_inertia[" + std::to_string(negative - inverse_inertia.begin()) + "]", Checks::text(*negative),
                  "out of range", "0 or more"});
  problems.throw_if_any();
  std::copy(angle.begin(), angle.end(), m.angle.begin());
  std::copy(speed.begin(), speed.end(), m.speed.begin());
  std::copy(inverse_inertia.begin(), inverse_inertia.end(), m.inverse_inertia.begin());
  m.unsettled = 0;
  for (std::size_t b = 0; b < m.blocks(); ++b) m.step_block(b, dt_ns);
  std::copy_n(m.torque.begin(), m.count, torque.begin());
  if (m.now_ns % firmware::kTickNs == 0) m.last_tick_ns = m.now_ns;
  m.now_ns += dt_ns;
}

}  // namespace vsa::device
