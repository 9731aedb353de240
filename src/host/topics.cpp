// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/topics.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "topics_commands.hpp"
#include "vsa/errors.hpp"

namespace vsa::host {
namespace {

using DoublePublisher = std::unique_ptr<Publisher<double>>;

struct Channels {
  DoublePublisher stiffness, deflection, preset, current_1, current_2;

  [[nodiscard]] bool wanted() const {
    const auto listened = [](const DoublePublisher& p) { return p && p->wanted(); };
    return listened(stiffness) || listened(deflection) || listened(preset) || listened(current_1) || listened(current_2);
  }
};

int motors_of(const ActuatorConfig& actuator) {
  const auto& transmission = actuator.unit.actuator.transmission;
  return transmission ? transmission->motor_count() : 2;
}

void send(const DoublePublisher& publisher, std::int64_t time_ns, double value) {
  if (publisher && publisher->wanted()) publisher->publish(time_ns, value);
}

/// A transport may keep its handlers longer than RobotTopics lives, above all where its constructor throws: they go through here.
class Gate {
 public:
  explicit Gate(TopicCommands& commands) : commands_(&commands) {}
  void close() {
    const std::lock_guard lock(mutex_);
    commands_ = nullptr;
  }
  template <class Call>
  void pass(const Call& call) {
    const std::lock_guard lock(mutex_);
    if (commands_ != nullptr) call(*commands_);
  }

 private:
  std::mutex mutex_;
  TopicCommands* commands_;
};

std::int64_t period_ns(double rate_Hz) { return std::max<std::int64_t>(1, std::llround(1e9 / std::max(rate_Hz, 1e-3))); }

}  // namespace

struct RobotTopics::Impl {
  Impl(Robot& the_robot, std::string model, Report the_report)
      : robot(the_robot),
        report(the_report),
        commands(the_robot, std::move(the_report)),
        gate(std::make_shared<Gate>(commands)),
        period(period_ns(the_robot.config().state_rate_Hz)) {
    message.model = std::move(model);
    for (const auto& actuator : robot.config().actuators) {
      message.names.push_back(actuator.name);
      message.first_joint.push_back(message.joints.size());
      message.commands.emplace_back();
      message.units.push_back({actuator.unit.actuator.linear() ? "m" : "rad", std::string(actuator.unit.preset_unit())});
      message.joints.push_back({actuator.joint, 0, 0, 0});
      for (int m = 1; m <= motors_of(actuator); ++m)
        message.joints.push_back({actuator.name + "_motor_" + std::to_string(m), 0, 0, 0});
    }
  }

