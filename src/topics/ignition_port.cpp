// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/ignition_port.hpp"

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "messages.hpp"
#include "stock.hpp"
#include "vsa/topics/transport.hpp"

namespace vsa::topics {
namespace {

using transport::Node;
using transport::TopicUtils;

/// The transport copies its handlers before it calls them, so that one may run after its node has gone: this keeps it out.
struct Gate {
  std::mutex mutex;
  bool open = true;
};

/// A publisher and what was last known of its listeners; shared, so that the port can refresh it.
struct Line {
  Node::Publisher publisher;
  std::atomic<bool> wanted{false};
};

class DoublePublisher final : public host::Publisher<double> {
 public:
  explicit DoublePublisher(std::shared_ptr<Line> line) : line_(std::move(line)) {}
  [[nodiscard]] bool wanted() const noexcept override { return line_->wanted.load(std::memory_order_relaxed); }
  void publish(std::int64_t time_ns, const double& value) override {
    set_time(*message_.mutable_header()->mutable_stamp(), time_ns);
    message_.set_data(value);
    line_->publisher.Publish(message_);
  }

 private:
  std::shared_ptr<Line> line_;
  msgs::Double message_;
};

class StatesPublisher final : public host::Publisher<host::JointStates> {
 public:
  explicit StatesPublisher(std::shared_ptr<Line> line) : line_(std::move(line)) {}
  [[nodiscard]] bool wanted() const noexcept override { return line_->wanted.load(std::memory_order_relaxed); }
  void publish(std::int64_t time_ns, const host::JointStates& states) override {
    encode(states, message_);
    set_time(*message_.mutable_header()->mutable_stamp(), time_ns);
    line_->publisher.Publish(message_);
  }

 private:
  std::shared_ptr<Line> line_;
  msgs::Model message_;
};

}  // namespace

void prefer_loopback() {
  const char* set = std::getenv(kAddressVariable);
  if (set == nullptr || *set == '\0')
    setenv(kAddressVariable, "127.0.0.1", 1);  // the transport takes an empty one for "any address"
}

struct IgnitionPort::Impl {
  template <class Message, class Handler>
  host::Outcome subscribe(const std::string& topic, Handler handler) {
    if (!TopicUtils::IsValidTopic(topic)) return host::Outcome::refused;
    std::function<void(const Message&)> callback = [gate = gate, handler = std::move(handler)](const Message& message) {
      const std::lock_guard lock(gate->mutex);
      if (gate->open) handler(message);
    };
    return node.Subscribe(topic, callback) ? host::Outcome::ok : host::Outcome::refused;
  }

  template <class Message>
  std::shared_ptr<Line> advertise(const std::string& topic) {
    auto line = std::make_shared<Line>();
    line->publisher = node.Advertise<Message>(topic);
    if (!line->publisher) return nullptr;
    lines.push_back(line);
    return line;
  }

  Node node;
  std::shared_ptr<Gate> gate = std::make_shared<Gate>();
  std::vector<std::shared_ptr<Line>> lines;
};

IgnitionPort::IgnitionPort() {
  prefer_loopback();
  impl_ = std::make_unique<Impl>();
}

IgnitionPort::~IgnitionPort() {
  const std::lock_guard lock(impl_->gate->mutex);
  impl_->gate->open = false;
  for (const auto& line : impl_->lines) line->wanted = false;
}

host::Outcome IgnitionPort::on_double(const std::string& topic, std::function<void(double)> handler) {
  return impl_->subscribe<msgs::Double>(topic, [h = std::move(handler)](const msgs::Double& message) { h(message.data()); });
}

host::Outcome IgnitionPort::on_trajectory([[maybe_unused]] const std::string& topic,
                                          [[maybe_unused]] std::function<void(const host::Trajectory&)> handler) {
#ifdef VSA_HAS_JOINT_TRAJECTORY
  return impl_->subscribe<msgs::JointTrajectory>(
      topic, [h = std::move(handler)](const msgs::JointTrajectory& message) { h(decode(message)); });
#else
  return host::Outcome::unsupported;
#endif
}

host::Outcome IgnitionPort::on_actuators(const std::string& topic, std::function<void(const host::ActuatorsCmd&)> handler) {
  return impl_->subscribe<msgs::Actuators>(topic, [h = std::move(handler)](const msgs::Actuators& message) { h(decode(message)); });
}

std::unique_ptr<host::Publisher<double>> IgnitionPort::advertise_double(const std::string& topic) {
  auto line = impl_->advertise<msgs::Double>(topic);
  return line ? std::make_unique<DoublePublisher>(std::move(line)) : nullptr;
}

std::unique_ptr<host::Publisher<host::JointStates>> IgnitionPort::advertise_states(const std::string& topic) {
  auto line = impl_->advertise<msgs::Model>(topic);
  return line ? std::make_unique<StatesPublisher>(std::move(line)) : nullptr;
}

void IgnitionPort::refresh_listeners() {
  for (const auto& line : impl_->lines) line->wanted.store(line->publisher.HasConnections(), std::memory_order_relaxed);
}

}  // namespace vsa::topics
