// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Commands: what a received frame does, and what is sent back.
#pragma once

#include <cstdint>

#include "vsa/bus/messages.hpp"
#include "vsa/firmware/program.hpp"

namespace vsa::firmware {

struct CommandContext {
  const ProgramParams& params;
  const Controller& controller;
  const bus::Wire& wire;
  std::int64_t now_ns;
  ProgramState& state;
  Output& out;
};

/// The frame in the state's receiver.
void execute_frame(const CommandContext& c) noexcept;
void send_info(const CommandContext& c) noexcept;
void send_parameter_list(const CommandContext& c) noexcept;
/// Parameter 1… of command 12; false: no such parameter.
bool set_parameter(const CommandContext& c, const bus::SetParameter& request) noexcept;

/// The first `size` bytes of the output's room go out, after what is going on now.
void send(const CommandContext& c, std::size_t size) noexcept;
void send(const CommandContext& c, const bus::FrameBytes& frame) noexcept;

}  // namespace vsa::firmware
