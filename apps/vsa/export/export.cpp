// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "export/export.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "export/fmu.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/numbers.hpp"
#include "terminal/output_files.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"

namespace vsa::app {
namespace {

constexpr const char* kExportNotes =
    R"(--fmu: A functional mock-up unit for co-simulation: an actuator type between its importer's shaft and commands (angle and speed in,
torque out), or a whole world with the embedded engine (commands in, joints and torques out). One file that needs no vsasim where it
is imported; an actuator's needs the C library only. docs/howto/fmu.md tells how to step it.
  --coupling            prescribed: the importer moves the shaft as it likes; implicit: it steps the unit first and applies mean_torque
                        over the same step, with v' = v + h a, q' = q + h v'
  --load-inertia-kgm2   behind the shaft: implicit coupling needs it, with the other the unit warns of steps that are too long

--mjcf: A world as MuJoCo's own format, for machines without SDF: NAME.xml is what moves, which MuJoCo's own programs open, too;
NAME.vsa.xml has the actuators, the bodies' looks and the joints' ends. `vsa run NAME.xml` moves bit for bit as the world that it
was made of. Where no SDF can be read, NAME.xml beside NAME.sdf stands for it.
  --plugin              writes NAME_plugin.xml, too: the same for a MuJoCo from 3.2 on with vsasim's plug-in, an instance of
                        vsasim.unit, its actuators and a sensor for each actuator. docs/howto/mujoco.md

Examples:
  vsa export --fmu qbmove_maker_pro_6_1
  vsa export --fmu sea_example --fmi 3 --out sea.fmu --set drive.supply_V=24
  vsa export --fmu qbmove_maker_pro --names gazebo_fmi --coupling implicit --load-inertia-kgm2 0.01
  vsa export --mjcf my_arm.sdf --out .
  vsa export --mjcf snake_flat --plugin --out snake)";

struct ExportOptions {
  std::string mjcf;
  bool plugin = false;
  FmuOptions fmu;
};

/// A robot that somebody wrote as MJCF beside its SDF is theirs.
void keep_others_work(const std::filesystem::path& path) {
  const std::optional<std::string> there = read_file(path);
  if (there && !there->empty() && !engine::is_exported(*there))
    throw InputError({path.string(), "", "", "is there and wasn't written by vsa export", "another --out, or remove it first"});
}

int export_mjcf(const ExportOptions& o) {
  const std::string& directory = o.fmu.out;
  if (directory.empty()) throw InputError({"", "--out", "", "is missing", "a directory for the files"});
  std::vector<engine::ExportedFile> files;
  // An MJCF stays what it is: only the plug-in's is written.
  if (!o.plugin || engine::mjcf_of(o.mjcf).empty()) files = engine::export_mjcf(o.mjcf);
  if (!files.empty()) keep_others_work(std::filesystem::path(directory) / files.front().name);
  if (o.plugin) {
    engine::PluginMjcf more = engine::export_plugin_mjcf(o.mjcf, {}, files.empty() ? "" : files.front().bytes);
    for (const std::string& note : more.notes) std::cerr << "note: " << note << '\n';
    files.push_back(std::move(more.file));
  }
  make_directory(directory, "--out");
  std::vector<std::pair<std::filesystem::path, std::string_view>> whole;
  for (const engine::ExportedFile& file : files) whole.emplace_back(std::filesystem::path(directory) / file.name, file.bytes);
  write_all_whole(whole);  // they belong to each other
  for (const auto& [path, bytes] : whole) std::cout << path.string() << '\n';
  return kDone;
}

int run_export(const ExportOptions& o) {
  if (!o.mjcf.empty()) return export_mjcf(o);
  if (!o.fmu.fmu.empty()) return export_fmu(o.fmu);
  throw InputError({"", "--fmu, --mjcf", "", "neither is given", "one of them"});
}

}  // namespace

void setup_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  FmuOptions& fmu = options->fmu;
  CLI::App* sub = app.add_subcommand("export", "Write an actuator or a world as a file for other simulators");
  CLI::Option* of_fmu = sub->add_option("--fmu", fmu.fmu, "Actuator type or world to write as a functional mock-up unit");
  CLI::Option* mjcf = sub->add_option("--mjcf", options->mjcf, "World to write in MuJoCo's format, for machines that read no SDF");
  of_fmu->type_name("TYPE|WORLD")->excludes(mjcf);
  mjcf->type_name("WORLD");
  sub->add_flag("--plugin", options->plugin, "Of an MJCF: write NAME_plugin.xml, too, for MuJoCo 3 with vsasim's plug-in")
      ->needs(mjcf);
  sub->add_option("--out", fmu.out, "FMU: file to write; default: NAME.fmu. MJCF: directory, made where it is missing");
  sub->add_option("--fmi", fmu.fmi, "Version of the interface; default 2")->check(CLI::IsMember({2, 3}))->needs(of_fmu);
  sub->add_option("--names", fmu.names, "Of inputs and outputs: vsasim's, or those of gazebo-fmi's actuator plug-in")
      ->check(CLI::IsMember({"vsasim", "gazebo_fmi"}))
      ->needs(of_fmu);
  sub->add_option("--coupling", fmu.coupling, "Start value: who moves the shaft; default prescribed")
      ->check(CLI::IsMember({"prescribed", "implicit"}))
      ->needs(of_fmu);
  sub->add_option("--load-inertia-kgm2", fmu.load_inertia_kgm2, "Start value: inertia behind the shaft, 0 … 1e6")
      ->check(number_given())
      ->needs(of_fmu);
  sub->add_option("--set", fmu.set, "Override a parameter of the type: key=value")->allow_extra_args(false)->needs(of_fmu);
  sub->footer(kExportNotes);
  sub->callback([options, &exit_code] { exit_code = run_export(*options); });
}

}  // namespace vsa::app
