// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Reading a comparison: every problem of the file at once, each with file, hypothesis and key.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/identify/comparison.hpp"

namespace vsa::identify {
namespace {

namespace fs = std::filesystem;

/// A table whose keys are read once each; those never asked for are unknown.
class Section {
 public:
  Section(const toml::table& table, std::string place, Problems& problems)
      : table_(table), place_(std::move(place)), problems_(problems) {}

  void add(const std::string& key, const std::string& value, const std::string& message, const std::string& allowed) const {
    problems_.add({place_, key, value, message, allowed});
  }
  void add_all(const InputError& error, const std::string& key) const {
    for (Problem p : error.problems()) {
      p.file = place_;
      p.key = p.key.empty() ? key : key + ": " + p.key;
      problems_.add(std::move(p));
    }
  }
  const toml::node* find(const char* key, const char* needed = nullptr) {
    asked_.emplace_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr && needed != nullptr) add(key, "", "is missing", needed);
    return node;
  }
  std::string text(const char* key, const char* needed) {
    const toml::node* node = find(key, needed);
    if (node == nullptr) return "";
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) add(key, "", "isn't what it should be", "some text");
    return value.value_or("");
  }
  std::optional<double> number(const char* key, double min, double max, bool whole) {
    const toml::node* node = find(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<double>();
    const std::string allowed = (whole ? "a whole number, " : "") + config::range_text(min, max);
    if (value && *value >= min && *value <= max && (!whole || *value == std::trunc(*value))) return value;
    add(key, value ? config::number_text(*value) : "", "isn't what it should be", allowed);
    return std::nullopt;
  }
  std::vector<std::string> texts(const char* key, const char* needed) {
    std::vector<std::string> out;
    const toml::node* node = find(key, needed);
    if (node == nullptr) return out;
    const toml::array* array = node->as_array();
    if (array == nullptr) return add(key, "", "isn't a list", needed), out;
    for (std::size_t i = 0; i < array->size(); ++i) {
      const auto value = (*array)[i].value_exact<std::string>();
      if (!value) add(fmt::format("{}[{}]", key, i), "", "isn't what it should be", "some text");
      if (value) out.push_back(*value);
    }
    return out;
  }
  /// { "group.key" = number, text or true/false }
  std::vector<config::Override> overrides(const char* key) {
    std::vector<config::Override> out;
    const toml::node* node = find(key);
    if (node == nullptr) return out;
    const toml::table* table = node->as_table();
    if (table == nullptr) return add(key, "", "isn't a table", "{ \"group.key\" = value, … }"), out;
    for (const auto& [name, value] : *table) {
      const std::string text = value_text(value);
      if (text.empty())
        add(fmt::format("{}.\"{}\"", key, name.str()), "", "isn't a value",
            "a number, a text, true or false; keys with a point in quotes");
      out.push_back({std::string(name.str()), text});
    }
    return out;
  }
  void refuse_others() const {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) add(name, "", "unknown key", config::join(asked_));
    }
  }

 private:
  static std::string value_text(const toml::node& node) {
    if (const auto word = node.value_exact<std::string>()) return *word;
    if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
    if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
    const auto number = node.value_exact<double>();
    return number && std::isfinite(*number) ? config::number_text(*number) : "";
  }

  const toml::table& table_;
  std::string place_;
  Problems& problems_;
  std::vector<std::string> asked_;
};

toml::table parse(const fs::path& file) {
  const auto text = read_file(file);
  if (!text) throw InputError({file.string(), "", "", "can't be read", "a TOML file"});
  try {
    return toml::parse(*text, file.string());
  } catch (const toml::parse_error& e) {
    throw InputError({fmt::format("{}:{}", file.string(), e.source().begin.line), "", "", std::string(e.description()), "TOML"});
  }
}

/// What [compare] says that isn't settings: the recordings' files and how they are weighted.
struct Sources {
  std::vector<fs::path> files;
  bool by_scatter = true;
};