  ~Impl() { gate->close(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void connect(TopicTransport& transport);
  void connect_commands(TopicTransport& transport, Problems& problems);
  void fill(std::int64_t time_ns);
  void publish(std::int64_t time_ns);
  void report_notices();

  Robot& robot;
  Report report;
  TopicCommands commands;
  std::shared_ptr<Gate> gate;
  std::int64_t period;
  std::int64_t last_period = -1;
  std::vector<Channels> channels;
  std::unique_ptr<Publisher<JointStates>> states;
  JointStates message;
};

void RobotTopics::Impl::connect_commands(TopicTransport& transport, Problems& problems) {
  const auto check = [&problems](Outcome outcome, const std::string& topic) {
    if (outcome == Outcome::refused)
      problems.add({"", "topic", topic, "the transport takes no such name", "letters, digits, _ and /"});
  };
  const auto& model = message.model;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    using Channel = Robot::Channel;
    for (const auto& [leaf, channel] :
         {std::pair{"cmd_equilibrium", Channel::equilibrium}, std::pair{"cmd_preset", Channel::preset}}) {
      const std::string topic = joint_topic(model, robot.config().actuators[i].name, leaf);
      const auto handler = [door = gate, topic, i, c = channel](double value) {
        door->pass([&](TopicCommands& to) { to.single(topic, i, c, value); });
      };
      check(transport.on_double(topic, handler), topic);
    }
  }
  const std::string cmd = model_topic(model, "vsa/cmd");
  const auto on_trajectory = [door = gate, cmd](const Trajectory& m) {
    door->pass([&](TopicCommands& to) { to.trajectory(cmd, m); });
  };
  check(transport.on_trajectory(cmd, on_trajectory), cmd);
  const std::string array = model_topic(model, "vsa/cmd_array");
  const auto on_array = [door = gate, array](const ActuatorsCmd& m) { door->pass([&](TopicCommands& to) { to.array(array, m); }); };
  check(transport.on_actuators(array, on_array), array);
}

void RobotTopics::Impl::connect(TopicTransport& transport) {
  Problems problems;
  const auto check_name = [&problems](const std::string& name, std::string_view what) {
    try {
      (void)topic_scope(name, what);
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  };
  check_name(message.model, "model");
  for (const auto& actuator : robot.config().actuators) check_name(actuator.name, "actuator");
  problems.throw_if_any();

  connect_commands(transport, problems);
  problems.throw_if_any();
  states = transport.advertise_states(model_topic(message.model, "vsa/joint_state"));
  for (const auto& actuator : robot.config().actuators) {
    const auto advertise = [&](std::string_view leaf) {
      return transport.advertise_double(joint_topic(message.model, actuator.name, leaf));
    };
    Channels c{advertise("stiffness"), advertise("deflection"), advertise("preset"), advertise("current_1"), nullptr};
    if (motors_of(actuator) > 1) c.current_2 = advertise("current_2");
    channels.push_back(std::move(c));
  }
}

void RobotTopics::Impl::fill(std::int64_t time_ns) {
  message.time_ns = time_ns;
  std::size_t joint = 0;
  for (std::size_t i = 0; i < robot.size(); ++i) {
    const ActuatorReading now = robot.read(i);
    message.commands[i] = {now.equilibrium_command_rad, now.preset_command};
    const auto set = [&](double position, double velocity, double force) {
      auto& entry = message.joints[joint++];
      entry.position_rad = position;
      entry.velocity_rad_per_s = velocity;
      entry.force_Nm = force;
    };
    set(now.shaft_rad, now.shaft_speed_rad_per_s, now.torque_Nm);
    for (std::size_t m = 0; m < static_cast<std::size_t>(motors_of(robot.config().actuators[i])); ++m) {
      set(now.motor_rad[m], now.motor_speed_rad_per_s[m], now.motor_torque_Nm[m]);
    }
  }
}

void RobotTopics::Impl::publish(std::int64_t time_ns) {
  if (states && states->wanted()) {
    fill(time_ns);
    states->publish(time_ns, message);
  }
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Channels& c = channels[i];
    if (!c.wanted()) continue;
    const ActuatorReading now = robot.read(i);
    send(c.stiffness, time_ns, now.stiffness_Nm_per_rad);
    send(c.deflection, time_ns, now.deflection_rad);
    send(c.preset, time_ns, now.preset);
    send(c.current_1, time_ns, now.current_A[0]);
    send(c.current_2, time_ns, now.current_A[1]);
  }
  report_notices();
}

void RobotTopics::Impl::report_notices() {
  for (const Notice& notice : robot.take_notices()) {
    if (report) report(message.model + ": " + notice.text);
  }
}

RobotTopics::RobotTopics(Robot& robot, std::string model, TopicTransport& transport, Report report)
    : impl_("vsa::host::RobotTopics", std::make_unique<Impl>(robot, std::move(model), std::move(report))) {
  impl_->connect(transport);
}
RobotTopics::~RobotTopics() = default;
RobotTopics::RobotTopics(RobotTopics&&) noexcept = default;
RobotTopics& RobotTopics::operator=(RobotTopics&&) noexcept = default;

void RobotTopics::update(std::int64_t time_ns) {
  const std::int64_t now = time_ns / impl_->period;
  if (now == impl_->last_period) return;
  impl_->last_period = now;
  impl_->publish(time_ns);
}

void RobotTopics::publish(std::int64_t time_ns) { impl_->publish(time_ns); }

std::uint64_t RobotTopics::refused() const { return impl_->commands.refused(); }

}  // namespace vsa::host
