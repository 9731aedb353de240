// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which unit, and which of its program's defects are repaired.
#pragma once

#include <cstdint>

namespace vsa::firmware {

/// maker_pro: NMMI/qbmove-maker-pro, program "QBMMP v6.1.0". advanced: NMMI/qbmove-advanced, program "QBADV v6.1.6" (commit
/// 1eac9d4; that repository's last commit is a merge that holds 6.1.2 again).
enum class Model : std::uint8_t { maker_pro, advanced };

/// Which years' control loop a maker pro runs; commands, parameters and protocol are those of 6.1 whatever it says. Dates and
/// commits: docs/lab/firmware-history.md.
enum class Generation : std::uint8_t {
  v6,  ///< 6.1 (2016–): 1 kHz
  v4,  ///< 4.0.2 … 5.0.1 (2014-05-15 … 2015-01-28): motors at 500 Hz, the supply's table in steps of 500 mV
  v3,  ///< 3.0.0 … 3.0.2 (2014-04): as v4, with the first table, to 13 V
  v2   ///< 2.0 … 2.1.1 (2014-01 … 04): as v4, without a limit by the supply
};

/// What they differ in. Gains are the same numbers in all, but the derivative is a difference over a loop's period: at 500 Hz the
/// same gain damps twice as much.
struct LoopFacts {
  std::uint8_t ticks = 1;         ///< of 1 ms a loop; encoders are read every tick
  std::int32_t sum_max = 100000;  ///< of the integral's error sum
  bool plain_products = false;    ///< no early shift for far errors, and the output's scaling truncates instead of rounding down
};
/// Of a generation: what holds for 4 holds for 3 and 2.
[[nodiscard]] constexpr LoopFacts loop_facts(Generation g) noexcept {
  return g == Generation::v6 ? LoopFacts{} : LoopFacts{2, 1000, true};
}

/// All false: the program as it is. Each switch repairs one defect and nothing else.
struct Repairs {
  /// 134 (positions) and 137 write their values four bytes apart instead of two: the second lands in the third's place.
  bool layout_134 = false;
  /// The parameter list's checksum covers its first 1200 mod 256 = 176 bytes only. true: all.
  bool list_checksum = false;
  /// The list in mode 5: that mode's name is too long for its place and runs into the text of parameter 7, which then reads "t".
  bool list_mode_5 = false;
  /// A set-parameter request isn't answered in dialect six, which public clients report as failure. true: acknowledged.
  bool acknowledge_set_parameter = false;
  /// The watchdog clears the reported on/off flag only; the motors stay enabled. true: they go off.
  bool watchdog_stops_motors = false;
  /// Watchdog periods 1 and 2 become a counter period of 0. true: at least 1.
  bool watchdog_short_periods = false;
  /// With start-up activation the motors are on, but the flag reads 0 after the first tick. true: it reads as they are.
  bool startup_activation_reported = false;
  /// ACTIVATE enables the motors at once, one to two ticks before the references are the present positions. true: with them.
  bool activation_with_references = false;
  /// Modes 3 and 5 take the current's derivative between two copies of the same sample: it is always 0. true: of the last two.
  bool double_loop_current_derivative = false;
  /// A jump of exactly 32768 or 49152 raw passes the plausibility check, because |jump| is taken in 16 bits. true: it is held back.
  bool jump_check_in_16_bits = false;
  /// Requests shorter than they should be are executed with bytes of earlier frames. true: ignored.
  bool short_frames_refused = false;
  /// Info text: mode 5 prints the single loop's gains (maker pro). true: those in force.
  bool info_gains = false;
  /// Calibration looks for a current above +1000 mA, but motor 2 is driven to negative currents. true: looks at magnitudes.
  bool calibration_both_motors = false;
  /// Advanced unit: the two motors share the memory of the duty's rate limit, and a limited duty that has the other sign goes out
  /// in the unlimited one's direction. true: one memory a motor, direction of what goes out.
  bool pwm_rate_per_motor = false;
  /// Advanced unit: SET_ZEROS doesn't reach the last samples (a loop that never runs), so that its jump counts as motion.
  bool zeros_reset_samples = false;

  bool operator==(const Repairs&) const = default;
};

}  // namespace vsa::firmware
