// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What every simulator does with a robot; its host only carries numbers in and out (docs/howto/your-simulator.md, examples/host).
//
//   Seat seat({element_xml, "world: model", "model", joints_of_the_model}, options);
//   seat.join(trees);            which joints move each other            once
//   seat.open_ports();           the buses' serial ports
//   seat.connect(port);          the robot's topics, on any transport
//
//   every step:  each actuator's angle and speed into seat.in()
//                if (seat.wants_mobility()) fill seat.mobility();
//                seat.step(dt_ns);
//                apply seat.torques(), and let the host's engine make its step
//                each angle and speed again; seat.observe();             where the host can look after its step
//                seat.publish_step(simulated time);
//   standing:    seat.publish_paused(simulated time);
//
// The seat's clock counts the steps that it was given since it was made or reset, so a host that sets its time back or seeks doesn't
// disturb buses and firmware; stamps of messages are the host's time.
// One thread steps; commands, faults and clients of serial ports come from any.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsa/config/plugin_xml.hpp"
#include "vsa/host/mobility_watch.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/host/robot_group.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/ports/pace_watch.hpp"
#include "vsa/ports/robot_ports.hpp"
#include "vsa/seat/driven_joints.hpp"

namespace vsa::seat {

/// A joint of the host's model.
struct Joint {
  std::string name;                   ///< relative to the model: "module_1::shaft"
  JointKey key{};                     ///< none: two robots that drive one joint go unnoticed
  std::string refusal{};              ///< why no actuator can drive it; empty: one can
  std::optional<double> start_rad{};  ///< where it begins, if not at 0
  bool slides = false;                ///< its position is a travel in m, for a linear actuator
};

/// What a host knows of a model before it steps: from it the seat makes its robot.
struct Model {
  std::string xml;                           ///< of the whole `<plugin>` element
  std::string where;                         ///< leads every line of a problem: "arm.sdf: arm"
  std::string name;                          ///< scoped
  std::vector<Joint> joints;                 ///< those that an element may name
  std::optional<host::RobotConfig> robot{};  ///< given: instead of `xml`, for a host whose models say it otherwise
};

/// What a host, or its user, wants otherwise than the element says.
struct Options {
  config::TypeLibrary types{};         ///< where the types that the element names are looked for
  config::Replacement actuator{};      ///< puts another actuator on the robot
  host::RobotTopics::Report report{};  ///< one readable line, from any thread; none: nobody is told
  bool makes_substeps = false;         ///< the host honours `<substeps>`; else a robot that asks for several is refused
  bool watches_pace = true;            ///< tells once where a robot with a serial port falls behind the wall clock
};

/// What every simulator does with a robot: host::Robot with its clock, B, ports, topics, faults and snapshots; its host only
/// carries numbers in and out. Neither copied nor moved; see clone().
class Seat {
 public:
  using Report = host::RobotTopics::Report;  ///< who reads the seat's lines

  /// Throws InputError with every problem at once; a joint that another robot of this process drives is one.
  Seat(const Model& model, const Options& options);
  ~Seat();
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  /// Another seat with its robot in the same state, without ports, topics and report: for a copy of the host's model.
  [[nodiscard]] std::unique_ptr<Seat> clone() const;

  [[nodiscard]] const std::string& model() const noexcept { return model_; }  ///< scoped name
  [[nodiscard]] host::Robot& robot() noexcept { return robot_; }              ///< its steps and resets are the seat's
  [[nodiscard]] const host::Robot& robot() const noexcept { return robot_; }  ///< to look at
  /// Of the actuators, into Model::joints.
  [[nodiscard]] const std::vector<std::size_t>& joints() const noexcept { return joints_; }
  void report_to(Report report) { report_ = std::move(report); }  ///< from now on; topics: from connect() on

  /// Which actuators' joints move each other (host::Robot::join). None where the model is no tree: that is reported, and each joint
  /// is then solved by itself with its type's shaft inertia, or what the host gives as JointIn::inverse_inertia.
  /// `shared`: those on a tree that other seats' actuators drive, too; such seats step in a SeatGroup (seat/seat_group.hpp).
  void join(const std::vector<std::vector<std::size_t>>& trees, const std::vector<std::size_t>& shared = {});

  /// One entry an actuator, to be filled before step() and before observe(). A step allocates nothing, as long as nothing is
  /// reported.
  [[nodiscard]] std::span<host::JointIn> in() noexcept { return own_.now.in; }
  /// Once before each step, when in() is filled: whether B is due (host/mobility_watch.hpp).
  [[nodiscard]] bool wants_mobility() noexcept { return !own_.mobility.empty() && own_.watch.due(own_.now.in); }
  /// Before that: how much a joint of its trees that it doesn't drive may have turned in the step before (MobilityWatch::turned).
  void turned(double rad) noexcept { own_.watch.turned(rad); }
  /// To be filled where wants_mobility() says so: B of each tree by rows, in the order of join().
  [[nodiscard]] std::span<double> mobility() noexcept { return own_.mobility; }
  /// A step length that the units don't know, or a joint that is no longer finite, stops the actuators with one reported line:
  /// torques are 0 until reset().
  /// `holder`: as host::Robot::advance has it.
  void step(std::int64_t dt_ns, device::Holder* holder = nullptr);
  /// Of the last step, N·m (N of a linear actuator), one an actuator.
  [[nodiscard]] std::span<const double> torques() const noexcept { return torques_; }
  [[nodiscard]] bool stopped() const noexcept { return own_.now.stopped; }  ///< whether it gave up, see step()
  /// in() tells where the joints are after the host's step.
  void observe() noexcept { robot_.observe(own_.now.in); }
  /// The host has put bodies elsewhere: B is due in the next step. With an actuator: its joint, and that was neither work nor
  /// acceleration, and readings have it where in() tells; throws InputError for one that isn't there.
  void moved() noexcept { own_.watch.again(); }
  void moved(std::size_t actuator);  ///< InputError: no such actuator

