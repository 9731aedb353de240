// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's whole program: bytes in, bytes and duty out, one tick a millisecond.
//
// Frames are handled when their last byte arrives; replies come from the last completed tick. A tick has two halves: `begin_tick`
// samples the encoders and drives the motors, `end_tick` reads supply and currents, calibrates, and makes the new references and
// measurements valid. The device's own loop spends an unknown part of the millisecond between them; bytes handed over in between
// see the tick before, as on the device. `tick` does both at once.
//
// While the program stores or sends it does nothing else: bytes wait in the receive buffer (32), ticks that begin and end in that
// time don't happen, and the one that is late runs at its own time (the device: at the end of the wait, less than 1 ms later).
// PWM is 0 from the beginning of a store to the next tick. `wake_ns` says when waiting bytes are due.
//
// Times: EEPROM_row_write is 10 ms (UNKNOWN on the unit; seven rows a store, so 70 ms; hosts wait 1 s); replies take their wire
// time.
//
// Sources: NMMI/qbmove-maker-pro 6.1 (main.c, interruptions.c, command_processing.c); NMMI/qbmove-advanced 6.1.6. Dialect seven has
// no public firmware: its answers are what qbdevice-api 7.2.8 expects (docs/explanation/4-firmware.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "vsa/bus/frame.hpp"
#include "vsa/bus/messages.hpp"
#include "vsa/firmware/controller.hpp"
#include "vsa/firmware/memory.hpp"
#include "vsa/firmware/model.hpp"
#include "vsa/firmware/output.hpp"
#include "vsa/firmware/receive_buffer.hpp"
#include "vsa/firmware/watchdog.hpp"

namespace vsa::firmware {

/// What a unit's program is made of, beside its parameter memory.
struct ProgramParams {
  Model model = Model::maker_pro;            ///< whose program
  bus::Dialect dialect = bus::Dialect::six;  ///< which it speaks
  Repairs repairs{};                         ///< the defects that are none
  Generation generation = Generation::v6;    ///< of a maker pro's control loop
  std::optional<bool> supply_table;          ///< duty limited by the supply; none: as the model has it (maker pro yes, advanced no)
  std::int64_t row_write_ns = 10'000'000;    ///< EEPROM row of 16 bytes
  std::uint32_t loop_time_us = 0;            ///< info text's "debug": the loop's run time, UNKNOWN
  std::int16_t cycle_time_us = 1000;         ///< dialect seven, GET_CYCLE_TIME
  bool operator==(const ProgramParams&) const = default;
};
/// A row and a loop time that are no times.
void validate(const ProgramParams& params, std::string_view where, Problems& problems);

/// CALIBRATE: every 100 ms a step. Motors to 0, a second's wait, then 91 raw (0.5°) apart a step with PD 0.1/0.3 until a current is
/// above +1000 mA; that reference is max_stiffness. Motors to 0, a second's wait, store both pages. The maker pro doesn't hear its
/// bus from the first step to the end; the advanced unit (6.1.6) does, and keeps its own gains.
struct Calibration {
  /// Where it is.
  enum class Stage : std::uint8_t { stop, start, go_apart, finish, wait_before, wait_after };
  Stage stage = Stage::stop;  ///< what comes next
  std::uint16_t divider = 1;  ///< ticks to 100; keeps its value between calibrations
  std::uint8_t pauses = 0;    ///< tenths of a second waited
  Gains saved{};              ///< the position gains that it comes back to
  static auto fields(auto& s, auto&& visit) {
    return visit("stage", "", s.stage, "divider", "", s.divider, "pauses", "", s.pauses, "saved", "", s.saved);
  }
};
[[nodiscard]] constexpr int choices(Calibration::Stage) noexcept { return 6; }  ///< for the walk over states

/// GET_COUNTERS of the advanced unit, in the order of its reply. Some are never counted.
struct Counters {
  /// One for each command; kCount: how many there are.
  enum Which : std::uint8_t {
    activate,
    set_inputs,
    set_position_stiffness,
    measurements,
    currents,
    currents_measurements,
    velocities,
    get_activate,
    inputs,
    info,
    set_zeros,
    parameters,
    ping,
    stores,
    store_default,
    restores,
    init,
    bootloader,
    calibrate,
    counters,
    kCount
  };
  std::array<std::uint16_t, kCount> value{};  ///< of each
  static auto fields(auto& s, auto&& visit) { return visit("value", "", s.value); }
};

/// All that changes of a program.
struct ProgramState {
  ControllerState loop;            ///< the controller
  MemoryState memory;              ///< the four copies of the parameters
  bus::UnitReceiver receiver;      ///< of frames
  ReceiveBuffer buffer;            ///< bytes that came while it was busy
  Watchdog watchdog;               ///< see firmware/watchdog.hpp
  Calibration calibration;         ///< of CALIBRATE
  Counters counters;               ///< of GET_COUNTERS
  std::int64_t busy_until_ns = 0;  ///< stores and answers: nothing else is done until then
  std::uint8_t enable = 0;         ///< enable pins: bit 0 motor 1, bit 1 motor 2
  std::uint8_t baud_divider = 3;   ///< of 6 MHz: 2 Mbaud
  bool activation_waits = false;   ///< Repairs::activation_with_references
  bool bytes_waiting = false;      ///< bytes that the program hasn't looked at
  bool receiver_off = false;       ///< during a calibration: nothing is heard
  bool in_bootloader = false;      ///< silent until the next power-up
  static auto fields(auto& s, auto&& visit) {
    return visit("loop", "", s.loop, "memory", "", s.memory, "receiver", "", s.receiver, "buffer", "", s.buffer, "watchdog", "",
                 s.watchdog, "calibration", "", s.calibration, "counters", "", s.counters, "busy_until", "ns", s.busy_until_ns,
                 "enable", "", s.enable, "baud_divider", "", s.baud_divider, "activation_waits", "", s.activation_waits,
                 "bytes_waiting", "", s.bytes_waiting, "receiver_off", "", s.receiver_off, "in_bootloader", "", s.in_bootloader);
  }
  [[nodiscard]] const char* impossible() const noexcept { return baud_divider > 0 ? nullptr : "a baud_divider from 1 on"; }
};

/// What the bridge gets: percent of full duty, signed; nothing while a motor's enable pin is off.
struct Drive {
  std::array<std::int32_t, 2> duty_pct{};  ///< percent of full duty, signed by the direction pin
  std::array<bool, 2> enabled{};           ///< bits 0 and 1 of `enable`
};

/// A unit's program: bytes and inputs in, bytes and duty out. It holds parameters only, so that units share it; the state is the
/// owner's.
class Program {
 public:
  explicit Program(const ProgramParams& params) noexcept;                              ///< checked by validate() alone
  [[nodiscard]] const ProgramParams& params() const noexcept { return params_; }       ///< as given
  [[nodiscard]] const Controller& controller() const noexcept { return controller_; }  ///< of the same parameters
  [[nodiscard]] const bus::Wire& wire() const noexcept { return wire_; }               ///< how it speaks

