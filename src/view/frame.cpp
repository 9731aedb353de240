// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/view/frame.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "vsa/record/recorder.hpp"

namespace vsa::view {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

template <class T>
void put(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

void put(std::string& out, const std::vector<float>& values) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

double strength(const scene::Contact& c) {
  return c.force_N[0] * c.force_N[0] + c.force_N[1] * c.force_N[1] + c.force_N[2] * c.force_N[2];
}

void keep_strongest(std::vector<scene::Contact>& contacts) {
  if (contacts.size() <= kContactsMax) return;
  const auto stronger = [](const auto& a, const auto& b) { return strength(a) > strength(b); };
  std::nth_element(contacts.begin(), contacts.begin() + kContactsMax, contacts.end(), stronger);
  contacts.resize(kContactsMax);
}

}  // namespace

std::shared_ptr<const std::string> FrameMaker::make(const host::Simulation& world, const FrameInfo& info) {
  record::read(world, sample_);
  frame_.clear();
  frame_.append(sample_, moving_);
  world.contacts(contacts_);
  keep_strongest(contacts_);
  touches_.clear();
  const auto add = [this](const std::array<double, 3>& v) {
    for (const double x : v) touches_.push_back(static_cast<float>(x));
  };
  for (const scene::Contact& c : contacts_) add(c.position), add(c.force_N);
  for (const scene::Pull& p : world.hands()) {
    touches_.push_back(static_cast<float>(p.link));
    add(p.point_m), add(p.target_m);
  }
  auto out = std::make_shared<std::string>();
  put(*out, info.time_s);
  put(*out, static_cast<float>(info.factor));
  put(*out, static_cast<std::uint32_t>((info.paused ? 1 : 0) | (info.recording ? 2 : 0) | (info.gait ? 4 : 0)));
  put(*out, static_cast<std::uint32_t>(contacts_.size()));
  put(*out, static_cast<std::uint32_t>(world.hands().size()));
  for (const auto* part : {&frame_.poses, &frame_.readings, &frame_.energy, &touches_}) put(*out, *part);
  return out;
}

}  // namespace vsa::view
