// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world, its loop and pages together.
#include "vsa/view/live_view.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "record/scratch.hpp"
#include "view/client.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/page/page.hpp"

namespace vsa::view::testing {
namespace {

using nlohmann::json;
using record::Scratch;
using Next = seat::RunControl::Next;

std::filesystem::path model(const std::string& name) { return std::filesystem::path(VSA_SOURCE_DIR) / "models" / name; }

/// A world with its view, and the loop of `vsa run`.
struct Session {
  Scratch scratch;
  engine::World world;
  std::optional<motion::Gait> gait;
  seat::RunControl control;
  std::optional<LiveView> view;

  explicit Session(const std::string& name, const std::string& gait_name = "")
      : world(engine::World::load(model("worlds/" + name))) {
    if (!gait_name.empty()) gait = motion::Gait::load(model("gaits/" + gait_name));
    record::spew(scratch.path() / "page.html", std::string("<p>") + std::string(page::kMarker) + "</p>");
    LiveOptions options;
    options.server.rate_Hz = 1000;
    options.page_template = options.replay_template = scratch.path() / "page.html";
    options.records = scratch.path() / "records";
    view.emplace(world, gait ? &*gait : nullptr, &control, options);
  }
  [[nodiscard]] std::uint16_t port() const {
    const std::string url = view->url();
    return static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  }
  Next turn() {
    view->serve();
    const Next next = control.next(world.time_ns());
    if (next == Next::step) {
      if (gait) gait->apply(world);
      world.step();
      view->stepped();
    } else {
      if (next == Next::reset) world.reset();
      view->idle();
    }
    return next;
  }
  bool until(const std::function<bool()>& holds) {
    return eventually([&] {
      turn();
      return holds();
    });
  }
};

json text_of(Client& client, const std::string& type) {
  for (;;) {
    const auto text = client.hear(false);
    if (!text) return {};
    json out = json::parse(*text);
    if (out["type"] == type) return out;
  }
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T out{};
  std::memcpy(&out, bytes.data() + offset, sizeof out);
  return out;
}

TEST(LiveView, MakesNoFramesWhereNobodyLooks) {
  Session run("bench_free.sdf");
  for (int i = 0; i < 5000; ++i) run.turn();
  EXPECT_EQ(run.view->counts().frames, 0U);
}

TEST(LiveView, GreetsWithWhatThereIsToAskFor) {
  Session run("snake_flat.sdf", "sidewind.toml");
  Client page(run.port());
  const json hello = text_of(page, "hello");
  EXPECT_EQ(hello["offers"], (json{{"contacts", true}, {"control", true}, {"hands", true}}));
  ASSERT_EQ(hello["actuators"].size(), run.world.actuators().size());
  EXPECT_NEAR(hello["actuators"][0]["preset"][1], 0.785, 1e-12);
  EXPECT_GT(hello["actuators"][0]["equilibrium_rad"][1], 1.0);
  const json& gait = hello["state"]["gait"];
  EXPECT_EQ(gait["playing"], true);
  EXPECT_NEAR(gait["frequency_rad_per_s"], 4.71, 1e-12);
  EXPECT_EQ(gait["groups"].size(), 2U);
  EXPECT_NE(get(run.port(), "/").find("\"format\":2"), std::string::npos);
  EXPECT_NE(get(run.port(), "/?reload=1").find("\"format\":2"), std::string::npos);
}

TEST(LiveView, FramesHoldWhatTheWorldHolds) {
  Session run("snake_flat.sdf", "sidewind.toml");
  for (int i = 0; i < 300; ++i) run.turn();
  Client page(run.port());
  run.control.request({false, true, 0, std::nullopt});
  ASSERT_EQ(run.turn(), Next::wait);
  std::string frame;
  std::thread hearing([&] { frame = page.hear(true).value_or(""); });
  for (; run.view->counts().sent == 0;) run.turn();
  hearing.join();
  EXPECT_EQ(at<double>(frame, 4), run.world.time_s());
  EXPECT_EQ(at<std::uint32_t>(frame, 16), 1U | 4U) << "paused, gait";
  std::vector<engine::Pose> poses(run.world.links().size());
  run.world.poses(poses);
  std::size_t offset = 28;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (run.world.links()[i].is_static) continue;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(at<float>(frame, offset + 4 * k), static_cast<float>(poses[i].position[k]));
    offset += 28;
  }
  EXPECT_EQ(at<float>(frame, offset), static_cast<float>(run.world.read(run.world.actuators()[0]).shaft_rad));
  std::vector<engine::Contact> contacts;
  run.world.contacts(contacts);
  EXPECT_EQ(at<std::uint32_t>(frame, 20), contacts.size());
  EXPECT_GT(contacts.size(), 0U);
}

TEST(LiveView, CommandsAnActuatorAndItFollows) {
  Session run("bench_free.sdf");
  Client page(run.port());
  page.say(R"({"do":"command","actuators":[0],"equilibrium_rad":0.5,"preset":0.3})");
  const engine::ActuatorRef& joint = run.world.actuators()[0];
  ASSERT_TRUE(run.until([&] { return run.world.read(joint).equilibrium_command_rad == 0.5; }));
  run.world.run(2);
  EXPECT_NEAR(run.world.read(joint).shaft_rad, 0.5, 0.1);
  EXPECT_NEAR(run.world.read(joint).preset, 0.3, 0.02);
}

TEST(LiveView, RefusesWhatIsOutOfRangeAndDoesNothing) {
  Session run("bench_free.sdf");
  Client page(run.port());
  page.say(R"({"do":"command","actuators":[0],"equilibrium_rad":99,"preset":0.3})");
  EXPECT_NE(text_of(page, "error")["text"].get<std::string>().find("out of range"), std::string::npos);
  const double before = run.world.read(run.world.actuators()[0]).preset_command;
  for (int i = 0; i < 100; ++i) run.turn();
  EXPECT_EQ(run.world.read(run.world.actuators()[0]).preset_command, before);
}

TEST(LiveView, PausesStepsAndResets) {
  Session run("bench_free.sdf");
  Client page(run.port());
  page.say(R"({"do":"pause"})");
  ASSERT_TRUE(run.until([&] { return run.control.paused(); }));
  const std::int64_t stopped = run.world.time_ns();
  for (int i = 0; i < 100; ++i) EXPECT_EQ(run.turn(), Next::wait);
  page.say(R"({"do":"step","steps":3})");
  ASSERT_TRUE(run.until([&] { return run.world.time_ns() > stopped && run.control.paused(); }));
  EXPECT_EQ(run.world.time_ns() - stopped, 3 * std::llround(run.world.step_s() * 1e9));
  page.say(R"({"do":"reset"})");
  ASSERT_TRUE(run.until([&] { return run.world.time_ns() == 0; }));
  EXPECT_EQ(run.turn(), Next::wait) << "a reset leaves a paused world paused";
  page.say(R"({"do":"speed","factor":0.25})");
  ASSERT_TRUE(run.until([&] { return run.view->speed_changes() == 1; }));
  EXPECT_EQ(run.view->speed(), 0.25);
}

TEST(LiveView, AResetOfAPausedWorldIsNeverShownAsRunning) {
  Session run("bench_free.sdf");
  for (int i = 0; i < 100; ++i) run.turn();
  run.control.request({false, true, 0, std::nullopt});
  ASSERT_EQ(run.turn(), Next::wait);
  Client page(run.port());
  page.say(R"({"do":"reset"})");
  ASSERT_TRUE(eventually([&] { return run.view->serve(), run.control.next(run.world.time_ns()) == Next::reset; }));
  run.world.reset();
  run.view->idle();
  std::string frame;
  do frame = page.hear(true).value();
  while (at<double>(frame, 4) > 0);
  EXPECT_EQ(at<std::uint32_t>(frame, 16) & 1U, 1U) << "a page would ask a running world to pause, and stand";
}

TEST(LiveView, WhatIsAskedForAfterAResetIsForTheWorldThatWasReset) {
  Session run("bench_free.sdf");
  for (int i = 0; i < 100; ++i) run.turn();
  Client page(run.port());
  text_of(page, "hello");
  page.say(R"({"do":"reset"})");
  page.say(R"({"do":"command","actuators":[0],"equilibrium_rad":0.4})");
  page.say(R"({"do":"speed","factor":0.5})");
  page.say("nothing");
  ASSERT_EQ(text_of(page, "error")["type"], "error") << "answered at once, and in turn: the three before it wait for the loop";
  ASSERT_TRUE(run.until([&] { return run.view->speed_changes() == 1; }));
  for (int i = 0; i < 50; ++i) run.turn();
  EXPECT_LT(run.world.time_s(), 0.1) << "it was reset";
  EXPECT_EQ(run.world.read(run.world.actuators()[0]).equilibrium_command_rad, 0.4);
}

TEST(LiveView, MakesNoFramesOfAStandingWorldWhereNobodyLooks) {
  Session run("bench_free.sdf");
  run.control.request({false, true, 0, std::nullopt});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(run.turn(), Next::wait);
  EXPECT_EQ(run.view->counts().frames, 0U);
}

TEST(LiveView, PullsALinkUntilItsViewerLeaves) {
  Session run("snake_flat.sdf");
  for (int i = 0; i < 200; ++i) run.turn();
  std::size_t link = 0;
  while (run.world.links()[link].is_static) ++link;
  std::vector<engine::Pose> poses(run.world.links().size());
  const auto height = [&] {
    run.world.poses(poses);
    return poses[link].position[2];
  };
  const double before = height();
  {
    Client page(run.port());
    page.say(R"({"do":"pull","link":)" + std::to_string(link) + R"(,"point_m":[0,0,0],"target_m":[0,0,0.4]})");
    ASSERT_TRUE(run.until([&] { return !run.world.pulls().empty(); }));
    ASSERT_TRUE(run.until([&] { return height() > before + 0.1; }));
    Client other(run.port());
    other.say(R"({"do":"pull","link":)" + std::to_string(link) + R"(,"point_m":[0,0,0],"target_m":[0,0,0.3]})");
    ASSERT_TRUE(run.until([&] { return run.world.pulls().size() == 2; })) << "each viewer has a hand";
    other.say(R"({"do":"release"})");
    ASSERT_TRUE(run.until([&] { return run.world.pulls().size() == 1; }));
  }
  EXPECT_TRUE(run.until([&] { return run.world.pulls().empty(); })) << "the page was closed with its hand on the robot";
}

TEST(LiveView, RecordsAndServesTheReplayPage) {
  Session run("bench_free.sdf");
  Client page(run.port());
  text_of(page, "hello");
  page.say(R"({"do":"record","on":true})");
  ASSERT_TRUE(run.until([&] { return std::filesystem::exists(run.scratch.path() / "records/recording-001/energy.csv"); }));
  EXPECT_TRUE(text_of(page, "state")["recordings"]["now"].is_string());
  EXPECT_TRUE(get(run.port(), "/recordings/recording-001.html").rfind("HTTP/1.1 404", 0) == 0) << "not before it is whole";
  for (int i = 0; i < 500; ++i) run.turn();
  page.say(R"({"do":"record","on":false})");
  json done;
  std::thread hearing([&] {
    while (done.empty()) done = text_of(page, "state").at("recordings").at("done");
  });
  ASSERT_TRUE(run.until([&] { return get(run.port(), "/recordings/recording-001.html").rfind("HTTP/1.1 200", 0) == 0; }));
  hearing.join();
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0]["url"], "/recordings/recording-001.html");
  EXPECT_NE(get(run.port(), done[0]["url"]).find("\"frames\":"), std::string::npos);
  for (const std::string path :
       {"/recordings/../page.html", "/recordings/.html", "/recordings/recording-002.html", "/recordings/%2e%2e.html"}) {
    EXPECT_TRUE(get(run.port(), path).rfind("HTTP/1.1 404", 0) == 0) << path;
  }
  const auto rows = record::slurp(run.scratch.path() / "records/recording-001/energy.csv");
  EXPECT_GT(std::count(rows.begin(), rows.end(), '\n'), 40);
}

