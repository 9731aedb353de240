// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A page and its live connection on this machine's loopback: HTTP/1.1 and WebSocket (Boost.Beast) in one thread of its own.
//
// Frames go one way: whoever makes them asks wanted(), which is one look at a flag, and hands a frame to show(), which puts it into
// a slot and returns. The server's thread sends the newest to every viewer that has asked for one; a viewer has at most two under
// way and asks for the next when it has drawn one, so a slow one gets fewer, newest ones, and nobody waits for it.
//
// Who may speak: connections to 127.0.0.1 only; a Host that isn't a loopback name (another name that points here: DNS rebinding) or
// a WebSocket whose Origin isn't this very page's gets 403. A message longer than message_max or not text ends its connection, and
// so does a viewer that doesn't read its answers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace vsa::view {

using ViewerId = std::uint64_t;  ///< tells viewers apart

/// What a path gives to a browser.
struct Download {
  std::string type;     ///< "text/html"
  std::string name;     ///< for the browser's folder; empty: shown
  std::string content;  ///< of any bytes
};

/// What the server serves. All of it is called in the server's thread.
class Host {
 public:
  virtual ~Host() = default;
  /// GET of a path ("/"); none: 404.
  virtual std::optional<Download> get(std::string_view path) = 0;
  /// First message to a viewer.
  virtual std::string greet(ViewerId viewer) = 0;
  /// A viewer's message; the answer, empty: none. `next` is set where the viewer asks for one more frame.
  virtual std::string hear(ViewerId viewer, std::string_view text, bool& next) = 0;
  virtual void gone(ViewerId viewer) = 0;  ///< its connection is closed
};

/// Where the server listens, and how much it takes.
struct ServerOptions {
  std::uint16_t port = 0;            ///< 0: any free one
  double rate_Hz = 60;               ///< frames a wall second at most
  std::size_t message_max = 4096;    ///< bytes of a viewer's message
  std::size_t connections_max = 64;  ///< connections at once
  std::size_t answers_max = 64;      ///< not yet read by a viewer
};

/// What a server has done since its start.
struct ServerCounts {
  std::uint64_t viewers_now = 0,  ///< now
      viewers = 0;                ///< since the start
  std::uint64_t frames = 0;       ///< shown by the maker
  std::uint64_t sent = 0;         ///< to viewers, summed
  std::uint64_t dropped = 0;      ///< for viewers that weren't ready, summed
  std::uint64_t refused = 0;      ///< connections: too many, wrong host or origin, no such page, no HTTP
};

/// A page and its live connections on this machine's loopback: HTTP and WebSocket in a thread of its own, which calls Host;
/// everything else may come from any.
class Server {
 public:
  /// Listens from here on. Throws InputError where the port can't be had. `host` must outlive it.
  Server(Host& host, const ServerOptions& options);
  /// Says goodbye to all viewers; a third of a second for those who don't listen.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] std::uint16_t port() const noexcept;  ///< that it listens on, which 0 left open
  [[nodiscard]] std::string url() const;              ///< "http://127.0.0.1:PORT/"

  /// True once for every frame that is due and that a viewer would get. Any thread.
  [[nodiscard]] bool wanted() noexcept;
  /// The newest frame: bytes after the four that count what this viewer missed (frame.hpp). Any thread.
  void show(std::shared_ptr<const std::string> frame);
  /// Text to all viewers, or to one. Any thread.
  void tell(std::string text);
  void tell(ViewerId viewer, std::string text);  ///< to one, if it is still there

  [[nodiscard]] ServerCounts counts() const;  ///< so far

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "localhost:8080" → the name's a loopback one. Any bytes.
[[nodiscard]] bool is_loopback_host(std::string_view host) noexcept;
/// Whether an Origin header is that of a page that this Host served: "http://" + host. Any bytes.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host) noexcept;

}  // namespace vsa::view
