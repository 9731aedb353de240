// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/view/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <map>

#include "vsa/errors.hpp"
#include "vsa/page/json.hpp"
#include "vsa/units.hpp"

namespace vsa::view {
namespace {

using page::Json;

constexpr double kReach_m = 1000;
constexpr Span kFactor{0.01, 100};
constexpr std::int64_t kStepsMax = 1000;
constexpr std::size_t kShown = 60;  // characters of a value in a message

struct Refused {
  std::string why;
};

/// One object: every key must be taken, and may be taken once.
class Fields {
 public:
  Fields(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) throw Refused{where_ + "not an object"};
  }

  [[nodiscard]] bool has(const char* key) const { return object_.contains(key); }
  const Json& at(const char* key) {
    const auto found = object_.find(key);
    if (found == object_.end()) throw Refused{where_ + key + ": missing"};
    taken_.emplace_back(key);
    return *found;
  }
  double number(const char* key, const Span& span) { return number(at(key), where_ + key, span); }
  static double number(const Json& value, const std::string& name, const Span& span) {
    if (!value.is_number()) throw Refused{name + ": not a number: " + shown(value)};
    const double x = value.get<double>();
    if (x >= span.min && x <= span.max) return x;  // false for NaN
    throw Refused{fmt::format("{} = {}: out of range (allowed: {} … {})", name, x, span.min, span.max)};
  }
  std::int64_t whole(const char* key, std::int64_t min, std::int64_t max) { return whole(at(key), where_ + key, min, max); }
  static std::int64_t whole(const Json& value, const std::string& name, std::int64_t min, std::int64_t max) {
    const bool fits = value.is_number_integer() && (!value.is_number_unsigned() || value.get<std::uint64_t>() <= INT64_MAX);
    if (!fits) throw Refused{name + ": not a whole number: " + shown(value)};
    const auto n = value.get<std::int64_t>();
    if (n >= min && n <= max) return n;
    throw Refused{fmt::format("{} = {}: out of range (allowed: {} … {})", name, n, min, max)};
  }
  std::string text(const char* key) {
    const Json& value = at(key);
    if (!value.is_string()) throw Refused{where_ + key + ": not a text: " + shown(value)};
    return value.get<std::string>();
  }
  bool flag(const char* key) {
    const Json& value = at(key);
    if (!value.is_boolean()) throw Refused{where_ + key + ": not true or false: " + shown(value)};
    return value.get<bool>();
  }
  const Json& list(const char* key) {
    const Json& value = at(key);
    if (!value.is_array()) throw Refused{where_ + key + ": not a list: " + shown(value)};
    return value;
  }
  std::array<double, 3> place(const char* key) {
    const Json& value = list(key);
    if (value.size() != 3) throw Refused{where_ + key + ": not three numbers"};
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i) out[i] = number(value[i], where_ + key, {-kReach_m, kReach_m});
    return out;
  }
  void done() const {
    for (const auto& [key, value] : object_.items()) {
      if (std::find(taken_.begin(), taken_.end(), key) == taken_.end()) {
        throw Refused{where_ + key.substr(0, kShown) + ": unknown key"};
      }
    }
  }

 private:
  static std::string shown(const Json& value) {
    const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() <= kShown ? text : text.substr(0, kShown) + "…";
  }

  const Json& object_;
  std::string where_;
  std::vector<std::string> taken_;
};

Request command(Fields& in, const Rules& rules) {
  Command out;
  const Json& list = in.list("actuators");
  if (list.empty() || list.size() > rules.actuators.size()) throw Refused{"actuators: none, or more than there are"};
  const auto last = static_cast<std::int64_t>(rules.actuators.size()) - 1;
  for (const Json& item : list) {
    const auto i = static_cast<std::size_t>(Fields::whole(item, "actuators", 0, last));
    if (std::find(out.actuators.begin(), out.actuators.end(), i) != out.actuators.end())
      throw Refused{"actuators: one is listed twice"};
    out.actuators.push_back(i);
    const Rules::Actuator& allowed = rules.actuators[i];
    if (in.has("equilibrium_rad")) out.equilibrium_rad = in.number("equilibrium_rad", allowed.equilibrium_rad);
    if (in.has("preset")) out.preset = in.number("preset", allowed.preset);
  }
  if (!out.equilibrium_rad && !out.preset) throw Refused{"equilibrium_rad, preset: both missing"};
  return out;
}

