// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A pendulum integrator of one's own as the host of a robot with one actuator: v' = v + dt·a, q' = q + dt·v'. All else, from the
// element to firmware, bus, springs, faults and serial ports, is the seat's (docs/howto/your-simulator.md). Topics need a
// transport: seat.connect(std::make_shared<vsa::topics::IgnitionTransport>()), and vsa::topics beside vsa::seat in CMakeLists.txt.
#include <cmath>
#include <cstdio>

#include "vsa/errors.hpp"
#include "vsa/seat/seat.hpp"

namespace {

constexpr const char* kRobot = R"(<plugin name="vsa::Robot" filename="libvsa-robot.so">
  <actuator name="shoulder">
    <joint>hinge</joint>
    <type>qbmove_maker_pro_6_1</type>
    <bus id="1">arm</bus>
    <initial equilibrium_rad="0" preset_rad="0.3"/>
  </actuator>
  <bus name="arm"/>
</plugin>)";

/// A rod that hangs: the host's physics.
struct Pendulum {
  double inertia_kgm2 = 0.005, weight_Nm = 0.3;
  double angle_rad = 0, speed_rad_per_s = 0;

  void step(double torque_Nm, double dt_s) {
    speed_rad_per_s += dt_s * (torque_Nm - weight_Nm * std::sin(angle_rad)) / inertia_kgm2;
    angle_rad += dt_s * speed_rad_per_s;
  }
};

void run() {
  constexpr std::int64_t kStep_ns = 1'000'000;
  vsa::seat::Options options;
  options.report = [](const std::string& line) { std::printf("%s\n", line.c_str()); };
  vsa::seat::Seat seat({kRobot, "pendulum", "pendulum", {{"hinge"}}}, options);
  seat.open_ports();  // none here: a <bus> may have one
  seat.join({{0}});   // one tree of one joint, with B = 1/inertia
  seat.robot().command(0, 1.0, 0.4);

  Pendulum pendulum;
  const auto tell = [&] {
    seat.in()[0].angle_rad = pendulum.angle_rad;
    seat.in()[0].speed_rad_per_s = pendulum.speed_rad_per_s;
  };
  for (std::int64_t t_ns = 0; t_ns < 2'000'000'000; t_ns += kStep_ns) {
    tell();
    if (seat.wants_mobility()) seat.mobility()[0] = 1 / pendulum.inertia_kgm2;
    seat.step(kStep_ns);
    pendulum.step(seat.torques()[0], 1e-9 * kStep_ns);
    tell();
    seat.observe();
    seat.publish_step(t_ns + kStep_ns);
  }
  const vsa::host::ActuatorReading now = seat.robot().read(0);
  std::printf("after 2 s at %.3f rad, stiffness %.2f N·m/rad\n", now.shaft_rad, now.stiffness_Nm_per_rad);
}

}  // namespace

int main() {
  try {
    run();
  } catch (const vsa::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
