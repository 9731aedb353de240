// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The info text of GET_INFO and of "?" CR LF: lines that end in CR LF, sent raw in dialect six. Clients look for lines such as
// "Max stiffness: 3000" (ticks) and "Position limit motor 1: inf -> -15000  sup -> 15000".
//
// Numbers are printed with the device's types: `int` has 16 bits, so that %d of a large raw value shows its lower half; %f prints a
// single-precision value with six decimals. Which of the two sets a line shows differs from line to line, as in the program.
//
// Source: NMMI/qbmove-maker-pro 6.1, infoPrepare; NMMI/qbmove-advanced 6.1.6.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "vsa/firmware/controller.hpp"

namespace vsa::firmware {

/// The program's buffer has 1100 bytes; the longest text is shorter.
inline constexpr std::size_t kInfoBytes = 1100;

/// What the text is about.
struct InfoSource {
  Model model = Model::maker_pro;  ///< whose text
  Repairs repairs{};               ///< what it reads otherwise then
  LoopMemory memory;               ///< whose values it shows
  const ControllerState& loop;     ///< whose loop
  std::uint32_t loop_time_us = 0;  ///< the line "debug"
};

/// The text, in `buffer`; cut if it doesn't fit.
[[nodiscard]] std::string_view info_text(const InfoSource& source, std::span<char> buffer) noexcept;

}  // namespace vsa::firmware
