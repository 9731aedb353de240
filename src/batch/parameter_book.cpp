// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "batch/parameter_book.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::batch {
namespace {

using config::Override;

constexpr std::string_view kMass = "link.mass_kg", kInertia = "link.inertia_factor", kFriction = "link.friction";
constexpr double kLeastFactor = 1e-6, kMostFactor = 1e6;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<Override> overrides(const host::ActuatorConfig& a) {
  std::vector<Override> out;
  if (a.changed)
    for (const auto& [key, value] : *a.changed) out.push_back({key, value});
  return out;
}

/// Of equal lists equal.
std::string recipe(const std::string& type, const std::vector<Override>& values) {
  std::string out = type;
  for (const Override& o : values) out += '\n' + o.key + '\t' + o.value;
  return out;
}

/// Null: a law's, or none.
const config::Parameter* parameter(std::string_view key) {
  const auto all = config::parameters();
  const auto at = std::find_if(all.begin(), all.end(), [key](const config::Parameter& p) { return p.key == key; });
  return at == all.end() ? nullptr : &*at;
}

/// "drive_2.friction_Nm": who has none has motors alike.
bool of_second_motor(std::string_view key) {
  const config::Parameter* p = parameter(key);
  return p != nullptr && p->second;
}

/// "drive_2.friction_Nm" → "drive.friction_Nm".
std::string of_first_motor(std::string key) {
  const std::size_t mark = key.find("_2.");
  return mark == std::string::npos ? key : key.erase(mark, 2);
}

/// Also of what a type may have and this one hasn't.
config::Kind kind_of(const config::Entry* entry, std::string_view key) {
  if (entry != nullptr) return entry->kind;
  const config::Parameter* p = parameter(key);
  return p == nullptr ? config::Kind::number : p->kind;
}

std::string value_text(const std::variant<double, std::string>& value, config::Kind kind) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  const double number = std::get<double>(value);
  if (kind == config::Kind::toggle && (number == 0 || number == 1)) return number == 1 ? "true" : "false";
  return config::number_text(number);
}

/// The text of a value as a number, as config::Entry has it.
double number_of(const std::string& text, const config::Entry* entry, std::string_view key) {
  if (text == "true" || text == "false") return text == "true" ? 1 : 0;
  if (kind_of(entry, key) == config::Kind::word) {
    const std::vector<std::string> words =
        entry != nullptr ? config::split(entry->bounds, ',') : config::split(std::string(parameter(key)->words), '|');
    for (std::size_t k = 0; k < words.size(); ++k)
      if (words[k].substr(std::min(words[k].find_first_not_of(' '), words[k].size())) == text) return static_cast<double>(k);
  }
  return config::parse_number(text).value_or(kNone);
}

const std::string* put_into(const host::ActuatorConfig& a, std::string_view key) {
  if (!a.changed) return nullptr;
  const auto at = std::find_if(a.changed->rbegin(), a.changed->rend(), [&](const auto& s) { return s.first == key; });
  return at == a.changed->rend() ? nullptr : &at->second;
}

/// "override drive.x" of a type's file → "joint_1: drive.x".
Problem named(Problem problem, const std::string& owner) {
  constexpr std::string_view kMark = "override ";
  if (problem.key.rfind(kMark, 0) == 0) {
    problem.file.clear();
    problem.key.erase(0, kMark.size());
  }
  problem.key = owner + ": " + problem.key;
  return problem;
}

}  // namespace

ParameterBook::ParameterBook(const engine::World& world) : first_{world.parameters(), {}}, kinds_(world.actuators().size()) {
  for (const engine::LinkInfo& link : world.links()) links_.push_back(world.link(link.name));
}

const ParameterBook::Kind& ParameterBook::kind(const engine::World& world, std::size_t actuator) {
  if (kinds_[actuator]) return *kinds_[actuator];
  const host::ActuatorConfig& a = world.actuator_parameters(*first_.of, world.actuators()[actuator]);
  std::shared_ptr<const Kind>& known = known_[recipe(a.type, overrides(a))];
  if (!known) {
    config::TypeFile file = world.types().open(a.type);
    config::ActuatorType type = file.make(overrides(a));
    const char* refusal = "its parameters were set as numbers, and its type knows nothing of them";
    known = std::make_shared<const Kind>(
        Kind{std::move(file), std::move(type.entries), device::alike(type.unit, a.unit) ? "" : refusal});
  }
  kinds_[actuator] = known;
  return *known;
}

const config::Entry* ParameterBook::entry(const engine::World& world, std::size_t actuator, const std::string& key) {
  const std::vector<config::Entry>& all = kind(world, actuator).entries;
  const auto at = std::find_if(all.begin(), all.end(), [&](const config::Entry& e) { return e.key == key; });
  return at == all.end() ? nullptr : &*at;
}

