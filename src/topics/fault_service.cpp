// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/fault_service.hpp"

#include <functional>
#include <mutex>

#include "stock.hpp"
#include "vsa/config/faults_text.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/host/topics.hpp"

namespace vsa::topics {
namespace {

/// The transport copies its handlers before it calls them, so that one may run after its node has gone: this keeps it out.
struct Desk {
  std::mutex mutex;
  host::Robot* robot = nullptr;
  std::string topic;

  bool serve(const msgs::StringMsg& request, msgs::StringMsg& reply) {
    const std::lock_guard lock(mutex);
    if (robot == nullptr) return false;
    try {
      const auto names = config::apply_faults(*robot, request.data(), topic);
      reply.set_data("ok: " + config::join(names));
    } catch (const InputError& error) {
      reply.set_data(std::string("refused: ") + error.what());
    }
    return true;
  }
};

}  // namespace

struct FaultService::Impl {
  std::shared_ptr<Desk> desk = std::make_shared<Desk>();
  transport::Node node;
};

FaultService::FaultService(host::Robot& robot, const std::string& model) : impl_(std::make_unique<Impl>()) {
  impl_->desk->robot = &robot;
  impl_->desk->topic = host::model_topic(model, "vsa/faults");
  std::function<bool(const msgs::StringMsg&, msgs::StringMsg&)> serve =
      [desk = impl_->desk](const msgs::StringMsg& request, msgs::StringMsg& reply) { return desk->serve(request, reply); };
  if (!impl_->node.Advertise(impl_->desk->topic, serve)) {
    throw InputError({"", "service", impl_->desk->topic, "the transport takes no such name", "letters, digits, _ and /"});
  }
}

FaultService::~FaultService() {
  if (!impl_) return;
  const std::lock_guard lock(impl_->desk->mutex);
  impl_->desk->robot = nullptr;
}
FaultService::FaultService(FaultService&&) noexcept = default;
FaultService& FaultService::operator=(FaultService&&) noexcept = default;

}  // namespace vsa::topics
