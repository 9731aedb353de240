// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a seat says and hears: ports, topics, faults, notices.
#include <algorithm>
#include <mutex>
#include <utility>

#include "vsa/config/faults_text.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/seat/seat.hpp"

namespace vsa::seat {
namespace {

constexpr std::chrono::milliseconds kPausedEvery{100};
constexpr std::int64_t kNoticesEvery_ns = 100'000'000;  // where no topics tell them

}  // namespace

/// A transport may keep its handlers longer than the seat lives, or is connected: they go through here.
struct Seat::Desk {
  explicit Desk(Seat& the_seat) : seat(&the_seat) {}

  void close() {
    const std::lock_guard lock(mutex);
    seat = nullptr;
  }
  std::optional<std::string> answer(const std::string& words, const std::string& service) {
    const std::lock_guard lock(mutex);
    if (seat == nullptr) return std::nullopt;
    try {
      return "ok: " + config::join(seat->apply_faults(words, service));
    } catch (const InputError& error) {
      return std::string("refused: ") + error.what();
    }
  }

  std::mutex mutex;
  Seat* seat;
};

void Seat::open_ports() {
  ports_.open(robot_, model_, [this](const std::string& line) { tell(line); });
}

void Seat::connect(std::shared_ptr<host::TopicTransport> transport) {
  host::RobotTopics topics(robot_, model_, *transport, report_);
  if (!desk_) desk_ = std::make_shared<Desk>(*this);
  const std::string service = host::model_topic(model_, "vsa/faults");
  const auto answer = [desk = desk_, service](const std::string& words) { return desk->answer(words, service); };
  if (transport->serve_text(service, answer) == host::Outcome::refused)
    throw InputError({"", "service", service, "the transport takes no such name", "letters, digits, _ and /"});
  connections_.push_back({std::move(transport), std::move(topics)});
}

void Seat::disconnect() {
  if (desk_) desk_->close();
  desk_.reset();
  connections_.clear();
}

void Seat::publish_step(std::int64_t time_ns) {
  for (Connection& c : connections_) c.topics.update(time_ns);
  if (!connections_.empty() || std::exchange(last_told_, time_ns / kNoticesEvery_ns) == time_ns / kNoticesEvery_ns) return;
  tell_notices();
}

void Seat::publish_paused(std::int64_t time_ns) {
  pace_.stood();
  const auto now = Clock::now();
  if (now < next_paused_) return;
  next_paused_ = now + kPausedEvery;
  publish(time_ns);
}

void Seat::publish(std::int64_t time_ns) {
  for (Connection& c : connections_) c.topics.publish(time_ns);
  if (connections_.empty()) tell_notices();
}

void Seat::tell_notices() {
  for (const host::Notice& notice : robot_.take_notices()) tell(model_ + ": " + notice.text);
}

std::uint64_t Seat::refused() const {
  std::uint64_t sum = 0;
  for (const Connection& c : connections_) sum += c.topics.refused();
  return sum;
}

std::vector<std::string> Seat::apply_faults(std::string_view text, std::string_view source) {
  text = config::trim(text);
  const std::size_t end = std::min(text.find_first_of(" \t\n\r\f\v"), text.size());
  const std::string who(text.substr(0, end));
  const bool all = who == "all";
  const auto one = robot_.find(who);
  if (!all && !one) {
    std::vector<std::string> names{"all"};
    for (const auto& a : robot_.config().actuators) names.push_back(a.name);
    throw InputError({"", std::string(source), who, "no such actuator", config::join(names)});
  }
  device::Faults faults = config::read_faults(text.substr(end), source);
  const std::size_t first = one.value_or(0), end_of_them = all ? robot_.size() : first + 1;
  for (std::size_t i = first; i < end_of_them; ++i) robot_.check_faults(i, faults);
  std::vector<std::string> names;
  for (std::size_t i = first; i < end_of_them; ++i) {
    robot_.set_faults(i, faults);
    ++faults.seed;
    names.push_back(robot_.config().actuators[i].name);
  }
  return names;
}

}  // namespace vsa::seat
