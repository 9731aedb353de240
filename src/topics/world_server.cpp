// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/topics/world_server.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <vector>

#include "messages.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/topics/ignition_transport.hpp"
#include "vsa/topics/transport.hpp"
#include "world_messages.hpp"

namespace vsa::topics {
namespace {

using std::chrono::steady_clock;
using transport::Node;
using namespace std::chrono_literals;

constexpr auto kListenersEvery = 20ms;
constexpr auto kClockEvery = 1ms;
constexpr auto kStatsEvery = 200ms;
constexpr auto kIdleEvery = 100ms;

/// Answers the control service from the transport's threads, and answers no more once it is closed.
class ControlService {
 public:
  ControlService(seat::RunControl& control, host::RobotTopics::Report report, std::string topic)
      : control_(control), report_(std::move(report)), topic_(std::move(topic)) {}

  bool serve(const msgs::WorldControl& request, msgs::Boolean& reply) {
    const std::lock_guard lock(mutex_);
    reply.set_data(false);
    if (!open_) return false;
    if (const char* fault = fault_of(request)) {
      refused_.fetch_add(1);
      if (reported_.insert(fault).second && report_) report_(topic_ + ": request refused: " + fault);
      return true;
    }
    seat::ControlRequest out;
    out.reset = request.reset().all();
    out.pause = request.pause();
    out.steps = request.multi_step() != 0 ? request.multi_step() : (request.step() ? 1U : 0U);
    if (request.has_run_to_sim_time()) out.run_to_ns = to_ns(request.run_to_sim_time());
    control_.request(out);
    reply.set_data(true);
    return true;
  }

  void close() {
    const std::lock_guard lock(mutex_);
    open_ = false;
  }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(); }

 private:
  static const char* fault_of(const msgs::WorldControl& request) {
    if (request.reset().time_only()) return "reset.time_only: time and state go back together (allowed: reset.all)";
    if (request.reset().model_only()) return "reset.model_only: time and state go back together (allowed: reset.all)";
    if (request.seed() != 0) return "seed: this simulator draws no random numbers (allowed: 0)";
    return nullptr;
  }

  seat::RunControl& control_;
  host::RobotTopics::Report report_;
  std::string topic_;
  std::mutex mutex_;
  bool open_ = true;
  std::set<std::string> reported_;
  std::atomic<std::uint64_t> refused_{0};
};

}  // namespace

struct WorldServer::Impl {
  Impl(engine::World& the_world, seat::RunControl& the_control) : world(the_world), control(the_control) {}
  ~Impl() {
    if (service) service->close();
    for (std::size_t i = 0; i < world.robot_count(); ++i) {
      world.seat(i).disconnect();
      world.seat(i).report_to({});
    }
  }

  void advertise(const host::RobotTopics::Report& report);
  void publish_clock();
  void publish_stats(steady_clock::time_point now);
  void refresh(steady_clock::time_point now);

  engine::World& world;
  seat::RunControl& control;
  std::shared_ptr<ControlService> service;
  std::shared_ptr<IgnitionTransport> transport = std::make_shared<IgnitionTransport>();
  Node node;
  Node::Publisher clock, stats;
  bool clock_wanted = false, stats_wanted = false;
  std::uint64_t iterations = 0;
  steady_clock::time_point start = steady_clock::now();
  steady_clock::time_point next_listeners{}, next_clock{}, next_stats{}, next_idle{};
  struct Mark {
    steady_clock::time_point wall;
    std::int64_t sim_ns = 0;
  } rate_mark{start, 0};
};

