// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "firmware/commands.hpp"

#include <variant>

#include "vsa/bus/bytes.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::firmware {
namespace {

constexpr std::uint8_t kGetCounters = 138;
constexpr std::int64_t kBootloaderNs = 2'000'000'000;

LoopMemory loop_memory(const ProgramState& s) noexcept { return {s.memory.stored, s.memory.current}; }

bool seven(const CommandContext& c) noexcept { return c.params.dialect == bus::Dialect::seven; }

template <class R>
void answer(const CommandContext& c, const R& reply) noexcept {
  send(c, bus::encode_reply(c.wire, c.state.memory.stored.id, reply));
}

void acknowledge(const CommandContext& c, bus::Command of, std::uint8_t id) noexcept {
  send(c, bus::encode_reply(c.wire, id, bus::Acknowledgement{true}, of));
}
void acknowledge(const CommandContext& c, bus::Command of) noexcept { acknowledge(c, of, c.state.memory.stored.id); }

void count(const CommandContext& c, Counters::Which which) noexcept { ++c.state.counters.value[which]; }

/// Dialect seven sends no offsets: the unit takes where it is as zero.
std::array<Ticks, 3> offsets_to_here(const ProgramState& s) noexcept {
  const Memory& m = s.memory.stored;
  std::array<Ticks, 3> out;
  for (int i = 0; i < 3; ++i) out[i] = {cut_16(shift_right(wrap_sub(m.offset[i], s.loop.meas[i]), m.resolution[i]))};
  return out;
}

void set_zeros(const CommandContext& c, const bus::SetZeros& request) noexcept {
  ProgramState& s = c.state;
  std::array<Ticks, 3> offsets = request.offsets ? *request.offsets : offsets_to_here(s);
  set_offsets(s.memory.stored, s.loop, offsets);
  // Over the wire the advanced unit's motors have the other sign; what the unit takes by itself has its own.
  for (int i = 0; i < 2 && c.params.model == Model::advanced && request.offsets; ++i)
    s.memory.stored.offset[i] = wrap_shl(-std::int32_t{offsets[i].value}, s.memory.stored.resolution[i]);
  if (seven(c)) s.memory.current.offset = s.memory.stored.offset;
  acknowledge(c, bus::Command::set_zeros);
  count(c, Counters::set_zeros);
}

/// A unit whose ID changes answers with its old one, because the host doesn't know better.
void store_parameters(const CommandContext& c) noexcept {
  ProgramState& s = c.state;
  const std::uint8_t id = s.memory.current.id;
  move_references(loop_memory(s), s.loop);
  begin_store(c.params, s, store(s.memory, Page::user), c.now_ns);
  acknowledge(c, bus::Command::store_parameters, id);
  count(c, Counters::stores);
}

void write_memory(const CommandContext& c, bus::Command command) noexcept {
  ProgramState& s = c.state;
  int rows = 0;
  if (command == bus::Command::store_defaults) rows = store(s.memory, Page::factory);
  if (command == bus::Command::restore_defaults) rows = restore(s.memory, c.params.model);
  if (command == bus::Command::init_memory) rows = initialise(s.memory, c.params.model);
  begin_store(c.params, s, rows, c.now_ns);
  acknowledge(c, command);
}

void activate(const CommandContext& c, std::uint8_t flags) noexcept {
  ProgramState& s = c.state;
  const std::uint8_t granted = request_activation(loop_memory(s), s.loop, flags);
  const bool any = c.params.model == Model::advanced && granted != 0;
  s.activation_waits = c.params.repairs.activation_with_references && granted != 0;
  if (!s.activation_waits) s.enable = any ? 3 : granted & 3;
  count(c, Counters::activate);
}

void set_watchdog(const CommandContext& c, std::uint8_t requested) noexcept {
  ProgramState& s = c.state;
  Watchdog& dog = s.watchdog;
  dog.enabled = requested != 0;
  std::uint8_t period = watchdog_period(requested);
  if (c.params.repairs.watchdog_short_periods && requested != 0 && period == 0) period = 1;
  s.memory.stored.watchdog_period = period;
  if (dog.enabled) dog.period = period;
  // The program corrects the number where it lies, for shorter frames to come.
  if (requested > 250) s.receiver.frame.body[1] = 250;
}

void set_baud_rate(const CommandContext& c, std::uint8_t divider) noexcept {
  c.state.memory.current.baud_rate = divider;
  c.state.baud_divider = divider == 13 ? 13 : 3;
  c.out.baud_changed = true;
}

void enter_bootloader(const CommandContext& c) noexcept {
  acknowledge(c, bus::Command::bootloader);
  c.state.busy_until_ns += kBootloaderNs;
  c.state.in_bootloader = true;
  c.out.bootloader = true;
}

void get_counters(const CommandContext& c) noexcept {
  std::array<std::uint8_t, 2 * std::size_t{Counters::kCount}> payload;
  bus::ByteWriter out{payload};
  for (const std::uint16_t v : c.state.counters.value) out.u16(v);
  send(c, bus::encode_frame(c.state.memory.stored.id, kGetCounters, payload));
  count(c, Counters::counters);
}

/// One overload a request.
struct Executor {
  const CommandContext& c;
  ProgramState& s = c.state;

