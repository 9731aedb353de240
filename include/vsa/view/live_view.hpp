// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A running world in any number of browsers: what pages ask for is checked in the server's thread, queued, and done by the run's
// own loop between two steps; what the world does goes out as frames (frame.hpp), made only when a viewer would get one.
//
//   while (…) { view.serve();  …  world.step();  view.stepped(); }
//
// Texts to pages are JSON objects by "type":
//   hello  once, first: what tells this run from others, what can be asked for, limits of every actuator, the gait's bounds, and
//          all that `state` has
//   state  whenever it changes: speed, gait (playing, values, what is commanded by hand), recording, recordings
//   error  what a page asked for was refused; it alone hears of it
//   note   something all should know
//   end    the run is over, with the reason
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "vsa/host/simulation.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/seat/run_control.hpp"
#include "vsa/view/server.hpp"

namespace vsa::view {

/// A live view's server, pages and pace.
struct LiveOptions {
  ServerOptions server;                   ///< port and limits
  std::filesystem::path page_template;    ///< empty: data_directory()/web/live.html
  std::filesystem::path replay_template;  ///< of recordings; empty: data_directory()/web/replay.html
  std::filesystem::path records = ".";    ///< where recordings go: a new directory recording-001, … each
  std::optional<double> speed = 1.0;      ///< at the start
};

/// A running world in any number of browsers: does what pages ask for between two steps, and shows them frames. World, gait and
/// control must outlive it. All but the pages' side belongs to the loop's thread. A page offers what there is: no gait, no play,
/// pause, step, reset and speed without `control`, no hands where the world has none.
class LiveView {
 public:
  /// Throws InputError: no such template, no such port. `gait` and `control` may be null.
  LiveView(host::Simulation& world, motion::Gait* gait, seat::RunControl* control, LiveOptions options);
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  [[nodiscard]] std::string url() const;      ///< of the page, with its port
  [[nodiscard]] ServerCounts counts() const;  ///< of viewers and frames so far

  /// Does what pages asked for. Before every decision of the loop.
  void serve();
  void stepped();   ///< after every step
  void idle();      ///< while paused, and after a reset
  void standing();  ///< now and then while a simulator that has no RunControl is paused

  /// Simulated by wall time that pages want; none: as fast as it can. `speed_changes` counts, so that a pace can be set anew.
  [[nodiscard]] std::optional<double> speed() const noexcept;
  [[nodiscard]] std::uint64_t speed_changes() const noexcept;  ///< how often pages have set the pace

  /// Ends a recording under way and tells the pages why the run is over. Returns the recordings' pages.
  std::vector<std::filesystem::path> finish(const std::string& why);
  [[nodiscard]] const std::vector<std::string>& failed() const noexcept;  ///< recordings that came to nothing, each with its reason

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::view
