// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every message of the unit as a type.
//
// Two dialects:
//   six    firmware 6.1 (public source). PING answers nothing but itself; an acknowledgement is [v][v] with v = 1 or 0, without the
//          command's number (so that "refused" looks like a ping's answer); setting a parameter isn't answered; info text and
//          parameter list are longer than LEN can say: the text comes raw, the list with LEN = 1201 mod 256.
//   seven  as the public client qbdevice-api 7.2.8 expects it: PING answers a serial number, an acknowledgement is
//          [command][v][CHK], setting a parameter is acknowledged, SET_INPUTS_ACK and GET_CYCLE_TIME exist, long answers have
//          LEN = bytes/32.
// A request's payload is read as the unit reads it: at fixed offsets, whatever LEN said. `complete` tells whether LEN covered it.
//
// Sources: NMMI/qbmove-maker-pro 6.1 (command_processing.c), NMMI/qbAPI, qbdevice-api 7.2.8 in revyos-ros/qbdevice-ros2-release.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "vsa/bus/frame.hpp"
#include "vsa/units.hpp"

namespace vsa::bus {

/// CMD: the command's number on the wire.
enum class Command : std::uint8_t {
  ping = 0,
  set_zeros = 1,
  store_parameters = 3,
  store_defaults = 4,
  restore_defaults = 5,
  get_info = 6,
  bootloader = 9,
  init_memory = 10,
  calibrate = 11,
  parameters = 12,  ///< index 0: list; from 1: set
  activate = 128,
  get_activate = 129,
  set_inputs = 130,
  get_inputs = 131,
  get_measurements = 132,
  get_currents = 133,
  get_currents_and_measurements = 134,
  set_position_stiffness = 135,
  get_velocities = 137,
  set_watchdog = 143,
  set_baud_rate = 144,
  set_inputs_acknowledged = 147,  ///< dialect seven
  get_cycle_time = 150,           ///< dialect seven
};

/// Which firmware's messages: six is 6.1 (public source), seven what qbdevice-api 7.2.8 expects.
enum class Dialect : std::uint8_t { six = 6, seven = 7 };

/// How a unit speaks.
struct Wire {
  Dialect dialect = Dialect::six;  ///< which one it speaks
  /// Firmware 6.1 writes the values of 134 (positions) and 137 four bytes apart instead of two: the first is right, the second
  /// lands in the third's place, the third is lost, and two bytes are never written. true: two apart, as clients read them. Dialect
  /// seven always has them two apart.
  bool repair_layout = false;
  /// Firmware 6.1 counts the checksum's bytes in 8 bits: the parameter list's CHK covers the first 1200 mod 256 = 176 bytes only.
  /// true: all 1200. Dialect seven's client checks all.
  bool repair_list_checksum = false;