bool ParameterBook::has(const engine::World& world, std::size_t owner, const std::string& key) {
  if (is_of_links(key)) {
    const bool friction = key == kFriction;
    return friction ? world.link_parameters(*first_.of, links_[owner]).friction.has_value() : !world.links()[owner].is_static;
  }
  if (entry(world, owner, key) != nullptr) return true;
  const auto& type = world.actuator_parameters(*first_.of, world.actuators()[owner]);
  const auto all = config::parameters();
  return std::any_of(all.begin(), all.end(), [&](const config::Parameter& p) {
    return p.key == key && p.need == config::Need::optional && config::why_absent(p, type.unit).empty();
  });
}

std::vector<std::size_t> ParameterBook::owners(const engine::World& world, const std::string& who, const std::string& key) {
  const bool links = is_of_links(key);
  if (links && key != kMass && key != kInertia && key != kFriction)
    throw InputError(
        Problem{"", key, "", "unknown key", std::string(kMass) + ", " + std::string(kInertia) + ", " + std::string(kFriction)});
  std::vector<std::size_t> out;
  if (!who.empty()) {
    if (links) {
      out.push_back(world.link(who).index());
    } else {
      const engine::ActuatorRef& ref = world.actuator(who);
      out.push_back(static_cast<std::size_t>(&ref - world.actuators().data()));
      if (entry(world, out.front(), key) == nullptr && parameter(key) == nullptr)
        refuse_unknown(world, out.front(), key, owner_name(world, key, out.front()) + ": ");
    }
    return out;
  }
  const std::size_t count = links ? links_.size() : world.actuators().size();
  bool could = false;
  for (std::size_t k = 0; k < count; ++k) {
    if (!has(world, k, key)) continue;
    could = true;
    // Nobody asked for unlike motors where they are alike: those who are named get them.
    if (links || !of_second_motor(key) || entry(world, k, key) != nullptr) out.push_back(k);
  }
  if (out.empty() && could)
    throw InputError(Problem{"", key, "", "no actuator has it: their motors are alike", "the name of one that shall have it"});
  if (!out.empty() || count == 0 || links) {
    if (out.empty()) throw InputError(Problem{"", key, "", links ? "no link has it" : "no actuator has it", ""});
    return out;
  }
  refuse_unknown(world, 0, key, "");
}

void ParameterBook::refuse_unknown(const engine::World& world, std::size_t actuator, const std::string& key,
                                   const std::string& of) {
  std::vector<std::string> keys;
  for (const config::Entry& e : kind(world, actuator).entries) keys.push_back(e.key);
  throw InputError(
      Problem{"", of + key, "", "unknown key" + config::did_you_mean(key, keys), "what vsa actuators TYPE lists, or link.…"});
}

std::string ParameterBook::owner_name(const engine::World& world, std::string_view key, std::size_t owner) const {
  if (is_of_links(key)) return world.links()[owner].name;
  return world.name_of(world.actuators()[owner]);
}

double ParameterBook::number(const engine::World& world, const CopyParameters& copy, std::size_t owner, const std::string& key) {
  if (is_of_links(key)) {
    const engine::LinkParameters link = world.link_parameters(*copy.of, links_[owner]);
    if (key == kFriction) return link.friction.value_or(kNone);
    return key == kMass ? link.mass_kg : copy.inertia_factor.empty() ? 1 : copy.inertia_factor[owner];
  }
  const config::Entry* at_first = entry(world, owner, key);
  const std::string* text = put_into(world.actuator_parameters(*copy.of, world.actuators()[owner]), key);
  if (text != nullptr) return number_of(*text, at_first, key);
  if (at_first != nullptr) return at_first->number;
  if (has(world, owner, key)) return kNone;
  throw InputError(Problem{"", owner_name(world, key, owner) + ": " + key, "", "unknown key", "what vsa actuators TYPE lists"});
}

double ParameterBook::nominal(const engine::World& world, std::size_t owner, const std::string& key) {
  double out = number(world, first_, owner, key);
  if (std::isnan(out) && of_second_motor(key)) out = number(world, first_, owner, of_first_motor(key));
  if (!std::isnan(out)) return out;
  throw InputError(Problem{"", owner_name(world, key, owner) + ": " + key, "", "began with none: there is nothing to multiply",
                           "a draw of the value itself"});
}

std::string ParameterBook::text(const engine::World& world, const CopyParameters& copy, std::size_t owner, const std::string& key) {
  const double as_number = number(world, copy, owner, key);
  if (is_of_links(key)) return config::number_text(as_number);
  const std::string* text = put_into(world.actuator_parameters(*copy.of, world.actuators()[owner]), key);
  if (text != nullptr) return *text;
  const config::Entry* at_first = entry(world, owner, key);
  return at_first != nullptr ? at_first->value : "";
}

double ParameterBook::rounded(const engine::World& world, std::size_t owner, const std::string& key, double value) {
  if (is_of_links(key)) return value;
  const config::Kind kind = kind_of(entry(world, owner, key), key);
  if (kind == config::Kind::number) return value;
  if (kind == config::Kind::integer) return std::round(value);
  throw InputError(
      Problem{"", owner_name(world, key, owner) + ": " + key, "", "is no number: nothing can be drawn for it", "set()"});
}

