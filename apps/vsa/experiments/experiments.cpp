// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "experiments/experiments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "experiments/page.hpp"
#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/follow.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "terminal/table.hpp"
#include "vsa/output_file.hpp"

namespace vsa::app {
namespace {

constexpr const char* kExperimentsNotes =
    R"(Each type has a rigid link on its shaft, axis upright, and does three things at presets from 0 to 90 % of what its
motors wind to; its best counts:
  throw    swings back and forward by 1 rad; a ball 0.5 m from the axis flies off where it is fastest
  settle   a blow gives the link 2 rad/s; until it stays within 5 % of its largest way
  hold     a load for 10 s; energy from the supply
Without --inertia-kgm2 and --load-Nm link and load are in proportion to the type's largest torque: J = torque/(200 rad/s²), half
the torque to hold. Writes report.html and results.json.

Examples:
  vsa experiments
  vsa experiments --types qbmove_maker_pro_6_1 awas_example sea_example --inertia-kgm2 0.01 --load-Nm 1)";

study::TaskOptions tasks_of(const ExperimentsOptions& o) {
  study::TaskOptions out;
  out.types = o.types;
  out.overrides = config::parse_overrides(o.set, "--set");
  out.inertia_kgm2 = o.inertia_kgm2;
  out.load_Nm = o.load_Nm;
  out.step_s = o.step_s.value_or(out.step_s);
  return out;
}

std::string command_of(const ExperimentsOptions& o) {
  std::string out = "vsa experiments";
  if (!o.types.empty()) out += fmt::format(" --types {}", fmt::join(o.types, " "));
  if (o.inertia_kgm2) out += fmt::format(" --inertia-kgm2 {}", *o.inertia_kgm2);
  if (o.load_Nm) out += fmt::format(" --load-Nm {}", *o.load_Nm);
  if (o.step_s) out += fmt::format(" --step-s {}", *o.step_s);
  for (const auto& s : o.set) out += " --set " + s;
  return out;
}

}  // namespace

int run_experiments(const ExperimentsOptions& options) {
  Console console;
  study::Tasks plan = study::plan_tasks(tasks_of(options));
  (void)report::page_template();
  const std::filesystem::path folder = options.out.empty() ? "experiments" : options.out;
  catch_interrupts();
  const auto done = study::run(std::move(plan), follow(console));
  console.wipe();
  if (!done) {
    console.line("stopped: nothing was written");
    return kSignalled + interrupted();
  }
  for (const study::TaskResults& r : done->each) {
    if (!std::isfinite(r.inertia_kgm2)) {
      console.line("warning: " + r.actuator.name + ": its motors move no load at any preset, so nothing was measured");
    } else if (!r.cheapest()) {
      console.line(fmt::format("warning: {}: holds {:.4g} N·m at no preset", r.actuator.name, r.load_Nm));
    }
  }
  const std::string command = command_of(options);
  make_directory(folder, "--out");
  report::write_report(tasks_page(*done, command), folder / "report.html");
  write_whole(folder / "results.json", study::to_json(*done, command));
  const report::Table table = tasks_table(*done);
  std::vector<std::vector<std::string>> rows{table.head};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  std::cout << table_text(rows, 0) << "written: " << (folder / "report.html").string() << " and results.json\n";
  return kDone;
}

void setup_experiments(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExperimentsOptions>();
  CLI::App* sub = app.add_subcommand("experiments", "Which actuator type throws farthest, settles soonest, holds cheapest");
  sub->add_option("--types", options->types, "Actuator types, see vsa actuators; default: all");
  sub->add_option("--inertia-kgm2", options->inertia_kgm2, "Inertia of every link; default: by each type's torque")
      ->check(number_given());
  sub->add_option("--load-Nm", options->load_Nm, "Torque to hold; default: half of each type's largest")->check(number_given());
  sub->add_option("--step-s", options->step_s, "Simulated seconds per step; default 0.00025")->check(number_given());
  sub->add_option("--set", options->set, "Override a parameter of every type: key=value")->allow_extra_args(false);
  sub->add_option("--out", options->out, "Directory for the files; default: experiments");
  sub->footer(kExperimentsNotes);
  sub->callback([options, &exit_code] { exit_code = run_experiments(*options); });
}

}  // namespace vsa::app
