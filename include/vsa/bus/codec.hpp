// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Between message types and frames, both ways, in both dialects. Pure functions; nothing allocates or throws.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "vsa/bus/frame.hpp"
#include "vsa/bus/messages.hpp"

namespace vsa::bus {

// ------------------------------------------------------------------------------------------------------------------ unit's side

/// The request in a frame, read at fixed offsets as the unit does, stale bytes included. None: the unit knows no such command in
/// this dialect and says nothing. Parameter indices aren't checked here.
[[nodiscard]] std::optional<Request> decode_request(Wire wire, const Frame& frame) noexcept;

/// Whether the frame's LEN covers all that the request reads. Real units don't look.
[[nodiscard]] bool complete(Wire wire, const Frame& frame) noexcept;

/// How a unit answers.
enum class ReplyKind : std::uint8_t { none, frame, parameter_list, info };
/// What a unit answers to a request it executes.
[[nodiscard]] ReplyKind reply_kind(Wire wire, const Request& request) noexcept;

/// Replies as frames, from the unit `id`. One function a reply; `bus::encode_reply(wire, id, MeasurementsReply{…})`.
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const PingReply& reply) noexcept;
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const ActivationReply& reply) noexcept;  ///< flags as they are
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const InputsReply& reply) noexcept;  ///< in the sense of the wire
/// In the sense of the wire.
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const MeasurementsReply& reply) noexcept;
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const CurrentsReply& reply) noexcept;  ///< mA
/// By repair_layout two or four bytes apart.
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const CurrentsAndMeasurementsReply& reply) noexcept;
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const VelocitiesReply& reply) noexcept;  ///< likewise
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const CycleTimeReply& reply) noexcept;   ///< dialect seven
/// An acknowledgement needs to know what it answers: dialect seven carries the command.
[[nodiscard]] FrameBytes encode_reply(Wire wire, std::uint8_t id, const Acknowledgement& reply, Command of) noexcept;

/// Bytes that encode_info writes for a text of this length.
[[nodiscard]] std::size_t info_bytes(Wire wire, std::size_t text_bytes) noexcept;
/// The info answer: dialect six, the text as it is; seven, a long packet (LEN·32 bytes after the header, zeros behind the text; at
/// most 255·32). Returns the bytes written, 0 if `out` is too small or the text too long.
std::size_t encode_info(Wire wire, std::uint8_t id, std::string_view text, std::span<std::uint8_t> out) noexcept;

// ------------------------------------------------------------------------------------------------------------------ master's side

/// A whole frame, checksum included.
[[nodiscard]] FrameBytes encode_request(Wire wire, std::uint8_t id, const Request& request) noexcept;

/// The reply in a frame that answers `command`. None: wrong command, wrong length.
/// Specialised for every reply below; other types don't link.
template <class R>
[[nodiscard]] std::optional<R> decode_reply(Wire wire, Command command, const Frame& frame) noexcept;

template <>
std::optional<PingReply> decode_reply<PingReply>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<Acknowledgement> decode_reply<Acknowledgement>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<ActivationReply> decode_reply<ActivationReply>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<InputsReply> decode_reply<InputsReply>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<MeasurementsReply> decode_reply<MeasurementsReply>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<CurrentsReply> decode_reply<CurrentsReply>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<CurrentsAndMeasurementsReply> decode_reply<CurrentsAndMeasurementsReply>(Wire wire, Command command,
                                                                                       const Frame& frame) noexcept;
template <>
std::optional<VelocitiesReply> decode_reply<VelocitiesReply>(Wire wire, Command command, const Frame& frame) noexcept;
template <>
std::optional<CycleTimeReply> decode_reply<CycleTimeReply>(Wire wire, Command command, const Frame& frame) noexcept;

/// Whether this frame can answer this request at all: right number (in dialect six an acknowledgement has none), any content.
[[nodiscard]] bool answers(Wire wire, Command command, const Frame& frame) noexcept;

}  // namespace vsa::bus
