// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot's state as numbers: the actuators' and the robot's own, then bus by bus.
#include <string>

#include "host/robot_impl.hpp"
#include "vsa/errors.hpp"
#include "vsa/state_io.hpp"

namespace vsa::host {
namespace {

/// Program times that far from the line's: a watchdog would count for minutes. 11 days.
constexpr std::int64_t kFarthestNs = 1'000'000'000'000'000;

template <class Sink>
void walk_bus(Sink& sink, const BusLine& bus) {
  sink.enter("");
  state::walk(sink, "chain", "", bus.chain_state());
  state::walk(sink, "master", "", bus.master_state());
  sink.leave();
}

/// "actuator[1].unit…" → "elbow/unit…", where there is such a beginning.
std::string renamed(const std::string& name, const std::vector<ActuatorConfig>& actuators) {
  constexpr std::string_view kBegin = "actuator[";
  if (name.rfind(kBegin, 0) != 0) return name;
  const std::size_t close = name.find("].");
  return actuators[std::stoul(name.substr(kBegin.size()))].name + "/" + name.substr(close + 2);
}

}  // namespace

StateLayout Robot::Impl::layout() const {
  StateLayout out = state::layout_of(state);
  for (StateEntry& e : out.entries()) e.name = renamed(e.name, config.actuators);
  for (std::size_t b = 0; b < buses.size(); ++b) {
    StateLayout one;
    state::Namer namer(one);
    walk_bus(namer, *buses[b]);
    out.append("bus " + config.buses[b].name + "/", one);
  }
  return out;
}

std::size_t Robot::Impl::size_as_numbers() const {
  state::Sizer sizer;
  state::walk_fields(sizer, state);
  for (const auto& bus : buses) walk_bus(sizer, *bus);
  return sizer.size();
}

std::size_t Robot::Impl::read_numbers(std::span<const double> in, state::Room room) {
  if (room == state::Room::kept) check_state_size(in.size(), numbers);
  state::Reader reader(in, room);
  state::walk_fields(reader, loaded.state);
  for (BusState& bus : loaded.buses) state::walk_fields(reader, bus);
  StateFault fault = reader.fault();
  if (!fault.there()) in = in.first(reader.at());
  for (std::size_t b = 0; b < buses.size() && !fault.there(); ++b) {
    if (const char* wrong = buses[b]->impossible(loaded.buses[b], loaded.state.time_ns))
      fault = {in.size() - 1, in.back(), "ends what can't be", wrong};
  }
  for (std::size_t i = 0; i < units.size() && !fault.there(); ++i) {
    if (units[i]->servo() != nullptr) continue;
    const firmware::ProgramState& p = loaded.state.actuators[i].unit.program;
    const std::int64_t line_ns = loaded.buses[config.actuators[i].bus].chain.now_ps / bus::kPsPerNs;
    const auto [low, high] = std::minmax(line_ns, loaded.state.time_ns);
    for (const std::int64_t t : {p.busy_until_ns, p.watchdog.next_clock_ns})
      if (t < low - kFarthestNs || t > high + kFarthestNs)
        fault = {in.size() - 1, static_cast<double>(t), "is a time that no program waits for", "within 11 days of the robot's, ns"};
  }
  if (fault.there()) throw_if_any(fault, room == state::Room::kept ? layout() : StateLayout{});
  return reader.at();
}

template <class Writer>
void Robot::Impl::write_numbers(Writer& writer) const {
  const QuietBuses quiet(buses);
  state::walk_fields(writer, shown());
  for (const auto& bus : buses) walk_bus(writer, *bus);
}

StateLayout Robot::state_layout() const { return impl_->layout(); }
std::size_t Robot::state_size() const { return impl_->numbers; }

void Robot::save(std::span<double> out) const {
  check_state_size(out.size(), impl_->numbers);
  state::Writer writer(out);
  impl_->write_numbers(writer);
  if (writer.fault().there()) throw_if_any(writer.fault(), impl_->layout());
}

void Robot::save_tight(state::Rewriter& out) const {
  if (out.room() < impl_->numbers)
    throw InputError(Problem{"", "state", std::to_string(out.room()) + " numbers", "is too little room for one",
                             std::to_string(impl_->numbers) + " and more"});
  impl_->write_numbers(out);
  throw_if_any(out.fault(), {});
}

void Robot::check(std::span<const double> in) const { impl_->read_numbers(in, state::Room::kept); }

void Robot::restore(std::span<const double> in) { impl_->restore_numbers(in, state::Room::kept); }
std::size_t Robot::restore_tight(std::span<const double> in) { return impl_->restore_numbers(in, state::Room::left_out); }

std::size_t Robot::Impl::restore_numbers(std::span<const double> in, state::Room room) {
  const std::size_t count = read_numbers(in, room);
  loaded.made_of = made_of;
  restore(loaded);
  return count;
}

std::uint64_t Robot::state_hash() const {
  std::vector<double> numbers(state_size());
  save(numbers);
  return vsa::state_hash(numbers);
}

}  // namespace vsa::host
