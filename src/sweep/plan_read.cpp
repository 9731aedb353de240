// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

#include "sweep/plan_parts.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/hash.hpp"

namespace vsa::sweep {
namespace {

namespace fs = std::filesystem;
using config::TomlSection;

template <class Item>
void refuse_twice(const std::vector<Item>& items, const char* key, const std::string& file, std::set<std::string>& names,
                  Problems& problems) {
  for (const Item& item : items) {
    if (!item.name.empty() && !names.insert(item.name).second)
      problems.add({file, key, item.name, "two columns of one name", "names that differ"});
    if (item.name == "." || std::any_of(item.name.begin(), item.name.end(), [](unsigned char c) { return c < ' '; }))
      problems.add({file, key, item.name, "is no column's name in HDF5", "another name"});
  }
}

std::uint64_t hashed(std::uint64_t h, std::string_view text) { return fnv1a("\xFF", fnv1a(text, h)); }

std::string shown(const toml::table& table) {
  std::ostringstream out;
  out << table;
  return out.str();
}

/// A type's file, those that it is based on, and the grids that they name.
std::string type_contents(const std::string& name) {
  const config::TypeLibrary library;
  std::string all;
  std::set<std::string> seen;
  for (std::string next = name; !next.empty() && seen.insert(next).second;) {
    const fs::path file = library.find(next);
    const std::string text = read_file(file).value_or("");
    all += text;
    try {
      const toml::table type = toml::parse(text);
      next = type["type"]["base"].value_or(std::string());
      if (const auto grid = type["elastic"]["grid"]["value"].value<std::string>())
        all += read_file(file.parent_path() / *grid).value_or("");
    } catch (const toml::parse_error&) {
      break;  // Plan::check tells
    }
  }
  return all;
}

/// Of the types that a world's text names.
std::string types_in(const std::string& world) {
  constexpr std::string_view kBegin = "<type>", kEnd = "</type>";
  std::set<std::string> names;
  for (std::size_t at = world.find(kBegin); at != std::string::npos; at = world.find(kBegin, at)) {
    at += kBegin.size();
    const std::size_t end = world.find(kEnd, at);
    if (end == std::string::npos) break;
    names.insert(std::string(config::trim(std::string_view(world).substr(at, end - at))));
  }
  std::string all;
  for (const std::string& name : names) {
    try {
      all += type_contents(name);
    } catch (const InputError&) {
      continue;  // Plan::check tells
    }
  }
  return all;
}

/// A world's file, of an MJCF the actuators beside it, and the types that they name.
std::string world_contents(fs::path file) {
  std::string all = read_file(file).value_or("");
  if (file.extension() == ".xml") all += read_file(file.replace_extension(".vsa.xml")).value_or("");
  return all + types_in(all);
}

/// What a key of the scenario names as files, as they are now.
std::string contents(const std::string& key, const std::string& name, const fs::path& beside) {
  const bool world = key == "scenario.world", gait = key == "motion.file", type = key == "scenario.type" || key == "study.type";
  if (!world && !gait && !type) return "";
  try {
    if (type) return type_contents(name);
    if (world) return world_contents(config::find_file(name, "world", "models/worlds", ".sdf", beside));
    return read_file(config::find_file(name, "gait", "models/gaits", ".toml", beside)).value_or("");
  } catch (const InputError&) {
    return "";  // Plan::check tells
  }
}

/// Of a study: what it is compared with or fitted to, files or folders of them.
std::uint64_t recordings_hashed(std::uint64_t h, const Plan::Impl& plan) {
  const auto* named = plan.base.at_path("study.recordings").as_array();
  for (std::size_t i = 0; named != nullptr && i < named->size(); ++i) {
    const fs::path place = plan.base_file.parent_path() / (*named)[i].value<std::string>().value_or("");
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(place, none)) files.push_back(entry.path());
    if (files.empty()) files.push_back(place);
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) h = hashed(hashed(h, file.filename().string()), read_file(file).value_or(""));
  }
  return h;
}

std::uint64_t fingerprint_of(const toml::table& root, const Plan::Impl& plan) {
  std::uint64_t h = hashed(fnv1a(""), "vsasim sweep 2");
  h = hashed(h, shown(root));
  h = hashed(h, shown(plan.base));
  const fs::path beside = plan.file.parent_path();
  for (const std::string key : {"scenario.world", "motion.file", "scenario.type", "study.type"}) {
    const fs::path place = key == "motion.file" && plan.own_motion ? beside : plan.base_file.parent_path();
    if (const auto name = plan.base.at_path(key).value<std::string>()) h = hashed(h, contents(key, *name, place));
  }
  for (const Axis& axis : plan.axes) {
    for (const Value& value : axis.values)
      if (const auto* name = std::get_if<std::string>(&value))
        for (const std::string& key : axis.keys) h = hashed(h, contents(key, *name, beside));
  }
  return recordings_hashed(h, plan);
}

