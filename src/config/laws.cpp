// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The elastic laws that actuator types may name: the library's (vsa/elastic/law.hpp) and whatever is added.
#include "config/law_modules.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/csv_table.hpp"
#include "vsa/config/text.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

std::vector<const elastic::Law*> standard_laws() {
  std::vector<const elastic::Law*> laws;
  std::map<std::string_view, std::string> taken;
  for (const elastic::Law* law : elastic::laws()) {
    laws.push_back(law);
    taken[law->name] = "by a law that ships";
  }
  Problems problems;
  for (const ForeignLaw& l : laws_of_path(problems)) {
    const auto [by, fresh] = taken.try_emplace(l.law->name, "of " + l.file.string());
    if (fresh) {
      laws.push_back(l.law);
    } else {
      problems.add({l.file.string(), "law", std::string(l.law->name), "the name is taken, " + by->second, "a name of its own"});
    }
  }
  problems.throw_if_any();
  return laws;
}

LawRegistry LawRegistry::standard() {
  LawRegistry laws;
  for (const elastic::Law* law : standard_laws()) laws.add(*law);
  return laws;
}

void LawRegistry::add(std::string name, LawFactory factory) { factories_.insert_or_assign(std::move(name), std::move(factory)); }

namespace {

/// A law's fault as a problem of its file, or of its parameter.
Problem problem_of(const elastic::LawFault& fault, const elastic::Law& law, std::span<const double> values, const LawRows& rows) {
  Problem out{"", std::string(fault.key), "", fault.message, fault.allowed};
  for (std::size_t i = 0; i < law.parameters.size(); ++i)
    if (law.parameters[i].key == fault.key) out.value = number_text(values[i]);
  if (law.file != nullptr && law.file->key == fault.key)
    out.file = fault.row ? at_line(rows.file, rows.lines.at(*fault.row)) : rows.file.string();
  return out;
}

}  // namespace

void LawRegistry::add(const elastic::Law& law) {
  add(std::string(law.name), [&law](LawReader& reader) -> std::shared_ptr<const elastic::Transmission> {
    std::vector<double> values;
    for (const elastic::LawParameter& p : law.parameters) values.push_back(reader.number(p.key, p.unit, p.min, p.max, p.meaning));
    LawRows rows;
    if (law.file != nullptr) {
      rows = reader.rows(*law.file);
      if (rows.values.empty()) return nullptr;
      values.insert(values.end(), rows.values.begin(), rows.values.end());
    }
    if (const auto fault = law.fault != nullptr ? law.fault(values) : std::nullopt)
      throw InputError(problem_of(*fault, law, values, rows));
    if (law.remark != nullptr) reader.remark(law.remark(values));
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
