// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "firmware/text_writer.hpp"

#include <array>
#include <cmath>

namespace vsa::firmware {
namespace {

constexpr std::uint64_t kMillion = 1'000'000;
constexpr double kExact = 8589934592.0;  // 2³³: below it, 24 bits · 10⁶ fit a double and the product an int64

/// The decimal digits of mantissa·2^exponent, most significant first, by doubling; returns how many.
int large_digits(std::uint64_t mantissa, int exponent, std::array<char, 48>& out) noexcept {
  std::array<int, 48> digit{};
  int count = 0;
  for (; mantissa != 0; mantissa /= 10) digit[count++] = static_cast<int>(mantissa % 10);
  for (; exponent > 0; --exponent) {
    int carry = 0;
    for (int i = 0; i < count; ++i) {
      const int doubled = 2 * digit[i] + carry;
      digit[i] = doubled % 10;
      carry = doubled / 10;
    }
    if (carry != 0) digit[count++] = carry;
  }
  for (int i = 0; i < count; ++i) out[i] = static_cast<char>('0' + digit[count - 1 - i]);
  return count;
}

}  // namespace

void TextWriter::digits(std::uint64_t value, int at_least) noexcept {
  std::array<char, 20> reversed{};
  int count = 0;
  for (; value != 0 || count < at_least; value /= 10) reversed[count++] = static_cast<char>('0' + value % 10);
  while (count > 0) put(reversed[--count]);
}

TextWriter& TextWriter::operator<<(std::string_view text) noexcept {
  for (const char c : text) put(c);
  return *this;
}

TextWriter& TextWriter::operator<<(std::int64_t value) noexcept {
  if (value < 0) put('-');
  digits(value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value), 1);
  return *this;
}

TextWriter& TextWriter::operator<<(float value) noexcept {
  if (std::isnan(value)) return *this << "NaN";
  if (std::signbit(value)) put('-');
  const double size = std::fabs(static_cast<double>(value));
  if (std::isinf(size)) return *this << "INF";
  if (size < kExact) {
    const auto micro = static_cast<std::uint64_t>(std::nearbyint(size * 1e6));
    digits(micro / kMillion, 1);
    put('.');
    digits(micro % kMillion, 6);
    return *this;
  }
  int exponent = 0;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(size, &exponent), 24));
  std::array<char, 48> text{};
  const int count = large_digits(mantissa, exponent - 24, text);
  return *this << std::string_view{text.data(), static_cast<std::size_t>(count)} << ".000000";
}

}  // namespace vsa::firmware
