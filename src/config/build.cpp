// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/build.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "config/resolve.hpp"
#include "vsa/config/csv_table.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/travel.hpp"

namespace vsa::config {
namespace {

using Law = std::shared_ptr<const elastic::Transmission>;

std::string column_text(std::span<const elastic::LawColumn> columns) {
  std::string out = "a CSV file with";
  for (const elastic::LawColumn& c : columns) out += ' ' + std::string(c.name) + (c.needed ? "" : " (optional)") + ',';
  out.pop_back();
  return out;
}

/// Every number within its column's bounds.
LawRows read_rows(const std::filesystem::path& file, std::span<const elastic::LawColumn> columns) {
  std::vector<WantedColumn> wanted;
  for (const elastic::LawColumn& c : columns) wanted.push_back({c.name, c.needed});
  CsvTable table = read_csv(file, wanted);
  if (table.lines.empty()) throw InputError(Problem{file.string(), "", "", "has no rows", "a header line and numbers"});
  FewProblems problems;
  LawRows out{{}, file, std::move(table.lines)};
  for (std::size_t row = 0; row < out.lines.size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = table.columns[c].empty() ? 0.0 : table.columns[c][row];
      out.values.push_back(value);
      if (value >= columns[c].min && value <= columns[c].max) continue;
      problems.add({at_line(file, out.lines[row]), std::string(columns[c].name), number_text(value),
                    "is outside of what the model accepts", range_text(columns[c].min, columns[c].max)});
    }
  }
  problems.throw_if_any();
  return out;
}

class KeysOfLaw final : public LawReader {
 public:
  explicit KeysOfLaw(Resolver& resolver) : resolver_(resolver) {}

  double number(std::string_view key, std::string_view unit, double min, double max, std::string_view meaning) override {
    const Spec spec{"elastic." + std::string(key), std::string(unit), Kind::number, min, max, "", meaning};
    if (const auto value = resolver_.resolve(spec)) return *value;
    failed_ = true;
    resolver_.report_missing(spec);
    return std::numeric_limits<double>::quiet_NaN();
  }

  LawRows rows(const elastic::LawFile& file) override {
    LawRows out;
    const std::string columns = column_text(file.columns);
    const Spec spec{"elastic." + std::string(file.key), "", Kind::file, 0, 0, columns, file.meaning};
    if (const auto path = resolver_.resolve_file(spec)) {
      try {
        out = read_rows(*path, file.columns);
      } catch (const InputError& error) {
        for (const Problem& p : error.problems()) resolver_.add(p);
      }
    } else {
      resolver_.report_missing(spec);
    }
    failed_ = failed_ || out.values.empty();
    return out;
  }

  void remark(std::string text) override { remarks_.push_back(std::move(text)); }

  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] std::vector<std::string>& remarks() noexcept { return remarks_; }

 private:
  Resolver& resolver_;
  bool failed_ = false;
  std::vector<std::string> remarks_;
};

/// Null where the law can't be made; the reason is reported then. `known`: its name is one.
Law make_law(const Document& document, const LawRegistry& laws, Resolver& resolver, bool& known,
             std::vector<std::string>& remarks) {
  const LawFactory* factory = laws.find(document.law);
  known = factory != nullptr;
  if (!known) {
    if (!document.law.empty())
      resolver.problem(document.law_line, "elastic.law", '"' + document.law + '"', "unknown law", join(laws.names()));
    return nullptr;
  }
  KeysOfLaw reader(resolver);
  Law law;
  try {
    law = (*factory)(reader);
  } catch (const InputError& error) {
    if (reader.failed()) return nullptr;  // it judged the NaN of a value that is reported already
    for (const Problem& p : error.problems()) {
      const std::string key = "elastic." + p.key;
      if (p.file.empty()) resolver.problem(resolver.line_of(key), key, p.value, p.message, p.allowed);
      if (!p.file.empty()) resolver.add({p.file, key, p.value, p.message, p.allowed});
    }
    return nullptr;
  }
  if (reader.failed()) return nullptr;
  remarks = std::move(reader.remarks());
  if (!law) resolver.problem(document.law_line, "elastic.law", '"' + document.law + '"', "the law's factory returned nothing");
  return law;
}

/// The servo where there is one; the reason is reported where its name is none.
bool make_controller(const Document& document, Resolver& resolver, ActuatorType& type) {
  type.controller = document.controller.empty() ? "qbmove" : document.controller;
  const std::vector<std::string> known = split(kControllers, '|');
  if (std::find(known.begin(), known.end(), type.controller) == known.end()) {
    resolver.problem(document.controller_line, "control.kind", '"' + type.controller + '"',
                     "is no controller" + did_you_mean(type.controller, known), join(known));
    return false;
  }
  for (const auto kind :
       {control::ServoKind::position_servo, control::ServoKind::torque_servo, control::ServoKind::motor_voltages}) {
    if (type.controller == control::name_of(kind)) type.unit.servo.emplace().kind = kind;
  }
  return true;
}

