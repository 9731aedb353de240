// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/unit_memory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
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

/// What `vsa set` would not store.
void look_at(const Memory& memory, const std::string& file, const std::string& key, Problems& notices) {
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
    const bool limit = raw != std::string::npos;
    notices.add({file, p.key.substr(0, raw), p.value, limit ? "isn't below limit_high" : p.message, p.allowed});
  }
}

Memory read_page(const toml::table& unit, const char* name, const std::string& file, const std::string& where, Problems& problems,
                 Problems& notices) {
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
      if (!number) problems.add({file, fmt::format("{}.{}[{}]", key, e.name, i), "", "isn't a number", ""});
      numbers[e.offset + i] = number.value_or(0);
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
    look_at(out, file, key, notices);
  }
  return out;
}

/// To the bit: over the wire a client can store a multiplier that isn't a number, which is unlike itself.
bool same(Memory a, Memory b) {
  const bool factors = bits_as<std::array<std::uint32_t, 3>>(a.multiplier) == bits_as<std::array<std::uint32_t, 3>>(b.multiplier);
  a.multiplier = b.multiplier = {};
  return factors && a == b;
}

/// Known before the port is there, and before what units store is lost.
std::filesystem::path writable(std::filesystem::path file) {
  struct Tried {};
  try {
    write_whole(file, [](const std::filesystem::path& /*beside*/) { throw Tried(); });
  } catch (const Tried&) {
    return file;
  } catch (const OutputError& error) {
    const std::string why = std::string(error.what()).substr(file.string().size() + 2);
    throw InputError({"", "--memory", file.string(), why, "a file in a directory that can be written"});
  }
  return file;
}

/// Of all names that lead there.
std::string by_one_name(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path there = std::filesystem::weakly_canonical(file, error);
  return error ? file.string() : there.string();
}

}  // namespace

UnitMemory::UnitMemory(std::filesystem::path file, std::string type, std::size_t units)
    : file_(writable(std::move(file))), type_(std::move(type)), lock_(by_one_name(file_), "another program keeps this memory") {
  std::error_code none;
  if (!std::filesystem::exists(file_, none)) return;
  const toml::table root = config::parse_toml(file_);
  const std::string name = file_.string();
  Problems problems;
  const auto only = [&](const toml::table& table, const std::string& where, std::initializer_list<std::string_view> keys) {
    for (const auto& entry : table)
      if (std::find(keys.begin(), keys.end(), entry.first.str()) == keys.end())
        problems.add({name, where + std::string(entry.first.str()), "", "unknown key", fmt::format("{}", fmt::join(keys, ", "))});
  };
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
    only(*unit, where + ".", {"user", "factory"});
    const Memory user = read_page(*unit, "user", name, where, problems, notices_),
                 factory = read_page(*unit, "factory", name, where, problems, notices_);
    pages_.push_back({user, factory});
  }
  only(root, "", {"type", "unit"});
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
