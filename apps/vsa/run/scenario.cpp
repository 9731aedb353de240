// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/scenario.hpp"

#include <sstream>

#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/scenario/toml.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;
using config::TomlSection;

/// A directory or file that needn't be there yet.
std::string path_at(TomlSection& section, const char* key, const fs::path& scenario, const std::string& otherwise) {
  const auto given = section.text(key);
  return given ? (scenario.parent_path() / *given).string() : otherwise;
}

std::string speed_at(TomlSection& section) {
  const toml::node* node = section.find("speed");
  if (node == nullptr) return "";
  if (node->is_string() && node->value<std::string>() != "max")
    section.add("speed", '"' + node->value_or(std::string()) + '"', "is no speed",
                config::range_text(kSlowest, kFastest) + ", or \"max\"");
  if (node->is_string()) return "max";
  const auto factor = section.number("speed", kSlowest, kFastest);
  return factor ? config::number_text(*factor) : "";
}

void read_run(TomlSection& s, const fs::path& file, RunOptions& out) {
  out.speed = speed_at(s);
  out.low_latency = s.flag("low_latency").value_or(false);
  out.view = s.flag("view").value_or(false);
  if (const auto port = s.whole("view_port", 0, 65535)) out.view_port = static_cast<int>(*port);
  out.view_records = path_at(s, "view_records", file, out.view_records);
  out.paused = s.flag("paused").value_or(false);
  out.no_topics = !s.flag("topics").value_or(true);
}

void read_record(TomlSection s, const fs::path& file, RunOptions& out) {
  out.record = path_at(s, "directory", file, "");
  out.record_rate_Hz = s.number("rate_Hz", kSlowestRecord_Hz, kFastestRecord_Hz).value_or(out.record_rate_Hz);
  out.page_rate_Hz = s.number("page_rate_Hz", kSlowestRecord_Hz, kFastestRecord_Hz).value_or(out.page_rate_Hz);
  s.refuse_others();
}

}  // namespace

bool is_scenario(const std::string& world) { return fs::path(world).extension() == ".toml"; }

RunOptions read_scenario(const fs::path& file) {
  const toml::table root = config::parse_toml(file);
  Problems problems;
  TomlSection top(&root, file.string(), "", problems);
  RunOptions out;
  if (const toml::table* table = top.need("scenario", "a table with the world").table("scenario")) {
    TomlSection run(table, file.string(), "scenario.", problems);
    static_cast<scenario::Scenario&>(out) = scenario::read(top, run, file, problems);
    read_run(run, file, out);
    run.refuse_others();
    read_record({top.table("record"), file.string(), "record.", problems}, file, out);
    top.refuse_others();
  }
  problems.throw_if_any();
  return out;
}

std::string scenario_text(const RunOptions& options, double duration_s, const std::vector<std::string>& remarks) {
  std::ostringstream out;
  out << "# Written by vsa run; `vsa run` with this file repeats the run.\n";
  for (const std::string& remark : remarks) out << "# " << remark << '\n';
  // Nobody's commands reach the repetition of a run that none could reach.
  out << '\n' << scenario::text(options, duration_s, options.no_topics ? toml::table{{"topics", false}} : toml::table{});
  const auto number = [](double value) {
    const std::string text = config::number_text(value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  };
  out << "\n[record]\nrate_Hz = " << number(options.record_rate_Hz) << "\npage_rate_Hz = " << number(options.page_rate_Hz) << "\n";
  return out.str();
}

}  // namespace vsa::app
