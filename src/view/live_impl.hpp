// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// LiveView's insides: what belongs to the server's thread, what to the loop's, and what lies between under the mutex.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "recordings.hpp"
#include "texts.hpp"
#include "vsa/errors.hpp"
#include "vsa/view/frame.hpp"
#include "vsa/view/live_view.hpp"
#include "vsa/view/request.hpp"

namespace vsa::view {

/// Simulated by wall time over the last moments.
class Factor {
 public:
  double update(double sim_s) {
    const auto now = Clock::now();
    if (now - since_ >= kOver || sim_s < sim_s_) {
      const double wall_s = std::chrono::duration<double>(now - since_).count();
      value_ = sim_s > sim_s_ ? (sim_s - sim_s_) / wall_s : 0;
      since_ = now;
      sim_s_ = sim_s;
    }
    return value_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kOver{300};
  Clock::time_point since_ = Clock::now();
  double sim_s_ = 0, value_ = 0;
};

struct LiveView::Impl final : Host {
  Impl(host::Simulation& the_world, motion::Gait* the_gait, seat::RunControl* the_control, LiveOptions options);

  // The server's thread
  std::optional<Download> get(std::string_view path) override;
  std::string greet(ViewerId viewer) override;
  std::string hear(ViewerId viewer, std::string_view text, bool& next) override;
  void gone(ViewerId viewer) override;
  bool ask(ViewerId viewer, Request request, std::size_t limit);

  // The loop's
  void serve();
  void publish(bool now);
  void changed();
  void collect();
  void sample();
  void set_pulls();
  template <class Work>
  void guarded(Work&& work);
  void operator()(const Play&) { control->request({false, false, 0, std::nullopt}); }
  void operator()(const Pause&) { control->request({false, true, 0, std::nullopt}); }
  void operator()(const Step& r) { control->request({false, true, r.steps, std::nullopt}); }
  void operator()(const Reset&) { control->request({true, std::nullopt, 0, std::nullopt}); }
  void operator()(const Speed& r) { speed = r.factor, ++speed_changes; }
  struct Actuator {
    std::string name, model;  ///< model: top-level
    std::size_t robot = 0, index = 0;
  };
  [[nodiscard]] static std::vector<Actuator> actuators_of(const host::Simulation& world);
  void operator()(const Command& r);
  void operator()(const PullLink& r);
  void operator()(const Release&);
  void operator()(const Record& r);
  void operator()(const ChangeGait& r) { gait->change(r.to, world.time_s()); }
  void operator()(const PlayGait& r) { r.on ? gait->resume(world.time_s()) : gait->hold(world.time_s()); }
  void operator()(const GiveBack&);
  void operator()(const Next&) {}

  host::Simulation& world;
  motion::Gait* gait;
  seat::RunControl* control;
  const Rules rules;
  const std::vector<Actuator> actuators;
  const std::string page;
  const std::string run = std::to_string(std::chrono::system_clock::now().time_since_epoch().count());  ///< unlike any other's
  std::vector<std::string> gait_names;  ///< one per actuator; empty: not the gait's
  Recordings recordings;
  std::vector<std::string> failed;  // of them, each with its reason
  FrameMaker frames;
  Factor factor;
  std::optional<double> speed;
  std::uint64_t speed_changes = 0;
  bool stands = false;  ///< a world without control
  std::map<ViewerId, scene::Pull> pulls;
  ViewerId asking = 0;  ///< whose request is being done

  std::mutex mutex;
  std::deque<std::pair<ViewerId, Request>> requests;
  std::string state;
  std::atomic<bool> pending{false};
  std::unique_ptr<Server> server;  ///< last: its thread uses the rest
};

/// What fails is told to who asked for it.
template <class Work>
void LiveView::Impl::guarded(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    server->tell(asking, plain_text("error", error.what()));
  } catch (const record::RecordError& error) {
    server->tell(asking, plain_text("error", error.what()));
  }
}

}  // namespace vsa::view