void WorldServer::Impl::advertise(const host::RobotTopics::Report& report) {
  const std::string scope = "/world/" + host::topic_scope(world.name(), "world");
  const std::string service_topic = scope + "/control";
  service = std::make_shared<ControlService>(control, report, service_topic);
  std::function<bool(const msgs::WorldControl&, msgs::Boolean&)> serve =
      [service = service](const msgs::WorldControl& request, msgs::Boolean& reply) { return service->serve(request, reply); };
  clock = node.Advertise<msgs::Clock>("/clock");
  stats = node.Advertise<msgs::WorldStatistics>(scope + "/stats");
  if (!clock || !stats || !node.Advertise(service_topic, serve)) {
    throw InputError({"", "world", world.name(), "the transport takes no topics of this name", "letters, digits, _ and /"});
  }
}

void WorldServer::Impl::publish_clock() {
  if (!clock_wanted) return;
  msgs::Clock message;
  set_time(*message.mutable_header()->mutable_stamp(), world.time_ns());
  set_time(*message.mutable_sim(), world.time_ns());
  set_time(*message.mutable_real(), std::chrono::nanoseconds(steady_clock::now() - start).count());
  set_time(*message.mutable_system(), std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count());
  clock.Publish(message);
}

void WorldServer::Impl::publish_stats(steady_clock::time_point now) {
  const double wall_s = std::chrono::duration<double>(now - rate_mark.wall).count();
  const double sim_s = 1e-9 * static_cast<double>(world.time_ns() - rate_mark.sim_ns);
  rate_mark = {now, world.time_ns()};
  if (!stats_wanted) return;
  msgs::WorldStatistics message;
  set_time(*message.mutable_header()->mutable_stamp(), world.time_ns());
  set_time(*message.mutable_sim_time(), world.time_ns());
  set_time(*message.mutable_real_time(), std::chrono::nanoseconds(now - start).count());
  set_time(*message.mutable_step_size(), std::llround(world.step_s() * 1e9));
  message.set_paused(control.paused());
  message.set_iterations(iterations);
  message.set_real_time_factor(wall_s > 0 && sim_s > 0 ? sim_s / wall_s : 0.0);
  stats.Publish(message);
}

void WorldServer::Impl::refresh(steady_clock::time_point now) {
  if (now < next_listeners) return;
  next_listeners = now + kListenersEvery;
  clock_wanted = clock.HasConnections();
  stats_wanted = stats.HasConnections();
}

WorldServer::WorldServer(engine::World& world, seat::RunControl& control, const host::RobotTopics::Report& report) {
  prefer_loopback();
  impl_ = std::make_unique<Impl>(world, control);
  impl_->advertise(report);
  for (std::size_t i = 0; i < world.robot_count(); ++i) {
    world.seat(i).report_to(report);
    world.seat(i).connect(impl_->transport);
  }
  impl_->rate_mark.sim_ns = world.time_ns();
}

WorldServer::~WorldServer() = default;

void WorldServer::stepped() {
  ++impl_->iterations;
  const auto now = steady_clock::now();
  impl_->refresh(now);
  if (now >= impl_->next_clock) {
    impl_->next_clock = now + kClockEvery;
    impl_->publish_clock();
  }
  for (std::size_t i = 0; i < impl_->world.robot_count(); ++i) impl_->world.seat(i).publish_step(impl_->world.time_ns());
  if (now >= impl_->next_stats) {
    impl_->next_stats = now + kStatsEvery;
    impl_->publish_stats(now);
  }
}

void WorldServer::idle() {
  const auto now = steady_clock::now();
  if (now < impl_->next_idle) return;
  impl_->next_idle = now + kIdleEvery;
  impl_->refresh(now);
  impl_->publish_clock();
  for (std::size_t i = 0; i < impl_->world.robot_count(); ++i) impl_->world.seat(i).publish(impl_->world.time_ns());
  impl_->publish_stats(now);
}

std::uint64_t WorldServer::refused() const noexcept {
  std::uint64_t sum = impl_->service->refused();
  for (std::size_t i = 0; i < impl_->world.robot_count(); ++i) sum += impl_->world.seat(i).refused();
  return sum;
}

std::uint64_t WorldServer::heard() const { return impl_->transport->heard(); }

}  // namespace vsa::topics
