// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/unit_memory.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "vsa/bits.hpp"
#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"
#include "vsa/output_file.hpp"
#include "vsa/state_io.hpp"

namespace vsa::app {
namespace {

using firmware::Memory;

std::string page_text(const char* name, const Memory& memory) {
  std::vector<double> numbers(state::size_of<Memory>());
  state::Writer writer(numbers);
  state::walk_fields(writer, memory);
  std::string out = fmt::format("[unit.{}]\n", name);
  const StateLayout layout = state::layout_of<Memory>();
  for (const StateEntry& e : layout.entries()) {
    std::string values;
    for (std::size_t i = 0; i < e.count; ++i) values += (i == 0 ? "" : ", ") + config::number_text(numbers[e.offset + i]);
    out += fmt::format("\"{}\" = [{}]\n", e.name, values);
  }
  return out;
}

/// What `vsa set` would store: what it wouldn't is a slip of the hand that wrote the file.
void check_page(const Memory& memory, const std::string& file, const std::string& key, Problems& problems) {
  Memory asked = memory;
  for (std::size_t i = 0; i < 2; ++i) {  // limits that leave a motor one place can be stored; a type can't have them
    if (asked.limit_low[i] != asked.limit_high[i]) continue;
    asked.limit_low[i] = 0;
    asked.limit_high[i] = 1;
  }
  Problems found;
  firmware::validate(asked, key + ".", found);
  for (const Problem& p : found.list()) {
    const std::size_t raw = p.key.rfind("_raw");  // of a type's keys, which have their unit
    problems.add({file, p.key.substr(0, raw), p.value, p.message, p.allowed});
  }
}

Memory read_page(const toml::table& unit, const char* name, const std::string& file, const std::string& where, Problems& problems) {
  Memory out;
  const StateLayout layout = state::layout_of<Memory>();
  const std::string key = where + "." + name;
  const toml::table* page = unit[name].as_table();
  if (page == nullptr) {
    problems.add({file, key, "", "is missing", "a table"});
    return out;
  }
  std::vector<double> numbers(state::size_of<Memory>());
  const std::size_t before = problems.list().size();
  for (const StateEntry& e : layout.entries()) {
    const toml::array* values = (*page)[e.name].as_array();
    const bool fits = values != nullptr && values->size() == e.count;
    for (std::size_t i = 0; fits && i < e.count; ++i) {
      const auto number = (*values)[i].value<double>();
      numbers[e.offset + i] = number.value_or(std::numeric_limits<double>::quiet_NaN());
    }
    if (!fits) problems.add({file, key + "." + e.name, "", "isn't there in full", fmt::format("{} numbers", e.count)});
  }
  if (page->size() != layout.entries().size() && problems.list().size() == before)
    problems.add({file, key, fmt::format("{} keys", page->size()), "has more than a unit's memory",
                  fmt::format("{}", layout.entries().size())});
  if (problems.list().size() != before) return out;
  state::Reader reader(numbers);
  state::walk_fields(reader, out);
  if (reader.fault().there()) {
    try {
      throw_if_any(reader.fault(), layout);
    } catch (const InputError& error) {
      for (const Problem& p : error.problems()) problems.add({file, key + "." + p.key, p.value, p.message, p.allowed});
    }
  } else if (out.valid) {
    check_page(out, file, key, problems);
  }
  return out;
}

/// To the bit: over the wire a client can store a multiplier that isn't a number, which is unlike itself.
bool same(Memory a, Memory b) {
  const bool factors = bits_as<std::array<std::uint32_t, 3>>(a.multiplier) == bits_as<std::array<std::uint32_t, 3>>(b.multiplier);
  a.multiplier = b.multiplier = {};
  return factors && a == b;
}

}  // namespace

UnitMemory::UnitMemory(std::filesystem::path file, std::string type, std::size_t units)
    : file_(std::move(file)), type_(std::move(type)) {
  std::error_code none;
  if (!std::filesystem::exists(file_, none)) return;
  const toml::table root = config::parse_toml(file_);
  const std::string name = file_.string();
  Problems problems;
  const auto of = root["type"].value<std::string>();
  if (!of || *of != type_) problems.add({name, "type", of.value_or(""), "isn't the type that is emulated", type_});
  const toml::array* list = root["unit"].as_array();
  const std::size_t count = list == nullptr ? 0 : list->size();
  if (count != units)
    problems.add({name, "unit", fmt::format("{} units", count), "aren't as many as --units", fmt::format("{}", units)});
  for (std::size_t i = 0; i < count; ++i) {
    const std::string where = fmt::format("unit[{}]", i);
    const toml::table* unit = (*list)[i].as_table();
    if (unit == nullptr) {
      problems.add({name, where, "", "isn't a table", ""});
      continue;
    }
    const Memory user = read_page(*unit, "user", name, where, problems),
                 factory = read_page(*unit, "factory", name, where, problems);
    pages_.push_back({user, factory});
  }
  problems.throw_if_any();
}

void UnitMemory::keep(const device::Emulation& emulation) {
  std::vector<device::UnitPages> now;
  for (std::size_t i = 0; i < emulation.size(); ++i) now.push_back(emulation.pages(i));
  const auto kept = [](const device::UnitPages& a, const device::UnitPages& b) {
    return same(a.user, b.user) && same(a.factory, b.factory);
  };
  if (std::equal(now.begin(), now.end(), pages_.begin(), pages_.end(), kept)) return;
  std::string text = "# What the units of vsa emulate --memory have stored.\ntype = \"" + type_ + "\"\n";
  for (const device::UnitPages& unit : now)
    text += "\n[[unit]]\n" + page_text("user", unit.user) + page_text("factory", unit.factory);
  write_whole(file_, text);
  pages_ = std::move(now);
}

}  // namespace vsa::app
