// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One page's WebSocket: one read and one write under way at a time; answers go before frames.
#include <chrono>

#include "hub.hpp"

namespace vsa::view {
namespace {

using namespace std::chrono_literals;

constexpr auto kHandshake = 30s;
constexpr auto kSilence = 120s;  // a page that compiles its shaders on a busy machine is silent for long
constexpr int kFramesUnderWay = 2;
constexpr int kSendBuffer = 64 * 1024;  // small, so that what lies in the kernel is never old

}  // namespace

Viewer::Viewer(Hub& hub, beast::tcp_stream stream, std::unique_ptr<Seat> seat)
    : hub_(hub), seat_(std::move(seat)), socket_(std::move(stream)) {}

Viewer::~Viewer() {
  if (id != 0) hub_.leave(id);
}

void Viewer::run(http::request<http::empty_body> upgrade) {
  upgrade_ = std::move(upgrade);
  Error ignored;
  auto& tcp_socket = beast::get_lowest_layer(socket_).socket();
  tcp_socket.set_option(Tcp::no_delay(true), ignored);
  tcp_socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
  beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own clock
  socket_.set_option(websocket::stream_base::timeout{kHandshake, kSilence, true});
  socket_.read_message_max(hub_.options.message_max);
  socket_.async_accept(upgrade_, [self = shared_from_this()](Error error) {
    if (error) return;
    self->open_ = true;
    self->hub_.join(self);
    self->read();
  });
}

void Viewer::read() {
  socket_.async_read(in_, [self = shared_from_this()](Error error, std::size_t size) {
    if (error) return self->drop();
    self->heard(size);
  });
}

void Viewer::heard(std::size_t size) {
  if (!open_) return;
  if (!socket_.got_text()) return drop();
  bool next = false;
  const auto* data = static_cast<const char*>(in_.cdata().data());
  std::string answer = hub_.host.hear(id, {data, size}, next);
  in_.consume(size);
  if (next && credit_ < kFramesUnderWay) ++credit_;
  if (!answer.empty()) send(std::move(answer));
  if (open_) read();
}

void Viewer::send(const Frame& frame) {
  if (!open_ || closing_) return;
  if (frame_ || credit_ == 0) {
    ++missed_;  // this one, or the one that waits, whose place it takes
    hub_.dropped.fetch_add(1, std::memory_order_relaxed);
    if (!frame_) return;
  } else {
    --credit_;
  }
  frame_ = frame;
  write_next();
}

void Viewer::send(std::string text) {
  if (!open_ || closing_) return;
  if (answers_.size() >= hub_.options.answers_max) return drop();
  answers_.push_back(std::move(text));
  write_next();
}

void Viewer::write_next() {
  if (writing_ || !open_) return;
  const auto done = [self = shared_from_this()](Error error, std::size_t) { self->written(error); };
  if (!answers_.empty()) {
    text_under_way_ = std::move(answers_.front());
    answers_.pop_front();
    writing_ = true;
    socket_.text(true);
    socket_.async_write(asio::buffer(text_under_way_), done);
  } else if (closing_) {
    open_ = false;
    socket_.async_close(websocket::close_code::going_away, [self = shared_from_this()](Error) {});
  } else if (frame_) {
    frame_under_way_ = std::move(frame_);
    frame_.reset();
    for (std::size_t i = 0; i < missed_bytes_.size(); ++i) missed_bytes_[i] = static_cast<unsigned char>(missed_ >> (8 * i));
    writing_ = true;
    socket_.binary(true);
    hub_.sent.fetch_add(1, std::memory_order_relaxed);
    socket_.async_write(std::array<asio::const_buffer, 2>{asio::buffer(missed_bytes_), asio::buffer(*frame_under_way_)}, done);
  }
}

void Viewer::written(Error error) {
  writing_ = false;
  if (error) return drop();
  write_next();
}

void Viewer::close() {
  closing_ = true;
  write_next();
}

void Viewer::drop() {
  open_ = false;
  if (id != 0) hub_.leave(id);
  id = 0;
  beast::get_lowest_layer(socket_).close();
}

void Hub::join(const std::shared_ptr<Viewer>& viewer) {
  viewer->id = ++last_id;
  viewers[viewer->id] = viewer;
  viewers_now = viewers.size();
  ++viewers_ever;
  viewer->send(host.greet(viewer->id));
  if (latest) viewer->send(latest);
  if (!ticking) tick();
}

void Hub::leave(ViewerId id) {
  viewers.erase(id);
  host.gone(id);
  viewers_now = viewers.size();  // last: who counts viewers may take it that all is done for those that left
}

/// Asks for a frame at the rate, where somebody would get it.
void Hub::tick() {
  ticking = !viewers.empty();
  if (!ticking) return;
  for (const auto& [id, held] : viewers) {
    const auto viewer = held.lock();
    if (viewer && viewer->ready()) wanted.store(true, std::memory_order_relaxed);
  }
  timer.expires_after(std::chrono::duration_cast<asio::steady_timer::duration>(std::chrono::duration<double>(1 / options.rate_Hz)));
  timer.async_wait([this](Error error) {
    if (!error) tick();
  });
}

void Hub::deliver() {
  {
    const std::lock_guard lock(slot_mutex);
    latest = std::move(slot);
    slot.reset();
    posted = false;
  }
  // A viewer may leave while it is sent to.
  const auto now = viewers;
  for (const auto& [id, held] : now) {
    if (const auto viewer = held.lock()) viewer->send(latest);
  }
}

void Hub::tell(const std::string& text) {
  const auto now = viewers;
  for (const auto& [id, held] : now) {
    if (const auto viewer = held.lock()) viewer->send(text);
  }
}

void Hub::tell(ViewerId id, const std::string& text) {
  const auto found = viewers.find(id);
  if (found == viewers.end()) return;
  if (const auto viewer = found->second.lock()) viewer->send(text);
}

void Hub::close_all() {
  timer.cancel();
  const auto now = viewers;
  for (const auto& [id, held] : now) {
    if (const auto viewer = held.lock()) viewer->close();
  }
}

}  // namespace vsa::view
