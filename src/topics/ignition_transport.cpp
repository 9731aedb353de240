// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/ignition_transport.hpp"

#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "messages.hpp"
#include "outbox.hpp"
#include "stock.hpp"
#include "vsa/errors.hpp"
#include "vsa/topics/transport.hpp"

// In builds that count what is run; the compiler gave it its name.
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void __gcov_dump() __attribute__((weak));

namespace vsa::topics {
namespace {

std::atomic<bool> talks = false;

using transport::Node;
using transport::TopicUtils;

/// The transport copies its handlers before it calls them, so that one may run after its node has gone: this keeps it out.
struct Gate {
  std::mutex mutex;
  bool open = true;
  std::uint64_t heard = 0;
};

/// A topic: what waits to be sent on it, and what was last known of its listeners.
class Topic {
 public:
  explicit Topic(const Node::Publisher& publisher) : publisher_(publisher) {}
  virtual ~Topic() = default;
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;

  [[nodiscard]] bool wanted() const noexcept { return wanted_.load(std::memory_order_relaxed); }
  void look_for_listeners() { wanted_.store(publisher_.HasConnections(), std::memory_order_relaxed); }
  virtual void send() = 0;
  virtual void close() noexcept { wanted_ = false; }

 protected:
  template <class Message>
  void publish(Message& message, std::int64_t time_ns) {
    set_time(*message.mutable_header()->mutable_stamp(), time_ns);
    publisher_.Publish(message);
  }

 private:
  Node::Publisher publisher_;
  std::atomic<bool> wanted_{false};
};

struct Doubles {
  using Plain = double;
  using Packed = msgs::Double;
  static constexpr std::size_t kSlots = 16;
  static void encode(double value, msgs::Double& out) { out.set_data(value); }
};

struct States {
  using Plain = host::JointStates;
  using Packed = msgs::Model;
  static constexpr std::size_t kSlots = 8;
  static void encode(const host::JointStates& states, msgs::Model& out) { topics::encode(states, out); }
};

template <class Kind>
class TopicOf final : public Topic {
 public:
  using Topic::Topic;

  template <class Hurry>
  void put(std::int64_t time_ns, const typename Kind::Plain& message, const Hurry& hurry) {
    box_.put([&](Stamped& slot) { slot.time_ns = time_ns, slot.message = message; }, hurry);
  }
  void send() override {
    box_.drain([this](const Stamped& slot) {
      Kind::encode(slot.message, packed_);
      publish(packed_, slot.time_ns);
    });
  }
  void close() noexcept override {
    Topic::close();
    box_.close();
  }

 private:
  struct Stamped {
    std::int64_t time_ns = 0;
    typename Kind::Plain message{};
  };
  Outbox<Stamped, Kind::kSlots> box_;
  typename Kind::Packed packed_;
};

/// The thread: sends what waits, and asks ignition-transport, which takes its lock for each, who listens.
class Office {
 public:
  ~Office() {
    sender_.reset();  // sends the last
    for (const auto& topic : topics_) topic->close();
  }
  void add(std::shared_ptr<Topic> topic) {
    const std::lock_guard lock(mutex_);
    topics_.push_back(std::move(topic));
  }
  void hurry() noexcept { sender_->hurry(); }

 private:
  std::chrono::milliseconds work() {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    const bool look = now >= next_look_;
    if (look) next_look_ = now + kLookEvery;
    bool wanted = false;
    for (const auto& topic : topics_) {
      topic->send();
      if (look) topic->look_for_listeners();
      wanted = wanted || topic->wanted();
    }
    return wanted ? kSendEvery : kLookEvery;
  }

  static constexpr std::chrono::milliseconds kSendEvery{1}, kLookEvery{20};
  std::mutex mutex_;
  std::vector<std::shared_ptr<Topic>> topics_;
  std::chrono::steady_clock::time_point next_look_{};
  std::optional<Sender> sender_{std::in_place, [this] { return work(); }};  ///< last: it uses the others
};

template <class Kind>
class TopicPublisher final : public host::Publisher<typename Kind::Plain> {
 public:
  TopicPublisher(std::shared_ptr<TopicOf<Kind>> topic, std::weak_ptr<Office> office)
      : topic_(std::move(topic)), office_(std::move(office)) {}
  [[nodiscard]] bool wanted() const noexcept override { return topic_->wanted(); }
  void publish(std::int64_t time_ns, const typename Kind::Plain& message) override {
    topic_->put(time_ns, message, [this] {
      if (const auto office = office_.lock()) office->hurry();
    });
  }

