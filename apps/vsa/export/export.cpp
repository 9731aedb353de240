// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "export/export.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "terminal/exit_codes.hpp"
#include "terminal/numbers.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/fmu_package/package.hpp"
#include "vsa/fmu_world/world_model.hpp"

namespace vsa::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* kNotes =
    R"(A functional mock-up unit for co-simulation: an actuator type between its importer's shaft and commands (angle and speed in,
torque out), or a whole world with the embedded engine (commands in, joints and torques out). One file that needs no vsasim where it
is imported; an actuator's needs the C library only. docs/howto/fmu.md tells how to step it.
  --coupling            prescribed: the importer moves the shaft as it likes; implicit: it steps the unit first and applies mean_torque
                        over the same step, with v' = v + h a, q' = q + h v'
  --load-inertia-kgm2   behind the shaft: implicit coupling needs it, with the other the unit warns of steps that are too long

Examples:
  vsa export --fmu qbmove_maker_pro_6_1
  vsa export --fmu sea_example --fmi 3 --out sea.fmu --set drive.supply_V=24
  vsa export --fmu qbmove_maker_pro --names gazebo_fmi --coupling implicit --load-inertia-kgm2 0.01)";

/// Beside this program: in a build, or in an installation.
fs::path library_beside(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path built = (folder / "../lib/vsasim" / name).lexically_normal();
  return fs::exists(built, error) ? built : (folder / VSA_FMU_LIBRARIES / name).lexically_normal();
}

/// Known before the work, not after.
void check_writable(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder))
    throw InputError({"", "--out", file.string(), "its directory doesn't exist", "a file in a directory that exists"});
  if (fs::is_directory(file)) throw InputError({"", "--out", file.string(), "is a directory", "a file"});
}

std::string licence() {
  const auto file = config::find_data("LICENSE");
  const auto text = file ? read_file(*file) : std::nullopt;
  if (!text) throw InputError({"", "LICENSE", "", "isn't among the data", "an installation, or the source tree"});
  return *text;
}

fmu::PackagePlan unit_package(const ExportOptions& o, const config::ActuatorType& type) {
  fmu::PackagePlan plan;
  plan.name = type.name;
  plan.title = type.title;
  plan.note =
      "Set shaft_angle and shaft_speed at each communication point, then step. With coupling prescribed the shaft goes on as they "
      "and "
      "shaft_acceleration say, commands are held, and torque is what acts at the point reached; set shaft_angle there and it "
      "follows. "
      "With coupling implicit step this unit first and apply mean_torque over the same step.";
  plan.version = o.fmi == 3 ? fmu::Version::fmi3 : fmu::Version::fmi2;
  plan.library = library_beside("libvsa-fmu.so");
  plan.licence = licence();
  return plan;
}

int export_unit(const ExportOptions& o, const config::TypeLibrary& library, const fs::path& file) {
  fmu::UnitPlan plan;
  plan.type = o.fmu;
  plan.start.set = config::parse_overrides(o.set, "--set");
  plan.start.coupling = o.coupling == "implicit" ? fmu::Coupling::implicit : fmu::Coupling::prescribed;
  plan.start.load_inertia_kgm2 = o.load_inertia_kgm2;
  plan.names = o.names == "gazebo_fmi" ? fmu::Names::gazebo_fmi : fmu::Names::vsasim;
  if (o.coupling == "implicit" && !(o.load_inertia_kgm2.value_or(0) > 0))
    throw InputError({"", "--coupling", "implicit", "foresees how the shaft moves", "--load-inertia-kgm2 beside it, above 0"});
  const fmu::Resources resources = fmu::unit_resources(library, plan);
  // The model that describes itself is made of what goes into the file, as its library will make it.
  const fmu::TemporaryFolder folder;
  fmu::write_resources(resources, folder.path());
  const auto model = fmu::open_unit(folder.path());
  fmu::write_package(*model, resources, unit_package(o, model->type()), file);
  std::cout << fmt::format("written: {} (FMI {}.0, {} variables)\n", file.string(), o.fmi, model->variables().size());
  return std::cout.flush() ? kDone : kFailed;
}

