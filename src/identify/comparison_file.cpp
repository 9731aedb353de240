// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Reading a comparison: every problem of the file at once, each with file, hypothesis and key.
#include <fmt/format.h>

#include <algorithm>

#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/comparison.hpp"

namespace vsa::identify {
namespace {

namespace fs = std::filesystem;

using Section = config::TomlSection;

void add_all(const Section& section, const InputError& error, const std::string& key) {
  for (const Problem& p : error.problems()) section.add(p.key.empty() ? key : key + ": " + p.key, p.value, p.message, p.allowed);
}

/// What [compare] says that isn't settings: the recordings' files and how they are weighted.
struct Sources {
  std::vector<fs::path> files;
  bool by_scatter = true;
};

Sources read_settings(Section& section, Comparison& out) {
  Sources sources;
  out.title = section.text("title").value_or("");
  for (const std::string& name : section.need("recordings", "a list of CSV files").texts("recordings")) {
    const fs::path file = out.file.parent_path() / name;
    const auto same = [&](const fs::path& other) { return other.filename() == file.filename(); };
    if (std::any_of(sources.files.begin(), sources.files.end(), same)) section.add("recordings", name, "is named twice", "once");
    sources.files.push_back(file);
  }
  out.fit.starts = static_cast<int>(section.whole("starts", 1, 100).value_or(out.fit.starts));
  out.fit.seed = static_cast<unsigned>(section.whole("seed", 0, 1e9).value_or(out.fit.seed));
  out.fit.iterations = static_cast<int>(section.whole("iterations", 1, 1000).value_or(out.fit.iterations));
  out.jobs = static_cast<int>(section.whole("jobs", 0, 1024).value_or(0));
  sources.by_scatter = section.word("weights", {"scatter", "equal"}).value_or("scatter") != "equal";
  section.refuse_others();
  return sources;
}

void read_bench(Section& section, SweepOptions& out) {
  out.period_s = section.number("period_s", 1, 3600).value_or(out.period_s);
  out.amplitude_rad = section.number("amplitude_rad", 0.01, 3);
  out.cycles = section.number("cycles", 1.5, 100).value_or(out.cycles);
  out.load_share = section.number("load_kg", 1e-3, 1e3).value_or(1);  // of 1 kg
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

void place_base(const std::string& base, const fs::path& beside, const config::TypeLibrary& library, experiment::Specimen& out) {
  const fs::path path(base);
  out.type = base;
  out.library = library;
  if (path.extension() != ".toml") return;
  std::vector<fs::path> directories{(beside / path).parent_path()};
  directories.insert(directories.end(), library.directories().begin(), library.directories().end());
  out.type = path.stem().string();
  out.library = config::TypeLibrary(std::move(directories));
}

/// Without its parameters where anything is wrong before them.
Hypothesis read_hypothesis(Section& section, const Comparison& comparison, const config::TypeLibrary& library) {
  Hypothesis out;
  out.name = section.need("name", "letters, digits, _ and -").text("name").value_or("");
  if (!out.name.empty() && !is_name(out.name)) section.add("name", out.name, "isn't a name", "letters, digits, _ and -");
  out.title = section.text("title").value_or(out.name);
  const std::string base = section.need("base", "a type's name, or a file NAME.toml").text("base").value_or("");
  const std::vector<config::Override> set = section.overrides("set"), start = section.overrides("start");
  const std::vector<std::string> free = section.need("free", "a list of keys, may be empty").texts("free"), keys = keys_in(free);
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
    out.type = out.specimen.library.load(out.specimen.type, out.specimen.overrides);
  } catch (const InputError& error) {
    add_all(section, error, "base " + base);
    out.type.file.clear();
    return out;
  }
  try {
    if (!free.empty()) out.free = parse_parameters(config::join(free, ","), out.type);
  } catch (const InputError& error) {
    add_all(section, error, "free");
  }
  return out;
}

/// Each recording, as the first hypothesis reads it; that every other can take it is looked at, too.
void read_recordings(Comparison& out, const Sources& sources, Problems& problems) {
  for (const fs::path& file : sources.files) {
    try {
      out.recordings.push_back(read_observation(file, out.hypotheses.front().type, out.sweep.load_share));
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  check_each_once(out.recordings, problems);
  if (sources.by_scatter) weigh_by_scatter(out.recordings);
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
void read_hypotheses(const std::vector<const toml::table*>& tables, Comparison& out, const config::TypeLibrary& library,
                     Problems& problems) {
  for (const toml::table* entry : tables) {
    const std::string name = (*entry)["name"].value_or(std::to_string(out.hypotheses.size() + 1));
    const std::string place = fmt::format("{}: hypothesis {}", config::place_of(out.file, *entry), name);
    Section section(entry, place, "", problems);
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

Comparison read_comparison(const fs::path& file, const config::TypeLibrary& library) {
  const toml::table root = config::parse_toml(file);
  Comparison out;
  out.file = file;
  Problems problems;
  Section top(&root, file.string(), "", problems);
  Sources sources;
  if (const toml::table* compare = top.need("compare", "a table with the recordings").table("compare")) {
    Section settings(compare, file.string() + ": compare", "", problems);
    sources = read_settings(settings, out);
    find_files(settings, sources);
  }
  Section bench(top.table("bench"), file.string() + ": bench", "", problems);
  read_bench(bench, out.sweep);
  const auto hypotheses = top.tables("hypothesis");
  if (hypotheses.empty()) top.add("hypothesis", "", "there is none", "one [[hypothesis]] or more");
  read_hypotheses(hypotheses, out, library, problems);
  top.refuse_others();
  if (problems.empty()) read_recordings(out, sources, problems);
  problems.throw_if_any();
  return out;
}

}  // namespace vsa::identify
