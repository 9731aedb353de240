// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/record/run_data.hpp"
#include "vsa/scenario/scenario.hpp"
#include "vsa/sweep/measure.hpp"

namespace vsa::sweep {
namespace {

using engine::World;
using host::ActuatorReading;
using Add = std::function<void(double)>;

constexpr double kTravelRate_Hz = 100;

double length(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

template <class Of>
using Signals = std::vector<std::pair<const char*, double (*)(const Of&)>>;

const Signals<ActuatorReading> kActuator{
    {"shaft_rad", [](const ActuatorReading& r) { return r.shaft_rad; }},
    {"shaft_speed_rad_per_s", [](const ActuatorReading& r) { return r.shaft_speed_rad_per_s; }},
    {"equilibrium_command_rad", [](const ActuatorReading& r) { return r.equilibrium_command_rad; }},
    {"equilibrium_rad", [](const ActuatorReading& r) { return r.equilibrium_rad; }},
    {"error_rad", [](const ActuatorReading& r) { return r.shaft_rad - r.equilibrium_command_rad; }},
    {"preset_command", [](const ActuatorReading& r) { return r.preset_command; }},
    {"preset", [](const ActuatorReading& r) { return r.preset; }},
    {"deflection_rad", [](const ActuatorReading& r) { return r.deflection_rad; }},
    {"stiffness_Nm_per_rad", [](const ActuatorReading& r) { return r.stiffness_Nm_per_rad; }},
    {"torque_Nm", [](const ActuatorReading& r) { return r.torque_Nm; }},
    {"motor_1_rad", [](const ActuatorReading& r) { return r.motor_rad[0]; }},
    {"motor_2_rad", [](const ActuatorReading& r) { return r.motor_rad[1]; }},
    {"motor_1_torque_Nm", [](const ActuatorReading& r) { return r.motor_torque_Nm[0]; }},
    {"motor_2_torque_Nm", [](const ActuatorReading& r) { return r.motor_torque_Nm[1]; }},
    {"current_1_A", [](const ActuatorReading& r) { return r.current_A[0]; }},
    {"current_2_A", [](const ActuatorReading& r) { return r.current_A[1]; }},
};

struct JointMotion {
  double position, speed;
};
const Signals<JointMotion> kJoint{{"position", [](const JointMotion& j) { return j.position; }},
                                  {"speed", [](const JointMotion& j) { return j.speed; }}};

struct LinkMotion {
  engine::Pose pose;
  engine::Twist twist;
};
const Signals<LinkMotion> kLink{
    {"x_m", [](const LinkMotion& l) { return l.pose.position[0]; }},
    {"y_m", [](const LinkMotion& l) { return l.pose.position[1]; }},
    {"z_m", [](const LinkMotion& l) { return l.pose.position[2]; }},
    {"speed_m_per_s", [](const LinkMotion& l) { return length(l.twist.linear_m_per_s); }},
    {"angular_speed_rad_per_s", [](const LinkMotion& l) { return length(l.twist.angular_rad_per_s); }},
};

/// What all measures of a sample share, worked out once.
struct Whole {
  actuator::Ledger ledger;
  std::array<double, 3> center{};
  double contact = 0, touches = 0, kinetic = 0, gravitational = 0;
  double path = kNaN, net = kNaN;  // until a gait's first period is full
};
struct Needs {
  bool ledger = false, center = false, contacts = false, energy = false, travel = false;
};
struct WorldSignal {
  const char* name;
  double (*value)(const Whole&);
  bool Needs::*need;
};
const std::vector<WorldSignal> kWorld{
    {"travel_net_m", [](const Whole& w) { return w.net; }, &Needs::travel},
    {"travel_path_m", [](const Whole& w) { return w.path; }, &Needs::travel},
    {"center_x_m", [](const Whole& w) { return w.center[0]; }, &Needs::center},
    {"center_y_m", [](const Whole& w) { return w.center[1]; }, &Needs::center},
    {"center_z_m", [](const Whole& w) { return w.center[2]; }, &Needs::center},
    {"contact_force_N", [](const Whole& w) { return w.contact; }, &Needs::contacts},
    {"contacts", [](const Whole& w) { return w.touches; }, &Needs::contacts},
    {"supply_J", [](const Whole& w) { return w.ledger.supply; }, &Needs::ledger},
    {"copper_J", [](const Whole& w) { return w.ledger.copper; }, &Needs::ledger},
    {"friction_J", [](const Whole& w) { return w.ledger.motor_friction + w.ledger.shaft_friction + w.ledger.tendon_friction; },
     &Needs::ledger},
    {"delivered_J", [](const Whole& w) { return w.ledger.delivered; }, &Needs::ledger},
    {"elastic_J", [](const Whole& w) { return w.ledger.elastic; }, &Needs::ledger},
    {"coupling_J", [](const Whole& w) { return w.ledger.coupling; }, &Needs::ledger},
    {"kinetic_J", [](const Whole& w) { return w.kinetic; }, &Needs::energy},
    {"gravitational_J", [](const Whole& w) { return w.gravitational; }, &Needs::energy},
};

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> out;
  for (const auto& entry : list) {
    if constexpr (requires { entry.name; }) {
      out.emplace_back(entry.name);
    } else {
      out.emplace_back(entry.first);
    }
  }
  return out;
}

template <class Of>
auto find(const Signals<Of>& list, const std::string& name) -> double (*)(const Of&) {
  for (const auto& [known, value] : list)
    if (name == known) return value;
  return nullptr;
}

/// Unnamed as the types that it knows: GCC 14 crashes on such a member of Impl in a unity source.
struct Watch {
  Statistic statistic;
  double from_s, to_s;
  double (*actuator)(const ActuatorReading&) = nullptr;
  std::optional<std::size_t> which{};  // actuator; none: all
  double (*joint)(const JointMotion&) = nullptr;
  engine::JointHandle joint_at{};
  double (*link)(const LinkMotion&) = nullptr;
  engine::LinkHandle link_at{};
  double (*whole)(const Whole&) = nullptr;
};

}  // namespace

std::vector<std::string> signal_names(const std::string& of) {
  return of == "actuator" ? names_of(kActuator)
         : of == "joint"  ? names_of(kJoint)
         : of == "link"   ? names_of(kLink)
                          : names_of(kWorld);
}

void check_signal(const Measure& m) {
  std::vector<std::string> known = signal_names(!m.joint.empty() ? "joint" : !m.link.empty() ? "link" : "actuator");
  if (m.joint.empty() && m.link.empty() && m.actuator.empty()) {
    const auto more = signal_names("world");
    known.insert(known.end(), more.begin(), more.end());
  }
  if (std::find(known.begin(), known.end(), m.signal) == known.end())
    throw InputError(
        {"", "signal", m.signal, "there is none of that name" + config::did_you_mean(m.signal, known), config::join(known)});
}

struct Observer::Impl {
  Impl(const std::vector<Measure>& measures, const World& world, double window_s)
      : model(scenario::travelling_model(world)),
        travel(window_s, std::max(1 / kTravelRate_Hz, world.step_s())),
        cadence(kTravelRate_Hz) {
    Problems problems;
    for (std::size_t i = 0; i < measures.size(); ++i) {
      try {
        watches.push_back(watch(measures[i], world));
      } catch (const InputError& error) {
        for (Problem p : error.problems()) {
          p.key = "measure[" + std::to_string(i) + "]" + (p.key.empty() ? "" : "." + p.key);
          problems.add(std::move(p));
        }
      }
    }
    problems.throw_if_any();
  }

