// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "model_watch.hpp"

#include <utility>

#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"

namespace vsa::plugins {
namespace {

/// Told of the element that ordered it.
InputError of_element(const InputError& error, const std::string& where, const std::string& key, const std::string& value) {
  std::vector<Problem> out;
  for (const Problem& p : error.problems()) {
    const std::string at = p.file.empty() || p.file == value ? "" : p.file + ": ";
    out.push_back({where, key, '"' + value + '"', at + p.message, p.allowed});
  }
  return InputError(std::move(out));
}

}  // namespace

std::unique_ptr<ModelWatch> ModelWatch::make(const std::string& where, const std::string& world, double step_s, seat::Seat& seat,
                                             const std::function<ModelLinks()>& links, Report report) {
  const host::RobotConfig& config = seat.robot().config();
  if (!config.record && !config.view_port) return nullptr;
  std::unique_ptr<ModelWatch> watch(new ModelWatch({world, step_s, seat, links()}, seat, std::move(report)));
  if (config.view_port) watch->start_view(where, *config.view_port);
  if (config.record) watch->start_record(where, *config.record);
  for (const std::string& notice : watch->scene_.warnings()) watch->report_(seat.model() + ": " + notice);
  return watch;
}

ModelWatch::ModelWatch(ModelScene scene, seat::Seat& seat, Report report)
    : seat_(seat), scene_(std::move(scene)), report_(std::move(report)) {}

void ModelWatch::start_record(const std::string& where, const host::RecordConfig& config) {
  directory_ = config.directory;
  record::RecorderOptions options;
  options.rate_Hz = config.rate_Hz;
  options.title = seat_.model();
  try {
    record_.emplace(record::describe(scene_), directory_, std::move(options));
  } catch (const InputError& error) {
    throw of_element(error, where, "record@directory", directory_);
  }
  report_(seat_.model() + ": recording into " + directory_);
  if (!record_->without_page().empty()) report_(seat_.model() + ": " + record_->without_page());
}

void ModelWatch::start_view(const std::string& where, std::uint16_t port) {
  view::LiveOptions options;
  options.server.port = port;
  options.page_template = config::find_data("web/live.html").value_or("");
  options.replay_template = config::find_data("web/replay.html").value_or("");
  try {
    view_.emplace(scene_, nullptr, nullptr, std::move(options));
  } catch (const InputError& error) {
    throw of_element(error, where, "view@port", std::to_string(port));
  }
  report_(seat_.model() + ": live view: " + view_->url());
}

void ModelWatch::before_step(std::int64_t time_ns) {
  scene_.set_time(time_ns);
  seat_.observe();
  if (record_ && record_->due(time_ns)) {
    record::read(scene_, sample_);
    try {
      record_->add(sample_);
    } catch (const record::RecordError& error) {
      report_(seat_.model() + ": the recording ended: " + error.what());
      end_record();
    }
  }
  if (!view_) return;
  view_->serve();
  view_->stepped();
}

void ModelWatch::paused() {
  if (!view_) return;
  view_->serve();
  view_->standing();
}

/// Once; told, not thrown: it belongs to a destructor.
void ModelWatch::end_record() noexcept {
  if (!record_) return;
  if (sample_.actuators.empty()) return record_.reset();  // no step was made: there is nothing for a page
  try {
    const auto page = record_->finish({}, "");
    if (!page.empty()) report_(seat_.model() + ": " + page.string());
  } catch (const std::exception& error) {
    report_(seat_.model() + ": the recording isn't whole: " + error.what());
  }
  record_.reset();
}

ModelWatch::~ModelWatch() {
  end_record();
  if (view_) static_cast<void>(view_->finish("The simulator has ended."));
}

}  // namespace vsa::plugins
