// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Saved states of an instance, and their bytes: every number as 8 bytes, the lowest first.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "vsa/bits.hpp"
#include "vsa/errors.hpp"
#include "vsa/fmu/instance.hpp"
#include "vsa/hash.hpp"

namespace vsa::fmu {
namespace {

constexpr std::string_view kMagic = "VSAFMU1\n";
constexpr std::size_t kWord = 8;
constexpr std::size_t kHeadWords = 7;  // magic, token, mode, start, has_stop, stop, count

void put_word(std::span<char> out, std::size_t word, std::uint64_t v) {
  for (std::size_t i = 0; i < kWord; ++i) out[word * kWord + i] = static_cast<char>(v >> (8 * i) & 0xFF);
}

std::uint64_t word_at(std::span<const char> in, std::size_t word) {
  std::uint64_t v = 0;
  for (std::size_t i = 0; i < kWord; ++i)
    v |= static_cast<std::uint64_t>(static_cast<unsigned char>(in[word * kWord + i])) << (8 * i);
  return v;
}

[[noreturn]] void refuse_bytes(const char* why) {
  throw InputError({"", "serialized state", "", why, "bytes that this FMU's fmi…SerializeFMUState gave"});
}

}  // namespace

Status Instance::save(const char* call, std::unique_ptr<Saved>& out) noexcept {
  return guarded(call, [&] {
    auto saved = std::make_unique<Saved>();
    saved->numbers.resize(model_->state_size());
    model_->save(saved->numbers);
    saved->mode = mode_;
    saved->start_s = start_s_;
    saved->stop_s = stop_s_;
    saved->has_stop = has_stop_;
    out = std::move(saved);
  });
}

Status Instance::restore(const char* call, const Saved* saved) noexcept {
  if (saved == nullptr) return refuse(call, "no state given");
  const Status status = guarded(call, [&] { model_->restore(saved->numbers); });
  if (status != Status::ok) return status;
  mode_ = saved->mode;
  start_s_ = saved->start_s;
  stop_s_ = saved->stop_s;
  has_stop_ = saved->has_stop;
  fresh_ = false;
  return Status::ok;
}

std::size_t Instance::bytes_of(const Saved& saved) const noexcept { return (kHeadWords + saved.numbers.size() + 1) * kWord; }

Status Instance::serialize(const char* call, const Saved* saved, std::span<char> out) noexcept {
  if (saved == nullptr) return refuse(call, "no state given");
  if (out.size() < bytes_of(*saved)) return refuse(call, "the room is smaller than fmi…SerializedFMUStateSize says");
  std::copy(kMagic.begin(), kMagic.end(), out.begin());
  put_word(out, 1, token_);
  put_word(out, 2, static_cast<std::uint64_t>(saved->mode));
  put_word(out, 3, bits_as<std::uint64_t>(saved->start_s));
  put_word(out, 4, saved->has_stop ? 1 : 0);
  put_word(out, 5, bits_as<std::uint64_t>(saved->stop_s));
  put_word(out, 6, saved->numbers.size());
  std::size_t word = kHeadWords;
  for (const double v : saved->numbers) put_word(out, word++, bits_as<std::uint64_t>(v));
  put_word(out, word, fnv1a({out.data(), word * kWord}));
  return Status::ok;
}

Status Instance::deserialize(const char* call, std::span<const char> in, std::unique_ptr<Saved>& out) noexcept {
  return guarded(call, [&] {
    if (in.size() < kHeadWords * kWord || !std::equal(kMagic.begin(), kMagic.end(), in.begin())) refuse_bytes("is none");
    if (word_at(in, 1) != token_) refuse_bytes("is of another FMU");
    auto saved = std::make_unique<Saved>();
    saved->numbers.resize(model_->state_size());
    if (word_at(in, 6) != saved->numbers.size() || in.size() < bytes_of(*saved)) refuse_bytes("has another length");
    const std::size_t end = kHeadWords + saved->numbers.size();
    if (word_at(in, end) != fnv1a({in.data(), end * kWord})) refuse_bytes("is damaged");
    if (word_at(in, 2) > static_cast<std::uint64_t>(Mode::failed)) refuse_bytes("is damaged");
    saved->mode = static_cast<Mode>(word_at(in, 2));
    saved->start_s = bits_as<double>(word_at(in, 3));
    saved->has_stop = word_at(in, 4) != 0;
    saved->stop_s = bits_as<double>(word_at(in, 5));
    for (std::size_t i = 0; i < saved->numbers.size(); ++i) saved->numbers[i] = bits_as<double>(word_at(in, kHeadWords + i));
    out = std::move(saved);
  });
}

}  // namespace vsa::fmu
