// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/view/server.hpp"

#include <boost/asio/post.hpp>
#include <chrono>
#include <thread>

#include "hub.hpp"
#include "vsa/errors.hpp"

namespace vsa::view {
namespace {

using namespace std::chrono_literals;
constexpr auto kLook = 10ms;
constexpr int kLooks = 33;  // at viewers that haven't gone yet
constexpr auto kRetryAccept = 100ms;

}  // namespace

struct Server::Impl {
  Impl(Host& host, const ServerOptions& options) : hub(host, options) {}

  void listen();
  void accept();
  void end();
  void farewell(int looks);

  Hub hub;
  Tcp::acceptor acceptor{hub.io};
  asio::steady_timer pause{hub.io};
  std::uint16_t port = 0;
  std::thread thread;
};

void Server::Impl::listen() {
  const auto fail = [&](const Error& error) {
    throw InputError(Problem{"", "--view-port", std::to_string(hub.options.port), "can't listen there: " + error.message(),
                             "a free port, or 0 for any"});
  };
  Error error;
  acceptor.open(Tcp::v4(), error);
  if (error) fail(error);
  acceptor.set_option(asio::socket_base::reuse_address(true), error);
  acceptor.bind({asio::ip::address_v4::loopback(), hub.options.port}, error);
  if (error) fail(error);
  acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) fail(error);
  port = acceptor.local_endpoint().port();
}

void Server::Impl::accept() {
  acceptor.async_accept([this](Error error, Tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // out of file descriptors, say: a moment later there may be one
      pause.expires_after(kRetryAccept);
      return pause.async_wait([this](Error stopped) {
        if (!stopped) accept();
      });
    }
    if (hub.connections < hub.options.connections_max) {
      greet_connection(hub, std::move(socket));
    } else {
      ++hub.refused;
    }
    accept();
  });
}

void Server::Impl::end() {
  Error ignored;
  acceptor.close(ignored);
  pause.cancel();
  hub.close_all();
  farewell(0);
}

void Server::Impl::farewell(int looks) {
  if (hub.connections == 0 || looks >= kLooks) return hub.io.stop();
  pause.expires_after(kLook);
  pause.async_wait([this, looks](Error) { farewell(looks + 1); });
}

Server::Server(Host& host, const ServerOptions& options) : impl_(std::make_unique<Impl>(host, options)) {
  impl_->listen();
  impl_->accept();
  impl_->thread = std::thread([this] { impl_->hub.io.run(); });
}

Server::~Server() {
  asio::post(impl_->hub.io, [this] { impl_->end(); });
  impl_->thread.join();
}

std::uint16_t Server::port() const noexcept { return impl_->port; }
std::string Server::url() const { return "http://127.0.0.1:" + std::to_string(impl_->port) + "/"; }

bool Server::wanted() noexcept {
  std::atomic<bool>& flag = impl_->hub.wanted;
  return flag.load(std::memory_order_relaxed) && flag.exchange(false);
}

void Server::show(std::shared_ptr<const std::string> frame) {
  Hub& hub = impl_->hub;
  ++hub.frames;
  {
    const std::lock_guard lock(hub.slot_mutex);
    hub.slot = std::move(frame);
    if (std::exchange(hub.posted, true)) return;
  }
  asio::post(impl_->hub.io, [&hub] { hub.deliver(); });
}

void Server::tell(std::string text) {
  asio::post(impl_->hub.io, [this, text = std::move(text)] { impl_->hub.tell(text); });
}

void Server::tell(ViewerId viewer, std::string text) {
  asio::post(impl_->hub.io, [this, viewer, text = std::move(text)] { impl_->hub.tell(viewer, text); });
}

ServerCounts Server::counts() const {
  const Hub& hub = impl_->hub;
  return {hub.viewers_now, hub.viewers_ever, hub.frames, hub.sent, hub.dropped, hub.refused};
}

}  // namespace vsa::view
