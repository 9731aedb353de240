// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "motion/motion_file.hpp"

#include <algorithm>

namespace vsa::motion {
namespace {

constexpr double kLongest_s = 1e5;

MotionTrack& track_of(MotionParams& motion, const std::string& actuator) {
  const auto it =
      std::find_if(motion.tracks.begin(), motion.tracks.end(), [&](const MotionTrack& t) { return t.actuator == actuator; });
  return it != motion.tracks.end() ? *it : motion.tracks.emplace_back(MotionTrack{actuator, {}, {}});
}

/// { actuator = degrees, … }
void read_channel(Reader& reader, const toml::table& keyframe, const std::string& scope, const char* key, const Bounds& bounds,
                  double time_s, std::vector<MotionKey> MotionTrack::*channel, MotionParams& motion) {
  const toml::node* node = keyframe.get(key);
  if (node == nullptr) return;
  const toml::table* values = node->as_table();
  if (values == nullptr || values->empty()) {
    reader.problem(scope + key, "", "not a table with an actuator at least", "{ ACTUATOR = degrees, … }");
    return;
  }
  for (const auto& [name, value] : *values) {
    const std::string actuator(name.str());
    const double degrees = reader.number(*values, scope + key + ".", actuator.c_str(), bounds);
    (track_of(motion, actuator).*channel).push_back({time_s, degrees * kDegree});
  }
}

void read_keyframe(Reader& reader, const toml::table& table, const std::string& scope, MotionParams& motion) {
  reader.only(table, scope, {"time_s", "equilibrium_deg", "preset_deg"});
  const double time_s = reader.number(table, scope, "time_s", {0, kLongest_s});
  const bool first = scope == "keyframe 1: ";
  if (!first && !(time_s > motion.end_s)) {
    reader.problem(scope + "time_s", fmt::format("{}", time_s), "not after the keyframe before it",
                   fmt::format("above {}", motion.end_s));
  }
  motion.end_s = time_s;
  if (!table.contains("equilibrium_deg") && !table.contains("preset_deg")) {
    reader.problem(scope + "equilibrium_deg", "", "missing, and preset_deg too: this keyframe says nothing", "");
  }
  read_channel(reader, table, scope, "equilibrium_deg", {-160, 160}, time_s, &MotionTrack::equilibrium, motion);
  read_channel(reader, table, scope, "preset_deg", {0, 90}, time_s, &MotionTrack::preset, motion);
}

}  // namespace

MotionParams read_motion(Reader& reader, const toml::table& root) {
  MotionParams motion;
  for (const char* key : {"group", "steering", "frequency_rad_per_s", "ramp_s"}) {
    if (root.contains(key)) reader.problem(key, "", "belongs to waves; this gait has keyframes", "either waves or keyframes");
  }
  reader.only(root, "",
              {"base", "title", "period_s", "interpolation", "loop_from_s", "keyframe", "group", "steering", "frequency_rad_per_s",
               "ramp_s"});
  if (root.contains("interpolation")) {
    const std::string word = reader.text(root, "", "interpolation");
    motion.smooth = word != "linear";
    if (word != "smooth" && word != "linear") reader.problem("interpolation", word, "unknown", "smooth, linear");
  }
  const toml::array* keyframes = root["keyframe"].as_array();
  if (keyframes == nullptr || keyframes->empty()) reader.problem("keyframe", "", "not a list of tables", "[[keyframe]]");
  for (std::size_t i = 0; keyframes != nullptr && i < keyframes->size(); ++i) {
    const std::string scope = fmt::format("keyframe {}", i + 1);
    const toml::table* table = keyframes->get(i)->as_table();
    if (table == nullptr) reader.problem(scope, "", "not a table", "[[keyframe]]");
    if (table != nullptr) read_keyframe(reader, *table, scope + ": ", motion);
  }
  if (root.contains("loop_from_s")) {
    motion.loop_from_s = reader.number(root, "", "loop_from_s", {0, kLongest_s});
    if (!(*motion.loop_from_s < motion.end_s)) {
      reader.problem("loop_from_s", fmt::format("{}", *motion.loop_from_s), "not before the last keyframe",
                     fmt::format("0 … below {}", motion.end_s));
    }
  }
  return motion;
}

}  // namespace vsa::motion