  void operator()(const bus::Ping&) const noexcept {
    answer(c, bus::PingReply{s.memory.stored.serial_number});
    count(c, Counters::ping);
  }
  void operator()(const bus::SetZeros& r) const noexcept { set_zeros(c, r); }
  void operator()(const bus::StoreParameters&) const noexcept { store_parameters(c); }
  void operator()(const bus::StoreDefaults&) const noexcept { write_memory(c, bus::Command::store_defaults); }
  void operator()(const bus::RestoreDefaults&) const noexcept { write_memory(c, bus::Command::restore_defaults); }
  void operator()(const bus::InitMemory&) const noexcept { write_memory(c, bus::Command::init_memory); }
  void operator()(const bus::GetInfo& r) const noexcept {
    if (r.kind == 0) send_info(c);
    count(c, Counters::info);
  }
  void operator()(const bus::Bootloader&) const noexcept { enter_bootloader(c); }
  void operator()(const bus::Calibrate&) const noexcept {
    s.calibration.stage = Calibration::Stage::start;
    acknowledge(c, bus::Command::calibrate);
  }
  void operator()(const bus::GetParameterList&) const noexcept {
    send_parameter_list(c);
    count(c, Counters::parameters);
  }
  void operator()(const bus::SetParameter& r) const noexcept {
    const bool set = set_parameter(c, r);
    if (set && (seven(c) || c.params.repairs.acknowledge_set_parameter)) acknowledge(c, bus::Command::parameters);
    count(c, Counters::parameters);
  }
  void operator()(const bus::Activate& r) const noexcept { activate(c, r.flags); }
  void operator()(const bus::GetActivate&) const noexcept {
    answer(c, bus::ActivationReply{s.loop.orders.onoff});
    count(c, Counters::get_activate);
  }
  void operator()(const bus::SetInputs& r) const noexcept {
    firmware::set_inputs(c.params.model, loop_memory(s), s.loop, r.inputs);
    count(c, Counters::set_inputs);
  }
  void operator()(const bus::SetInputsAcknowledged& r) const noexcept {
    (*this)(bus::SetInputs{r.inputs});
    acknowledge(c, bus::Command::set_inputs_acknowledged);
  }
  void operator()(const bus::GetInputs&) const noexcept {
    answer(c, bus::InputsReply{firmware::inputs(s.memory.stored, s.loop)});
    count(c, Counters::inputs);
  }
  void operator()(const bus::GetMeasurements&) const noexcept {
    answer(c, bus::MeasurementsReply{positions(c.params.model, s.memory.stored, s.loop)});
    count(c, Counters::measurements);
  }
  void operator()(const bus::GetCurrents&) const noexcept {
    answer(c, bus::CurrentsReply{currents_mA(s.loop)});
    count(c, Counters::currents);
  }
  void operator()(const bus::GetCurrentsAndMeasurements&) const noexcept {
    answer(c, bus::CurrentsAndMeasurementsReply{currents_mA(s.loop), positions(c.params.model, s.memory.stored, s.loop)});
    count(c, Counters::currents_measurements);
  }
  void operator()(const bus::SetPositionStiffness& r) const noexcept {
    set_position_stiffness(c.params.model, loop_memory(s), s.loop, r.position, r.stiffness);
    count(c, Counters::set_position_stiffness);
  }
  void operator()(const bus::GetVelocities&) const noexcept {
    answer(c, bus::VelocitiesReply{});
    count(c, Counters::velocities);
  }
  void operator()(const bus::SetWatchdog& r) const noexcept { set_watchdog(c, r.period); }
  void operator()(const bus::SetBaudRate& r) const noexcept { set_baud_rate(c, r.divider); }
  void operator()(const bus::GetCycleTime&) const noexcept { answer(c, bus::CycleTimeReply{0, c.params.cycle_time_us}); }
};

}  // namespace

void execute_frame(const CommandContext& c) noexcept {
  const bus::Frame& frame = c.state.receiver.frame;
  if (c.params.model == Model::advanced && frame.command() == kGetCounters) return get_counters(c);
  if (c.params.repairs.short_frames_refused && !bus::complete(c.wire, frame)) return;
  if (const auto request = bus::decode_request(c.wire, frame)) std::visit(Executor{c}, *request);
}

}  // namespace vsa::firmware
