// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "vsa/checks.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"
#include "vsa/page/page.hpp"
#include "vsa/record/csv.hpp"
#include "vsa/record/page.hpp"
#include "vsa/record/recorder.hpp"
#include "vsa/record/run_log.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;

RecorderOptions checked(RecorderOptions options) {
  Problems problems;
  const auto rate = [&](const char* key, double value) {
    if (!(value > 0 && value <= 1e6)) problems.add({"", key, Checks::text(value), "not a recording rate", "above 0 to 1e6 Hz"});
  };
  rate("rate_Hz", options.rate_Hz);
  rate("page_rate_Hz", options.page_rate_Hz);
  if (options.page_frames_max < 2) {
    problems.add({"", "page_frames_max", std::to_string(options.page_frames_max), "too few frames", "2 or more"});
  }
  problems.throw_if_any();
  return options;
}

/// Empty, with the reason in `why_none`, where nobody named a template and none is installed or built.
std::string template_for(const RecorderOptions& options, std::string& why_none) {
  if (!options.page_template.empty()) return page::read_template(options.page_template);
  if (const auto found = config::find_data("web/replay.html")) return page::read_template(*found);
  std::string places;
  for (const fs::path& d : config::data_directories()) places += (places.empty() ? "" : ", ") + d.string();
  why_none = "no replay page: its template web/replay.html is in none of " + places + " (it comes with an installation or a build)";
  return {};
}

std::string seconds(std::int64_t time_ns) {
  std::string text = std::to_string(seconds_of(time_ns));
  return text.substr(0, text.size() - 3) + " s";
}

}  // namespace

struct RunRecord::Impl {
  RunInfo info;
  fs::path directory;
  RecorderOptions options;
  std::string without_page;  // before the template, which may set it
  std::string page_template;
  CsvFiles files;
  RunLog log;  // behind the files: they hold the directory
  Cadence cadence;
  PageData page;
  std::int64_t seen_ns = -1;
  std::optional<std::int64_t> went_back_from_ns;  // since the last sample
  std::vector<std::string> notes;
  bool files_failed = false;

  Impl(RunInfo i, fs::path d, RecorderOptions o)
      : info(std::move(i)),
        directory(std::move(d)),
        options(checked(std::move(o))),
        page_template(template_for(options, without_page)),
        files(info, directory, {RunLog::kFile}),
        log(info, directory, options.rate_Hz),
        cadence(options.rate_Hz),
        page(info, options.page_rate_Hz, options.page_frames_max) {}

  void look(std::int64_t time_ns) noexcept {
    if (time_ns < seen_ns) went_back_from_ns = seen_ns;
    seen_ns = time_ns;
  }

  void start_over(std::int64_t from_ns, std::int64_t time_ns) {
    notes.push_back("The world went back from " + seconds(from_ns) + " to " + seconds(time_ns) + ": the recording starts there.");
    cadence.restart();
    page.restart();
    if (files_failed) return;
    files.restart();
    log.restart();
  }

  void write_files(const Sample& sample) {
    try {
      files.write(sample);
      log.write(sample);
      cadence.taken(sample.time_ns);
    } catch (const RecordError& e) {
      files_failed = true;
      notes.push_back("The data files end at " + seconds(sample.time_ns) + ". " + e.what());
      throw;
    }
  }
};

RunRecord::RunRecord(RunInfo info, fs::path directory, RecorderOptions options)
    : impl_(std::make_unique<Impl>(std::move(info), std::move(directory), std::move(options))) {}
RunRecord::~RunRecord() = default;
RunRecord::RunRecord(RunRecord&&) noexcept = default;
RunRecord& RunRecord::operator=(RunRecord&&) noexcept = default;

bool RunRecord::due(std::int64_t time_ns) noexcept {
  impl_->look(time_ns);
  return impl_->cadence.due(time_ns) || impl_->page.due(time_ns) || impl_->went_back_from_ns;
}

void RunRecord::add(const Sample& sample) {
  Impl& r = *impl_;
  r.look(sample.time_ns);
  if (const auto from_ns = std::exchange(r.went_back_from_ns, std::nullopt)) r.start_over(*from_ns, sample.time_ns);
  if (r.page.due(sample.time_ns)) r.page.add(sample);
  if (!r.files_failed && r.cadence.due(sample.time_ns)) r.write_files(sample);
}

fs::path RunRecord::finish(const std::vector<Statistic>& summary, std::string_view note) {
  Impl& r = *impl_;
  PageText text{r.options.title.empty() ? r.info.world : r.options.title, summary, r.notes};
  if (!note.empty()) text.notes.emplace_back(note);
  // First what is small and makes the data whole; whatever fails, the rest is done all the same.
  std::exception_ptr failed;
  const auto do_it = [&failed](auto&& what) {
    try {
      what();
    } catch (const RecordError&) {
      if (!failed) failed = std::current_exception();
    }
  };
  do_it([&] { r.log.close(); });
  do_it([&] { r.files.close(); });
  fs::path file;
  do_it([&] {
    if (!r.without_page.empty()) return;
    page::write(r.directory / "replay.html", r.page_template, r.page.json(r.info, text));
    file = r.directory / "replay.html";
  });
  r.files.release();
  if (failed) std::rethrow_exception(failed);
  return file;
}

const std::string& RunRecord::without_page() const { return impl_->without_page; }

std::vector<fs::path> RunRecord::files() const {
  std::vector<fs::path> all = impl_->files.files();
  all.push_back(impl_->log.file());
  return all;
}

}  // namespace vsa::record