Sources read_settings(Section& section, Comparison& out) {
  Sources sources;
  out.title = section.find("title") != nullptr ? section.text("title", "some text") : "";
  for (const std::string& name : section.texts("recordings", "a list of CSV files")) {
    const fs::path file = out.file.parent_path() / name;
    const auto same = [&](const fs::path& other) { return other.filename() == file.filename(); };
    if (std::any_of(sources.files.begin(), sources.files.end(), same)) section.add("recordings", name, "is named twice", "once");
    sources.files.push_back(file);
  }
  out.fit.starts = static_cast<int>(section.number("starts", 1, 100, true).value_or(out.fit.starts));
  out.fit.seed = static_cast<unsigned>(section.number("seed", 0, 1e9, true).value_or(out.fit.seed));
  out.fit.iterations = static_cast<int>(section.number("iterations", 1, 1000, true).value_or(out.fit.iterations));
  out.jobs = static_cast<int>(section.number("jobs", 0, 1024, true).value_or(0));
  const std::string weights = section.find("weights") != nullptr ? section.text("weights", "scatter, equal") : "scatter";
  if (weights != "scatter" && weights != "equal") section.add("weights", weights, "isn't one of the words", "scatter, equal");
  sources.by_scatter = weights != "equal";
  section.refuse_others();
  return sources;
}

void read_bench(Section& section, SweepOptions& out) {
  out.period_s = section.number("period_s", 1, 3600, false).value_or(out.period_s);
  out.amplitude_rad = section.number("amplitude_rad", 0.01, 3, false);
  out.cycles = section.number("cycles", 1.5, 100, false).value_or(out.cycles);
  section.refuse_others();
}

bool is_name(const std::string& text) {
  return !text.empty() &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
}

/// The keys of "a.x=b.y".
std::vector<std::string> keys_in(const std::vector<std::string>& free) {
  std::vector<std::string> out;
  for (const std::string& text : free) {
    for (const std::string& key : config::split(text, '=')) out.emplace_back(config::trim(key));
  }
  return out;
}

void place_base(const std::string& base, const fs::path& beside, const config::PresetLibrary& library, experiment::Specimen& out) {
  const fs::path path(base);
  out.preset = base;
  out.library = library;
  if (path.extension() != ".toml") return;
  std::vector<fs::path> directories{(beside / path).parent_path()};
  directories.insert(directories.end(), library.directories().begin(), library.directories().end());
  out.preset = path.stem().string();
  out.library = config::PresetLibrary(std::move(directories));
}