host::ActuatorConfig ParameterBook::remade(host::ActuatorConfig now, const Kind& kind, const std::vector<Override>& values,
                                           const Law& at_first) {
  now.unit = kind.file.make(values).unit;
  // Copies with springs as at first share them, too.
  if (now.unit.actuator.transmission->equals(*at_first)) now.unit.actuator.transmission = at_first;
  auto changed = std::make_shared<host::Settings>();
  for (const Override& o : values) changed->emplace_back(o.key, o.value);
  now.changed = std::move(changed);
  return now;
}

std::vector<Override> ParameterBook::values_with(const host::ActuatorConfig& now, const Kind& kind,
                                                 const std::vector<const Change*>& changes) {
  std::vector<Override> values = overrides(now);
  for (const Change* c : changes) {
    const auto e = std::find_if(kind.entries.begin(), kind.entries.end(), [&](const auto& x) { return x.key == *c->key; });
    std::erase_if(values, [&](const Override& o) { return o.key == *c->key; });
    values.push_back({*c->key, value_text(c->value, kind_of(e == kind.entries.end() ? nullptr : &*e, *c->key))});
  }
  return values;
}

void ParameterBook::change_actuators(const engine::World& world, const CopyParameters& copy, const std::vector<Change>& changes,
                                     engine::ParameterChanges& out, Problems& problems) const {
  std::map<std::size_t, std::vector<const Change*>> by_actuator;
  for (const Change& c : changes)
    if (!is_of_links(*c.key)) by_actuator[c.owner].push_back(&c);
  std::map<std::string, host::ActuatorConfig> made;  // equal ones once
  for (const auto& [actuator, own] : by_actuator) {
    const engine::ActuatorRef& ref = world.actuators()[actuator];
    const Kind& kind = *kinds_[actuator];
    const std::string name = owner_name(world, "", actuator);
    if (!kind.refusal.empty()) {
      problems.add({"", name + ": " + *own.front()->key, "", kind.refusal, "a World made with its values (--set, <override>)"});
      continue;
    }
    const host::ActuatorConfig& now = world.actuator_parameters(*copy.of, ref);
    const std::vector<Override> values = values_with(now, kind, own);
    const std::string key = recipe(now.type, values);
    try {
      if (made.find(key) == made.end())
        made[key] = remade(now, kind, values, world.actuator_parameters(*first_.of, ref).unit.actuator.transmission);
      out.actuators.emplace_back(ref, made[key]);
    } catch (const InputError& error) {
      for (const Problem& p : error.problems()) problems.add(named(p, name));
    }
  }
}

void ParameterBook::change_links(const engine::World& world, const std::vector<Change>& changes, CopyParameters& copy,
                                 engine::ParameterChanges& out, Problems& problems) const {
  std::map<std::size_t, engine::LinkParameters> links;
  for (const Change& c : changes) {
    if (!is_of_links(*c.key)) continue;
    const auto value = std::holds_alternative<double>(c.value) ? std::optional(std::get<double>(c.value))
                                                               : config::parse_number(std::get<std::string>(c.value));
    const std::string name = owner_name(world, *c.key, c.owner) + ": " + *c.key;
    if (!value) {
      problems.add({"", name, std::get<std::string>(c.value), "isn't a number", "a number"});
      continue;
    }
    engine::LinkParameters& to = links.try_emplace(c.owner, world.link_parameters(*copy.of, links_[c.owner])).first->second;
    if (*c.key == kFriction) {
      to.friction = *value;
    } else if (*c.key == kMass) {
      to.mass_kg = *value;
    } else if (!(*value >= kLeastFactor && *value <= kMostFactor)) {
      problems.add({"", name, config::number_text(*value), "is out of range", config::range_text(kLeastFactor, kMostFactor)});
    } else if (world.links()[c.owner].is_static) {
      problems.add({"", name, config::number_text(*value), "is static", "a link that moves"});
    } else {
      copy.inertia_factor.resize(links_.size(), 1.0);
      copy.inertia_factor[c.owner] = *value;
    }
  }
  for (auto& [l, to] : links) {
    const engine::LinkParameters at_first = world.link_parameters(*first_.of, links_[l]);
    const double factor = copy.inertia_factor.empty() ? 1.0 : copy.inertia_factor[l];
    if (!world.links()[l].is_static)
      for (std::size_t k = 0; k < 3; ++k) to.inertia_kgm2[k] = at_first.inertia_kgm2[k] * (to.mass_kg / at_first.mass_kg * factor);
    out.links.emplace_back(links_[l], to);
  }
}

CopyParameters ParameterBook::with(const engine::World& world, const CopyParameters& copy,
                                   const std::vector<Change>& changes) const {
  CopyParameters out = copy;
  engine::ParameterChanges all;
  Problems problems;
  change_actuators(world, copy, changes, all, problems);
  change_links(world, changes, out, all, problems);
  try {
    out.of = world.parameters_with(*copy.of, all);
  } catch (const InputError& error) {
    problems.add_all(error);
  }
  problems.throw_if_any();
  return out;
}

}  // namespace vsa::batch
