// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "validate/validate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/follow.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/output_files.hpp"
#include "validate/output.hpp"
#include "vsa/output_file.hpp"

namespace vsa::app {
namespace {

constexpr const char* kValidateNotes =
    R"(Runs the load test of every recording in data/, the speed and preset-step experiments, and compares. What the type's
[evidence] names was calibrated, all else is predicted; the two are told and counted apart. Bounds stand in data/bounds.toml,
each with its reason. Writes report.html and results.json. Exit code 1 where a bound is broken, of either kind.

Examples:
  vsa validate
  vsa validate --type identified --out identified
  vsa validate --recordings my_recordings        # stiffness_preset_0.4602rad_samples.csv in it is predicted
  vsa validate --markdown docs/validation.md)";

std::string command_of(const ValidateOptions& o) {
  std::string out = "vsa validate";
  if (o.type != ValidateOptions{}.type) out += " --type " + o.type;
  for (const auto& s : o.set) out += " --set " + s;
  for (const auto& r : o.recordings) out += " --recordings " + r;
  if (!o.leave_one_out.empty()) out += " --leave-one-out " + o.leave_one_out;
  if (!o.bounds.empty()) out += " --bounds " + o.bounds;
  return out;
}

study::ValidationOptions study_of(const ValidateOptions& o) {
  study::ValidationOptions out;
  out.specimen.type = o.type;
  out.specimen.overrides = config::parse_overrides(o.set, "--set");
  out.recordings.assign(o.recordings.begin(), o.recordings.end());
  out.leave_one_out = o.leave_one_out;
  out.bounds = o.bounds;
  return out;
}

void write_markdown(const study::Validation& v, const std::filesystem::path& file, const std::string& command) {
  const std::vector<Picture> all = pictures(v, file);
  for (const Picture& p : all) {
    const std::filesystem::path to = file.parent_path() / p.file;
    make_directory(to.parent_path(), "--markdown");
    write_whole(to, p.svg);
  }
  write_whole(file, with_history(v, VSA_VERSION, with_tables(file, kMarkers, markdown_tables(v, all, command))));
}

/// "speed.0.7500.mean_pulley_rad_per_s = 4.9 (3.375 … 4.125), …".
std::string broken_text(const study::Validation& v) {
  std::string out;
  for (const experiment::Verdict& d : v.verdicts) {
    if (d.held) continue;
    out += (out.empty() ? "" : ", ") + fmt::format("{} = {:.4g} ({})", d.bound.quantity, d.value, experiment::bound_text(d.bound));
  }
  return out;
}

}  // namespace

int run_validate(const ValidateOptions& o) {
  study::ValidationPlan plan = study::plan_validation(study_of(o));
  if (!o.markdown.empty()) (void)with_tables(o.markdown, kMarkers, "");  // told before the work, not after it
  (void)report::page_template();
  const std::filesystem::path out = o.out.empty() ? "validate_" + o.type : o.out;
  catch_interrupts();
  Console console;
  const auto found = study::run(std::move(plan), follow(console));
  console.wipe();
  if (!found) {
    console.line("stopped: nothing was written");
    return kSignalled + interrupted();
  }
  const study::Validation& v = *found;
  const std::string command = command_of(o);
  make_directory(out, "--out");
  write_whole(out / "results.json", study::to_json(v, command));
  report::write_report(validation_report(v, command), out / "report.html");
  if (!o.markdown.empty()) write_markdown(v, o.markdown, command);
  std::cout << validation_text(v)
            << fmt::format("written: {} and results.json, {:.0f} s\n", (out / "report.html").string(), v.wall_s);
  const bool held = experiment::all_held(v.verdicts);
  if (!held) console.line("bounds broken: " + broken_text(v));
  return held ? kDone : kFailed;
}

void setup_validate(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<ValidateOptions>();
  CLI::App* sub = app.add_subcommand("validate", "Compare the simulator with every recording in data/");
  sub->add_option("--type", o->type, "Actuator type")->capture_default_str();
  sub->add_option("--set", o->set, "Override a parameter: key=value")->allow_extra_args(false);
  sub->add_option("--out", o->out, "Directory for the files; default: validate_TYPE");
  sub->add_option("--recordings", o->recordings, "Directory with more recordings than data/ has");
  sub->add_option("--leave-one-out", o->leave_one_out,
                  "results.json of vsa identify with its cross-validation; default: data/TYPE/leave_one_out.json, if it is there");
  sub->add_option("--bounds", o->bounds, "Bounds to hold; default: data/bounds.toml");
  sub->add_option("--markdown", o->markdown, "Replace the tables in this file, or write it; pictures go to figures/ beside it");
  sub->footer(kValidateNotes);
  sub->callback([o, &exit_code] { exit_code = run_validate(*o); });
}

}  // namespace vsa::app
