// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/unit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vsa::device {
namespace {

using firmware::kTickNs;

constexpr int kMaxIterations = 80;
constexpr double kRelativeTolerance = 1e-4;
constexpr double kAbsoluteTolerance_Nm = 1e-6;
constexpr double kDutyScale = 101.0;  // the PWM counter's period

std::int16_t to_ticks(double rad, int resolution) noexcept {
  const double raw = std::nearbyint(rad / (2.0 * kPi) * kRawPerTurn);
  const double ticks = std::floor(raw / static_cast<double>(1 << resolution));
  return static_cast<std::int16_t>(std::clamp(ticks, -32768.0, 32767.0));
}

}  // namespace

Unit::Unit(UnitConfig config)
    : config_(std::move(config)), shaft_friction_(config_.actuator.shaft_friction), actuator_(config_.actuator) {}

int Unit::ticks_in(std::int64_t t_ns, std::int64_t dt_ns) noexcept {
  const std::int64_t first = (t_ns + kTickNs - 1) / kTickNs;
  const std::int64_t end = (t_ns + dt_ns + kTickNs - 1) / kTickNs;
  return static_cast<int>(end - first);
}

std::array<Ticks, 2> Unit::inputs_for(double equilibrium_rad, double preset) const noexcept {
  const double kept = std::clamp(preset, -config_.preset_max, config_.preset_max);
  const auto x = config_.actuator.transmission->references({equilibrium_rad, kept});
  return {Ticks{to_ticks(x[0], config_.loop.resolution[0])}, Ticks{to_ticks(x[1], config_.loop.resolution[1])}};
}

UnitState Unit::initial(double equilibrium_rad, double preset, double shaft_rad) const noexcept {
  UnitState s;
  firmware::set_inputs(config_.loop, s.loop, inputs_for(equilibrium_rad, preset));
  s.loop.ref = s.loop.ref_old = s.loop.ref_new;
  s.loop.motors_on = true;
  s.loop.limit_pct = config_.loop.supply_limit
                         ? firmware::supply_limit_pct(sensor::supply_from_adc(sensor::supply_adc(config_.actuator.bridge.supply_V)))
                         : 100;
  const double rad_per_raw = radians(Raw{1});
  s.actuator = actuator_.initial({s.loop.ref[0] * rad_per_raw, s.loop.ref[1] * rad_per_raw}, shaft_rad);
  return s;
}

void Unit::tick(UnitState& s, double shaft, const TickMail& mail) noexcept {
  if (mail.has_inputs) firmware::set_inputs(config_.loop, s.loop, mail.inputs);
  const actuator::ActuatorParams& p = config_.actuator;
  firmware::TickInputs in;
  const std::array<double, 3> angle{s.actuator.motor[0].angle, s.actuator.motor[1].angle, shaft};
  for (int i = 0; i < 3; ++i) in.encoder[i] = sensor::encoder_sample(p.encoder, angle[i] + (i == 2 ? p.shaft_zero_rad : 0.0));
  for (int i = 0; i < 2; ++i)
    in.current_adc[i] = sensor::current_adc(actuator_.motor_current(s.actuator, i, s.voltage[i], s.terminal));
  drive::BridgeParams bridge = p.bridge;
  if (!s.supply_on) bridge.supply_V = 0.0;
  in.supply_adc = sensor::supply_adc(bridge.supply_V);
  // The duty goes out before this tick's supply reading changes the limit.
  const std::int32_t limit = config_.loop.supply_limit ? s.loop.limit_pct : 100;
  firmware::tick(config_.loop, s.loop, in);
  const bool off = !s.loop.motors_on;
  s.terminal = off && !bridge.brake_when_off ? drive::Terminal::open : drive::Terminal::driven;
  for (int i = 0; i < 2; ++i) {
    const double output = limit > 0 ? s.loop.duty[i] / static_cast<double>(limit) : 0.0;
    s.voltage[i] = off ? 0.0 : config_.polarity * drive::bridge_voltage(bridge, output, limit / kDutyScale);
  }
}