/// A recording whose page meets something in its place: a pipe that nobody reads, or what a test puts there.
struct StuckRecording {
  Session run{"bench_free.sdf"};
  Client page{run.port()};
  std::filesystem::path directory = run.scratch.path() / "records" / "recording-001", in_the_way = directory / "replay.html";

  bool begin() {
    page.say(R"({"do":"record","on":true})");
    return run.until([&] { return std::filesystem::exists(directory / "energy.csv"); });
  }
  bool begin_and_stop() {
    if (!begin() || ::mkfifo(in_the_way.c_str(), 0600) != 0) return false;
    page.say(R"({"do":"record","on":false})");
    return heard([](const json& r) { return r.at("now").is_null() && r.at("writing") == json::parse(R"(["recording-001"])"); });
  }
  /// Turns the loop until the page hears of such recordings.
  bool heard(const std::function<bool(const json&)>& such) {
    std::atomic<bool> so{false};
    std::thread hearing([&] {
      for (json state = text_of(page, "state"); !state.empty(); state = text_of(page, "state")) {
        if (such(state.at("recordings"))) break;
      }
      so = true;
    });
    const bool in_time = run.until([&] { return so.load(); });
    hearing.join();
    return in_time;
  }
};

TEST(LiveView, GoesOnWhileTheReplayPageIsWritten) {
  StuckRecording stuck;
  ASSERT_TRUE(stuck.begin_and_stop());
  const double stopped_s = stuck.run.world.time_s();
  for (int i = 0; i < 1000; ++i) stuck.run.turn();
  EXPECT_GE(stuck.run.world.time_s(), stopped_s + 0.5);
  EXPECT_TRUE(get(stuck.run.port(), "/recordings/recording-001.html").rfind("HTTP/1.1 404", 0) == 0);
  // The next recording doesn't wait either.
  stuck.page.say(R"({"do":"record","on":true})");
  EXPECT_TRUE(
      stuck.run.until([&] { return std::filesystem::exists(stuck.run.scratch.path() / "records/recording-002/energy.csv"); }));
  EXPECT_EQ(record::slurp(stuck.in_the_way).substr(0, 3), "<p>") << "the pipe gives way";
  EXPECT_TRUE(stuck.heard([](const json& r) { return r.at("writing").empty() && r.at("done").size() == 1; }));
  EXPECT_EQ(stuck.run.view->finish("").size(), 2U) << "and the end of the run waits for every page";
}

