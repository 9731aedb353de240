// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A browser's end of the connection, as small as can be, blocking. Who waits for what never comes is ended by the test's time
// limit.
#pragma once

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>

namespace vsa::view::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Error = boost::system::error_code;

inline std::string own_host(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

/// Until it holds; the processor goes to others meanwhile. False after five minutes.
inline bool eventually(const std::function<bool()>& holds) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  while (!holds()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    std::this_thread::yield();
  }
  return true;
}

struct Socket {
  asio::io_context io;
  Tcp::socket tcp_socket{io};
  explicit Socket(std::uint16_t port) { tcp_socket.connect({asio::ip::address_v4::loopback(), port}); }
  void write(const std::string& bytes) {
    Error ignored;
    asio::write(tcp_socket, asio::buffer(bytes), ignored);
  }
  /// Sends a handshake and waits for its answer.
  void upgrade(const std::string& request) {
    write(request);
    std::string head;
    Error ended;
    asio::read_until(tcp_socket, asio::dynamic_buffer(head), "\r\n\r\n", ended);
  }
  /// To the end of what the other side says.
  std::string read_all() {
    std::string out;
    Error ended;
    asio::read(tcp_socket, asio::dynamic_buffer(out), ended);
    return out;
  }
  /// Ends at once, without goodbye (RST).
  void abort() {
    tcp_socket.set_option(asio::socket_base::linger(true, 0));
    tcp_socket.close();
  }
};

inline std::string get(std::uint16_t port, const std::string& target, const std::string& host, const std::string& verb = "GET") {
  Socket socket(port);
  socket.write(verb + " " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
  return socket.read_all();
}
inline std::string get(std::uint16_t port, const std::string& target) { return get(port, target, own_host(port)); }

class Client {
 public:
  explicit Client(std::uint16_t port, std::optional<std::string> origin = std::nullopt) {
    beast::get_lowest_layer(socket_).connect({asio::ip::address_v4::loopback(), port});
    socket_.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      if (origin) request.set(http::field::origin, *origin);
    }));
    socket_.read_message_max(64U << 20U);
    Error error;
    socket_.handshake(own_host(port), "/live", error);
    open = !error;
  }

  void say(const std::string& text) {
    Error error;
    socket_.text(true);
    socket_.write(asio::buffer(text), error);
  }
  void say_binary(const std::string& bytes) {
    Error error;
    socket_.binary(true);
    socket_.write(asio::buffer(bytes), error);
  }
  /// The next message; none where the connection has ended.
  std::optional<std::string> hear() {
    beast::flat_buffer in;
    Error error;
    socket_.read(in, error);
    if (error) return std::nullopt;
    binary = socket_.got_binary();
    return beast::buffers_to_string(in.data());
  }
  /// The next text, or the next frame; what comes between is left out.
  std::optional<std::string> hear(bool frame) {
    for (;;) {
      auto message = hear();
      if (!message || binary == frame) return message;
    }
  }
  void leave() {
    Error error;
    socket_.close(websocket::close_code::normal, error);
  }
  Tcp::socket& below() { return beast::get_lowest_layer(socket_); }

  bool open = false, binary = false;

 private:
  asio::io_context io_;
  websocket::stream<Tcp::socket> socket_{io_};
};

inline constexpr const char* kNext = R"({"do":"next"})";

}  // namespace vsa::view::testing
