// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "study/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include "vsa/errors.hpp"
#include "vsa/files.hpp"

namespace vsa::study {
namespace {

namespace fs = std::filesystem;

/// The best first.
constexpr std::array<std::string_view, 3> kEndings{"_branches.csv", "_samples.csv", ".csv"};

struct Found {
  fs::path file, below;  ///< `below`: the directory that was searched
  std::size_t ending = 0;
};
/// By the path without its ending: one recording has up to three files.
using FoundFiles = std::map<std::string, Found>;

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

void consider(const fs::path& file, const fs::path& below, FoundFiles& found) {
  constexpr std::string_view kBegin = "stiffness_preset_";
  const std::string name = file.filename().string();
  if (name.rfind(kBegin, 0) != 0) return;
  for (std::size_t e = 0; e < kEndings.size(); ++e) {
    if (!ends_with(name, kEndings[e])) continue;
    const std::string stem = name.substr(0, name.size() - kEndings[e].size());
    // Other files of a run have more words behind the preset.
    if (stem.find('_', kBegin.size()) != std::string::npos) return;
    const auto [it, fresh] = found.try_emplace((fs::weakly_canonical(file.parent_path()) / stem).string(), Found{file, below, e});
    if (!fresh && e < it->second.ending) it->second = {file, below, e};
    return;
  }
}

void search(const fs::path& directory, const std::string& flag, FoundFiles& found) {
  std::error_code error;
  if (!fs::is_directory(directory, error)) {
    throw InputError({"", flag, directory.string(), "isn't a directory that can be read", "a directory with recordings"});
  }
  const std::size_t before = found.size();
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(directory, options, error), end; !error && it != end; it.increment(error)) {
    consider(it->path(), directory, found);
  }
  if (found.size() == before) {
    throw InputError(
        {"", flag, directory.string(), "holds no recording that isn't in data/", "stiffness_preset_0.6903rad_samples.csv"});
  }
}

/// The words of origin.txt as one line.
std::string origin_of(const fs::path& recording) {
  std::istringstream in(read_file(recording.parent_path() / "origin.txt").value_or(""));
  std::string out;
  for (std::string word; in >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

Recording read(const Found& f, const fs::path& data) {
  const bool shipped = f.below == data;
  Recording out;
  out.file = shipped ? fs::relative(f.file, data).generic_string() : f.file.generic_string();
  out.preset = experiment::preset_of_name(f.file).value;
  out.data = f.ending == 0 ? experiment::read_branches(f.file) : experiment::branches(experiment::read_load_recording(f.file));
  out.origin = origin_of(f.file);
  return out;
}

}  // namespace

std::vector<Recording> read_recordings(const fs::path& data, const std::vector<fs::path>& more,
                                       const config::ActuatorType& actuator) {
  FoundFiles found;
  search(data, "data", found);
  for (const fs::path& directory : more) search(directory, "--recordings", found);
  std::vector<Found> files;
  for (const auto& [key, f] : found) files.push_back(f);
  // Of two with one name the user's own is the one that is told.
  std::stable_partition(files.begin(), files.end(), [&](const Found& f) { return f.below == data; });
  const std::string unit(actuator.unit.actuator.transmission->preset_unit());
  Problems problems;
  std::map<std::string, std::string> named;
  std::vector<Recording> out;
  for (const Found& f : files) {
    const auto wrong = [&](const std::string& value, const std::string& what, const std::string& allowed) {
      problems.add({f.file.string(), "file name", value, what, allowed});
    };
    try {
      const experiment::NamedPreset preset = experiment::preset_of_name(f.file);
      if (preset.unit != unit) {
        wrong(preset.unit, "the preset isn't in the unit of " + actuator.name, unit.empty() ? "an actuator with a preset" : unit);
        continue;
      }
      out.push_back(read(f, data));
      const auto [it, fresh] = named.try_emplace(config::experiment_name("stiffness", preset.value), out.back().file);
      if (!fresh) {
        wrong(fmt::format("{:.4f}", preset.value), "another recording has this preset: " + it->second, "one recording a preset");
      }
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
  std::sort(out.begin(), out.end(), [](const Recording& a, const Recording& b) { return a.preset < b.preset; });
  return out;
}

}  // namespace vsa::study
