// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/build.hpp"

#include <limits>

#include "config/resolve.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/transmission.hpp"

namespace vsa::config {
namespace {

using Law = std::shared_ptr<const elastic::Transmission>;

class Reader final : public LawReader {
 public:
  explicit Reader(Resolver& resolver) : resolver_(resolver) {}

  double number(std::string_view key, std::string_view unit, double min, double max, std::string_view meaning) override {
    const Spec spec{"elastic." + std::string(key), std::string(unit), Kind::number, min, max, "", meaning};
    if (const auto value = resolver_.resolve(spec)) return *value;
    failed_ = true;
    resolver_.report_missing(spec);
    return std::numeric_limits<double>::quiet_NaN();
  }

  [[nodiscard]] bool failed() const noexcept { return failed_; }

 private:
  Resolver& resolver_;
  bool failed_ = false;
};

/// Null where the law can't be made; the reason is reported then. `known`: its name is one.
Law make_law(const Document& document, const LawRegistry& laws, Resolver& resolver, bool& known) {
  const LawFactory* factory = laws.find(document.law);
  known = factory != nullptr;
  if (!known) {
    if (!document.law.empty())
      resolver.problem(document.law_line, "elastic.law", '"' + document.law + '"', "unknown law", join(laws.names()));
    return nullptr;
  }
  Reader reader(resolver);
  Law law;
  try {
    law = (*factory)(reader);
  } catch (const InputError& error) {
    if (reader.failed()) return nullptr;  // it judged the NaN of a value that is reported already
    for (const Problem& p : error.problems()) {
      const std::string key = "elastic." + p.key;
      resolver.problem(resolver.line_of(key), key, p.value, p.message, p.allowed);
    }
    return nullptr;
  }
  if (reader.failed()) return nullptr;
  if (!law) resolver.problem(document.law_line, "elastic.law", '"' + document.law + '"', "the law's factory returned nothing");
  return law;
}

Spec spec_of(const Parameter& p, const Law& law) {
  std::string unit(p.unit);
  if (p.unit == kPresetUnit) unit = law ? std::string(law->preset_unit()) : "?";
  return {std::string(p.key), unit, p.kind, p.min, p.max, p.words, p.meaning};
}

void read_parameter(const Parameter& p, const Law& law, Resolver& resolver, device::UnitConfig& unit) {
  const Spec spec = spec_of(p, law);
  if (spec.unit.empty() && p.unit == kPresetUnit) {
    if (resolver.has(p.key)) resolver.problem(resolver.line_of(p.key), spec.key, "", "the law has no preset: leave this out");
    resolver.know(p.key);
    unit.preset_max = 0;
    return;
  }
  if (const auto value = resolver.resolve(spec)) {
    p.set(unit, *value);
  } else if (p.need == Need::required && spec.unit != "?") {  // without its law nobody knows whether it has a preset
    resolver.report_missing(spec);
  } else if (p.need == Need::defaulted && !resolver.has(p.key)) {
    p.set(unit, resolver.use_default(spec, p.default_value, p.default_source));
  }
}

/// What single values can't show.
void check_together(const device::UnitConfig& unit, Resolver& resolver) {
  if (const auto& law = unit.actuator.transmission; law && law->spring_count() == 0 && unit.actuator.tendon.friction > 0) {
    resolver.problem(resolver.line_of("tendon.friction"), "tendon.friction", number_text(unit.actuator.tendon.friction),
                     "the law names no spring that a tension could load", "0");
  }
  if (unit.actuator.tendon.friction > 0 && unit.actuator.tendon.presliding_J <= 0) {
    resolver.problem(resolver.line_of("tendon.presliding_J"), "tendon.presliding_J", number_text(unit.actuator.tendon.presliding_J),
                     "tendon.friction needs a presliding", "above 0");
  }
  const drive::BridgeParams& bridge = unit.actuator.bridge;
  if (bridge.pin == drive::PwmPin::enable && bridge.period_s > 0 && !unit.actuator.motor.inductance_H) {
    resolver.problem(resolver.line_of("drive.inductance_H"), "drive.inductance_H", "",
                     "a modulated enable pin with a period needs the winding's inductance", "above 0, or drive.pwm_period_s = 0");
  }
  if (unit.program.generation != firmware::Generation::v6 && unit.program.model != firmware::Model::maker_pro) {
    resolver.problem(resolver.line_of("firmware.generation"), "firmware.generation", "",
                     "older loops are those of the maker pro: the advanced unit has one", "6.1, or firmware.model = maker_pro");
  }
  const std::int32_t low = unit.memory.limit_low[0], high = unit.memory.limit_high[0];
  if (low >= high) {
    resolver.problem(resolver.line_of("firmware.limit_low_raw"), "firmware.limit_low_raw", std::to_string(low),
                     "must be below firmware.limit_high_raw", "below " + std::to_string(high));
  }
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
  const Law law = make_law(document, laws, resolver, law_known);
  type.unit.actuator.transmission = law;
  for (const Parameter& p : parameters()) read_parameter(p, law, resolver, type.unit);
  check_together(type.unit, resolver);
  resolver.report_unknown(law_known ? "" : "elastic.");
  type.entries = std::move(resolver.entries());
  return type;
}

}  // namespace vsa::config
