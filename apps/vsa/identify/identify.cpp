// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/identify.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "identify/asked.hpp"
#include "identify/compare.hpp"
#include "terminal/console.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

constexpr const char* kIdentifyNotes =
    R"(Fits the simulated load test (world bench_load, full dynamics, read by the unit's encoders) to recordings by least
squares over both branches. A parameter is a key of the actuator type, see vsa actuators NAME; tied keys get one value.
Recordings: load_torque_Nm,deflection_rad[,time_s|sample], the commanded preset in the name (…_preset_0.6903rad….csv);
or branch means (…_branches.csv). Period and amplitude of the sweep are common to all.

Writes report.html, results.json and identified.toml, an actuator type for vsa. Where the data don't determine a parameter it
says which, writes no type and ends with 1.

--compare FILE fits each hypothesis of a TOML file to the recordings that it names, and with each of them left out, and
writes comparison.md, comparison.json and every fit into --out; begun again it goes on. docs/howto/identify.md tells the
file's keys.

Examples:
  vsa identify data/qbmove_maker_pro/*_samples.csv --type qbmove_maker_pro \
    --parameters elastic.k1_Nm=elastic.k2_Nm,drive.dead_band,shaft.friction_Nm,sensor.encoder_zero_rad
  vsa identify --compare data/qbmove_maker_pro/hypotheses.toml)";

/// A file of hypotheses says all but where to write and how many fits at once.
void refuse_mixed(const CLI::App& sub) {
  Problems problems;
  for (const CLI::Option* option : sub.get_options()) {
    const std::string name = option->get_name();
    const bool either =
        name == "--help" || name == "--out" || name == "--compare" || name == "--threads" || name == "--part" || name == "--wait-s";
    if (option->count() == 0 || either) continue;
    problems.add(
        {"", name, "", "isn't for --compare: its file says it, and it goes on by itself", "--out, --threads, --part, --wait-s"});
  }
  problems.throw_if_any();
}

}  // namespace

int run_identify(const IdentifyOptions& o) {
  const Asked asked(o);
  catch_interrupts();
  Console console;
  Generations generations = generations_of(asked, console);
  sweep::Log log(asked.folder(), asked.series({}));
  return identify_with(asked, generations, console, [&](const std::vector<identify::Job>& jobs, const Todo& runs) {
    static_cast<void>(make_here(asked.series(jobs), runs, static_cast<unsigned>(o.threads.value_or(0)), log, console));
    return interrupted() == 0;
  });
}

std::function<void()> add_identify_options(CLI::App& to, const std::shared_ptr<IdentifyOptions>& o) {
  CLI::App* sub = &to;
  sub->add_option("RECORDING", o->recordings, "CSV files");
  sub->add_option("--type", o->type, "Actuator type: start values, bounds and all that isn't identified");
  sub->add_option("--parameters", o->parameters, "Keys to identify, comma-separated; key=key gives both one value");
  sub->add_option("--set", o->set, "Hold a parameter at another value, or start there if it is identified: key=value")
      ->allow_extra_args(false);
  sub->add_option("--out", o->out, "Directory for the files; default: identify_TYPE, compare_FILE");
  sub->add_option("--name", o->name, "Name of the type that is written")->capture_default_str();
  sub->add_option("--period-s", o->period_s, "Period of the sweep")->check(number_given())->capture_default_str();
  sub->add_option("--amplitude-rad", o->amplitude_rad,
                  "Amplitude of the sweep; default: the shaft reaches 94° at preset 0, 81° at 0.6903 rad")
      ->check(number_given());
  sub->add_option("--load-kg", o->load_kg, "Mass on the bench's lever")->check(number_given())->capture_default_str();
  sub->add_option("--cycles", o->cycles, "Cycles to simulate; the first half is left out")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--starts", o->starts, "Local solutions: from the type's values, and from the places that a global search finds")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--seed", o->seed, "Of the global search")->check(number_given())->capture_default_str();
  sub->add_flag("--no-global", o->no_global, "Take the other starts about the type's values instead");
  sub->add_option("--iterations", o->iterations, "Most iterations of each")->check(number_given())->capture_default_str();
  sub->add_option("--profile", o->profile, "Points of each parameter's profile; 0: none")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--weights", o->weights, "scatter: a recording counts by its own repeatability; equal: each radian alike")
      ->check(CLI::IsMember({"scatter", "equal"}))
      ->capture_default_str();
  sub->add_flag("--no-cross-validation", o->no_cross_validation, "Don't fit again without each preset in turn");
  sub->add_option("--bootstrap", o->bootstrap, "Fits to recordings with errors drawn anew, for intervals by their scatter; 0: none")
      ->check(number_given())
      ->capture_default_str();
  sub->add_option("--compare", o->compare.file, "Compare the hypotheses of this TOML file instead");
  sub->add_option("--threads", o->threads,
                  "Fits at once in each process, 0 as many as the machine runs; default: that, or as the file of --compare says")
      ->check(between(0, 1024));
  sub->add_flag("--resume", o->resume, "Go on where fits of the same command ended");
  sub->add_flag("--retry-failed", o->retry_failed, "And make again what failed")->needs("--resume");
  sub->footer(kIdentifyNotes);
  return [o, sub] {
    if (!o->compare.file.empty()) refuse_mixed(*sub);
    o->compare.out = o->out;
    o->compare.threads = o->threads;
    o->compare.part = o->part;
    o->compare.wait_s = o->wait_s;
  };
}

void setup_identify(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<IdentifyOptions>();
  CLI::App* sub = app.add_subcommand("identify", "Find parameters of an actuator type from load-test recordings");
  const auto check = add_identify_options(*sub, o);
  sub->add_option("--part", o->part, "Make every Nth fit, from the Ith on, beside the other parts: I/N");
  sub->add_option("--wait-s", o->wait_s, "How long a part waits without news of the others, s")
      ->check(number_given())
      ->capture_default_str()
      ->needs("--part");
  sub->callback([o, check, &exit_code] {
    check();
    exit_code = o->compare.file.empty() ? run_identify(*o) : run_compare(o->compare);
  });
}

}  // namespace vsa::app
