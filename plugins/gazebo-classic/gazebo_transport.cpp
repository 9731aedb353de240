// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "gazebo_transport.hpp"

#include <gazebo/msgs/any.pb.h>
#include <gazebo/msgs/param_v.pb.h>

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

/// All numbers of a robot, one message a publication: 60 publishers on a node of Gazebo's cost a step of the snake 20 to 40 µs,
/// even where nobody listens (docs/howto/gazebo.md).
struct Readings {
  gazebo::transport::PublisherPtr publisher;
  gazebo::msgs::Param_V message;  ///< the time, then one number each in the order of advertise_double
  bool wanted = false;

  int add(const std::string& name) {
    gazebo::msgs::Param& param = *message.add_param();
    param.set_name(name);
    param.mutable_value()->set_type(Any::DOUBLE);
    return message.param_size() - 1;
  }
};

class ReadingPublisher final : public host::Publisher<double> {
 public:
  ReadingPublisher(std::shared_ptr<Readings> readings, int index) : readings_(std::move(readings)), index_(index) {}
  [[nodiscard]] bool wanted() const noexcept override {
    if (index_ == kFirst) readings_->wanted = readings_->publisher->HasConnections();  // takes locks: once a publication
    return readings_->wanted;
  }
  void publish(std::int64_t time_ns, const double& value) override {
    readings_->message.mutable_param(index_)->mutable_value()->set_double_value(value);
    if (index_ + 1 < readings_->message.param_size()) return;
    gazebo::msgs::Time& time = *readings_->message.mutable_param(0)->mutable_value()->mutable_time_value();
    time.set_sec(static_cast<std::int32_t>(time_ns / 1'000'000'000));
    time.set_nsec(static_cast<std::int32_t>(time_ns % 1'000'000'000));
    readings_->publisher->Publish(readings_->message);
  }

 private:
  static constexpr int kFirst = 1;
  std::shared_ptr<Readings> readings_;
  int index_;
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

struct GazeboTransport::Impl {
  gazebo::transport::NodePtr node{new gazebo::transport::Node};
  std::vector<std::shared_ptr<Listener>> listeners;
  std::vector<gazebo::transport::SubscriberPtr> subscribers;
  std::string joints;  ///< what every joint's topics begin with
  std::shared_ptr<Readings> readings = std::make_shared<Readings>();
  std::vector<gazebo::transport::PublisherPtr> types;  ///< tell `gz topic` the type of a topic that only listens
};

GazeboTransport::GazeboTransport(const std::string& world, const std::string& model) : impl_(std::make_unique<Impl>()) {
  impl_->node->Init(world);
  impl_->joints = host::model_topic(model, "joint/");
  impl_->readings->publisher = impl_->node->Advertise<gazebo::msgs::Param_V>(host::model_topic(model, "vsa/readings"));
  impl_->readings->add("time");
  impl_->readings->message.mutable_param(0)->mutable_value()->set_type(Any::TIME);
}

GazeboTransport::~GazeboTransport() {
  for (const auto& listener : impl_->listeners) {
    const std::lock_guard lock(listener->mutex);
    listener->handler = nullptr;
  }
  impl_->subscribers.clear();
  impl_->node->Fini();  // forgets the listeners before they go
}

host::Outcome GazeboTransport::on_double(const std::string& topic, std::function<void(double)> handler) {
  auto listener = std::make_shared<Listener>();
  listener->handler = std::move(handler);
  impl_->types.push_back(impl_->node->Advertise<Any>(topic));
  impl_->subscribers.push_back(impl_->node->Subscribe(topic, &Listener::receive, listener.get()));
  impl_->listeners.push_back(std::move(listener));
  return host::Outcome::ok;
}

std::unique_ptr<host::Publisher<double>> GazeboTransport::advertise_double(const std::string& topic) {
  const std::string name = topic.rfind(impl_->joints, 0) == 0 ? topic.substr(impl_->joints.size()) : topic;
  return std::make_unique<ReadingPublisher>(impl_->readings, impl_->readings->add(name));
}

}  // namespace vsa::plugins
