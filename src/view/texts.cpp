// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "texts.hpp"

#include <nlohmann/json.hpp>

namespace vsa::view {
namespace {

using nlohmann::json;

/// Names and paths may hold any bytes.
std::string dumped(const json& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

json gait_json(const motion::Gait& gait) {
  const motion::GaitChange values = gait.values();
  json groups = json::array();
  for (std::size_t g = 0; g < values.groups.size(); ++g) {
    const motion::WaveParams& w = values.groups[g];
    groups.push_back({{"name", gait.params().groups[g].name},
                      {"actuators", gait.params().groups[g].actuators},
                      {"amplitude_rad", w.amplitude_rad},
                      {"offset_rad", w.offset_rad},
                      {"lambda", w.lambda},
                      {"delta_rad", w.delta_rad},
                      {"preset_rad", w.preset_rad}});
  }
  return {{"title", gait.params().title},
          {"playing", !gait.held()},
          {"frequency_rad_per_s", values.frequency_rad_per_s},
          {"groups", std::move(groups)}};
}

json recordings_json(const Recordings& recordings) {
  json done = json::array();
  for (const Recordings::Done& one : recordings.done()) {
    done.push_back({{"name", one.name}, {"path", one.page.string()}, {"url", "/recordings/" + one.name + ".html"}});
  }
  json now = nullptr;
  if (recordings.running()) now = recordings.directory().string();
  return {{"now", std::move(now)}, {"writing", recordings.writing()}, {"done", std::move(done)}};
}

json span_json(const Span& span) { return {span.min, span.max}; }
json span_json(const motion::GaitRange& range) { return {range.min, range.max}; }

}  // namespace

std::string state_text(const State& state) {
  json hands = json::array();
  for (const motion::ByHand& hand : state.by_hand) hands.push_back({hand.equilibrium, hand.preset});
  return dumped({{"type", "state"},
                 {"speed", state.speed ? json(*state.speed) : json(nullptr)},
                 {"gait", state.gait != nullptr ? gait_json(*state.gait) : json(nullptr)},
                 {"by_hand", std::move(hands)},
                 {"recordings", recordings_json(*state.recordings)}});
}

std::string hello_text(const Rules& rules, const std::string& run, const std::string& state) {
  json actuators = json::array();
  for (const Rules::Actuator& a : rules.actuators) {
    actuators.push_back({{"equilibrium_rad", span_json(a.equilibrium_rad)}, {"preset", span_json(a.preset)}});
  }
  const motion::GaitBounds& b = motion::kGaitBounds;
  const json bounds = {{"frequency_rad_per_s", span_json(b.frequency_rad_per_s)},
                       {"amplitude_deg", span_json(b.amplitude_deg)},
                       {"offset_deg", span_json(b.offset_deg)},
                       {"lambda", span_json(b.lambda)},
                       {"delta_deg", span_json(b.delta_deg)},
                       {"preset_deg", span_json(b.preset_deg)}};
  return dumped({{"type", "hello"},
                 {"run", run},
                 {"offers", {{"contacts", rules.contacts}, {"control", rules.control}, {"hands", rules.hands}}},
                 {"actuators", std::move(actuators)},
                 {"gait_bounds", bounds},
                 {"state", json::parse(state, nullptr, false)}});
}

std::string plain_text(const char* type, const std::string& text) { return dumped({{"type", type}, {"text", text}}); }

}  // namespace vsa::view
