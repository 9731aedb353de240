// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/page.hpp"

#include <algorithm>
#include <array>

#include "record/energy_columns.hpp"
#include "record/page_json.hpp"
#include "vsa/page/json.hpp"

namespace vsa::record {
namespace {

using page::base64;
using page::Json;

struct Channel {
  std::string_view name;
  double (*value)(const host::ActuatorReading&);
};

using Reading = host::ActuatorReading;
constexpr std::array<Channel, 10> kChannels{{
    {"shaft_rad", [](const Reading& r) { return r.shaft_rad; }},
    {"shaft_speed_rad_per_s", [](const Reading& r) { return r.shaft_speed_rad_per_s; }},
    {"equilibrium_command_rad", [](const Reading& r) { return r.equilibrium_command_rad; }},
    {"equilibrium_rad", [](const Reading& r) { return r.equilibrium_rad; }},
    {"preset_command", [](const Reading& r) { return r.preset_command; }},
    {"preset", [](const Reading& r) { return r.preset; }},
    {"stiffness_Nm_per_rad", [](const Reading& r) { return r.stiffness_Nm_per_rad; }},
    {"torque_Nm", [](const Reading& r) { return r.torque_Nm; }},
    {"current_1_A", [](const Reading& r) { return r.current_A[0]; }},
    {"current_2_A", [](const Reading& r) { return r.current_A[1]; }},
}};
constexpr std::size_t kPoseNumbers = 7;

/// frames × width → width × frames: the page draws one channel at a time.
std::vector<float> by_channel(const std::vector<float>& frames, std::size_t width) {
  std::vector<float> out(frames.size());
  const std::size_t count = width == 0 ? 0 : frames.size() / width;
  for (std::size_t f = 0; f < count; ++f) {
    for (std::size_t c = 0; c < width; ++c) out[c * count + f] = frames[f * width + c];
  }
  return out;
}

template <class Columns>
Json names(const Columns& columns) {
  Json out = Json::array();
  for (const auto& c : columns) out.push_back(c.name);
  return out;
}

template <class Number>
void drop_odd(std::vector<Number>& frames, std::size_t width) {
  std::size_t kept = 0;
  for (std::size_t f = 0; width > 0 && f < frames.size() / width; f += 2, ++kept) {
    std::copy_n(frames.begin() + static_cast<std::ptrdiff_t>(f * width), width,
                frames.begin() + static_cast<std::ptrdiff_t>(kept * width));
  }
  frames.resize(kept * width);
}

}  // namespace

void Frame::clear() {
  for (auto* v : {&poses, &readings, &energy}) v->clear();
}

void Frame::append(const Sample& sample, const std::vector<std::size_t>& moving) {
  const auto f = [](double v) { return static_cast<float>(v); };
  for (const std::size_t i : moving) {
    for (const double v : sample.poses[i].position) poses.push_back(f(v));
    for (const double v : sample.poses[i].quaternion) poses.push_back(f(v));
  }
  for (const Reading& r : sample.actuators) {
    for (const Channel& c : kChannels) readings.push_back(f(c.value(r)));
  }
  for (const EnergyColumn& c : kEnergyColumns) energy.push_back(f(c.value(sample)));
}

std::vector<std::size_t> moving_links(const RunInfo& info) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < info.links.size(); ++i) {
    if (!info.links[i].is_static) out.push_back(i);
  }
  return out;
}

PageData::PageData(const RunInfo& info, double rate_Hz, std::size_t frames_max)
    : moving_(moving_links(info)), rate_Hz_(rate_Hz), frames_max_(frames_max), cadence_(rate_Hz) {
  for (const RobotInfo& r : info.robots) actuators_ += r.actuators.size();
}

void PageData::halve() {
  drop_odd(time_, 1);
  drop_odd(data_.poses, moving_.size() * kPoseNumbers);
  drop_odd(data_.readings, actuators_ * kChannels.size());
  drop_odd(data_.energy, kEnergyColumns.size());
  rate_Hz_ /= 2;
  cadence_ = Cadence(rate_Hz_);
}

void PageData::add(const Sample& sample) {
  if (time_.empty()) first_ = sample.poses;
  if (frames() >= frames_max_) halve();
  time_.push_back(seconds_of(sample.time_ns));
  data_.append(sample, moving_);
  cadence_.taken(sample.time_ns);
}

void PageData::restart() {
  time_.clear();
  data_.clear();
  cadence_.restart();
}

std::string PageData::json(const RunInfo& info, const PageText& text) const {
  Json out = page_header(info, text, first_);
  out["frames"] = frames();
  out["time"] = page::base64_wide(time_);
  out["poses"] = base64(data_.poses);
  out["actuator_channels"] = names(kChannels);
  out["actuators"] = base64(by_channel(data_.readings, actuators_ * kChannels.size()));
  out["energy_channels"] = names(kEnergyColumns);
  out["energy"] = base64(by_channel(data_.energy, kEnergyColumns.size()));
  return page::text(out);
}

}  // namespace vsa::record