Request pull(Fields& in, const Rules& rules) {
  PullLink out;
  out.link = static_cast<std::size_t>(in.whole("link", 0, static_cast<std::int64_t>(rules.moves.size()) - 1));
  if (!rules.moves[out.link]) throw Refused{fmt::format("link = {}: doesn't move", out.link)};
  out.point_m = in.place("point_m");
  out.target_m = in.place("target_m");
  return out;
}

Span in_rad(const motion::GaitRange& degrees) { return {degrees.min * kPi / 180, degrees.max * kPi / 180}; }
Span span(const motion::GaitRange& range) { return {range.min, range.max}; }

Request change_gait(Fields& in, const Rules& rules) {
  const motion::GaitBounds& bounds = motion::kGaitBounds;
  ChangeGait out;
  out.to.frequency_rad_per_s = in.number("frequency_rad_per_s", span(bounds.frequency_rad_per_s));
  const Json& list = in.list("groups");
  if (list.size() != rules.gait_groups.size()) throw Refused{"groups: not as many as the gait has"};
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string& name = rules.gait_groups[i];
    Fields group(list[i], "groups." + name + ".");
    if (group.text("name") != name) throw Refused{"groups: must be in the gait's order, here " + name};
    out.to.groups.push_back({group.number("amplitude_rad", in_rad(bounds.amplitude_deg)),
                             group.number("offset_rad", in_rad(bounds.offset_deg)), group.number("lambda", span(bounds.lambda)),
                             group.number("delta_rad", in_rad(bounds.delta_deg)),
                             group.number("preset_rad", in_rad(bounds.preset_deg))});
    group.done();
  }
  return out;
}

Request speed(Fields& in) {
  const Json& factor = in.at("factor");
  return Speed{factor.is_null() ? std::nullopt : std::optional(Fields::number(factor, "factor", kFactor))};
}

using Reader = std::function<Request(Fields&, const Rules&)>;

template <class T>
Reader plain() {
  return [](Fields&, const Rules&) -> Request { return T{}; };
}

std::map<std::string, Reader, std::less<>> readers() {
  return {{"play", plain<Play>()},
          {"pause", plain<Pause>()},
          {"reset", plain<Reset>()},
          {"release", plain<Release>()},
          {"give_back", plain<GiveBack>()},
          {"next", plain<Next>()},
          {"step",
           [](Fields& in, const Rules&) -> Request { return Step{static_cast<std::uint32_t>(in.whole("steps", 1, kStepsMax))}; }},
          {"speed", [](Fields& in, const Rules&) { return speed(in); }},
          {"command", command},
          {"pull", pull},
          {"record", [](Fields& in, const Rules&) -> Request { return Record{in.flag("on")}; }},
          {"gait", change_gait},
          {"gait_play", [](Fields& in, const Rules&) -> Request { return PlayGait{in.flag("on")}; }}};
}
const std::map<std::string, Reader, std::less<>> kReaders = readers();

bool one_of(std::string_view what, std::initializer_list<std::string_view> these) {
  return std::find(these.begin(), these.end(), what) != these.end();
}

void check_offered(const std::string& what, const Rules& rules) {
  if (!rules.gait && one_of(what, {"gait", "gait_play", "give_back"})) throw Refused{what + ": this run plays no gait"};
  if (!rules.control && one_of(what, {"play", "pause", "step", "reset", "speed"}))
    throw Refused{what + ": the simulator's own controls do that"};
  if (!rules.hands && what == "pull") throw Refused{what + ": this simulator takes no hands"};
}

Request read(const Json& object, const Rules& rules) {
  Fields in(object, "");
  const std::string what = in.text("do");
  const auto reader = kReaders.find(what);
  if (reader == kReaders.end()) throw Refused{"do = " + what.substr(0, kShown) + ": unknown"};
  check_offered(what, rules);
  Request out = reader->second(in, rules);
  in.done();
  return out;
}

}  // namespace

Parsed parse_request(std::string_view text, const Rules& rules) {
  try {
    return {read(page::read_json(text, "", ""), rules), ""};
  } catch (const InputError& error) {
    const std::string& key = error.problems().front().key;
    return {std::nullopt, key.empty() ? "not JSON" : key.substr(0, kShown) + ": is given twice"};
  } catch (const Refused& refused) {
    return {std::nullopt, refused.why};
  }
}

}  // namespace vsa::view