TEST(LiveView, TellsThatAReplayPageCouldNotBeWritten) {
  StuckRecording stuck;
  ASSERT_TRUE(stuck.begin());
  std::filesystem::create_directory(stuck.in_the_way);  // the page can't take its place
  stuck.page.say(R"({"do":"record","on":false})");
  std::string note;
  std::atomic<bool> told{false};
  std::thread hearing([&] {
    note = text_of(stuck.page, "note")["text"];
    told = true;
  });
  EXPECT_TRUE(stuck.run.until([&] { return told.load(); }));
  hearing.join();
  EXPECT_EQ(note.rfind("recording-001: ", 0), 0U) << note;
  EXPECT_NE(note.find("replay.html"), std::string::npos) << note;
  EXPECT_TRUE(stuck.run.view->finish("").empty());
  ASSERT_EQ(stuck.run.view->failed().size(), 1U) << "the run's own terminal tells, too";
  EXPECT_NE(stuck.run.view->failed()[0].find("replay.html"), std::string::npos);
}

TEST(LiveView, TellsWhyARecordingCantBegin) {
  Session run("bench_free.sdf");
  record::spew(run.scratch.path() / "records", "a file where a directory should be");
  Client page(run.port());
  page.say(R"({"do":"record","on":true})");
  std::string why;
  std::atomic<bool> told{false};
  std::thread hearing([&] {
    why = text_of(page, "error")["text"];
    told = true;
  });
  EXPECT_TRUE(run.until([&] { return told.load(); }));
  hearing.join();
  EXPECT_NE(why.find("records"), std::string::npos) << why;
}