  Watch watch(const Measure& m, const World& world) {
    check_signal(m);
    Watch w{Statistic(m), m.from_s, m.to_s};
    if (!m.joint.empty()) {
      w.joint = find(kJoint, m.signal);
      w.joint_at = world.joint(m.joint);
    } else if (!m.link.empty()) {
      w.link = find(kLink, m.signal);
      w.link_at = world.link(m.link);
    } else if ((w.actuator = find(kActuator, m.signal)) != nullptr) {
      if (world.actuators().empty()) throw InputError({"", "signal", m.signal, "the world has no actuator", ""});
      if (!m.actuator.empty()) {
        const auto& ref = world.actuator(m.actuator);
        for (std::size_t i = 0; i < world.actuators().size(); ++i)
          if (world.actuators()[i].robot == ref.robot && world.actuators()[i].index == ref.index) w.which = i;
      }
      reads = true;
    } else {
      for (const WorldSignal& s : kWorld) {
        if (m.signal != s.name) continue;
        w.whole = s.value;
        needs.*s.need = true;
        if ((s.need == &Needs::travel || s.need == &Needs::center) && model.empty())
          throw InputError({"", "signal", m.signal, "no robot of this world flies free", "a signal of actuators, joints or links"});
      }
    }
    return w;
  }

  void look(const World& world) {
    if (reads) {
      readings.clear();
      for (const auto& ref : world.actuators()) readings.push_back(world.read(ref));
    }
    if (needs.ledger) whole.ledger = world.ledger();
    if (needs.center) whole.center = world.center_of_mass(model);
    if (needs.travel && cadence.due(world.time_ns())) {
      cadence.taken(world.time_ns());
      travel.add(world.center_of_mass(model));
    }
    if (travel.measured()) {
      whole.path = travel.path_m();
      whole.net = travel.net_m();
    }
    if (needs.contacts) {
      world.contacts(contacts);
      whole.contact = 0;
      for (const auto& c : contacts) whole.contact = std::max(whole.contact, length(c.force_N));
      whole.touches = static_cast<double>(contacts.size());
    }
    if (needs.energy) {
      const World::Energy e = world.energy();
      whole.kinetic = e.kinetic;
      whole.gravitational = e.gravitational;
    }
  }

  void sample(const World& world) {
    look(world);
    const double t = world.time_s();
    for (Watch& w : watches) {
      if (!(t > w.from_s && t <= w.to_s)) continue;
      if (w.actuator != nullptr && w.which) {
        w.statistic.add(t, w.actuator(readings[*w.which]));
      } else if (w.actuator != nullptr) {
        for (const ActuatorReading& r : readings) w.statistic.add(t, w.actuator(r));
      } else if (w.joint != nullptr) {
        w.statistic.add(t, w.joint({world.joint_angle(w.joint_at), world.joint_speed(w.joint_at)}));
      } else if (w.link != nullptr) {
        w.statistic.add(t, w.link({world.pose(w.link_at), world.velocity(w.link_at)}));
      } else if (const double value = w.whole(whole); travel.measured() || !std::isnan(value)) {
        w.statistic.add(t, value);
      }
    }
  }

  std::string model;
  motion::Travel travel;
  record::Cadence cadence;
  Needs needs;
  bool reads = false;
  std::vector<Watch> watches;
  std::vector<ActuatorReading> readings;
  std::vector<engine::Contact> contacts;
  Whole whole;
};

Observer::Observer(const std::vector<Measure>& measures, const World& world, double window_s)
    : impl_(std::make_unique<Impl>(measures, world, window_s)) {}
Observer::~Observer() = default;
void Observer::sample(const World& world) { impl_->sample(world); }
std::vector<double> Observer::values() const {
  std::vector<double> out;
  for (const Watch& w : impl_->watches) out.push_back(w.statistic.value());
  return out;
}

}  // namespace vsa::sweep