  /// Whether 134 and 137 have their values two bytes apart.
  [[nodiscard]] constexpr bool packed() const noexcept { return repair_layout || dialect == Dialect::seven; }
  bool operator==(const Wire&) const = default;
};

// ---------------------------------------------------------------------------------------------------------------------- replies

/// The unit says nothing.
struct NoReply {
  bool operator==(const NoReply&) const = default;
};
/// The answer is no frame: see encode_info, and encode_parameter_list in parameters.hpp.
struct StreamReply {
  bool operator==(const StreamReply&) const = default;
};
/// It is there.
struct PingReply {
  std::uint32_t serial_number = 0;  ///< dialect seven; six doesn't send it
  bool operator==(const PingReply&) const = default;
};
/// Done, or not done.
struct Acknowledgement {
  bool ok = true;  ///< 1 on the wire; false: 0
  bool operator==(const Acknowledgement&) const = default;
};
/// Whether the motors are on.
struct ActivationReply {
  std::uint8_t flags = 0;  ///< 3 on, 0 off
  bool operator==(const ActivationReply&) const = default;
};
/// The references that the unit has.
struct InputsReply {
  std::array<Ticks, 2> inputs{};  ///< of motor 1 and 2
  bool operator==(const InputsReply&) const = default;
};
/// The angles that the unit reads.
struct MeasurementsReply {
  std::array<Ticks, 3> positions{};  ///< motor 1, motor 2, shaft
  bool operator==(const MeasurementsReply&) const = default;
};
/// The currents that the program measures, filtered.
struct CurrentsReply {
  std::array<std::int16_t, 2> currents_mA{};  ///< of motor 1 and 2
  bool operator==(const CurrentsReply&) const = default;
};
/// Both, in one answer.
struct CurrentsAndMeasurementsReply {
  std::array<std::int16_t, 2> currents_mA{};  ///< of motor 1 and 2
  std::array<Ticks, 3> positions{};           ///< the shaft's isn't sent in firmware 6.1's layout: decoded as 0
  bool operator==(const CurrentsAndMeasurementsReply&) const = default;
};
/// Speeds of motor 1, motor 2 and shaft.
struct VelocitiesReply {
  std::array<std::int16_t, 3> velocities{};  ///< as above; firmware 6.1 never computes them
  bool operator==(const VelocitiesReply&) const = default;
};
/// How long the program's loop takes. Dialect seven.
struct CycleTimeReply {
  std::int16_t unknown = 0;     ///< the client skips it; no public source says what it is
  std::int16_t cycle_time = 0;  ///< as sent; its unit isn't public
  bool operator==(const CycleTimeReply&) const = default;
};

// --------------------------------------------------------------------------------------------------------------------- requests

/// A request without a payload. Of every request `code` is the command's number and `Reply` dialect six's answer, except where it says
/// otherwise.
template <Command C, class R>
struct Request0 {
  static constexpr Command code = C;  ///< its number
  using Reply = R;                    ///< what answers it
  bool operator==(const Request0&) const = default;
};

using Ping = Request0<Command::ping, PingReply>;  ///< is a unit there
/// What was set goes into the EEPROM, and acts from now on.
using StoreParameters = Request0<Command::store_parameters, Acknowledgement>;
using StoreDefaults = Request0<Command::store_defaults, Acknowledgement>;      ///< likewise, into the page of defaults
using RestoreDefaults = Request0<Command::restore_defaults, Acknowledgement>;  ///< the factory page's parameters again, stored
using Bootloader = Request0<Command::bootloader, Acknowledgement>;             ///< leaves the program for its loader
using InitMemory = Request0<Command::init_memory, Acknowledgement>;            ///< the program's initial values, into both pages
using Calibrate = Request0<Command::calibrate, Acknowledgement>;  ///< the unit looks for its largest preset (firmware::Calibration)
using GetActivate = Request0<Command::get_activate, ActivationReply>;            ///< are the motors on
using GetInputs = Request0<Command::get_inputs, InputsReply>;                    ///< the references
using GetMeasurements = Request0<Command::get_measurements, MeasurementsReply>;  ///< the angles
using GetCurrents = Request0<Command::get_currents, CurrentsReply>;              ///< the currents
using GetCurrentsAndMeasurements = Request0<Command::get_currents_and_measurements, CurrentsAndMeasurementsReply>;  ///< both
using GetVelocities = Request0<Command::get_velocities, VelocitiesReply>;  ///< firmware 6.1 answers without computing them
using GetCycleTime = Request0<Command::get_cycle_time, CycleTimeReply>;    ///< dialect seven

/// Dialect seven's client sends no offsets: the unit takes its present position as zero.
struct SetZeros {
  static constexpr Command code = Command::set_zeros;  ///< its number
  using Reply = Acknowledgement;                       ///< what answers it
  /// Of motor 1, motor 2 and shaft; none: the present position.
  std::optional<std::array<Ticks, 3>> offsets = std::array<Ticks, 3>{};
  bool operator==(const SetZeros&) const = default;
};
/// The unit's text about itself.
struct GetInfo {
  static constexpr Command code = Command::get_info;  ///< its number
  using Reply = StreamReply;                          ///< what answers it
  std::uint16_t kind = 0;                             ///< 0 all; the unit doesn't answer others
  bool operator==(const GetInfo&) const = default;
};
/// All parameters, with their texts and menus.
struct GetParameterList {
  static constexpr Command code = Command::parameters;  ///< the number; SetParameter has the same
  using Reply = StreamReply;                            ///< what answers it
  bool operator==(const GetParameterList&) const = default;
};
/// Values by parameters.hpp. Not answered in dialect six, acknowledged in seven.
struct SetParameter {
  static constexpr Command code = Command::parameters;  ///< the number; GetParameterList has the same
  using Reply = Acknowledgement;                        ///< in dialect seven
  static constexpr std::size_t kMaxValueBytes = 16;     ///< of the longest value
  std::uint16_t index = 1;                              ///< ParameterId; 0 would ask for the list
  std::array<std::uint8_t, kMaxValueBytes> value{};     ///< as parameters.hpp writes them
  std::uint8_t value_bytes = 0;  ///< sent; when a unit decodes, what LEN covered (the rest of `value` is stale, and it reads it)
  bool operator==(const SetParameter&) const = default;
};
/// Motors on or off.
struct Activate {
  static constexpr Command code = Command::activate;  ///< its number
  using Reply = NoReply;                              ///< not answered
  std::uint8_t flags = 0;                             ///< 3 on, 0 off; written to the enable pins as it is
  bool operator==(const Activate&) const = default;
};
/// The two references, one a motor.
struct SetInputs {
  static constexpr Command code = Command::set_inputs;  ///< its number
  using Reply = NoReply;                                ///< not answered
  std::array<Ticks, 2> inputs{};                        ///< of motor 1 and 2
  bool operator==(const SetInputs&) const = default;
};
/// SET_INPUTS that is answered. Dialect seven.
struct SetInputsAcknowledged {
  static constexpr Command code = Command::set_inputs_acknowledged;  ///< its number
  using Reply = Acknowledgement;                                     ///< what answers it
  std::array<Ticks, 2> inputs{};                                     ///< of motor 1 and 2
  bool operator==(const SetInputsAcknowledged&) const = default;
};
/// Equilibrium and preset, of which the unit makes the two references.
struct SetPositionStiffness {
  static constexpr Command code = Command::set_position_stiffness;  ///< its number
  using Reply = NoReply;                                            ///< not answered
  Ticks position{};                                                 ///< of the shaft
  std::int16_t stiffness = 0;                                       ///< of 32768: the part of max_stiffness
  bool operator==(const SetPositionStiffness&) const = default;
};
/// How long the unit stays on without a message.
struct SetWatchdog {
  static constexpr Command code = Command::set_watchdog;  ///< its number
  using Reply = NoReply;                                  ///< not answered
  std::uint8_t period = 0;                                ///< about 20 ms each; 0 disables
  bool operator==(const SetWatchdog&) const = default;
};
/// The rate that the unit listens and speaks at.
struct SetBaudRate {
  static constexpr Command code = Command::set_baud_rate;  ///< its number
  using Reply = NoReply;                                   ///< not answered
  std::uint8_t divider = 3;                                ///< 13: 460 800 baud; anything else: 2 000 000
  bool operator==(const SetBaudRate&) const = default;
};

/// Any request.
using Request = std::variant<Ping, SetZeros, StoreParameters, StoreDefaults, RestoreDefaults, GetInfo, Bootloader, InitMemory,
                             Calibrate, GetParameterList, SetParameter, Activate, GetActivate, SetInputs, GetInputs,
                             GetMeasurements, GetCurrents, GetCurrentsAndMeasurements, SetPositionStiffness, GetVelocities,
                             SetWatchdog, SetBaudRate, SetInputsAcknowledged, GetCycleTime>;

// The codec of these types is in codec.hpp.

}  // namespace vsa::bus
