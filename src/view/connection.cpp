// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A connection's HTTP request: answered and closed, or upgraded.
#include <chrono>
#include <optional>

#include "hub.hpp"

namespace vsa::view {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kHeaderMax = 8192;
constexpr auto kRequestTime = 10s;
constexpr auto kAnswerTime = 30s;
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self' "
    "ws://127.0.0.1:* ws://localhost:*; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view_of(boost::string_view text) { return {text.data(), text.size()}; }

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Hub& hub, Tcp::socket socket) : hub_(hub), seat_(std::make_unique<Seat>(hub)), stream_(std::move(socket)) {
    parser_.header_limit(kHeaderMax);
    parser_.body_limit(0);
  }

  void run() {
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, in_, parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (!error) return self->answer();
      ++self->hub_.refused;
    });
  }

 private:
  using Response = http::response<http::string_body>;

  void answer() {
    const auto& request = parser_.get();
    const std::string_view host = view_of(request[http::field::host]);
    if (!is_loopback_host(host)) return refuse(http::status::forbidden, "This server answers to loopback names only.\n");
    if (websocket::is_upgrade(request)) return upgrade(host);
    const bool head = request.method() == http::verb::head;
    if (request.method() != http::verb::get && !head) return refuse(http::status::method_not_allowed, "GET only.\n");
    std::optional<Download> found = hub_.host.get(view_of(request.target()));
    if (!found) return refuse(http::status::not_found, "No such page.\n");
    Response response = blank(http::status::ok, found->type);
    if (!found->name.empty()) response.set(http::field::content_disposition, "attachment; filename=\"" + found->name + "\"");
    response.content_length(found->content.size());
    if (!head) response.body() = std::move(found->content);
    send(std::move(response));
  }

  void upgrade(std::string_view host) {
    const auto& request = parser_.get();
    const auto origin = request.find(http::field::origin);
    // A browser always tells; who doesn't is a program of this machine.
    if (origin != request.end() && !is_own_origin(view_of(origin->value()), host)) {
      return refuse(http::status::forbidden, "Only the page that this server gave out may connect.\n");
    }
    if (view_of(request.target()) != "/live") return refuse(http::status::not_found, "No such page.\n");
    std::make_shared<Viewer>(hub_, std::move(stream_), std::move(seat_))->run(parser_.release());
  }

  Response blank(http::status status, const std::string& type) {
    Response response{status, 11};
    response.set(http::field::content_type, type + "; charset=utf-8");
    response.set("Content-Security-Policy", kPolicy);
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.keep_alive(false);
    return response;
  }

  void refuse(http::status status, const char* why) {
    ++hub_.refused;
    Response response = blank(status, "text/plain");
    response.content_length(std::string_view(why).size());
    if (parser_.get().method() != http::verb::head) response.body() = why;
    send(std::move(response));
  }

  void send(Response response) {
    response_ = std::move(response);
    stream_.expires_after(kAnswerTime);
    http::async_write(stream_, response_, [self = shared_from_this()](Error, std::size_t) {
      Error ignored;
      self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    });
  }

  Hub& hub_;
  std::unique_ptr<Seat> seat_;
  beast::tcp_stream stream_;
  beast::flat_buffer in_{kHeaderMax};
  http::request_parser<http::empty_body> parser_;
  Response response_;
};

}  // namespace

void greet_connection(Hub& hub, Tcp::socket socket) { std::make_shared<Connection>(hub, std::move(socket))->run(); }

bool is_loopback_host(std::string_view host) noexcept {
  std::string_view port;
  if (const std::size_t colon = host.rfind(':'); colon != std::string_view::npos) {
    port = host.substr(colon + 1);
    host = host.substr(0, colon);
    if (port.empty() || port.size() > 5 || port.find_first_not_of("0123456789") != std::string_view::npos) return false;
  }
  const auto same = [](std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
      if (lower(a[i]) != b[i]) return false;
    }
    return a.size() == b.size();
  };
  return same(host, "localhost") || host == "127.0.0.1";
}

bool is_own_origin(std::string_view origin, std::string_view host) noexcept {
  constexpr std::string_view kScheme = "http://";
  return is_loopback_host(host) && origin.substr(0, kScheme.size()) == kScheme && origin.substr(kScheme.size()) == host;
}

}  // namespace vsa::view