TEST(LiveView, EditsTheGaitAndLeavesJointsToTheHand) {
  Session run("snake_flat.sdf", "sidewind.toml");
  Client page(run.port());
  json gait = text_of(page, "hello")["state"]["gait"];
  json edit = {{"do", "gait"}, {"frequency_rad_per_s", 6.0}, {"groups", gait["groups"]}};
  for (json& group : edit["groups"]) group.erase("actuators");
  edit["groups"][0]["amplitude_rad"] = 0.4;
  page.say(edit.dump());
  ASSERT_TRUE(run.until([&] { return run.gait->params().frequency_rad_per_s == 6.0; }));
  EXPECT_EQ(run.gait->params().groups[0].amplitude_rad, 0.4);
  EXPECT_EQ(text_of(page, "state")["gait"]["frequency_rad_per_s"], 6.0);

  page.say(R"({"do":"command","actuators":[3],"preset":0.1})");
  const auto reading = [&] { return run.world.read(run.world.actuators()[3]); };
  ASSERT_TRUE(run.until([&] { return reading().preset_command == 0.1; }));
  EXPECT_EQ(text_of(page, "state")["by_hand"][3], json::parse("[false,true]"));
  const double before = reading().equilibrium_command_rad;
  for (int i = 0; i < 200; ++i) run.turn();
  EXPECT_EQ(reading().preset_command, 0.1) << "the hand's";
  EXPECT_NE(reading().equilibrium_command_rad, before) << "the gait's";
  page.say(R"({"do":"give_back"})");
  EXPECT_TRUE(run.until([&] { return reading().preset_command != 0.1; }));

  page.say(R"({"do":"gait_play","on":false})");
  ASSERT_TRUE(run.until([&] { return run.gait->held(); }));
  for (int i = 0; i < 50; ++i) run.turn();
  const double held = reading().equilibrium_command_rad;
  for (int i = 0; i < 200; ++i) run.turn();
  EXPECT_EQ(reading().equilibrium_command_rad, held);
}

TEST(LiveView, TellsItsPagesWhyTheRunIsOver) {
  Session run("bench_free.sdf");
  Client page(run.port());
  text_of(page, "hello");
  run.view->finish("it blew up");
  EXPECT_EQ(text_of(page, "end")["text"], "it blew up");
}

}  // namespace
}  // namespace vsa::view::testing
