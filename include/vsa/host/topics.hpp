// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the topics of a robot mean, once for every host. A host supplies a TopicTransport (subscribe and publish); the rest is here.
//
// M is the scoped model name, J the actuator's name; their scopes "a::b" become "a/b" in a topic.
//
//   topic                              kind          unit     meaning
//   /model/M/joint/J/cmd_equilibrium   double        rad      equilibrium position; the preset stays
//   /model/M/joint/J/cmd_preset        double        rad ¹    stiffness preset; the equilibrium stays
//   /model/M/vsa/cmd                   trajectory    rad ¹    name `J` = equilibrium, `J_preset` = preset
//   /model/M/vsa/cmd_array             actuators     rad ¹    all equilibria, then all presets, in the plug-in's order
//   /model/M/vsa/joint_state           joint states  rad …    per actuator: shaft (the SDF joint's name), J_motor_1, J_motor_2
//   /model/M/joint/J/stiffness         double        N·m/rad
//   /model/M/joint/J/deflection        double        rad      shaft − equilibrium
//   /model/M/joint/J/preset            double        rad ¹    attained, from the pulleys
//   /model/M/joint/J/current_1, _2     double        A        physical; the unit's filtered readings are on its port
//   /model/M/vsa/faults                a service: text to text; what it means is a seat's business (vsa/seat/seat.hpp)
//   ¹ the unit of the actuator's law: half the pulleys' difference, in rad, for the qbmove
//
// A trajectory with one point acts at once, whatever its time. With several, each channel goes linearly from its
// present command to the first point and from point to point, in simulated time that starts at the next step, and holds the last;
// velocities and efforts aren't used. A channel that isn't named keeps what it has.
//
// Refused as a whole, with one reported line a topic and kind of fault: numbers that aren't finite, wrong lengths, unknown or
// repeated names, times that are negative or don't increase. Out-of-range values are the robot's business: it clamps and gives a
// Notice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::host {

/// A trajectory message: channels by name, and their values at each point. One point acts at once, several are followed linearly.
struct Trajectory {
  /// One line of the table: a value for each name, and when.
  struct Point {
    std::vector<double> positions;  ///< one a name
    double time_from_start_s = 0;   ///< ≥ 0, from point to point more
  };
  std::vector<std::string> names;  ///< of channels: an actuator's name, or that and "_preset"
  std::vector<Point> points;       ///< in order of time
};

/// The message of cmd_array.
struct ActuatorsCmd {
  std::vector<double> positions;  ///< all equilibria, rad, then all presets
};

/// The states of one robot at one instant. Simulation truth, not the unit's readings.
struct JointStates {
  /// A shaft or a pulley.
  struct Joint {
    std::string name;               ///< as host/topics.hpp names it in a message
    double position_rad = 0;        ///< rad; m of a shaft that slides
    double velocity_rad_per_s = 0;  ///< rad/s; m/s of a shaft that slides
    double force_Nm = 0;            ///< shaft: by the actuator on the robot; motor: by the spring on its pulley
  };
  /// What an actuator has been told, so that a client sees its command arrive.
  struct Command {
    double equilibrium_rad = 0;  ///< as it was given
    double preset = 0;           ///< likewise, in the law's preset unit
  };
  /// What these numbers are in.
  struct Units {
    std::string equilibrium = "rad",  ///< "m" of a shaft that slides
        preset = "rad";               ///< the law's or the servo's; empty: it has no preset
  };
  std::int64_t time_ns = 0;              ///< simulated
  std::string model;                     ///< scoped name
  std::vector<Joint> joints;             ///< of each actuator: shaft, motor 1, and motor 2 where it has one
  std::vector<std::string> names;        ///< of the actuators
  std::vector<std::size_t> first_joint;  ///< each actuator's shaft, in `joints`
  std::vector<Command> commands;         ///< one per actuator
  std::vector<Units> units;              ///< likewise
};

/// One advertised topic. `wanted` must be cheap: it is asked for every topic at the state rate.
template <class Message>
class Publisher {
 public:
  virtual ~Publisher() = default;
  [[nodiscard]] virtual bool wanted() const noexcept = 0;  ///< whether anybody listens
  /// Sends it; `time_ns` is its stamp.
  virtual void publish(std::int64_t time_ns, const Message& message) = 0;
};

/// What became of a subscription, a service or a topic.
enum class Outcome {
  ok,
  unsupported,  ///< the transport has no such message kind: the topic is left out
  refused,      ///< the transport takes no such topic name
};

/// What a host supplies so that RobotTopics can subscribe and publish. Handlers may be called from any thread, and no more once the
/// transport is gone.
class TopicTransport {
 public:
  virtual ~TopicTransport() = default;
  virtual Outcome on_double(const std::string& topic, std::function<void(double)> handler) = 0;  ///< `handler` gets each message
  virtual Outcome on_trajectory(const std::string& topic, std::function<void(const Trajectory&)> handler) = 0;   ///< likewise
  virtual Outcome on_actuators(const std::string& topic, std::function<void(const ActuatorsCmd&)> handler) = 0;  ///< likewise
  /// A service: a text is asked and one answered; none: there is nobody any more who could.
  using Answer = std::function<std::optional<std::string>(const std::string& request)>;
  /// Answers requests until the transport is gone.
  virtual Outcome serve_text(const std::string& service, Answer answer) = 0;
  /// Null: unsupported or refused.
  virtual std::unique_ptr<Publisher<double>> advertise_double(const std::string& topic) = 0;
  /// Null: unsupported or refused.
  virtual std::unique_ptr<Publisher<JointStates>> advertise_states(const std::string& topic) = 0;
};

/// "a::b" → "a/b". Throws InputError where the name can't be a topic: empty parts, white space, '@', '~' or ":=".
[[nodiscard]] std::string topic_scope(std::string_view scoped_name, std::string_view what);

/// The topics' names, for hosts and clients alike. Names are scoped with "::" or "/".
[[nodiscard]] std::string model_topic(std::string_view model, std::string_view leaf);  ///< leaf: "vsa/cmd", "vsa/joint_state", …
/// The same of an actuator's topics: "cmd_equilibrium", "stiffness", …
[[nodiscard]] std::string joint_topic(std::string_view model, std::string_view actuator, std::string_view leaf);

/// One robot's topics: takes commands, publishes states, reports what is refused. The robot must outlive it. Commands that come
/// once it is gone, or whose constructor threw, do nothing.
class RobotTopics {
 public:
  /// One readable line. Called from any thread.
  using Report = std::function<void(const std::string& line)>;

  /// Throws InputError with every name that can't be a topic, and where a name `J_preset` could mean two things.
  RobotTopics(Robot& robot, std::string model, TopicTransport& transport, Report report);
  ~RobotTopics();
  RobotTopics(RobotTopics&&) noexcept;
  RobotTopics& operator=(RobotTopics&&) noexcept;

  /// After every step: publishes when a state period of simulated time has begun since the last call (or time went back), to those
  /// who listen, and reports what the robot clamped. Between two periods it costs a comparison.
  void update(std::int64_t time_ns);
  /// Publishes whatever the time: for a paused host, so that who comes late sees the state too.
  void publish(std::int64_t time_ns);

  [[nodiscard]] std::uint64_t refused() const;  ///< commands refused so far, reported or not

 private:
  struct Impl;
  Owner<Impl> impl_;
};

}  // namespace vsa::host
