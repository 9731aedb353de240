// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "export/fmu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "terminal/exit_codes.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/notices.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/fmu_package/package.hpp"
#include "vsa/fmu_world/world_model.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::app {
namespace fs = std::filesystem;
namespace {

/// Beside this program, in a build as in an installation.
fs::path library_beside(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  return (folder / "../lib/vsasim/fmu" / name).lexically_normal();
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

fmu::PackagePlan unit_package(const FmuOptions& o, const config::ActuatorType& type) {
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

/// Old spellings in them were told of the files that they are copies of.
void write_copies(const fmu::Resources& resources, const fs::path& folder) {
  config::listen_to_notices({});
  fmu::write_resources(resources, folder);
}

int export_unit(const FmuOptions& o, const config::TypeLibrary& library, const fs::path& file) {
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
  const vsa::TemporaryFolder folder;
  write_copies(resources, folder.path());
  const auto model = fmu::open_unit(folder.path());
  fmu::write_package(*model, resources, unit_package(o, model->type()), file);
  std::cout << fmt::format("written: {} (FMI {}.0, {} variables)\n", file.string(), o.fmi, model->variables().size());
  return kDone;
}

int export_world(const FmuOptions& o, const config::TypeLibrary& library, const fs::path& file) {
  if (o.names != "vsasim" || o.coupling != "prescribed" || o.load_inertia_kgm2)
    throw InputError({"", "--names, --coupling, --load-inertia-kgm2", o.fmu, "are for one actuator: this is a world", ""});
  const fmu::Resources resources = fmu::world_resources(library, {o.fmu, config::parse_overrides(o.set, "--set")});
  const vsa::TemporaryFolder folder;
  write_copies(resources, folder.path());
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
  return kDone;
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

int export_fmu(const FmuOptions& o) {
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