Unit::Walk Unit::walk(UnitState& s, const Path& path, std::span<const TickMail> mail) noexcept {
  const auto substep_ns = static_cast<std::int64_t>(std::llround(config_.substep_max_s * 1e9));
  const double dt_s = static_cast<double>(path.dt_ns) * 1e-9;
  // What the host will do with the shaft if the prediction holds: q' = q + dt·v'.
  const double end_speed = 2.0 * path.dy / dt_s - path.speed;
  Walk sum;
  std::size_t ticks = 0;
  for (std::int64_t now = 0; now < path.dt_ns;) {
    const std::int64_t into_tick = (path.t_ns + now) % kTickNs;
    if (into_tick == 0 && now == 0) {
      ++ticks;  // done by step(): it doesn't depend on the path
    } else if (into_tick == 0) {
      tick(s, path.q0 + static_cast<double>(now) * 1e-9 * end_speed, ticks < mail.size() ? mail[ticks] : TickMail{});
      ++ticks;
    }
    const std::int64_t h_ns = std::min({substep_ns, kTickNs - into_tick, path.dt_ns - now});
    const double share = static_cast<double>(h_ns) / static_cast<double>(path.dt_ns);
    const auto r = actuator_.segment(s.actuator, static_cast<double>(h_ns) * 1e-9, {path.dy * share, s.voltage, s.terminal});
    sum.torque += r.torque * share;
    // r.slope is for the segment's own end; with the whole path its start moves too. 1 for a single segment.
    const double reach = 2.0 * static_cast<double>(now) / static_cast<double>(path.dt_ns) + share;
    sum.slope += r.slope * share * reach;
    now += h_ns;
  }
  return sum;
}

double Unit::step(UnitState& s, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in, std::span<const TickMail> mail) noexcept {
  const double dt = static_cast<double>(dt_ns) * 1e-9;
  const double y = in.angle - 0.5 * dt * in.speed;
  if (!s.started) {
    actuator_.place(s.actuator, y);
  } else {
    actuator_.settle(s.actuator, y, s.applied_torque, y - s.start_y, s.path_work);
  }
  const double other = s.started ? (in.speed - s.last_speed) / s.last_dt - in.inverse_inertia * s.applied_torque : 0.0;
  const double c = 0.5 * dt * dt * in.inverse_inertia;
  const double free = dt * in.speed + 0.5 * dt * dt * other;
  const double u = y - s.actuator.shaft_anchor;

  // A tick at the step's start sees the shaft where it is, so it happens once and not in every trial of the path.
  if (t_ns % kTickNs == 0) tick(s, in.angle, mail.empty() ? TickMail{} : mail[0]);

  const UnitState start = s;
  double dy = s.started ? free + c * s.applied_torque : free;
  double low = -std::numeric_limits<double>::infinity(), high = -low, last_move = high;
  double torque = 0;
  Walk path;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (iteration > 0) s = start;
    path = walk(s, {y, dy, in.angle, in.speed, t_ns, dt_ns}, mail);
    // Newton on the spring, exact on the friction.
    const double slope = std::max(path.slope, 0.0);
    const double yield = 1.0 / (1.0 + c * slope);
    const auto next = drive::solve_friction(shaft_friction_, u, (free + c * (path.torque + slope * dy)) * yield, c * yield);
    const double move = next.displacement - dy;
    torque = path.torque - slope * move + next.torque;
    // The linear correction leaves an error of second order; the stiffer the step (c·slope), the more of it reaches the shaft.
    if (std::abs(slope * move) <= yield * yield * (kRelativeTolerance * std::abs(path.torque) + kAbsoluteTolerance_Nm)) break;
    // The residual grows with dy, so its sign brackets the root; a hardening spring throws Newton out, bisection calls it back.
    (move > 0 ? low : high) = dy;
    const bool inside = next.displacement > low && next.displacement < high;
    const bool shrinking = std::abs(move) < 0.7 * last_move;
    last_move = std::abs(move);
    const bool bracketed = std::isfinite(low) && std::isfinite(high);
    dy = inside && (shrinking || !bracketed) ? next.displacement : 0.5 * (low + high);
    if (!std::isfinite(dy)) break;
  }
  const double spring_work = path.torque * dy;
  const auto rub = actuator_.shaft_friction(s.actuator, dy);
  s.path_work = s.actuator.ledger.pending = spring_work + rub.torque * dy;
  s.start_y = y;
  s.applied_torque = torque;
  s.last_speed = in.speed;
  s.last_dt = dt;
  s.started = true;
  return torque;
}

}  // namespace vsa::device
