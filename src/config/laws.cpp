// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The elastic laws that actuator types may name. A new law in the library: its room's header, a line in law_parameters(), a line here.
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/schema.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace vsa::config {
namespace {

std::vector<double> read_all(LawReader& reader, std::string_view law) {
  std::vector<double> values;
  for (const LawParameter& p : law_parameters()) {
    if (p.law == law) values.push_back(reader.number(p.key, p.unit, p.min, p.max, p.meaning));
  }
  return values;
}

std::shared_ptr<const elastic::Transmission> two_sinh(LawReader& reader) {
  const std::vector<double> v = read_all(reader, "two_sinh");
  return std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{.k_Nm = {v[0], v[2]}, .a_per_rad = {v[1], v[3]}});
}

std::shared_ptr<const elastic::Transmission> two_sinh_linear(LawReader& reader) {
  const std::vector<double> v = read_all(reader, "two_sinh_linear");
  return std::make_shared<elastic::TwoSinh>(elastic::TwoSinhParams{
      .k_Nm = {v[0], v[3]}, .a_per_rad = {v[1], v[4]}, .c_Nm_per_rad = {v[2], v[5]}, .linear_beyond_rad = v[6]});
}

std::shared_ptr<const elastic::Transmission> series_spring(LawReader& reader) {
  return std::make_shared<elastic::SeriesSpring>(read_all(reader, "series_spring")[0]);
}

}  // namespace

LawRegistry LawRegistry::standard() {
  LawRegistry laws;
  laws.add("two_sinh", two_sinh);
  laws.add("two_sinh_linear", two_sinh_linear);
  laws.add("series_spring", series_spring);
  return laws;
}

void LawRegistry::add(std::string name, LawFactory factory) { factories_.insert_or_assign(std::move(name), std::move(factory)); }

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