/// Whether the type's controller has that parameter; one that is given all the same is refused.
bool is_of(const Parameter& p, const std::string& controller, Resolver& resolver) {
  const std::vector<std::string> those = split(controllers_of(p), '|');
  if (std::find(those.begin(), those.end(), controller) != those.end()) return true;
  if (resolver.has(p.key))
    resolver.problem(resolver.line_of(p.key), std::string(p.key), "",
                     "is of the controller " + join(those, ", ") + ": control.kind is " + controller, "leave it out");
  resolver.know(p.key);
  return false;
}

Spec spec_of(const Parameter& p, const Law& law, const device::UnitConfig& with) {
  std::string unit(p.unit);
  if (p.unit == kPresetUnit) unit = law ? std::string(with.preset_unit()) : "?";
  return {std::string(p.key), unit, p.kind, p.min, p.max, p.words, p.meaning};
}

void read_parameter(const Parameter& p, const Law& law, Resolver& resolver, device::UnitConfig& unit) {
  const Spec spec = spec_of(p, law, unit);
  if (const std::string why = law ? why_absent(p, unit) : ""; !why.empty()) {
    if (resolver.has_own(p.key)) resolver.problem(resolver.line_of(p.key), spec.key, "", why);  // a base's isn't this file's fault
    resolver.know(p.key);
    if (p.unit == kPresetUnit) unit.preset_max = 0;
    return;
  }
  if (const auto value = resolver.resolve(spec)) {
    p.apply(unit, *value);
  } else if (p.need == Need::required && spec.unit != "?" && (law || p.shaft != "m")) {
    // Without its law nobody knows whether it has a preset, or slides.
    resolver.report_missing(spec);
  } else if (p.need == Need::defaulted && !resolver.has(p.key)) {
    p.apply(unit, resolver.use_default(spec, p.default_value, p.default_source));
  }
}

/// A base's tendons are those of its springs: a law that names none doesn't take them, as it doesn't take the springs.
bool leaves_tendons(const Law& law, const Resolver& resolver) {
  return law && law->spring_count() == 0 && resolver.inherited("tendon.friction").value_or(0) > 0;
}

void leave_tendon(const Parameter& p, Resolver& resolver, device::UnitConfig& unit) {
  resolver.know(p.key);
  p.apply(unit, resolver.use_default(spec_of(p, nullptr, unit), p.default_value, "the base's is of springs that this law hasn't"));
}

/// What the models need beyond single values; of keys that have none, and of a law that couldn't be made, enough is said.
void check_together(const device::UnitConfig& unit, Resolver& resolver) {
  Problems found;
  device::validate(unit, "", found);
  for (const Problem& p : found.list())
    if (p.key != "elastic.law" && !resolver.failed(p.key))
      resolver.problem(resolver.line_of(p.key), p.key, p.value, p.message, p.allowed);
  // A unit takes any gain, and the defaults are the maker pro's: motors that run away are nobody's wish.
  constexpr const char* kGain = "firmware.kp_pct_per_tick";
  if (!unit.servo && unit.program.model == firmware::Model::advanced && unit.memory.position.p > 0 && !resolver.failed(kGain))
    resolver.problem(resolver.line_of(kGain), kGain, number_text(std::round(unit.memory.position.p / 6.5536) / 1e4),
                     "drives the motors away: the advanced unit's program counts the other way round",
                     "below 0, as firmware.kd_pct_per_tick (-0.1 and -0.8 as shipped), and firmware.supply_limit = false");
}

}  // namespace

ActuatorType build_type(const Document& document, const std::vector<Override>& overrides, const LawRegistry& laws,
                        Problems& problems) {
  ActuatorType type;
  type.name = document.name;
  type.title = document.title;
  type.description = document.description;
  type.law = document.law;
  type.rank = document.rank;
  type.base = document.base;
  type.file = document.file;
  type.evidence = document.evidence;
  type.mass_kg = document.mass_kg;
  type.notices = document.notices;
  Resolver resolver(document, overrides, problems);
  bool law_known = false;
  const Law law = make_law(document, laws, resolver, law_known, type.remarks);
  type.unit.actuator.transmission = law;
  const bool controller_known = make_controller(document, resolver, type), no_tendons = leaves_tendons(law, resolver);
  for (const Parameter& p : parameters()) {
    if (!controller_known) {
      resolver.know(p.key);
    } else if (no_tendons && p.key.rfind("tendon.", 0) == 0 && !resolver.has_own(p.key)) {
      leave_tendon(p, resolver, type.unit);
    } else if (is_of(p, type.controller, resolver)) {
      read_parameter(p, law, resolver, type.unit);
    }
  }
  check_together(type.unit, resolver);
  resolver.report_unknown(law_known ? "" : "elastic.");
  type.entries = std::move(resolver.entries());
  return type;
}

}  // namespace vsa::config
