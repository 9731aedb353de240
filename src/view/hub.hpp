// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Who is there. Everything but `wanted` and the slot belongs to the server's thread.
#pragma once

#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "vsa/view/server.hpp"

namespace vsa::view {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Error = boost::system::error_code;
using Frame = std::shared_ptr<const std::string>;

class Viewer;

struct Hub {
  Hub(Host& the_host, const ServerOptions& the_options) : host(the_host), options(the_options) {}

  Host& host;
  ServerOptions options;
  std::map<ViewerId, std::weak_ptr<Viewer>> viewers;
  ViewerId last_id = 0;
  std::size_t connections = 0;
  bool ticking = false;
  std::atomic<bool> wanted{false};
  std::atomic<std::uint64_t> viewers_now{0}, viewers_ever{0}, frames{0}, sent{0}, dropped{0}, refused{0};
  std::mutex slot_mutex;
  Frame slot;           ///< put there by show(), under the mutex
  bool posted = false;  ///< deliver() is on its way, under the mutex
  Frame latest;
  // After what its handlers hold on to: they go with it, and viewers say goodbye to the map above.
  asio::io_context io{1};
  asio::steady_timer timer{io};

  void join(const std::shared_ptr<Viewer>& viewer);
  void leave(ViewerId id);
  void tick();
  void deliver();
  void tell(const std::string& text);
  void tell(ViewerId id, const std::string& text);
  void close_all();
};

/// Counts a connection for as long as it lives.
class Seat {
 public:
  explicit Seat(Hub& hub) : hub_(hub) { ++hub_.connections; }
  ~Seat() { --hub_.connections; }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

 private:
  Hub& hub_;
};

/// Reads one HTTP request, answers it or makes a viewer of its sender.
void greet_connection(Hub& hub, Tcp::socket socket);

class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  Viewer(Hub& hub, beast::tcp_stream stream, std::unique_ptr<Seat> seat);
  ~Viewer();
  void run(http::request<http::empty_body> upgrade);

  [[nodiscard]] bool ready() const noexcept { return open_ && credit_ > 0; }
  void send(const Frame& frame);
  void send(std::string text);
  void close();

  ViewerId id = 0;

 private:
  void read();
  void heard(std::size_t size);
  void write_next();
  void written(Error error);
  void drop();

  Hub& hub_;
  std::unique_ptr<Seat> seat_;
  websocket::stream<beast::tcp_stream> socket_;
  http::request<http::empty_body> upgrade_;
  beast::flat_buffer in_;
  std::deque<std::string> answers_;
  Frame frame_;  ///< to be written
  std::array<unsigned char, 4> missed_bytes_{};
  std::uint32_t missed_ = 0;
  int credit_ = 2;
  bool writing_ = false, open_ = false, closing_ = false;
  std::string text_under_way_;
  Frame frame_under_way_;
};

}  // namespace vsa::view