/// Without its parameters where anything is wrong before them.
Hypothesis read_hypothesis(Section& section, const Comparison& comparison, const config::PresetLibrary& library) {
  Hypothesis out;
  out.name = section.text("name", "letters, digits, _ and -");
  if (!out.name.empty() && !is_name(out.name)) section.add("name", out.name, "isn't a name", "letters, digits, _ and -");
  out.title = section.find("title") != nullptr ? section.text("title", "some text") : out.name;
  const std::string base = section.text("base", "a preset's name, or a file NAME.toml");
  const std::vector<config::Override> set = section.overrides("set"), start = section.overrides("start");
  const std::vector<std::string> free = section.texts("free", "a list of keys, may be empty"), keys = keys_in(free);
  section.refuse_others();
  const auto is_free = [&](const std::string& key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
  for (const config::Override& o : set) {
    if (is_free(o.key)) section.add("set", o.key, "is both set and free", "one of the two; another start goes to start");
  }
  for (const config::Override& o : start) {
    if (!is_free(o.key)) section.add("start", o.key, "isn't free", keys.empty() ? "no key is" : config::join(keys));
  }
  if (base.empty()) return out;
  try {
    place_base(base, comparison.file.parent_path(), library, out.specimen);
    out.specimen.overrides = set;
    out.specimen.overrides.insert(out.specimen.overrides.end(), start.begin(), start.end());
    out.preset = out.specimen.library.load(out.specimen.preset, out.specimen.overrides);
  } catch (const InputError& error) {
    section.add_all(error, "base " + base);
    out.preset.file.clear();
    return out;
  }
  try {
    if (!free.empty()) out.free = parse_parameters(config::join(free, ","), out.preset);
  } catch (const InputError& error) {
    section.add_all(error, "free");
  }
  return out;
}

/// Each recording, as the first hypothesis reads it; that every other can take it is looked at, too.
void read_recordings(Comparison& out, const Sources& sources, Problems& problems) {
  for (const fs::path& file : sources.files) {
    try {
      out.recordings.push_back(read_observation(file, out.hypotheses.front().preset));
      if (sources.by_scatter) out.recordings.back().weight = scatter_weight(out.recordings.back().data);
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  for (const Hypothesis& h : out.hypotheses) {
    for (const Observation& o : out.recordings) {
      try {
        experiment::check_preset(h.specimen, o.preset);
      } catch (const InputError& error) {
        for (Problem p : error.problems()) {
          p.file = fmt::format("{}: hypothesis {}: {}", out.file.string(), h.name, o.name);
          problems.add(std::move(p));
        }
      }
    }
  }
}

/// The hypotheses of [[hypothesis]], each in a section of its own.
void read_hypotheses(const toml::array& array, Comparison& out, const config::PresetLibrary& library, Problems& problems) {
  for (const toml::node& node : array) {
    const toml::table& entry = *node.as_table();
    const std::string name = entry["name"].value_or(std::to_string(out.hypotheses.size() + 1));
    const std::string place = fmt::format("{}:{}: hypothesis {}", out.file.string(), entry.source().begin.line, name);
    Section section(entry, place, problems);
    Hypothesis h = read_hypothesis(section, out, library);
    const auto same = [&](const Hypothesis& other) { return other.name == h.name; };
    if (!h.name.empty() && std::any_of(out.hypotheses.begin(), out.hypotheses.end(), same))
      section.add("name", h.name, "is there twice", "a name of its own");
    out.hypotheses.push_back(std::move(h));
  }
}

/// Files that aren't there are told with whatever else is wrong.
void find_files(const Section& section, const Sources& sources) {
  if (sources.files.empty()) section.add("recordings", "", "there is none", "one CSV file or more");
  for (const fs::path& file : sources.files) {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
      section.add("recordings", file.string(), "no such file", "CSV files, relative to this one");
  }
}

}  // namespace

Comparison read_comparison(const fs::path& file, const config::PresetLibrary& library) {
  const toml::table root = parse(file), empty;
  Comparison out;
  out.file = file;
  Problems problems;
  Section top(root, file.string(), problems);
  const auto table = [&](const char* key, const char* needed) -> const toml::table& {
    const toml::node* node = top.find(key, needed);
    if (node != nullptr && !node->is_table()) top.add(key, "", "isn't a table", fmt::format("[{}]", key));
    return node != nullptr && node->is_table() ? *node->as_table() : empty;
  };
  const toml::table& compare = table("compare", "a table with the recordings");
  Section settings(compare, file.string() + ": compare", problems);
  Sources sources;
  if (&compare != &empty) {
    sources = read_settings(settings, out);
    find_files(settings, sources);
  }
  Section bench(table("bench", nullptr), file.string() + ": bench", problems);
  read_bench(bench, out.sweep);
  const toml::node* node = top.find("hypothesis");
  const toml::array* array = node != nullptr ? node->as_array() : nullptr;
  if (array != nullptr && !array->empty() && array->is_homogeneous<toml::table>()) {
    read_hypotheses(*array, out, library, problems);
  } else {
    top.add("hypothesis", "", "there is none", "one [[hypothesis]] or more");
  }
  top.refuse_others();
  if (problems.empty()) read_recordings(out, sources, problems);
  problems.throw_if_any();
  return out;
}

}  // namespace vsa::identify
