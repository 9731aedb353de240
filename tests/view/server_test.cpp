// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/view/server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#include "client.hpp"
#include "vsa/errors.hpp"

namespace vsa::view::testing {
namespace {

/// Echoes what it hears.
struct Echo : Host {
  std::optional<Download> get(std::string_view path) override {
    if (path == "/") return Download{"text/html", "", "<p>page</p>"};
    if (path == "/file") return Download{"text/html", "run.html", "content"};
    return std::nullopt;
  }
  std::string greet(ViewerId) override { return "hello"; }
  std::string hear(ViewerId, std::string_view text, bool& next) override {
    next = text == kNext;
    ++heard;
    return next ? "" : std::string(text);
  }
  void gone(ViewerId) override { ++left; }
  std::atomic<int> heard{0}, left{0};
};

std::shared_ptr<const std::string> frame(const std::string& text) { return std::make_shared<const std::string>(text); }
std::string without_count(const std::string& message) { return message.substr(4); }
std::uint32_t missed(const std::string& message) {
  std::uint32_t out = 0;
  std::memcpy(&out, message.data(), sizeof out);
  return out;
}
bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

TEST(Server, ServesItsPagesToLoopbackNamesOnly) {
  Echo host;
  Server server(host, {});
  const std::uint16_t port = server.port();
  EXPECT_EQ(server.url(), "http://127.0.0.1:" + std::to_string(port) + "/");
  for (const std::string& name : {own_host(port), std::string("localhost:9"), std::string("LocalHost")}) {
    const std::string answer = get(port, "/", name);
    EXPECT_TRUE(begins(answer, "HTTP/1.1 200 ")) << name << answer;
    EXPECT_NE(answer.find("<p>page</p>"), std::string::npos);
    EXPECT_NE(answer.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  }
  for (const std::string name :
       {"evil.example", "evil.example:80", "127.0.0.1.evil.example", "localhost:", "localhost:x", "", "[::1]"}) {
    EXPECT_TRUE(begins(get(port, "/", name), "HTTP/1.1 403 ")) << name;
  }
  EXPECT_TRUE(begins(get(port, "/other"), "HTTP/1.1 404 "));
  EXPECT_TRUE(begins(get(port, "/", own_host(port), "POST"), "HTTP/1.1 405 "));
  for (const std::string path : {"/", "/other"}) {
    const std::string answer = get(port, path, own_host(port), "HEAD");
    EXPECT_EQ(answer.substr(answer.find("\r\n\r\n")), "\r\n\r\n") << path << ": no body";
    EXPECT_EQ(answer.find("Content-Length: 0"), std::string::npos) << path;
  }
  EXPECT_NE(get(port, "/file").find("attachment; filename=\"run.html\""), std::string::npos);
}

TEST(Server, ConnectsOnlyThePageThatItGaveOut) {
  Echo host;
  Server server(host, {});
  const std::string own = own_host(server.port());
  for (const std::string origin :
       {"http://evil.example", "null", "", "https://127.0.0.1", "http://localhost:1", "http://127.0.0.1"}) {
    Client client(server.port(), origin);
    EXPECT_FALSE(client.open) << origin;
  }
  EXPECT_FALSE(Client(server.port(), "https://" + own).open);
  Client page(server.port(), "http://" + own);
  ASSERT_TRUE(page.open);
  EXPECT_EQ(page.hear(), "hello");
  Client program(server.port());
  EXPECT_TRUE(program.open) << "a program of this machine has no origin";
}

TEST(Server, AnswersItsViewersInTurn) {
  Echo host;
  Server server(host, {});
  Client a(server.port()), b(server.port());
  EXPECT_EQ(a.hear(), "hello");
  EXPECT_EQ(b.hear(), "hello");
  for (const std::string text : {"one", "two", "three"}) a.say(text);
  for (const std::string text : {"one", "two", "three"}) EXPECT_EQ(a.hear(), text);
  server.tell("to all");
  EXPECT_EQ(a.hear(), "to all");
  EXPECT_EQ(b.hear(), "to all");
}

TEST(Server, AsksForFramesOnlyWhileSomebodyWouldGetThem) {
  Echo host;
  ServerOptions options;
  options.rate_Hz = 1000;
  Server server(host, options);
  EXPECT_FALSE(server.wanted());
  Client viewer(server.port());
  viewer.hear();
  for (const std::string text : {"one", "two"}) {
    ASSERT_TRUE(eventually([&] { return server.wanted(); }));
    server.show(frame(text));
    EXPECT_EQ(without_count(viewer.hear(true).value_or("none")), text);
  }
  // Two are under way and none is asked for.
  while (server.wanted()) {
  }
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(server.wanted());
  viewer.say(kNext);
  EXPECT_TRUE(eventually([&] { return server.wanted(); }));
}

TEST(Server, GivesASlowViewerFewerFramesAndTheNewestAndLetsNobodyWait) {
  Echo host;
  Server server(host, {});
  Client slow(server.port()), quick(server.port());
  slow.hear();
  quick.hear();
  constexpr int kFrames = 500;
  const std::string padding(100, '.');
  for (int i = 1; i <= kFrames; ++i) {
    server.show(frame(std::to_string(i) + padding));
    const std::string got = quick.hear(true).value_or("");
    ASSERT_EQ(std::stoi(without_count(got)), i) << "the quick one gets every frame";
    EXPECT_EQ(missed(got), 0U);
    quick.say(kNext);
    ASSERT_TRUE(eventually([&] { return host.heard == i; }));
  }
  EXPECT_EQ(std::stoi(without_count(slow.hear(true).value_or(""))), 1);
  EXPECT_EQ(std::stoi(without_count(slow.hear(true).value_or(""))), 2);
  slow.say(kNext);
  ASSERT_TRUE(eventually([&] { return host.heard == kFrames + 1; }));
  server.show(frame(std::to_string(kFrames + 1)));
  const std::string newest = slow.hear(true).value_or("");
  EXPECT_EQ(std::stoi(without_count(newest)), kFrames + 1);
  EXPECT_EQ(missed(newest), static_cast<std::uint32_t>(kFrames - 2));
  EXPECT_EQ(server.counts().dropped, static_cast<std::uint64_t>(kFrames - 2));
}

TEST(Server, ShowsTheNewestFrameToANewViewer) {
  Echo host;
  Server server(host, {});
  server.show(frame("old"));
  server.show(frame("new"));
  ASSERT_TRUE(eventually([&] {
    Client viewer(server.port());
    return without_count(viewer.hear(true).value_or("none")) == "new";
  }));
}

TEST(Server, EndsAViewerThatSendsTooMuchOrNoText) {
  Echo host;
  ServerOptions options;
  options.message_max = 100;
  Server server(host, options);
  Client fits(server.port()), large(server.port()), binary(server.port());
  for (Client* c : {&fits, &large, &binary}) c->hear();
  large.say(std::string(101, 'x'));
  EXPECT_EQ(large.hear(), std::nullopt);
  binary.say_binary("abc");
  EXPECT_EQ(binary.hear(), std::nullopt);
  fits.say(std::string(100, 'x'));
  EXPECT_EQ(fits.hear(), std::string(100, 'x'));
}

TEST(Server, EndsAViewerThatDoesntReadItsAnswers) {
  Echo host;
  Server server(host, {});
  Client deaf(server.port());
  deaf.hear();
  const std::string text(4000, 'x');
  std::thread talk([&] {
    for (int i = 0; i < 100'000 && host.left == 0; ++i) deaf.say(text);
  });
  EXPECT_TRUE(eventually([&] { return host.left > 0; }));
  talk.join();
  Client next(server.port());
  EXPECT_EQ(next.hear(), "hello");
}

TEST(Server, TakesNoMoreConnectionsThanItsLimit) {
  Echo host;
  ServerOptions options;
  options.connections_max = 3;
  Server server(host, options);
  {
    Client a(server.port()), b(server.port()), c(server.port());
    for (Client* viewer : {&a, &b, &c}) EXPECT_EQ(viewer->hear(), "hello");
    EXPECT_EQ(get(server.port(), "/"), "") << "one too many is closed without a word";
  }
  EXPECT_TRUE(eventually([&] { return begins(get(server.port(), "/"), "HTTP/1.1 200 "); }));
}

TEST(Server, SurvivesAThousandReconnects) {
  Echo host;
  Server server(host, {});
  for (int i = 0; i < 1000; ++i) {
    Client viewer(server.port());
    ASSERT_TRUE(viewer.open) << i;
    ASSERT_EQ(viewer.hear(), "hello") << i;
    if (i % 3 == 0) viewer.leave();
    if (i % 3 == 1) {
      viewer.below().set_option(asio::socket_base::linger(true, 0));
      viewer.below().close();
    }
    server.show(frame("x"));
  }
  EXPECT_TRUE(eventually([&] { return server.counts().viewers_now == 0; }));
  EXPECT_EQ(server.counts().viewers, 1000U);
  EXPECT_EQ(host.left, 1000);
  Client last(server.port());
  EXPECT_EQ(last.hear(), "hello");
}

TEST(Server, SurvivesRandomBytesBeforeAndAfterTheHandshake) {
  Echo host;
  Server server(host, {});
  std::mt19937 dice(3);
  const auto bytes = [&](std::size_t n) {
    std::string out(n, '\0');
    for (char& c : out) c = static_cast<char>(dice());
    return out;
  };
  const std::string start = "GET /live HTTP/1.1\r\nHost: " + own_host(server.port()) +
                            "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  for (int i = 0; i < 600; ++i) {
    Socket socket(server.port());
    std::string text = bytes(dice() % 4000);
    if (i % 3 == 1) {
      text = start + "X: " + bytes(20) + "\r\n\r\n" + bytes(50);
      for (std::size_t k = dice() % 5; k > 0; --k) text[dice() % text.size()] = static_cast<char>(dice());
    }
    if (i % 3 == 2) socket.upgrade(start + "\r\n");
    socket.write(text);
    if (i % 2 == 0) {
      Error ignored;
      socket.tcp_socket.shutdown(Tcp::socket::shutdown_send, ignored);
      socket.read_all();
    } else {
      socket.abort();
    }
  }
  // Masked frames with lengths that lie: 2⁶³ − 1 bytes, and one byte more than allowed.
  for (const std::string& length : {std::string("\xff\x7f\xff\xff\xff\xff\xff\xff\xff", 9), std::string("\xfe\x10\x01", 3)}) {
    Socket socket(server.port());
    socket.upgrade(start + "\r\n");
    socket.write("\x81" + length + "abcd" + bytes(100));
    socket.read_all();
  }
  Client viewer(server.port());
  EXPECT_EQ(viewer.hear(), "hello");
  EXPECT_TRUE(eventually([&] { return server.counts().viewers_now == 1; }));
}

TEST(Server, SaysWhyItCantHaveAPort) {
  Echo host;
  Server first(host, {});
  ServerOptions same;
  same.port = first.port();
  try {
    Server second(host, same);
    FAIL() << "two servers on one port";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--view-port = " + std::to_string(first.port())), std::string::npos) << error.what();
  }
}

TEST(Server, SaysAllThatItWasToldBeforeItSaysGoodbye) {
  for (int round = 0; round < 50; ++round) {
    Echo host;
    auto server = std::make_unique<Server>(host, ServerOptions{});
    Client page(server->port());
    page.hear();
    const std::string long_text(200'000, 'x');  // under way when the rest is said
    std::vector<std::string> heard;
    std::thread reading([&] {
      while (const auto text = page.hear()) heard.push_back(*text);
    });
    server->tell(long_text);
    server->tell("then");
    server->tell("last");
    server.reset();
    reading.join();
    ASSERT_EQ(heard.size(), 3U) << "round " << round;
    EXPECT_EQ(heard[0].size(), long_text.size());
    EXPECT_EQ(heard[2], "last");
  }
}

TEST(Server, SaysGoodbyeAndDoesntWaitForTheDeaf) {
  Echo host;
  auto server = std::make_unique<Server>(host, ServerOptions{});
  Client polite(server->port()), deaf(server->port());
  polite.hear();
  deaf.hear();
  std::thread reading([&] { EXPECT_EQ(polite.hear(), std::nullopt); });
  server.reset();
  reading.join();
}

}  // namespace
}  // namespace vsa::view::testing
