// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whether a robot that is left alone comes to rest, as any host's robot tells it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::test {

constexpr double kQuiet_rad_per_s = 0.02;
constexpr double kScatter = 0.01;          // of the joint's largest torque …
constexpr double kScatterLeast_Nm = 2e-3;  // … or as much as that, where hardly any torque is asked for
constexpr double kCreated = -1e-3;         // summed coupling over what moved
constexpr double kNothing_J = 1e-9;        // moves nothing: rounding has no sign

struct Rest {
  double rms_speed = 0;      ///< of the actuated joints over the time measured, rad/s
  double top_speed = 0;      ///< of any joint at any time, rad/s: a world that stands still for another reason shows here
  double scatter = 0;        ///< the largest standard deviation of a torque over it, per the largest torque of that joint, of those
                             ///< that scatter by more than kScatterLeast_Nm
  double torque_sd_Nm = 0;   ///< the largest deviation itself
  double coupling_J = 0;     ///< the summed `coupling`
  double coupling_part = 0;  ///< the summed `coupling` over what moved
  double integrator_part = 0;  ///< likewise `integrator`

  [[nodiscard]] bool slow() const { return rms_speed < kQuiet_rad_per_s; }
  [[nodiscard]] bool steady() const { return scatter < kScatter; }
};

class RestMeter {
 public:
  explicit RestMeter(std::size_t joints) : joints_(joints) {}

  /// One joint after a step. `count`: in the time that is measured, else only its torque's size is.
  void sample(std::size_t joint, const host::ActuatorReading& r, bool count) {
    Sums& s = joints_[joint];
    s.largest = std::max(s.largest, std::abs(r.mean_torque_Nm));
    top_speed_ = std::max(top_speed_, std::abs(r.shaft_speed_rad_per_s));
    if (!count) return;
    ++s.n;
    s.t += r.mean_torque_Nm;
    s.tt += r.mean_torque_Nm * r.mean_torque_Nm;
    s.vv += r.shaft_speed_rad_per_s * r.shaft_speed_rad_per_s;
  }
  void sample(const host::Robot& robot, bool count) {
    for (std::size_t i = 0; i < joints_.size(); ++i) sample(i, robot.read(i), count);
  }

  [[nodiscard]] Rest rest(const actuator::Ledger& ledger) const {
    Rest rest;
    rest.top_speed = top_speed_;
    double vv = 0, n = 0;
    for (const Sums& s : joints_) {
      vv += s.vv;
      n += s.n;
      const double sd = std::sqrt(std::max(0.0, s.tt / s.n - (s.t / s.n) * (s.t / s.n)));
      rest.torque_sd_Nm = std::max(rest.torque_sd_Nm, sd);
      if (sd > kScatterLeast_Nm) rest.scatter = std::max(rest.scatter, sd / s.largest);
    }
    rest.rms_speed = std::sqrt(vv / n);
    rest.coupling_J = ledger.coupling;
    if (ledger.moved() > kNothing_J) {
      rest.coupling_part = ledger.coupling / ledger.moved();
      rest.integrator_part = ledger.integrator / ledger.moved();
    }
    return rest;
  }

 private:
  struct Sums {
    double t = 0, tt = 0, vv = 0, largest = 0, n = 0;
  };
  std::vector<Sums> joints_;
  double top_speed_ = 0;
};

}  // namespace vsa::test
