// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Records a run: CSV files (csv.hpp), an MCAP file (run_log.hpp) and a replay page (page.hpp).
//
//   vsa::record::Recorder recorder(world, "out");     // the sample at the present time is taken here, before the first step
//   while (…) { world.step(); recorder.sample(world); }
//   recorder.finish({{"distance", "4.2 m"}});
//
// A run that blows up: what was sampled is in the files already; call finish() with a note and the page shows the run so far.
// A world that was reset starts the recording over (its files hold one run, in order of time), and the page says so.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/host/simulation.hpp"
#include "vsa/record/run_data.hpp"

namespace vsa::record {

/// What a recording is to hold.
struct RecorderOptions {
  double rate_Hz = 100;                ///< of the CSV files, (0, 1e6]
  double page_rate_Hz = 50;            ///< of the page, (0, 1e6]; halved as often as page_frames_max asks
  std::size_t page_frames_max = 4000;  ///< at least 2
  std::string title;                   ///< of the page; empty: the world's name
  /// What was ordered to break from the start, as `vsa run --fault` takes it (orders are taken at the first step, so the world
  /// can't tell before). Empty: what is broken in the world now.
  std::string faults{};
  /// Empty: web/replay.html of the data directories; where none has it, the files are written and there is no page.
  std::filesystem::path page_template;
};

/// The recorder's core, fed with samples: for tests and for those that have samples but no host::Simulation.
class RunRecord {
 public:
  /// Throws InputError: options out of range, directory or files that can't be written, a named template that is missing.
  RunRecord(RunInfo info, std::filesystem::path directory, RecorderOptions options);
  ~RunRecord();
  RunRecord(RunRecord&&) noexcept;
  RunRecord& operator=(RunRecord&&) noexcept;

  /// Whether a sample at that time is wanted by the files or the page. Asked after each step: time that is earlier than it was when
  /// this was asked last is a world that went back.
  [[nodiscard]] bool due(std::int64_t time_ns) noexcept;
  /// Throws RecordError; then nothing more is written to the files, but the page can still be made.
  void add(const Sample& sample);
  /// Closes the files and writes DIR/replay.html; returns its path, empty without a page. Once: the directory is free then for
  /// another recording. Throws RecordError.
  std::filesystem::path finish(const std::vector<Statistic>& summary, std::string_view note);
  /// Why there will be no page, in a sentence; empty: there will be one.
  [[nodiscard]] const std::string& without_page() const;
  [[nodiscard]] std::vector<std::filesystem::path> files() const;  ///< without the page, which finish() makes

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Records a simulation: RunRecord with samples of it.
class Recorder {
 public:
  /// Takes the first sample; throws as RunRecord.
  Recorder(const host::Simulation& world, const std::filesystem::path& directory, RecorderOptions options = {});

  /// Call after each step: takes a sample if one is due.
  void sample(const host::Simulation& world);

  /// Writes the page, if there is a template. `note` says on it why the run ended early; empty where it didn't.
  std::filesystem::path finish(const std::vector<Statistic>& summary = {}, std::string_view note = {});

  /// Without the page, which finish() makes.
  [[nodiscard]] std::vector<std::filesystem::path> files() const { return record_.files(); }
  /// Why there will be no page; empty: there will be one.
  [[nodiscard]] const std::string& without_page() const { return record_.without_page(); }

 private:
  Sample sample_;  // reused, so that sampling doesn't allocate
  RunRecord record_;
};

/// The present moment; reuses what `sample` holds.
void read(const host::Simulation& world, Sample& sample);

/// What stays the same over a run of this world.
[[nodiscard]] RunInfo describe(const host::Simulation& world);

}  // namespace vsa::record
