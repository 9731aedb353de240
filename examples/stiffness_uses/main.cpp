// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-stiffness-uses impact|gripper|throw|terrain [--out DIR]: what variable stiffness is good for, measured
// (docs/explanation/what-stiffness-is-good-for.md). Each writes a page and prints its table. Exit codes: 0 done, 1 failed, 2 bad
// usage or input.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "pages.hpp"
#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace {

using namespace vsa::stiffness_uses;

constexpr double kDegree = vsa::kPi / 180;

struct Options {
  std::string out = "out/stiffness_uses";
  std::vector<double> presets_deg{5, 15, 25, 35, 44.9};
  std::vector<std::string> grounds{"flat", "rubble", "hills"};
  std::vector<std::string> gaits{"steered_soft", "steered", "steered_stiff"};
  int starts = 3, jobs = 1;
  double duration_s = 30;
};

void publish(const Options& o, const std::string& name, Page page) {
  std::filesystem::create_directories(o.out);
  page.report.footer = "vsa-stiffness-uses " + name;
  const auto file = std::filesystem::path(o.out) / (name + ".html");
  vsa::report::write_report(page.report, file);
  fmt::print("{}\n{}\n", page.markdown, file.string());
}

void impact(const Options& o) {
  std::vector<ImpactRun> runs;
  for (const double preset : o.presets_deg) runs.push_back(run_impact(preset * kDegree));
  publish(o, "impact", impact_page(runs));
}

void gripper(const Options& o) {
  std::vector<GripRun> runs;
  for (const char* object : {"hard", "soft"}) {
    for (const double preset : o.presets_deg) runs.push_back(run_gripper(object, preset * kDegree, {-5, 0, 5, 10, 15, 20, 25, 30}));
  }
  publish(o, "gripper", gripper_page(runs));
}

void throwing(const Options& o) {
  std::vector<double> times;
  for (int i = 0; i <= 24; ++i) times.push_back(0.05 * i);
  std::vector<std::vector<ThrowRun>> sweeps;
  std::vector<ThrowRun> traces;
  for (const double preset : o.presets_deg) {
    ThrowPlan plan;
    plan.preset_rad = preset * kDegree;
    sweeps.push_back(sweep_throw(plan, times));
    plan.swing_back_s = best_of(sweeps.back()).swing_back_s;
    plan.trace = true;
    if (preset == o.presets_deg.front() || preset == o.presets_deg.back()) traces.push_back(run_throw(plan));
  }
  publish(o, "throw", throw_page(sweeps, traces));
}

void terrain(const Options& o) {
  std::vector<TerrainPlan> plans;
  for (const auto& ground : o.grounds) {
    for (const auto& gait : o.gaits) {
      for (int start = 0; start < o.starts; ++start) plans.push_back({ground, gait, start, o.starts, o.duration_s});
    }
  }
  publish(o, "terrain", terrain_page(run_terrains(plans, o.jobs), o.duration_s));
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("What variable stiffness is good for: four experiments, each a page and a table");
  app.require_subcommand(1);
  const auto add = [&](const char* name, const char* what, void (*run)(const Options&)) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->add_option("--out", o.out, "Directory for the page")->capture_default_str();
    sub->callback([&o, run] { run(o); });
    return sub;
  };
  const auto presets = [&](CLI::App* sub) {
    sub->add_option("--presets-deg", o.presets_deg, "Stiffness presets")->check(CLI::Range(0.0, 44.97))->capture_default_str();
  };
  presets(add("impact", "A ball hits Frank's hand", impact));
  presets(add("gripper", "A gripper closes on a hard and a soft object", gripper));
  presets(add("throw", "A spring makes a link faster than its motors", throwing));
  CLI::App* snake = add("terrain", "The snake over three grounds; minutes", terrain);
  snake->add_option("--grounds", o.grounds, "flat, rubble, hills")->delimiter(',')->capture_default_str();
  snake->add_option("--gaits", o.gaits, "Built-in gaits or files")->delimiter(',')->capture_default_str();
  snake->add_option("--starts", o.starts, "Runs of each, a little turned")->check(CLI::Range(1, 100))->capture_default_str();
  snake->add_option("--duration-s", o.duration_s, "Simulated seconds a run")->check(CLI::Range(5.0, 1e4))->capture_default_str();
  snake->add_option("--jobs", o.jobs, "Runs at a time")->check(CLI::Range(1, 64))->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const vsa::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vsa-stiffness-uses: {}\n", error.what());
    return 1;
  }
  return 0;
}
