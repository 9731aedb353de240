// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The live page of a world that no engine of ours moves, without a loop's controls, a gait or hands.
#include <gtest/gtest.h>

#include <future>
#include <nlohmann/json.hpp>

#include "client.hpp"
#include "record/scratch.hpp"
#include "support/fake_simulation.hpp"
#include "vsa/page/page.hpp"
#include "vsa/view/live_view.hpp"

namespace vsa::view::testing {
namespace {

using nlohmann::json;

struct AnySimulation : ::testing::Test {
  AnySimulation() {
    record::spew(scratch.path() / "page.html", std::string(page::kMarker));
    LiveOptions options;
    options.server.rate_Hz = 1000;
    options.page_template = options.replay_template = scratch.path() / "page.html";
    options.records = scratch.path() / "records";
    view.emplace(world, nullptr, nullptr, options);
    const std::string url = view->url();
    client.emplace(static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1))));
    hello = json::parse(client->hear(false).value());
  }
  void turn() {
    view->serve();
    world.step();
    view->stepped();
  }
  /// While the world goes on.
  std::string next(bool frame) {
    auto heard = std::async(std::launch::async, [&] { return client->hear(frame).value_or(""); });
    while (heard.wait_for(std::chrono::seconds(0)) != std::future_status::ready) turn();
    return heard.get();
  }

  record::Scratch scratch;
  test::FakeSimulation world;
  std::optional<LiveView> view;
  std::optional<Client> client;
  json hello;
};

TEST_F(AnySimulation, TellsPagesWhatTheyMayOffer) {
  EXPECT_EQ(hello["offers"], (json{{"contacts", false}, {"control", false}, {"hands", false}}));
  EXPECT_EQ(hello["actuators"].size(), 1u);
  EXPECT_TRUE(hello["state"]["gait"].is_null());
}

TEST_F(AnySimulation, TakesCommandsAndRefusesToPause) {
  client->say(R"({"do":"command","actuators":[0],"equilibrium_rad":0.5})");
  client->say(R"({"do":"pause"})");
  const json error = json::parse(next(false));
  EXPECT_EQ(error["type"], "error");
  EXPECT_NE(error["text"].get<std::string>().find("simulator's own"), std::string::npos);
  EXPECT_TRUE(eventually([&] { return turn(), world.robot(0).read(0).equilibrium_command_rad == 0.5; }));
}

TEST_F(AnySimulation, ShowsThatItStands) {
  const auto paused = [](const std::string& frame) { return (frame.at(16) & 1) != 0; };  // behind u32, f64, f32
  EXPECT_FALSE(paused(next(true)));
  client->say(kNext);
  client->say(kNext);
  auto heard = std::async(std::launch::async, [&] {
    std::string frame;
    do {
      frame = client->hear(true).value();
      client->say(kNext);
    } while (!paused(frame));
    return true;
  });
  while (heard.wait_for(std::chrono::seconds(0)) != std::future_status::ready) view->standing();
  EXPECT_TRUE(heard.get());
}

}  // namespace
}  // namespace vsa::view::testing
