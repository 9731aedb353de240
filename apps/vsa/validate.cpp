// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "validate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "exit_codes.hpp"
#include "interrupt.hpp"
#include "output_files.hpp"
#include "settings.hpp"
#include "validate_output.hpp"
#include "vsa/config/preset.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

constexpr const char* kNotes =
    R"(Runs the load test of every recording in data/, the speed and preset-step experiments, and compares. Bounds stand in
data/bounds.toml, each with its reason. Writes report.html and results.json. Exit code 1 where a bound is broken.

Examples:
  vsa validate
  vsa validate --preset identified --out identified
  vsa validate --markdown docs/validation.md)";

std::filesystem::path bounds_file(const ValidateOptions& o) {
  if (!o.bounds.empty()) return o.bounds;
  const auto found = config::find_data("data/bounds.toml");
  if (!found) throw InputError({"", "data/bounds.toml", "", "is in no data directory", "set VSA_DATA_DIR, or --bounds"});
  return *found;
}

std::string command_of(const ValidateOptions& o) {
  std::string out = "vsa validate";
  if (o.preset != ValidateOptions{}.preset) out += " --preset " + o.preset;
  for (const auto& s : o.set) out += " --set " + s;
  if (!o.bounds.empty()) out += " --bounds " + o.bounds;
  return out;
}

}  // namespace

int run_validate(const ValidateOptions& o) {
  const experiment::BoundsFile bounds = experiment::read_bounds(bounds_file(o));
  experiment::Specimen specimen;
  specimen.preset = o.preset;
  specimen.overrides = parse_settings(o.set, "--set");
  if (!o.markdown.empty()) (void)with_tables(o.markdown, "");  // told before the work, not after it
  const std::filesystem::path out = o.out.empty() ? "validate_" + o.preset : o.out;
  catch_interrupts();
  Console console;
  auto found = validate(specimen, bounds.published, console);
  if (!found) {
    console.line("stopped: nothing was written");
    return kSignalled + interrupted();
  }
  Validation& v = *found;
  v.command = command_of(o);
  v.verdicts = experiment::judge(bounds.bounds, quantities(v));
  make_directory(out, "--out");
  write_whole(out / "results.json", results_json(v));
  report::write_report(validation_report(v), out / "report.html");
  if (!o.markdown.empty()) write_whole(o.markdown, with_tables(o.markdown, markdown_tables(v)));
  std::cout << validation_text(v)
            << fmt::format("written: {} and results.json, {:.0f} s\n", (out / "report.html").string(), v.wall_s);
  const bool held = experiment::all_held(v.verdicts);
  if (!held) console.line("a stated bound is broken");
  return std::cout.flush() && held ? kDone : kFailed;
}

void setup_validate(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<ValidateOptions>();
  CLI::App* sub = app.add_subcommand("validate", "Compare the simulator with every recording in data/");
  sub->add_option("--preset", o->preset, "Actuator preset")->capture_default_str();
  sub->add_option("--set", o->set, "Override a parameter: key=value");
  sub->add_option("--out", o->out, "Directory for the files; default: validate_PRESET");
  sub->add_option("--bounds", o->bounds, "Bounds to hold; default: data/bounds.toml");
  sub->add_option("--markdown", o->markdown, "Replace the tables in this file, or write it");
  sub->footer(kNotes);
  sub->callback([o, &exit_code] { exit_code = run_validate(*o); });
}

}  // namespace vsa::app
