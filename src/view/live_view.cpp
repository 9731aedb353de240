// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/view/live_view.hpp"

#include <algorithm>
#include <iterator>

#include "live_impl.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/page/page.hpp"
#include "vsa/record/page.hpp"
#include "vsa/record/recorder.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::view {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRequestsMax = 256;  // that wait for the loop
constexpr std::string_view kRecordings = "/recordings/", kHtml = ".html";

fs::path or_built_in(const fs::path& given, const char* name) {
  return given.empty() ? config::data_directory() / "web" / name : given;
}

std::string page_of(const host::Simulation& world, const fs::path& file) {
  const record::RunInfo info = record::describe(world);
  record::PageData data(info, 1, 2);
  record::Sample first;
  record::read(world, first);
  data.add(first);
  return page::filled(page::read_template(file), data.json(info, {world.name(), {}, world.warnings()}));
}

}  // namespace

LiveView::Impl::Impl(host::Simulation& the_world, motion::Gait* the_gait, seat::RunControl* the_control, LiveOptions options)
    : world(the_world),
      gait(the_gait),
      control(the_control),
      rules(rules_of(the_world, the_gait, the_control != nullptr)),
      actuators(actuators_of(the_world)),
      page(page_of(the_world, or_built_in(options.page_template, "live.html"))),
      gait_names(rules.actuators.size()),
      recordings(std::move(options.records), or_built_in(options.replay_template, "replay.html")),
      frames(record::describe(the_world)),
      speed(options.speed) {
  const auto is_the_gaits = [&](const std::string& name) {
    const auto named = [&](const Actuator& a) { return a.name == name || a.model + '/' + a.name == name; };
    const auto at = std::find_if(actuators.begin(), actuators.end(), named);
    if (at != actuators.end()) gait_names[static_cast<std::size_t>(at - actuators.begin())] = name;
  };
  const motion::GaitParams none, &params = gait != nullptr ? gait->params() : none;
  for (const motion::GaitGroup& group : params.groups)
    for (const std::string& name : group.actuators) is_the_gaits(name);
  for (const motion::MotionTrack& track : params.motion ? params.motion->tracks : std::vector<motion::MotionTrack>{})
    is_the_gaits(track.actuator);
  changed();
  server = std::make_unique<Server>(*this, options.server);
}

std::vector<LiveView::Impl::Actuator> LiveView::Impl::actuators_of(const host::Simulation& world) {
  std::vector<Actuator> out;
  for (std::size_t r = 0; r < world.robot_count(); ++r) {
    const std::string& model = world.robot_model(r);
    for (const host::ActuatorConfig& a : world.robot(r).config().actuators) {
      const std::size_t index = out.empty() || out.back().robot != r ? 0 : out.back().index + 1;
      out.push_back({a.name, std::string(outermost(model)), r, index});
    }
  }
  return out;
}

std::optional<Download> LiveView::Impl::get(std::string_view path) {
  path = path.substr(0, path.find_first_of("?#"));
  if (path == "/") return Download{"text/html", "", page};
  const bool recording = path.size() > kRecordings.size() + kHtml.size() && path.substr(0, kRecordings.size()) == kRecordings &&
                         path.substr(path.size() - kHtml.size()) == kHtml;
  if (!recording) return std::nullopt;
  path.remove_prefix(kRecordings.size());
  path.remove_suffix(kHtml.size());
  return recordings.get(path);
}

std::string LiveView::Impl::greet(ViewerId) {
  const std::lock_guard lock(mutex);
  return hello_text(rules, run, state);
}

bool LiveView::Impl::ask(ViewerId viewer, Request request, std::size_t limit) {
  {
    const std::lock_guard lock(mutex);
    if (requests.size() >= limit) return false;
    requests.emplace_back(viewer, std::move(request));
    pending = true;
  }
  if (control != nullptr) control->wake();
  return true;
}

std::string LiveView::Impl::hear(ViewerId viewer, std::string_view text, bool& next) {
  Parsed parsed = parse_request(text, rules);
  if (!parsed.request) return plain_text("error", parsed.error);
  next = std::holds_alternative<Next>(*parsed.request);
  if (next || ask(viewer, std::move(*parsed.request), kRequestsMax)) return "";
  return plain_text("error", "too many requests at once: this one was not done");
}

