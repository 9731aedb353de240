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

constexpr const char* kNoState = "that is no state of this instance";

std::size_t bytes_of(std::size_t numbers) { return (kHeadWords + numbers + 1) * kWord; }

}  // namespace

Instance::Saved* Instance::known(const void* state) const noexcept {
  const auto at = std::find_if(states_.begin(), states_.end(), [&](const auto& s) { return s.get() == state; });
  return at == states_.end() ? nullptr : at->get();
}

Status Instance::save(const char* call, void** state) noexcept {
  if (state == nullptr) return refuse(call, "no place for the state");
  if (*state != nullptr && known(*state) == nullptr) return refuse(call, kNoState);
  return guarded(call, [&] {
    Saved saved{mode_, start_s_, stop_s_, has_stop_, std::vector<double>(model_->state_size())};
    model_->save(saved.numbers);
    if (Saved* again = known(*state)) {
      *again = std::move(saved);
    } else {
      states_.push_back(std::make_unique<Saved>(std::move(saved)));
      *state = states_.back().get();
    }
  });
}

Status Instance::restore(const char* call, const void* state) noexcept {
  const Saved* saved = known(state);
  if (saved == nullptr) return refuse(call, kNoState);
  const Status status = guarded(call, [&] { model_->restore(saved->numbers); });
  if (status != Status::ok) return status;
  mode_ = saved->mode;
  start_s_ = saved->start_s;
  stop_s_ = saved->stop_s;
  has_stop_ = saved->has_stop;
  fresh_ = false;
  return Status::ok;
}

Status Instance::free_state(const char* call, void** state) noexcept {
  if (state == nullptr || *state == nullptr) return Status::ok;
  if (known(*state) == nullptr) return refuse(call, kNoState);
  const void* gone = *state;
  states_.erase(std::find_if(states_.begin(), states_.end(), [&](const auto& s) { return s.get() == gone; }));
  *state = nullptr;
  return Status::ok;
}

Status Instance::size_of_state(const char* call, const void* state, std::size_t* size) noexcept {
  const Saved* saved = known(state);
  if (saved == nullptr || size == nullptr) return refuse(call, saved == nullptr ? kNoState : "no place for the size");
  *size = bytes_of(saved->numbers.size());
  return Status::ok;
}

Status Instance::serialize(const char* call, const void* state, std::span<char> out) noexcept {
  const Saved* saved = known(state);
  if (saved == nullptr) return refuse(call, kNoState);
  if (out.size() < bytes_of(saved->numbers.size())) return refuse(call, "the room is smaller than fmi…SerializedFMUStateSize says");
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

Status Instance::deserialize(const char* call, std::span<const char> in, void** state) noexcept {
  if (state == nullptr) return refuse(call, "no place for the state");
  return guarded(call, [&] {
    if (in.size() < kHeadWords * kWord || !std::equal(kMagic.begin(), kMagic.end(), in.begin())) refuse_bytes("is none");
    if (word_at(in, 1) != token_) refuse_bytes("is of another FMU");
    Saved saved;
    saved.numbers.resize(model_->state_size());
    if (word_at(in, 6) != saved.numbers.size() || in.size() < bytes_of(saved.numbers.size())) refuse_bytes("has another length");
    const std::size_t end = kHeadWords + saved.numbers.size();
    if (word_at(in, end) != fnv1a({in.data(), end * kWord})) refuse_bytes("is damaged");
    if (word_at(in, 2) > static_cast<std::uint64_t>(Mode::failed)) refuse_bytes("is damaged");
    saved.mode = static_cast<Mode>(word_at(in, 2));
    saved.start_s = bits_as<double>(word_at(in, 3));
    saved.has_stop = word_at(in, 4) != 0;
    saved.stop_s = bits_as<double>(word_at(in, 5));
    for (std::size_t i = 0; i < saved.numbers.size(); ++i) saved.numbers[i] = bits_as<double>(word_at(in, kHeadWords + i));
    states_.push_back(std::make_unique<Saved>(std::move(saved)));
    *state = states_.back().get();
  });
}

}  // namespace vsa::fmu
