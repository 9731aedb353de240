// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "engine/world_cache.hpp"

#include <algorithm>
#include <list>
#include <mutex>

#include "vsa/description/capabilities.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/files.hpp"
#include "vsa/physics/mjcf.hpp"
#include "vsa/physics/mujoco.hpp"
#include "vsa/sdf/feature.hpp"
#include "vsa/sdf/finder.hpp"
#include "vsa/sdf/source_mark.hpp"
#include "vsa/utf8.hpp"

namespace vsa::engine {
namespace {

constexpr std::size_t kMost = 8;  // files kept; a world of many large meshes holds some 10 MB

struct Key {
  std::filesystem::path path, directory;
  std::string text;
  reader::SearchPath search;
  Concave concave;
  ImpossibleInertia impossible_inertia;
  std::shared_ptr<const physics::Engine> engine;
  [[nodiscard]] bool operator==(const Key&) const = default;
};

struct Entry {
  Key key;
  std::shared_ptr<ReadWorld> file;
  reader::SeenFiles seen;
};

const std::shared_ptr<const physics::Engine> default_engine = physics::mujoco();

Key key_of(const reader::SdfSource& source, const WorldOptions& options) {
  std::error_code ignored;
  return {source.path,
          std::filesystem::current_path(ignored),
          std::string(source.text),
          reader::SearchPath(options.model_path),
          options.concave,
          options.impossible_inertia,
          options.physics ? options.physics : default_engine};
}

/// The one used last stands first.
class Cache {
 public:
  std::shared_ptr<const Entry> find(const Key& key) {
    std::shared_ptr<const Entry> known;
    {
      const std::scoped_lock lock(mutex_);
      const auto at = std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e->key == key; });
      if (at == entries_.end()) return nullptr;
      entries_.splice(entries_.begin(), entries_, at);
      known = *at;
    }
    if (known->seen.unchanged()) return known;
    const std::scoped_lock lock(mutex_);
    entries_.remove(known);
    return nullptr;
  }

  void keep(std::shared_ptr<const Entry> entry) {
    const std::scoped_lock lock(mutex_);
    entries_.push_front(std::move(entry));
    if (entries_.size() > kMost) entries_.pop_back();
  }

 private:
  std::mutex mutex_;
  std::list<std::shared_ptr<const Entry>> entries_;
};

Cache cache;

// libsdformat keeps global state while it reads: two threads in sdf::Root::Load crash.
std::mutex reading;

/// An MJCF beside an SDF stands for it where no SDF can be read, so both should say the same.
void compare_with_mjcf(const std::filesystem::path& sdf, Entry& entry) {
  std::filesystem::path mjcf = sdf;
  mjcf.replace_extension(".xml");
  if (sdf.extension() != ".sdf" || !entry.seen.asks(mjcf)) return;
  entry.seen.reads(mjcf);
  const auto written_of = reader::source_mark_in(read_file(mjcf).value_or(""));
  if (!written_of) return;
  const auto now = reader::source_mark(sdf, reader::Finder(entry.key.search, entry.seen), entry.seen);
  if (!now || *now == *written_of) return;
  const std::string name = mjcf.filename().string();
  entry.file->warnings.push_back(
      (reader::sdf_feature().is_in()
           ? name + " beside it was written of another state of this SDF or of what it includes, and builds without SDF run that"
           : "it or what it includes has changed since " + name + " was written of it, and that is what runs") +
      ": vsa export --mjcf writes it anew, in a build with SDF");
}

/// Topics, tables and pages hold names, and are UTF-8.
void check_names(const description::World& world, const std::string& file, Problems& problems) {
  const auto check = [&](const char* what, const std::string& name) {
    if (!is_utf8(name)) problems.add({file, what, name, "isn't UTF-8", "a file in UTF-8"});
  };
  check("world", world.name);
  for (const description::Plugin& p : world.plugins) check("model", p.model);
  for (const description::Link& l : world.links) check("link", l.name);
  for (const description::Joint& j : world.joints) check("joint", j.name);
}

description::World read_description(const reader::SdfSource& source, const WorldOptions& options, Entry& entry,
                                    Problems& problems) {
  ReadWorld& file = *entry.file;
  const std::filesystem::path mjcf = mjcf_of(source.path);
  if (mjcf.empty() && !physics::is_mjcf({}, source.text)) {
    description::World out = reader::read_sdf(source, {file.engine->capabilities(), options.concave, options.impossible_inertia},
                                              reader::Finder(entry.key.search, entry.seen), entry.seen, file.warnings, problems);
    if (problems.empty()) compare_with_mjcf(source.path, entry);
    return out;
  }
  for (const std::filesystem::path& read : physics::files_of_mjcf(mjcf)) entry.seen.reads(read);
  physics::MjcfRead read = physics::read_mjcf(mjcf, source.text, file.warnings, problems);
  if (read.names_others) entry.seen.lost();
  if (problems.empty() && mjcf != source.path) compare_with_mjcf(source.path, entry);
  return std::move(read.world);
}

}  // namespace

std::shared_ptr<const physics::CompiledWorld> ReadWorld::compiled(double step_s, std::string_view file, Problems& problems) {
  const std::scoped_lock lock(compiling_);
  if (compiled_ == nullptr || step_s_ != step_s) {
    compiled_ = engine->compile(world, step_s, file, problems);
    step_s_ = step_s;
  }
  return compiled_;
}

std::shared_ptr<ReadWorld> read_world(const reader::SdfSource& source, const WorldOptions& options, Problems& problems) {
  Key key = key_of(source, options);
  if (const auto known = cache.find(key)) return known->file;
  const std::scoped_lock lock(reading);
  if (const auto known = cache.find(key)) return known->file;  // read while this thread waited
  const auto entry = std::make_shared<Entry>(Entry{std::move(key), std::make_shared<ReadWorld>(), {}});
  entry->file->engine = entry->key.engine;
  entry->file->world = std::make_shared<const description::World>(read_description(source, options, *entry, problems));
  if (problems.empty()) check_names(*entry->file->world, source.label(), problems);
  if (problems.empty() && entry->seen.settled()) cache.keep(entry);
  return entry->file;
}

}  // namespace vsa::engine