/// The tables of the scenario that the plan has itself, or those of the file that it names.
void read_base(TomlSection& top, Plan::Impl& out, Problems& problems) {
  bool own = false;
  out.own_motion = top.find("motion") != nullptr;
  for (const char* part : kParts) {
    const toml::node* node = top.find(part);
    if (node == nullptr || (std::string(part) == "scenario" && !node->is_table())) continue;
    out.base.insert(part, *node);
    own = own || std::string(part) == "scenario" || std::string(part) == "study";
  }
  out.base_file = out.file;
  if (out.is_study()) {
    for (const char* other : {"scenario", "motion", "command", "start"})
      if (top.find(other) != nullptr) top.add(other, "", "is a scenario's, and this plan has a study", "[study] or [scenario]");
    return;
  }
  const toml::node* named = top.find("scenario");
  if (own) return;
  const auto name = named == nullptr ? std::nullopt : named->value_exact<std::string>();
  if (!name) {
    top.add("scenario", "", "is missing", "a scenario's file, or a table with the world");
    return;
  }
  out.base_file = out.file.parent_path() / *name;
  try {
    toml::table base = config::parse_toml(out.base_file);
    base.erase("record");  // where it goes and how fast is the sweep's matter
    if (toml::table* run = base["scenario"].as_table())
      for (const char* outside : kOutside) run->erase(outside);
    for (auto&& [key, node] : out.base) base.insert_or_assign(key, node);  // the plan's own tables replace the file's
    out.base = std::move(base);
  } catch (const InputError& error) {
    problems.add_all(error);
  }
}

/// Where two axes set the same, one of them would do nothing.
void refuse_shared_keys(const Plan::Impl& plan, Problems& problems) {
  std::set<std::pair<std::string, std::string>> seen;
  for (const Axis& axis : plan.axes) {
    for (const std::string& key : axis.keys) {
      const std::string of_type = key.rfind("set.", 0) == 0 ? key.substr(4) : key;
      if (!key.empty() && !seen.emplace(of_type, axis.of).second)
        problems.add({plan.file.string(), "vary.key", key, "is varied twice", "each key once, by itself or as set.KEY"});
    }
  }
}

void count(TomlSection& top, Plan::Impl& out) {
  double cells = 1;
  std::size_t sobol = 0;
  bool drawn = false;
  for (const Axis& axis : out.axes) {
    if (axis.kind == Axis::Kind::listed) cells *= static_cast<double>(std::max<std::size_t>(1, axis.values.size()));
    sobol += axis.kind == Axis::Kind::sobol ? 1 : 0;
    drawn = drawn || axis.kind == Axis::Kind::random || axis.kind == Axis::Kind::sobol;
  }
  if (drawn) top.need("samples", "how many draws of the random and Sobol' axes, 1 …");
  const auto samples = top.whole("samples", 1, kMostSamples);
  if (samples && !drawn)
    top.add("samples", std::to_string(*samples), "no axis is drawn", "an axis with random or sobol, or no samples");
  out.samples = static_cast<std::size_t>(samples.value_or(1));
  constexpr std::size_t kMostSobol = boost::random::default_sobol_table::max_dimension;
  if (sobol > kMostSobol)
    top.add("vary", std::to_string(sobol), "more Sobol' axes than can be", "at most " + std::to_string(kMostSobol));
  double runs = cells * static_cast<double>(out.samples) * static_cast<double>(out.repetitions);
  if (out.search) runs *= static_cast<double>(out.search->population) * (out.search->generations + 1.0);
  if (runs > Plan::kMostRuns) {
    top.add("vary", config::number_text(runs), "runs are more than a plan may have",
            "at most " + config::number_text(Plan::kMostRuns));
    return;
  }
  out.cells = static_cast<std::size_t>(cells);
}

}  // namespace

Plan Plan::load(const fs::path& file) {
  const toml::table root = config::parse_toml(file);
  Problems problems;
  auto impl = std::make_shared<Impl>();
  impl->file = file;
  impl->text = read_file(file).value_or("");
  TomlSection top(&root, file.string(), "", problems);
  impl->title = top.text("title").value_or("");
  if (const auto seed = top.whole("seed", 0, scenario::kLargestSeed)) impl->seed = static_cast<std::uint64_t>(*seed);
  impl->repetitions = static_cast<std::size_t>(top.whole("repetitions", 1, kMostSamples).value_or(1));
  read_base(top, *impl, problems);
  TomlSection start(top.table("start"), file.string(), "start.", problems);
  impl->start.yaw_deg = start.number("yaw_deg", 0, 180).value_or(0);
  impl->start.xy_m = start.number("xy_m", 0, 1e3).value_or(0);
  start.refuse_others();
  TomlSection limits(top.table("limits"), file.string(), "limits.", problems);
  impl->limit_s = limits.number("run_s", 1e-3, 1e7).value_or(impl->limit_s);
  limits.refuse_others();
  const auto vary = top.tables("vary"), measure = top.tables("measure");
  const auto place = [&](const toml::table* t) { return config::place_of(file, *t); };
  for (const toml::table* t : vary) impl->axes.push_back(read_axis({t, place(t), "vary.", problems}));
  for (const toml::table* t : measure) {
    const TomlSection section(t, place(t), "measure.", problems);
    impl->measures.push_back(impl->is_study() ? read_study_measure(section) : read_measure(section));
  }
  for (const Axis& axis : impl->axes)
    if (impl->is_study() && axis.parameter)
      problems.add({file.string(), "vary.key", config::join(axis.keys), "is no key of a study", "study.…, set.…"});
  refuse_shared_keys(*impl, problems);
  if (measure.empty()) top.add("measure", "", "is missing", "[[measure]] with name and signal");
  std::set<std::string> names{"point", "repetition", "notice", "error"};
  refuse_twice(impl->axes, "vary.name", file.string(), names, problems);
  refuse_twice(impl->measures, "measure.name", file.string(), names, problems);
  read_search(top, file.string(), *impl, problems);
  count(top, *impl);
  top.refuse_others();
  problems.throw_if_any();
  impl->fingerprint = fingerprint_of(root, *impl);
  return Plan(std::move(impl));
}

}  // namespace vsa::sweep