  /// A unit with an empty EEPROM, switched on: it has written its initial values and is ready.
  [[nodiscard]] ProgramState fresh(std::int64_t now_ns) const noexcept;
  /// A unit whose EEPROM holds these parameters in both pages, switched on.
  [[nodiscard]] ProgramState fresh(std::int64_t now_ns, const Memory& shipped) const noexcept;
  /// Power comes back: the EEPROM's pages are what stays. The references are 0, and so are the turns.
  void power_up(ProgramState& s, std::int64_t now_ns) const noexcept;

  /// A byte of the bus, at its stop bit's end.
  void receive(ProgramState& s, std::uint8_t byte, std::int64_t now_ns, Output& out) const noexcept;
  /// Whether a whole frame that is on the wire from `begin_ns` (its first byte's end) to `end_ns` may come by receive_frame: the
  /// program is free, waits for a frame's beginning, and the watchdog's clock doesn't tick meanwhile.
  [[nodiscard]] bool hears_frames(const ProgramState& s, std::int64_t begin_ns, std::int64_t end_ns) const noexcept {
    return s.busy_until_ns <= begin_ns && s.receiver.at_rest() && !s.bytes_waiting && !s.receiver_off && s.buffer.empty() &&
           !s.buffer.overflow && (s.watchdog.next_clock_ns > end_ns || s.watchdog.next_clock_ns <= begin_ns);
  }
  /// The bytes of one bus::whole_frame at once: the same as byte by byte, at a fraction of the cost. Only if hears_frames.
  void receive_frame(ProgramState& s, std::span<const std::uint8_t> frame, std::int64_t now_ns, Output& out) const noexcept;
  /// The same of frames for other units, so many bytes in all, between two of the watchdog's clocks: the last one's ID, length and time.
  static void let_pass(ProgramState& s, std::size_t bytes, std::uint8_t id, std::uint8_t length, std::int64_t now_ns) noexcept;
  /// Moves what the program waits for: a host's time jumped, and the unit doesn't notice.
  static void shift_time(ProgramState& s, std::int64_t by_ns) noexcept;
  /// Looks at bytes that waited. Harmless at any time.
  void poll(ProgramState& s, std::int64_t now_ns, Output& out) const noexcept;
  /// When `poll` has something to do; none: nothing waits.
  [[nodiscard]] std::optional<std::int64_t> wake_ns(const ProgramState& s) const noexcept;

  /// The first half of a tick: samples the encoders, drives the motors.
  void begin_tick(ProgramState& s, const TickInputs& in, std::int64_t now_ns, Output& out) const noexcept;
  /// Supply, currents, calibration, references.
  void end_tick(ProgramState& s, const TickInputs& in, std::int64_t now_ns, Output& out) const noexcept;
  void tick(ProgramState& s, const TickInputs& in, std::int64_t now_ns, Output& out) const noexcept;  ///< both, as one

  [[nodiscard]] Drive drive(const ProgramState& s) const noexcept;  ///< until the next tick

 private:
  [[nodiscard]] bool skips(const ProgramState& s, std::int64_t now_ns) const noexcept;
  void calibrate(ProgramState& s, std::int64_t now_ns) const noexcept;
  void calibration_step(ProgramState& s, std::int64_t now_ns) const noexcept;
  void finish_calibration(ProgramState& s, std::int64_t now_ns) const noexcept;
  void drain(ProgramState& s, std::int64_t now_ns, Output& out) const noexcept;

  ProgramParams params_;
  Controller controller_;
  bus::Wire wire_;
};

/// What a simulation starts with instead of a power-up: a unit that has been on for long and stands on its references (the new ones
/// of the state), motors enabled, turns counted, no derivative kick at the first tick, the supply's limit in force.
void settle(const Program& program, ProgramState& s, const TickInputs& in) noexcept;

/// The baud rate of a divider: 2 000 000, or 461 538 for 13 (called 460 800).
[[nodiscard]] constexpr double baud_Hz(std::uint8_t divider) noexcept { return 6'000'000.0 / divider; }

/// From now on the program stores: PWM 0, and busy for the rows' time.
void begin_store(const ProgramParams& p, ProgramState& s, int rows, std::int64_t now_ns) noexcept;

}  // namespace vsa::firmware
