// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "engine/world_cache.hpp"
#include "engine/world_check.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/physics/mjcf.hpp"
#include "vsa/sdf/feature.hpp"
#include "vsa/sdf/source_mark.hpp"

namespace vsa::engine {

void check_file_is_exported(const WorldOptions& options, bool robots, Problems& problems) {
  const auto say = [&](const char* key, std::string value) {
    problems.add({"", key, std::move(value), "an export has what its file has", "none"});
  };
  if (options.step_s) say("step_s", fmt::format("{}", *options.step_s));
  if (!robots) return;
  if (options.actuator.type) say("actuator", *options.actuator.type);
  for (const config::Override& o : options.actuator.overrides) say("actuator", o.key);
  if (!options.actuators) say("actuators", "false");
}

std::vector<ExportedFile> export_mjcf(const std::filesystem::path& world, const WorldOptions& options) {
  const std::filesystem::path path = config::find_file(world.string(), "world", "models/worlds", ".sdf");
  Problems problems;
  check_file_is_exported(options, true, problems);
  const std::shared_ptr<ReadWorld> file = read_world({path, {}}, options, problems);
  problems.throw_if_any();
  // Its robots, too, as vsa run would read them: an element that nobody can read would lie there as a part of the export.
  if (!file->world->native) (void)World::load(path, options);
  std::vector<ExportedFile> out;
  for (physics::WrittenFile& one : physics::write_mjcf_files(*file->world, path.stem().string(), path.string(), problems))
    out.push_back({std::move(one.name), std::move(one.bytes)});
  problems.throw_if_any();
  reader::SeenFiles seen;
  const auto mark = reader::source_mark(path, reader::Finder(reader::SearchPath(options.model_path), seen), seen);
  if (mark) out.front().bytes = reader::with_source_mark(std::move(out.front().bytes), *mark);
  return out;
}

bool is_exported(std::string_view mjcf) {
  // Before there were marks, and where what an SDF names can't be read, there is none.
  constexpr std::string_view kSecondLine = "<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n";
  const std::size_t line = mjcf.find('\n');
  return reader::source_mark_in(mjcf).has_value() ||
         (mjcf.starts_with("<mujoco model=\"") && line != std::string_view::npos && mjcf.substr(line + 1).starts_with(kSecondLine));
}

std::filesystem::path mjcf_of(const std::filesystem::path& world) {
  if (world.empty() || physics::is_mjcf(world, {})) return world;
  std::filesystem::path beside = world;
  beside.replace_extension(".xml");
  std::error_code none;
  const bool is_read = world.extension() == ".urdf" ? reader::urdf_feature().is_in() : reader::sdf_feature().is_in();
  const bool stands_in = !is_read && std::filesystem::is_regular_file(beside, none);
  return stands_in ? beside : std::filesystem::path{};
}

}  // namespace vsa::engine
