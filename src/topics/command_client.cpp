// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/command_client.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string_view>

#include "messages.hpp"
#include "vsa/errors.hpp"
#include "vsa/topics/transport.hpp"

namespace vsa::topics {
namespace {

constexpr std::string_view kPrefix = "/model/";
constexpr std::string_view kSuffix = "/vsa/joint_state";

/// Filled by the transport's thread; shared with its handler, which may outlive the client by a moment.
struct Inbox {
  std::mutex mutex;
  std::condition_variable arrived;
  std::optional<host::JointStates> newest;
};

}  // namespace

struct CommandClient::Impl {
  transport::Node node;
  transport::Node::Publisher publisher;
  std::shared_ptr<Inbox> inbox = std::make_shared<Inbox>();
};

CommandClient::CommandClient() {
  prefer_loopback();
  impl_ = std::make_unique<Impl>();
}

CommandClient::~CommandClient() = default;

std::vector<std::string> CommandClient::models() const {
  std::vector<std::string> topics, found;
  impl_->node.TopicList(topics);
  for (const std::string_view topic : topics) {
    if (topic.size() <= kPrefix.size() + kSuffix.size() || topic.substr(0, kPrefix.size()) != kPrefix) continue;
    if (topic.substr(topic.size() - kSuffix.size()) != kSuffix) continue;
    found.emplace_back(topic.substr(kPrefix.size(), topic.size() - kPrefix.size() - kSuffix.size()));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void CommandClient::watch(const std::string& model) {
  const std::string command = host::model_topic(model, "vsa/cmd");
  const std::string state = host::model_topic(model, "vsa/joint_state");
  impl_->publisher = impl_->node.Advertise<msgs::JointTrajectory>(command);
  std::function<void(const msgs::Model&)> handler = [inbox = impl_->inbox](const msgs::Model& message) {
    {
      const std::lock_guard lock(inbox->mutex);
      inbox->newest = decode(message);
    }
    inbox->arrived.notify_all();
  };
  if (!impl_->publisher || !impl_->node.Subscribe(state, handler)) {
    throw InputError({"", "model", model, "the transport takes no topics of this name", "letters, digits, _ and /"});
  }
}

std::optional<host::JointStates> CommandClient::wait_for_state(std::chrono::milliseconds limit) {
  std::unique_lock lock(impl_->inbox->mutex);
  impl_->inbox->arrived.wait_for(lock, limit, [this] { return impl_->inbox->newest.has_value(); });
  std::optional<host::JointStates> state;
  state.swap(impl_->inbox->newest);
  return state;
}

void CommandClient::send(const host::Trajectory& trajectory) {
  msgs::JointTrajectory message;
  encode(trajectory, message);
  impl_->publisher.Publish(message);
}

}  // namespace vsa::topics
