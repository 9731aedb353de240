// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world with all its files, so that it is found where nothing else is: model://NAME/… becomes a path below the file that names it.
#include <set>

#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/fmu_world/world_model.hpp"
#include "vsa/physics/mjcf.hpp"
#include "vsa/sdf/finder.hpp"

namespace vsa::fmu {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPlan = "world.toml";
constexpr std::string_view kModel = "model://";

bool is_xml(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".sdf" || ending == ".urdf" || ending == ".world" || ending == ".xml";
}

/// The models that a text names, whose URIs are made to begin with `up`.
std::set<std::string> take_models(std::string& text, const std::string& up) {
  std::set<std::string> names;
  for (std::size_t at = text.find(kModel); at != std::string::npos; at = text.find(kModel, at)) {
    const std::size_t begin = at + kModel.size(), end = text.find_first_of("/<\"' \n", begin);
    names.insert(text.substr(begin, end - begin));
    text.replace(at, kModel.size(), up);
  }
  return names;
}

void refuse_other_uris(const fs::path& file, const std::string& text) {
  for (const char* other : {"package://", "file://", "http://", "https://"}) {
    if (text.find(std::string(">") + other) == std::string::npos && text.find(std::string("\"") + other) == std::string::npos)
      continue;
    throw InputError({file.string(), "uri", other, "names a file that an FMU can't take along", "model://NAME/…"});
  }
}

class Collector {
 public:
  void world(const fs::path& file) {
    if (const fs::path mjcf = engine::mjcf_of(file); !mjcf.empty()) return mjcf_world(mjcf);
    std::string text = bytes_of(file);
    refuse_other_uris(file, text);
    name_ = "world" + file.extension().string();
    for (const std::string& model : take_models(text, "models/")) add(model, file);
    out_[name_] = std::move(text);
  }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Resources take() { return std::move(out_); }

 private:
  /// The file, its companion and all that they name, under their own names.
  void mjcf_world(const fs::path& file) {
    name_ = file.filename().string();
    std::error_code error;
    for (const fs::path& each : physics::files_of_mjcf(file))
      if (each == file || fs::is_regular_file(each, error)) add_mjcf(each);
  }

  void add_mjcf(const fs::path& file) {
    constexpr std::string_view kFile = "file=", kBlanks = " \t\r\n";
    if (!seen_.insert(file.string()).second) return;
    std::string text = bytes_of(file);
    for (const char* elsewhere : {"meshdir=", "texturedir=", "assetdir="})
      if (file.extension() == ".xml" && text.find(elsewhere) != std::string::npos)
        throw InputError(
            {file.string(), elsewhere, "", "names a folder, which an FMU doesn't take along", "files beside the MJCF"});
    for (std::size_t at = text.find(kFile); file.extension() == ".xml" && at != std::string::npos; at = text.find(kFile, at + 1)) {
      if (at == 0 || kBlanks.find(text[at - 1]) == std::string_view::npos) continue;  // the end of another word
      const std::size_t begin = at + kFile.size() + 1, end = text.find(text[begin - 1], begin);
      const fs::path named = text.substr(begin, end - begin);
      if (named != named.filename() || !fs::is_regular_file(file.parent_path() / named))
        throw InputError({file.string(), "file", named.string(), "can't go into an FMU", "the name of a file beside the MJCF"});
      add_mjcf(file.parent_path() / named);
    }
    out_[file.filename().string()] = std::move(text);
  }

  static std::string bytes_of(const fs::path& file) {
    auto text = read_file(file);
    if (!text) throw InputError({file.string(), "", "", "can't be read", ""});
    return std::move(*text);
  }

  void add(const std::string& model, const fs::path& from) {
    if (!seen_.insert(model).second) return;
    reader::SeenFiles files;
    const reader::Finder finder(reader::SearchPath({}), files);
    const fs::path folder = finder.find(std::string(kModel) + model, from.parent_path());
    std::error_code error;
    if (folder.empty() || !fs::is_directory(folder, error))
      throw InputError({from.string(), "uri", std::string(kModel) + model, "there is no such folder",
                        finder.searched(std::string(kModel) + model, from.parent_path())});
    for (auto& [name, bytes] : read_resources(folder)) {
      std::string text = bytes;
      const fs::path relative = fs::path("models") / model / name;
      if (is_xml(relative)) {
        refuse_other_uris(folder / name, text);
        // From the folder of the file up to models/.
        std::string up;
        for (fs::path p = relative.parent_path(); p != "models"; p = p.parent_path()) up += "../";
        for (const std::string& other : take_models(text, up)) add(other, folder / name);
      }
      out_[relative.generic_string()] = std::move(text);
    }
  }

  Resources out_;
  std::set<std::string> seen_;
  std::string name_;
};

config::Replacement replacement(const std::vector<config::Override>& set) {
  config::Replacement out;
  out.overrides = set;
  out.flag = "--set";
  return out;
}

}  // namespace

Resources world_resources(const config::TypeLibrary& library, const WorldPlan& plan) {
  const fs::path file = config::find_file(plan.world, "world", "models/worlds", ".sdf");
  engine::WorldOptions options;
  options.types = library;
  options.actuator = replacement(plan.set);
  const engine::World world = engine::World::load(file, options);  // what is wrong with it is told by its own names
  Collector collector;
  collector.world(file);
  const std::string name = collector.name();
  Resources out = collector.take();
  for (std::size_t r = 0; r < world.robot_count(); ++r)
    for (const host::ActuatorConfig& a : world.robot(r).config().actuators) add_type_files(out, library, a.type);
  out["actuators/readme.txt"] =
      "The types of this world's actuators.\n";  // a data directory has that folder, also of a world without
  out[kPlan] = "written_by = \"vsasim " VSA_VERSION "\"\nworld = " + toml_text(name) + "\n\n[set]\n";
  for (const config::Override& o : plan.set) out[kPlan] += toml_text(o.key) + " = " + toml_text(o.value) + '\n';
  return out;
}

std::unique_ptr<WorldModel> open_world(const fs::path& resources) {
  const fs::path file = resources / kPlan;
  const toml::table table = config::parse_toml(file);
  Problems problems;
  config::TomlSection section(&table, file.string(), "", problems);
  static_cast<void>(section.text("written_by"));
  const auto world = section.need("world", "a file beside this one").text("world");
  const std::vector<config::Override> set = section.overrides("set");
  section.refuse_others();
  problems.throw_if_any();
  engine::WorldOptions options;
  options.types = config::TypeLibrary({resources / "actuators"}, built_in_laws());
  options.actuator = replacement(set);
  return std::make_unique<WorldModel>(engine::World::load(resources / *world, options));
}

}  // namespace vsa::fmu
