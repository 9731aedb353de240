// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "doctor/doctor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "doctor/checks.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/table.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

using Level = Finding::Level;

const char* word(Level level) { return level == Level::ok ? "ok" : level == Level::note ? "note" : "problem"; }

std::string plain(const Finding& f) {
  return fmt::format("{}: {}: {}{}\n", word(f.level), f.what, f.text, f.todo.empty() ? "" : ": " + f.todo);
}

/// Colours and room, for people.
std::string pretty(const Finding& f, std::size_t width, bool colour) {
  const char* code = f.level == Level::ok ? "\033[32m" : f.level == Level::note ? "\033[33m" : "\033[31m";
  std::string out = fmt::format("{}{:8}{}", colour ? code : "", word(f.level), colour ? "\033[0m" : "");
  bool first = true;
  for (const std::string& line : wrap(f.what + ": " + f.text, width > 20 ? width - 8 : width)) {
    out += (first ? "" : "        ") + line + '\n';
    first = false;
  }
  if (f.todo.empty()) return out;
  for (const std::string& line : wrap("→ " + f.todo, width > 24 ? width - 10 : width)) out += "          " + line + '\n';
  return out;
}

std::string count(std::size_t n, const char* of) { return fmt::format("{} {}{}", n, of, n == 1 ? "" : "s"); }

/// The world's own first: whoever asks about one wants to know that.
int report(const Findings& of_world, const Findings& of_machine) {
  std::vector<Finding> findings = of_world.list();
  findings.insert(findings.end(), of_machine.list().begin(), of_machine.list().end());
  const std::size_t width = terminal_width();
  const bool colour = width != 0 && std::getenv("NO_COLOR") == nullptr;
  std::size_t notes = 0, problems = 0;
  for (const Finding& f : findings) {
    notes += f.level == Level::note ? 1 : 0;
    problems += f.level == Level::problem ? 1 : 0;
    std::cout << (width == 0 ? plain(f) : pretty(f, width, colour));
  }
  std::cout << fmt::format("{}, {}\n", count(problems, "problem"), count(notes, "note"));
  return problems == 0 ? kDone : kFailed;
}

/// Every actuator type as `vsa actuators` would read it.
void check_presets(Findings& findings) {
  const config::TypeLibrary library;
  std::size_t good = 0;
  for (const std::string& name : library.names()) {
    try {
      (void)library.load(name);
      ++good;
    } catch (const InputError& error) {
      for (const Problem& p : error.problems()) findings.problem("actuator type " + name, p.text(), "mend or remove the file");
    }
  }
  if (good > 0) findings.ok("actuator types", fmt::format("{} found", good));
  constexpr const char* kPath = "VSA_ACTUATOR_PATH";
  for (const std::filesystem::path& directory : directories_of(kPath)) {
    std::error_code none;
    if (!std::filesystem::is_directory(directory, none))
      findings.note(kPath, directory.string() + " is no directory", "take it out of the list");
  }
  if (library.names().empty()) findings.problem("actuator types", "none found", "set VSA_DATA_DIR or VSA_ACTUATOR_PATH");
}

}  // namespace

std::string value_of(const char* variable) {
  const char* text = std::getenv(variable);
  return text == nullptr ? "" : text;
}

std::vector<std::filesystem::path> directories_of(const char* variable) {
  std::vector<std::filesystem::path> out;
  for (const std::string& one : config::split(value_of(variable), ':')) {
    if (!one.empty()) out.emplace_back(one);
  }
  return out;
}

void check_data(Findings& findings, bool pages) {
  try {
    findings.ok("data directory", config::data_directory().string());
    check_presets(findings);
  } catch (const InputError& error) {
    findings.problem("data directory", error.problems().front().text(), "set VSA_DATA_DIR to PREFIX/share/vsa, or unset it");
    return;
  }
  const auto worlds = config::find_data("models/worlds");
  std::error_code none;
  std::size_t files = 0;
  for (std::filesystem::directory_iterator at(worlds.value_or(""), none), end; !none && at != end; at.increment(none))
    files += at->path().extension() == ".sdf" ? 1 : 0;
  if (files > 0) {
    findings.ok("built-in worlds", fmt::format("{} in {}", files, worlds->string()));
  } else {
    findings.problem("built-in worlds", "none found", "install again: models/worlds belongs into the data directory");
  }
  if (!pages) return;
  std::vector<std::string> missing;
  for (const char* page : {"web/replay.html", "web/live.html", "web/report.html"}) {
    if (!config::find_data(page)) missing.emplace_back(page);
  }
  if (missing.empty()) {
    findings.ok("pages", "replay, live view and report");
  } else {
    findings.problem("pages", fmt::format("no {} in the data directory", fmt::join(missing, ", ")),
                     "install again, or build the target vsa_web; records and reports have no page until then");
  }
}

int run_doctor(const DoctorOptions& options, LoadingCheck check_loading, const std::vector<Feature>& features) {
  Findings findings, of_world;
  for (const Feature& feature : features) {
    const std::string name(feature.name);
    if (feature.is_in()) {
      findings.ok(name, "by " + std::string(feature.found_as));
    } else {
      findings.note(name, "left out of this build", std::string(feature.remedy));
    }
  }
  check_data(findings, !features.empty());
  const std::vector<Host> hosts = check_hosts(findings);
  check_plugins(findings, hosts);
  check_model_paths(findings, hosts);
  check_network(findings);
  check_ports(findings, options.devices);
  if (!options.world.empty()) check_world(of_world, hosts, options.world, check_loading);
  return report(of_world, findings);
}

}  // namespace vsa::app
