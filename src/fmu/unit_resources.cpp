// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <set>

#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/fmu/resources.hpp"

namespace vsa::fmu {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPlan = "unit.toml";
constexpr const char* kFolder = "actuators/";

std::string bytes_of(const fs::path& file) {
  auto text = read_file(file);
  if (!text) throw InputError({file.string(), "", "", "can't be read", ""});
  return std::move(*text);
}

/// Below the folder of resources it stands as it does below the type's own.
void add_file(Resources& out, const fs::path& file, const fs::path& beside) {
  const fs::path name = fs::absolute(file).lexically_normal().lexically_relative(fs::absolute(beside).lexically_normal());
  if (name.empty() || *name.begin() == "..")
    throw InputError({file.string(), "--fmu", "", "lies outside of the type's folder, which the FMU takes along",
                      "a file below " + beside.string()});
  out[kFolder + name.generic_string()] = bytes_of(file);
}

const char* word(Names names) { return names == Names::gazebo_fmi ? "gazebo_fmi" : "vsasim"; }
const char* word(Coupling coupling) { return coupling == Coupling::implicit ? "implicit" : "prescribed"; }

std::string plan_text(const UnitPlan& plan) {
  const UnitStart& s = plan.start;
  std::string out = "written_by = \"vsasim " VSA_VERSION "\"\ntype = " + toml_text(plan.type) + "\nnames = \"" + word(plan.names) +
                    "\"\ncoupling = \"" + word(s.coupling.value_or(Coupling::prescribed)) + "\"\n" +
                    "load_inertia_kg_m2 = " + config::number_text(s.load_inertia_kgm2.value_or(0)) + "\n\n[set]\n";
  for (const config::Override& o : s.set) out += toml_text(o.key) + " = " + toml_text(o.value) + '\n';
  return out;
}

}  // namespace

config::LawRegistry built_in_laws() {
  config::LawRegistry laws;
  for (const elastic::Law* law : elastic::laws()) laws.add(*law);
  return laws;
}

void add_type_files(Resources& to, const config::TypeLibrary& library, const std::string& name) {
  const config::ActuatorType type = library.load(name);
  if (const config::LawRegistry laws = built_in_laws(); laws.find(type.law) == nullptr)
    throw InputError({type.file.string(), "elastic.law", type.law, "is of a library of its own, which an FMU doesn't have in it",
                      config::join(laws.names())});
  std::set<std::string> seen;
  for (fs::path file = type.file; seen.insert(file.string()).second;) {
    // Types find their base beside them, so all stand in one folder.
    to[kFolder + file.filename().string()] = bytes_of(file);
    const config::ActuatorType here = library.load_file(file);
    for (const config::Entry& e : here.entries)
      if (e.kind == config::Kind::file) add_file(to, e.value, file.parent_path());
    if (here.base.empty()) break;
    const fs::path beside = file.parent_path() / (here.base + ".toml");
    file = fs::exists(beside) ? beside : library.find(here.base);
  }
}

Resources unit_resources(const config::TypeLibrary& library, const UnitPlan& plan) {
  static_cast<void>(library.load(plan.type, plan.start.set));  // what is wrong with the values
  Resources out;
  out[kPlan] = plan_text(plan);
  add_type_files(out, library, plan.type);
  return out;
}

std::unique_ptr<UnitModel> open_unit(const fs::path& resources) {
  const fs::path file = resources / kPlan;
  const toml::table table = config::parse_toml(file);
  Problems problems;
  config::TomlSection section(&table, file.string(), "", problems);
  UnitStart start;
  static_cast<void>(section.text("written_by"));
  const auto type = section.need("type", "a type's name").text("type");
  const auto names = section.need("names", "vsasim, gazebo_fmi").word("names", {"vsasim", "gazebo_fmi"});
  const auto coupling = section.need("coupling", "prescribed, implicit").word("coupling", {"prescribed", "implicit"});
  start.load_inertia_kgm2 = section.number("load_inertia_kg_m2", 0, kFarthest);
  start.set = section.overrides("set");
  section.refuse_others();
  problems.throw_if_any();
  start.coupling = *coupling == "implicit" ? Coupling::implicit : Coupling::prescribed;
  const config::TypeLibrary library({resources / "actuators"}, built_in_laws());
  return std::make_unique<UnitModel>(library.open(*type), std::move(start),
                                     *names == "gazebo_fmi" ? Names::gazebo_fmi : Names::vsasim);
}

}  // namespace vsa::fmu
