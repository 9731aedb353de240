// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The elastic laws that actuator types may name: the library's (vsa/elastic/law.hpp) and whatever is added.
#include "vsa/config/actuator_type.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

LawRegistry LawRegistry::standard() {
  LawRegistry laws;
  for (const elastic::Law* law : elastic::laws()) laws.add(*law);
  return laws;
}

void LawRegistry::add(std::string name, LawFactory factory) { factories_.insert_or_assign(std::move(name), std::move(factory)); }

void LawRegistry::add(const elastic::Law& law) {
  add(std::string(law.name), [&law](LawReader& reader) {
    std::vector<double> values;
    for (const elastic::LawParameter& p : law.parameters) values.push_back(reader.number(p.key, p.unit, p.min, p.max, p.meaning));
    Problems problems;
    elastic::validate(law, values, "", problems);
    problems.throw_if_any();
    return law.make(values);
  });
}

const LawFactory* LawRegistry::find(std::string_view name) const {
  const auto it = factories_.find(name);
  return it == factories_.end() ? nullptr : &it->second;
}

std::vector<std::string> LawRegistry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, factory] : factories_) names.push_back(name);
  return names;
}

}  // namespace vsa::config