 private:
  std::shared_ptr<TopicOf<Kind>> topic_;
  std::weak_ptr<Office> office_;
};

}  // namespace

void prefer_loopback() {
  if (const std::string why_none = why_no_topics(); !why_none.empty()) throw InputError({"", "topics", "", why_none, ""});
  talks = true;
  const char* set = std::getenv(kAddressVariable);
  if (set == nullptr || *set == '\0')
    setenv(kAddressVariable, "127.0.0.1", 1);  // the transport takes an empty one for "any address"
}

std::string why_no_topics() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return "";
  bool up = false;
  for (const ifaddrs* at = list; at != nullptr; at = at->ifa_next)
    up = up || (at->ifa_addr != nullptr && at->ifa_addr->sa_family == AF_INET && (at->ifa_flags & IFF_UP) != 0);
  freeifaddrs(list);
  return up ? "" : "no network interface is up, so there are no topics (ip link set lo up brings them)";
}

void leave(int exit_code) {
  if (!talks) std::exit(exit_code);
  for (std::ostream* stream : {&std::cout, &std::cerr, &std::clog}) stream->flush();
  std::fflush(nullptr);
  if (__gcov_dump != nullptr) __gcov_dump();
  std::_Exit(exit_code);
}

struct IgnitionTransport::Impl {
  template <class Message, class Handler>
  host::Outcome subscribe(const std::string& topic, Handler handler) {
    if (!TopicUtils::IsValidTopic(topic)) return host::Outcome::refused;
    std::function<void(const Message&)> callback = [gate = gate, handler = std::move(handler)](const Message& message) {
      const std::lock_guard lock(gate->mutex);
      ++gate->heard;
      if (gate->open) handler(message);
    };
    return node.Subscribe(topic, callback) ? host::Outcome::ok : host::Outcome::refused;
  }

  template <class Kind>
  std::unique_ptr<TopicPublisher<Kind>> advertise(const std::string& name) {
    Node::Publisher publisher = node.Advertise<typename Kind::Packed>(name);
    if (!publisher) return nullptr;
    auto topic = std::make_shared<TopicOf<Kind>>(std::move(publisher));
    office->add(topic);
    return std::make_unique<TopicPublisher<Kind>>(std::move(topic), office);
  }

  Node node;
  std::shared_ptr<Gate> gate = std::make_shared<Gate>();
  std::shared_ptr<Office> office = std::make_shared<Office>();
};

IgnitionTransport::IgnitionTransport() {
  prefer_loopback();
  impl_ = std::make_unique<Impl>();
}

std::uint64_t IgnitionTransport::heard() const {
  const std::lock_guard lock(impl_->gate->mutex);
  return impl_->gate->heard;
}

IgnitionTransport::~IgnitionTransport() {
  const std::lock_guard lock(impl_->gate->mutex);
  impl_->gate->open = false;
}

host::Outcome IgnitionTransport::on_double(const std::string& topic, std::function<void(double)> handler) {
  return impl_->subscribe<msgs::Double>(topic, [h = std::move(handler)](const msgs::Double& message) { h(message.data()); });
}

host::Outcome IgnitionTransport::on_trajectory([[maybe_unused]] const std::string& topic,
                                               [[maybe_unused]] std::function<void(const host::Trajectory&)> handler) {
#ifdef VSA_HAS_JOINT_TRAJECTORY
  return impl_->subscribe<msgs::JointTrajectory>(
      topic, [h = std::move(handler)](const msgs::JointTrajectory& message) { h(decode(message)); });
#else
  return host::Outcome::unsupported;
#endif
}

host::Outcome IgnitionTransport::on_actuators(const std::string& topic, std::function<void(const host::ActuatorsCmd&)> handler) {
  return impl_->subscribe<msgs::Actuators>(topic, [h = std::move(handler)](const msgs::Actuators& message) { h(decode(message)); });
}

host::Outcome IgnitionTransport::serve_text(const std::string& service, Answer answer) {
  std::function<bool(const msgs::StringMsg&, msgs::StringMsg&)> serve =
      [gate = impl_->gate, answer = std::move(answer)](const msgs::StringMsg& request, msgs::StringMsg& reply) {
        const std::lock_guard lock(gate->mutex);
        ++gate->heard;
        const std::optional<std::string> text = gate->open ? answer(request.data()) : std::nullopt;
        if (text) reply.set_data(*text);
        return text.has_value();
      };
  return impl_->node.Advertise(service, serve) ? host::Outcome::ok : host::Outcome::refused;
}

std::unique_ptr<host::Publisher<double>> IgnitionTransport::advertise_double(const std::string& topic) {
  return impl_->advertise<Doubles>(topic);
}

std::unique_ptr<host::Publisher<host::JointStates>> IgnitionTransport::advertise_states(const std::string& topic) {
  return impl_->advertise<States>(topic);
}

}  // namespace vsa::topics
