// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Big-endian values, field by field. The unit's processor is big-endian by its compiler and copies memory to the wire.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace vsa::bus {

static_assert(sizeof(float) == 4, "the wire carries IEEE-754 single precision");

/// Writes values one after another; what doesn't fit is dropped and marked.
class ByteWriter {
 public:
  explicit constexpr ByteWriter(std::span<std::uint8_t> out) noexcept : out_(out) {}  ///< writes into `out`, which must outlive it

  /// As it is.
  constexpr void u8(std::uint8_t v) noexcept {
    if (size_ < out_.size())
      out_[size_++] = v;
    else
      overflowed_ = true;
  }
  /// High byte first, as the next ones.
  constexpr void u16(std::uint16_t v) noexcept {
    u8(static_cast<std::uint8_t>(v >> 8));
    u8(static_cast<std::uint8_t>(v & 0xFF));
  }
  /// High byte first.
  constexpr void u32(std::uint32_t v) noexcept {
    u16(static_cast<std::uint16_t>(v >> 16));
    u16(static_cast<std::uint16_t>(v & 0xFFFF));
  }
  constexpr void i16(std::int16_t v) noexcept { u16(static_cast<std::uint16_t>(v)); }  ///< two's complement
  constexpr void i32(std::int32_t v) noexcept { u32(static_cast<std::uint32_t>(v)); }  ///< two's complement
  /// IEEE-754 single precision.
  void f32(float v) noexcept {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &v, sizeof bits);
    u32(bits);
  }
  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }       ///< bytes written
  [[nodiscard]] constexpr bool overflowed() const noexcept { return overflowed_; }  ///< whether something didn't fit

 private:
  std::span<std::uint8_t> out_;
  std::size_t size_ = 0;
  bool overflowed_ = false;
};

/// Reads values one after another; past the end it reads zeros and marks it.
class ByteReader {
 public:
  explicit constexpr ByteReader(std::span<const std::uint8_t> in) noexcept : in_(in) {}  ///< reads `in`, which must outlive it

  /// 0 past the end.
  constexpr std::uint8_t u8() noexcept {
    if (at_ < in_.size()) return in_[at_++];
    overran_ = true;
    return 0;
  }
  /// High byte first, as the next ones.
  constexpr std::uint16_t u16() noexcept {
    const std::uint8_t high = u8();
    return static_cast<std::uint16_t>((high << 8) | u8());
  }
  /// High byte first.
  constexpr std::uint32_t u32() noexcept {
    const std::uint32_t high = u16();
    return (high << 16) | u16();
  }
  constexpr std::int16_t i16() noexcept { return static_cast<std::int16_t>(u16()); }  ///< two's complement
  constexpr std::int32_t i32() noexcept { return static_cast<std::int32_t>(u32()); }  ///< two's complement
  /// IEEE-754 single precision.
  float f32() noexcept {
    const std::uint32_t bits = u32();
    float v = 0;
    std::memcpy(&v, &bits, sizeof v);
    return v;
  }
  [[nodiscard]] constexpr bool overran() const noexcept { return overran_; }              ///< whether zeros were made up
  [[nodiscard]] constexpr std::size_t left() const noexcept { return in_.size() - at_; }  ///< bytes not read yet

 private:
  std::span<const std::uint8_t> in_;
  std::size_t at_ = 0;
  bool overran_ = false;
};

}  // namespace vsa::bus