void LiveView::Impl::gone(ViewerId viewer) { ask(viewer, Release{}, SIZE_MAX); }

/// Pages of recordings that are written by now.
void LiveView::Impl::collect() {
  std::vector<std::string> problems;
  if (!recordings.collect(problems)) return;
  for (const std::string& problem : problems) server->tell(plain_text("note", problem));
  failed.insert(failed.end(), problems.begin(), problems.end());
  changed();
}

void LiveView::Impl::serve() {
  collect();
  if (!pending.load(std::memory_order_relaxed)) return;
  std::deque<std::pair<ViewerId, Request>> now;
  {
    const std::lock_guard lock(mutex);
    now.swap(requests);
    pending = false;
  }
  if (world.hands().empty()) pulls.clear();  // a reset let go
  bool resets = false;
  while (!now.empty() && !resets) {
    const auto [viewer, request] = std::move(now.front());
    now.pop_front();
    asking = viewer;
    resets = std::holds_alternative<Reset>(request);
    guarded([&, &what = request] { std::visit(*this, what); });
  }
  if (!now.empty()) {  // what came after a reset is for the world that was reset
    const std::lock_guard lock(mutex);
    requests.insert(requests.begin(), std::make_move_iterator(now.begin()), std::make_move_iterator(now.end()));
    pending = true;
  }
  changed();
}

void LiveView::Impl::changed() {
  std::vector<motion::ByHand> hands;
  for (const std::string& name : gait_names) hands.push_back(name.empty() ? motion::ByHand{} : gait->by_hand(name));
  std::string text = state_text({speed, gait, std::move(hands), &recordings});
  {
    const std::lock_guard lock(mutex);
    if (text == state) return;
    state = text;
  }
  if (server) server->tell(std::move(text));
}

void LiveView::Impl::sample() {
  if (!recordings.running()) return;
  try {
    recordings.sample(world);
  } catch (const record::RecordError& error) {
    failed.emplace_back(error.what());
    server->tell(plain_text("note", std::string("The recording ended: ") + error.what()));
    guarded([&] { recordings.stop(world, error.what()); });
    changed();
  }
}

void LiveView::Impl::publish(bool now) {
  if (!server->wanted() && !(now && server->counts().viewers_now > 0)) return;
  const FrameInfo info{world.time_s(), factor.update(world.time_s()), control != nullptr ? control->paused() : stands,
                       recordings.running(), gait != nullptr && !gait->held()};
  server->show(frames.make(world, info));
}

LiveView::LiveView(host::Simulation& world, motion::Gait* gait, seat::RunControl* control, LiveOptions options)
    : impl_(std::make_unique<Impl>(world, gait, control, std::move(options))) {}
LiveView::~LiveView() = default;

std::string LiveView::url() const { return impl_->server->url(); }
ServerCounts LiveView::counts() const { return impl_->server->counts(); }
void LiveView::serve() { impl_->serve(); }
std::optional<double> LiveView::speed() const noexcept { return impl_->speed; }
std::uint64_t LiveView::speed_changes() const noexcept { return impl_->speed_changes; }

void LiveView::stepped() {
  impl_->stands = false;
  impl_->sample();
  impl_->publish(false);
}

void LiveView::idle() {
  impl_->sample();
  impl_->publish(true);
}

void LiveView::standing() {
  impl_->stands = true;
  impl_->publish(false);
}

const std::vector<std::string>& LiveView::failed() const noexcept { return impl_->failed; }

std::vector<fs::path> LiveView::finish(const std::string& why) {
  Impl& v = *impl_;
  if (v.recordings.running()) v.guarded([&] { v.recordings.stop(v.world, why); });
  v.recordings.wait();
  v.collect();
  v.changed();
  v.server->tell(plain_text("end", why.empty() ? "The run is over." : why));
  std::vector<fs::path> out;
  for (const Recordings::Done& one : v.recordings.done()) out.push_back(one.page);
  return out;
}

}  // namespace vsa::view