  void open_ports();  ///< reports each; throws InputError with every one that can't be had
  /// Those that are open.
  [[nodiscard]] const std::vector<std::unique_ptr<serial::VirtualPort>>& ports() const noexcept { return ports_.all(); }

  /// The robot's topics (host/topics.hpp) and the service of its faults, /model/M/vsa/faults: asked "ACTUATOR words" or "all words"
  /// (config/faults_text.hpp) it answers "ok: …", or "refused: …" and nothing has changed. Several transports: on each. Throws InputError
  /// for names that the transport doesn't take.
  void connect(std::shared_ptr<host::TopicTransport> transport);
  void disconnect();  ///< from all
  /// After a step: states at the robot's state rate, and what the robot has to tell. Without topics: only that, 10 times a simulated
  /// second.
  void publish_step(std::int64_t time_ns);
  void publish_paused(std::int64_t time_ns);    ///< the same while the host stands, 10 times a wall second at most
  void publish(std::int64_t time_ns);           ///< now, whatever the time
  [[nodiscard]] std::uint64_t refused() const;  ///< commands on topics refused so far

  /// "ACTUATOR words" or "all words" (config/faults_text.hpp): sets the faults of one actuator or of all, or of none where anything
  /// is wrong (InputError; `source` names the text in it). With the same words each unit gets the next seed. Returns the actuators'
  /// names. From any thread.
  std::vector<std::string> apply_faults(std::string_view text, std::string_view source);

  void reset();  ///< back to the first sample

  struct Snapshot;  ///< of robot, clock, B and in()
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;
  void restore(const Snapshot& snapshot);      ///< of this seat or of a clone; torques are 0 until the next step
  void check(const Snapshot& snapshot) const;  ///< throws InputError where restore() would be wrong
  /// As numbers: the robot's (host/robot.hpp tells of errors), then the seat's own; join() changes the layout.
  [[nodiscard]] StateLayout state_layout() const;
  [[nodiscard]] std::size_t state_size() const noexcept { return robot_.state_size() + own_size_; }  ///< how many save() gives
  void save(std::span<double> out) const;                                                            ///< fills state_size() numbers
  void restore(std::span<const double> in);  ///< as restore() of a snapshot, from such numbers
  void check(std::span<const double> in);    ///< throws what restore() would
  /// As host::Robot has them; the seat's own numbers come first.
  void save_tight(state::Rewriter& out) const;
  std::size_t restore_tight(std::span<const double> in);  ///< how many it took
  /// For a host whose step may fail: keep() before it, and go_back() to there. Nothing is allocated.
  void keep();
  void go_back();  ///< to where keep() was called last

 private:
  friend class SeatGroup;
  using Clock = std::chrono::steady_clock;
  struct Desk;
  /// What a step changes beside the robot and B.
  struct Moment {
    std::int64_t time_ns = 0;
    bool stopped = false;
    std::vector<host::JointIn> in;
    static auto fields(auto& s, auto&& visit) {
      return visit("time", "ns", s.time_ns, "stopped", "", s.stopped, "joint", "", s.in);
    }
    [[nodiscard]] const char* impossible() const noexcept;
  };
  /// All of the seat's own.
  struct Own {
    Moment now;
    std::vector<double> mobility;
    host::MobilityWatch watch;
    [[nodiscard]] static Own of(std::size_t joints);  ///< at the first sample
    static auto fields(auto& s, auto&& visit) {
      return visit("now", "", s.now, "mobility", "1/(kg·m²)", s.mobility, "mobility_watch", "", s.watch);
    }
  };
  struct Connection {
    std::shared_ptr<host::TopicTransport> transport;
    host::RobotTopics topics;
  };

  Seat(const Seat& other, host::Robot robot);
  /// step() of seats on one tree, in the order of the group's robots, whose mobility() is filled. Where one has stopped all do.
  /// `holder`: of the group's trees; steps() has those of the robots' own.
  static void step_together(std::span<Seat* const> seats, host::RobotGroup& group, std::int64_t dt_ns, device::Holder* holder);
  void stop(const std::string& why);
  [[nodiscard]] bool can_step(std::int64_t dt_ns);
  void stepped(std::int64_t dt_ns);
  void tell(const std::string& line) const;
  void tell_notices();
  void read_own(std::span<const double> in);  ///< of all numbers, into loaded_; throws InputError
  void set_own(const Own& own);

  std::string model_;
  host::Robot robot_;
  std::vector<std::size_t> joints_;
  DrivenJoints driven_;
  Report report_;
  bool watches_pace_;
  Own own_, kept_, loaded_;  ///< loaded_: scratch of numbers that are being checked
  std::vector<double> torques_;
  std::size_t own_size_ = 0;     ///< as numbers
  std::int64_t last_told_ = -1;  ///< tenth of a second whose notices were told
  Clock::time_point next_paused_{};
  std::vector<Connection> connections_;
  std::shared_ptr<Desk> desk_;  ///< answers for the seat while it is connected
  ports::RobotPorts ports_;
  ports::PaceWatch pace_;
};

}  // namespace vsa::seat
