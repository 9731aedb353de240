// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Numbers and words into a fixed buffer; no locale, no allocation. What doesn't fit is dropped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vsa::firmware {

class TextWriter {
 public:
  explicit TextWriter(std::span<char> out) noexcept : out_(out) {}

  TextWriter& operator<<(std::string_view text) noexcept;
  TextWriter& operator<<(std::int64_t value) noexcept;
  /// Six decimals, round half to even, exact for every float.
  TextWriter& operator<<(float value) noexcept;
  [[nodiscard]] std::string_view text() const noexcept { return {out_.data(), size_}; }

 private:
  void put(char c) noexcept {
    if (size_ < out_.size()) out_[size_++] = c;
  }
  void digits(std::uint64_t value, int at_least) noexcept;

  std::span<char> out_;
  std::size_t size_ = 0;
};

}  // namespace vsa::firmware