int export_world(const ExportOptions& o, const config::TypeLibrary& library, const fs::path& file) {
  if (o.names != "vsasim" || o.coupling != "prescribed" || o.load_inertia_kgm2)
    throw InputError({"", "--names, --coupling, --load-inertia-kgm2", o.fmu, "are for one actuator: this is a world", ""});
  const fmu::Resources resources = fmu::world_resources(library, {o.fmu, config::parse_overrides(o.set, "--set")});
  const fmu::TemporaryFolder folder;
  fmu::write_resources(resources, folder.path());
  const auto model = fmu::open_world(folder.path());
  fmu::PackagePlan plan;
  plan.name = fs::path(o.fmu).stem().string();
  plan.title = "world " + model->world().name() + " of vsasim, with its embedded engine";
  plan.note = "The world goes in steps of " + config::number_text(model->world().step_s()) +
              " s. A communication step makes as many as end by its end; a communication point between two sees the outputs of the "
              "last one.";
  plan.version = o.fmi == 3 ? fmu::Version::fmi3 : fmu::Version::fmi2;
  plan.step_s = model->world().step_s();
  plan.library = library_beside("libvsa-fmu-world.so");
  plan.licence = licence();
  fmu::write_package(*model, resources, plan, file);
  std::cout << fmt::format("written: {} (FMI {}.0, {} variables)\n", file.string(), o.fmi, model->variables().size());
  return std::cout.flush() ? kDone : kFailed;
}

/// A type by its name; all else is a world's name or file.
bool is_type(const config::TypeLibrary& library, const std::string& name) {
  const std::vector<std::string> names = library.names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A word that is neither is told what both are.
[[noreturn]] void refuse_unknown(const config::TypeLibrary& library, const std::string& name) {
  std::vector<std::string> all = library.names(), worlds = config::built_in_files("models/worlds", ".sdf");
  all.insert(all.end(), worlds.begin(), worlds.end());
  throw InputError({"", "--fmu", name, "is neither an actuator type nor a world" + config::did_you_mean(name, all),
                    "types: " + config::join(library.names()) + "; worlds: " + config::join(worlds) + ", or a file"});
}

}  // namespace

void setup_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* sub = app.add_subcommand("export", "Write an actuator or a world as a file for other simulators");
  sub->add_option("--fmu", options->fmu, "Actuator type or world to write as a functional mock-up unit")->required();
  sub->add_option("--out", options->out, "File to write; default: NAME.fmu");
  sub->add_option("--fmi", options->fmi, "Version of the interface; default 2")->check(CLI::IsMember({2, 3}));
  sub->add_option("--names", options->names, "Of inputs and outputs: vsasim's, or those of gazebo-fmi's actuator plug-in")
      ->check(CLI::IsMember({"vsasim", "gazebo_fmi"}));
  sub->add_option("--coupling", options->coupling, "Start value: who moves the shaft; default prescribed")
      ->check(CLI::IsMember({"prescribed", "implicit"}));
  sub->add_option("--load-inertia-kgm2", options->load_inertia_kgm2, "Start value: inertia behind the shaft, 0 … 1e6")
      ->check(number_given());
  sub->add_option("--set", options->set, "Override a parameter of the type: key=value")->allow_extra_args(false);
  sub->footer(kNotes);
  sub->callback([options, &exit_code] { exit_code = run_export(*options); });
}

int run_export(const ExportOptions& o) {
  if (o.load_inertia_kgm2 && !(*o.load_inertia_kgm2 >= 0 && *o.load_inertia_kgm2 <= fmu::kFarthest))
    throw InputError({"", "--load-inertia-kgm2", config::number_text(*o.load_inertia_kgm2), "is out of range", "0 … 1e6"});
  const config::TypeLibrary library;
  const fs::path file = o.out.empty() ? fs::path(o.fmu).stem().string() + ".fmu" : o.out;
  check_writable(file);
  if (is_type(library, o.fmu)) return export_unit(o, library, file);
  const std::vector<std::string> worlds = config::built_in_files("models/worlds", ".sdf");
  if (!fs::exists(o.fmu) && std::find(worlds.begin(), worlds.end(), fs::path(o.fmu).stem().string()) == worlds.end())
    refuse_unknown(library, o.fmu);
  return export_world(o, library, file);
}

}  // namespace vsa::app
