// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "gazebo_port.hpp"

#include <gazebo/msgs/any.pb.h>

#include <cmath>
#include <gazebo/transport/Node.hh>
#include <gazebo/transport/Publisher.hh>
#include <gazebo/transport/Subscriber.hh>
#include <limits>
#include <mutex>
#include <vector>

namespace vsa::plugins {
namespace {

using gazebo::msgs::Any;

double number(const Any& message) {
  if (message.type() == Any::DOUBLE && message.has_double_value()) return message.double_value();
  if (message.type() == Any::INT32 && message.has_int_value()) return message.int_value();
  return std::numeric_limits<double>::quiet_NaN();  // is refused and reported as such
}

class AnyPublisher final : public host::Publisher<double> {
 public:
  explicit AnyPublisher(gazebo::transport::PublisherPtr publisher) : publisher_(std::move(publisher)) {}
  [[nodiscard]] bool wanted() const noexcept override { return publisher_->HasConnections(); }
  void publish(std::int64_t, const double& value) override {
    Any message;
    message.set_type(Any::DOUBLE);
    message.set_double_value(value);
    publisher_->Publish(message);
  }

 private:
  gazebo::transport::PublisherPtr publisher_;
};

/// What a subscriber calls; closed before the handler's owner goes.
struct Listener {
  std::mutex mutex;
  std::function<void(double)> handler;
  void receive(const boost::shared_ptr<const Any>& message) {
    const std::lock_guard lock(mutex);
    if (handler) handler(number(*message));
  }
};

}  // namespace

struct GazeboPort::Impl {
  gazebo::transport::NodePtr node{new gazebo::transport::Node};
  std::vector<std::shared_ptr<Listener>> listeners;
  std::vector<gazebo::transport::SubscriberPtr> subscribers;
  std::vector<gazebo::transport::PublisherPtr> types;  ///< tell `gz topic` the type of a topic that only listens
};

GazeboPort::GazeboPort(const std::string& world) : impl_(std::make_unique<Impl>()) { impl_->node->Init(world); }

GazeboPort::~GazeboPort() {
  for (const auto& listener : impl_->listeners) {
    const std::lock_guard lock(listener->mutex);
    listener->handler = nullptr;
  }
  impl_->subscribers.clear();
  impl_->node->Fini();  // forgets the listeners before they go
}

host::Outcome GazeboPort::on_double(const std::string& topic, std::function<void(double)> handler) {
  auto listener = std::make_shared<Listener>();
  listener->handler = std::move(handler);
  impl_->types.push_back(impl_->node->Advertise<Any>(topic));
  impl_->subscribers.push_back(impl_->node->Subscribe(topic, &Listener::receive, listener.get()));
  impl_->listeners.push_back(std::move(listener));
  return host::Outcome::ok;
}

std::unique_ptr<host::Publisher<double>> GazeboPort::advertise_double(const std::string& topic) {
  return std::make_unique<AnyPublisher>(impl_->node->Advertise<Any>(topic));
}

}  // namespace vsa::plugins
