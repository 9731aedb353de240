// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's parameter memory. Four copies of one set:
//
//   stored    what commands write (the program's g_mem)
//   current   what the loop uses (c_mem)
//   user      the EEPROM's first page: what a power-up loads
//   factory   the EEPROM's page of defaults
//
//   store(page)  current := stored, page := stored. So STORE_DEFAULT, too, makes everything current, and leaves the user page as
//                it was.
//   restore      stored := factory, then store(user); an empty factory page: initialise
//   initialise   stored := the values below, then store(user), store(factory); max steps and baud rate stay what they are
//   recall       (power-up) stored := user, current := stored; an empty user page: restore
//
// At once act: resolutions (in all conversions) and offsets, which the program reads from `stored`, the max_stiffness that info
// text and calibration use, and which control mode ACTIVATE and SET_INPUTS look at. Everything else acts after a store. The ID that
// a unit listens to is the current one; its answers carry the stored one.
//
// Source: NMMI/qbmove-maker-pro 6.1, command_processing.c, globals.h. Sizes: 111 bytes, 7 EEPROM rows of 16.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "vsa/bits.hpp"
#include "vsa/errors.hpp"
#include "vsa/firmware/model.hpp"

namespace vsa::firmware {

/// 16.16 fixed point.
struct Gains {
  std::int32_t p = 0,  ///< proportional
      i = 0,           ///< integral
      d = 0;           ///< derivative
  static auto fields(auto& s, auto&& visit) { return visit("p", "", s.p, "i", "", s.i, "d", "", s.d); }
  bool operator==(const Gains&) const = default;
};

/// One set of the unit's parameters, as its EEPROM has them. Angles are raw, 65536 per turn; gains 16.16 fixed point.
struct Memory {
  bool valid = false;                        ///< false: never written (an empty EEPROM page)
  std::uint8_t id = 0;                       ///< 1…; 0 is broadcast
  Gains position;                            ///< modes 0 and 4: % PWM a raw tick
  Gains current;                             ///< mode 2: % PWM a mA
  Gains double_position;                     ///< modes 3 and 5: mA a raw tick
  Gains double_current;                      ///< modes 3 and 5: % PWM a mA
  std::int16_t current_limit_mA = 0;         ///< modes 2, 3, 5
  std::uint8_t startup_activation = 0;       ///< written to the enable pins at power-up: 3 on
  std::uint8_t input_mode = 0;               ///< 0 bus, 1 third encoder
  std::uint8_t control_mode = 0;             ///< 0…5; others: no output
  std::array<std::uint8_t, 3> resolution{};  ///< ticks = raw >> resolution
  std::array<std::int32_t, 3> offset{};      ///< raw
  std::array<float, 3> multiplier{};         ///< of motor 1, motor 2 and shaft
  std::uint8_t limits_on = 0;                ///< whether references are cut to the limits
  std::array<std::int32_t, 2> limit_low{},   ///< raw
      limit_high{};                          ///< raw
  std::uint16_t max_stiffness = 0;           ///< raw; set by calibration
  std::uint8_t baud_rate = 0;                ///< the divider of 6 MHz, as SET_BAUD_RATE gave it
  std::uint8_t watchdog_period = 0;          ///< of the counter; 0 disables
  std::int32_t max_step_negative = 0,        ///< not used by the program
      max_step_positive = 0;                 ///< not used by the program
  std::uint8_t max_pwm_rate = 255;           ///< advanced unit: % a tick. Not in its initial values; 255 never limits
  std::uint32_t serial_number = 0;           ///< dialect seven
  static auto fields(auto& s, auto&& visit) {
    return visit("valid", "", s.valid, "id", "", s.id, "position", "", s.position, "current", "", s.current, "double_position", "",
                 s.double_position, "double_current", "", s.double_current, "current_limit", "mA", s.current_limit_mA,
                 "startup_activation", "", s.startup_activation, "input_mode", "", s.input_mode, "control_mode", "", s.control_mode,
                 "resolution", "", s.resolution, "offset", "raw", s.offset, "multiplier", "", s.multiplier, "limits_on", "",
                 s.limits_on, "limit_low", "raw", s.limit_low, "limit_high", "raw", s.limit_high, "max_stiffness", "raw",
                 s.max_stiffness, "baud_rate", "", s.baud_rate, "watchdog_period", "", s.watchdog_period, "max_step_negative", "",
                 s.max_step_negative, "max_step_positive", "", s.max_step_positive, "max_pwm_rate", "%", s.max_pwm_rate,
                 "serial_number", "", s.serial_number);
  }
  bool operator==(const Memory&) const = default;
  /// To the bit, for the walk over states.
  [[nodiscard]] bool alike(const Memory& other) const noexcept {
    using Bits = std::array<std::uint32_t, 3>;
    return *this == other && bits_as<Bits>(multiplier) == bits_as<Bits>(other.multiplier);
  }
};
/// What a device's own EEPROM could hold for its program to work; keys are those of files ("limit_low_raw").
void validate(const Memory& memory, std::string_view where, Problems& problems);

/// The four copies that a unit has of its parameters: two in memory, two in the EEPROM.
struct MemoryState {
  Memory stored,                         ///< what commands write
      current;                           ///< what the loop uses
  Memory user,                           ///< the EEPROM's first page
      factory;                           ///< the EEPROM's page of defaults
  static constexpr bool kSeldom = true;  ///< for the walk over states
  static auto fields(auto& s, auto&& visit) {
    return visit("stored", "", s.stored, "current", "", s.current, "user", "", s.user, "factory", "", s.factory);
  }
  bool operator==(const MemoryState&) const = default;
};

/// Of the EEPROM.
enum class Page : std::uint8_t { user, factory };

inline constexpr int kMemoryRows = 7;  ///< EEPROM rows that one store writes

/// What INIT_MEM writes over `was`.
[[nodiscard]] Memory initial_memory(Model model, const Memory& was = {}) noexcept;

/// Each returns the EEPROM rows it wrote: that is the time it takes.
int store(MemoryState& m, Page page) noexcept;
int restore(MemoryState& m, Model model) noexcept;     ///< stored := factory, then stored into the user page
int initialise(MemoryState& m, Model model) noexcept;  ///< the initial values, into both pages
int recall(MemoryState& m, Model model) noexcept;      ///< stored := user, current := stored; an empty page: restore

}  // namespace vsa::firmware
