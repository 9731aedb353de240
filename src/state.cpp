// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/state.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "vsa/bits.hpp"
#include "vsa/errors.hpp"
#include "vsa/state_fields.hpp"

namespace vsa {
namespace {

constexpr std::array<std::string_view, 7> kKinds{"real", "single", "whole", "wide", "flag", "choice", "bytes"};
constexpr std::uint64_t kSeed = 0xCBF29CE484222325ULL;

/// splitmix64's finish of what was there and what comes.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t next) noexcept {
  std::uint64_t z = (hash ^ next) + 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

std::uint64_t mixed(std::uint64_t hash, std::string_view text) noexcept {
  for (const char c : text) hash = mixed(hash, static_cast<unsigned char>(c));
  return mixed(hash, text.size());
}

std::string text_of(double v) {
  std::ostringstream out;
  out.precision(17);
  out << v;
  return out.str();
}

}  // namespace

std::string_view name_of(StateKind kind) noexcept { return kKinds[static_cast<std::size_t>(kind)]; }

void StateLayout::add(std::string name, std::string unit, StateKind kind, std::size_t count) {
  entries_.push_back({std::move(name), std::move(unit), kind, size_, count});
  size_ += count;
}

void StateLayout::append(std::string_view prefix, const StateLayout& other) {
  for (const StateEntry& e : other.entries_) add(std::string(prefix) + e.name, e.unit, e.kind, e.count);
}

const StateEntry* StateLayout::find(std::string_view name) const noexcept {
  const auto it = std::find_if(entries_.begin(), entries_.end(), [name](const StateEntry& e) { return e.name == name; });
  return it == entries_.end() ? nullptr : &*it;
}

std::string StateLayout::name_at(std::size_t offset) const {
  const auto it =
      std::find_if(entries_.begin(), entries_.end(), [offset](const StateEntry& e) { return offset < e.offset + e.count; });
  if (it == entries_.end()) return "number " + std::to_string(offset);
  return it->count == 1 ? it->name : it->name + ", number " + std::to_string(offset - it->offset);
}

std::uint64_t StateLayout::hash() const noexcept {
  std::uint64_t hash = mixed(kSeed, entries_.size());
  for (const StateEntry& e : entries_)
    hash = mixed(mixed(mixed(mixed(hash, e.name), e.unit), static_cast<std::uint64_t>(e.kind)), e.count);
  return hash;
}

std::uint64_t state_hash(std::span<const double> numbers) noexcept {
  std::uint64_t hash = mixed(kSeed, numbers.size());
  for (const double v : numbers) hash = mixed(hash, bits_as<std::uint64_t>(v));
  return hash;
}

std::optional<std::size_t> first_difference(std::span<const double> a, std::span<const double> b) noexcept {
  const auto same = [](double x, double y) { return bits_as<std::uint64_t>(x) == bits_as<std::uint64_t>(y); };
  const auto [at, other] = std::mismatch(a.begin(), a.end(), b.begin(), b.end(), same);
  if (at == a.end() && other == b.end()) return std::nullopt;
  return static_cast<std::size_t>(at - a.begin());
}

void throw_if_any(const StateFault& fault, const StateLayout& layout) {
  if (!fault.there()) return;
  const std::string allowed = *fault.allowed != '\0' ? fault.allowed : text_of(fault.low) + " … " + text_of(fault.high);
  throw InputError(Problem{"", layout.name_at(fault.offset), text_of(fault.value), fault.message, allowed});
}

void check_state_size(std::size_t given, std::size_t wanted) {
  if (given != wanted)
    throw InputError(Problem{"", "state", std::to_string(given) + " numbers", "wrong size", std::to_string(wanted)});
}

namespace state {
namespace {

// The bits of a NaN: sign, exponent, payload from the top.
constexpr int kPayloadShift = 52 - 23;
constexpr std::uint64_t kWideExponent = 0x7FF0000000000000ULL;
constexpr std::uint32_t kSinglePayload = 0x007FFFFF, kSingleExponent = 0x7F800000;

}  // namespace

double widened(float v) noexcept {
  if (v == v) return v;
  const auto bits = bits_as<std::uint32_t>(v);
  return bits_as<double>((std::uint64_t{bits >> 31} << 63) | kWideExponent |
                         (std::uint64_t{bits & kSinglePayload} << kPayloadShift));
}

std::optional<float> narrowed(double v) noexcept {
  if (v == v) {
    const bool fits = std::isinf(v) || std::abs(v) <= std::numeric_limits<float>::max();
    const float x = fits ? static_cast<float>(v) : 0.0F;
    return fits && static_cast<double>(x) == v ? std::optional(x) : std::nullopt;
  }
  const auto bits = bits_as<std::uint64_t>(v);
  const auto payload = static_cast<std::uint32_t>(bits >> kPayloadShift) & kSinglePayload;
  if (payload == 0 || (bits & ((std::uint64_t{1} << kPayloadShift) - 1)) != 0) return std::nullopt;
  return bits_as<float>((static_cast<std::uint32_t>(bits >> 63) << 31) | kSingleExponent | payload);
}

void put_bytes(double* at, std::span<const std::uint8_t> bytes) noexcept {
  const auto byte = [](const std::uint8_t* from, std::size_t k) { return std::int64_t{from[k]} << (8 * k); };
  const std::uint8_t* from = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= kBytesPerNumber; left -= kBytesPerNumber, from += kBytesPerNumber)  // in one sum: a compiler loads them at once
    *at++ = static_cast<double>(byte(from, 0) | byte(from, 1) | byte(from, 2) | byte(from, 3) | byte(from, 4) | byte(from, 5));
  if (left == 0) return;
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < left; ++k) sum |= byte(from, k);
  *at = static_cast<double>(sum);
}

StateFault get_bytes(const double* at, std::span<std::uint8_t> bytes) noexcept {
  std::size_t offset = 0;
  for (std::size_t begin = 0; begin < bytes.size(); begin += kBytesPerNumber, ++offset) {
    const auto part = bytes.subspan(begin, std::min(kBytesPerNumber, bytes.size() - begin));
    const double high = std::ldexp(1.0, static_cast<int>(8 * part.size())) - 1;
    if (!is_whole(at[offset], 0, high)) return {offset, at[offset], "is no such bytes", "", 0, high};
    auto sum = static_cast<std::uint64_t>(at[offset]);
    for (std::uint8_t& byte : part) byte = static_cast<std::uint8_t>(sum & 0xFF), sum >>= 8;
  }
  return {};
}

}  // namespace state
}  // namespace vsa
