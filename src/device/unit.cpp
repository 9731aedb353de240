// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/unit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

double seconds(std::int64_t ns) noexcept { return static_cast<double>(ns) * 1e-9; }

std::int64_t substep(const UnitConfig& config) noexcept {
  return static_cast<std::int64_t>(std::llround(config.substep_max_s * 1e9));
}

struct Span {
  std::int64_t t_ns, dt_ns, substep_ns;
};

/// Trials of the shaft's path over a step, with voltages that are known. Each begins at the same state; the last one is kept. All
/// but a step's last segment run on the state itself, put back for the next trial; most steps have that one only.
class PathTrials {
 public:
  PathTrials(actuator::Actuator& actuator, actuator::ActuatorState& state, std::span<const Held> held, const Span& span) noexcept
      : actuator_(actuator), state_(state), held_(held), span_(span) {
    if (length(0) < span_.dt_ns) {
      start_ = state_;
    } else {
      begin_last(0, 0);
    }
  }

  /// What the last segment lets expect for dy = 0; none for a step of several segments.
  [[nodiscard]] std::optional<actuator::SegmentResult> foresee() noexcept {
    if (start_) return std::nullopt;
    return actuator_.foresee(state_, last_);
  }

  /// The mean torque along y → y + dy, and its slope.
  actuator::SegmentResult at(double dy) noexcept {
    if (!start_) return actuator_.attempt(state_, last_, dy);
    state_ = *start_;
    actuator::SegmentResult sum;
    std::int64_t now = 0;
    std::size_t interval = 0;
    for (std::int64_t h = length(0); now + h < span_.dt_ns; h = length(now)) {
      const actuator::SegmentInput in{dy * share(h), held_[interval].voltage, held_[interval].terminal};
      add(sum, actuator_.segment(state_, seconds(h), in), now, h);
      now += h;
      if ((span_.t_ns + now) % kTickNs == 0) ++interval;
    }
    begin_last(now, interval);
    add(sum, actuator_.attempt(state_, last_, dy * share(span_.dt_ns - now)), now, span_.dt_ns - now);
    return sum;
  }

  void finish() noexcept { actuator_.finish(state_, last_); }

 private:
  [[nodiscard]] std::int64_t length(std::int64_t now) const noexcept {
    return std::min({span_.substep_ns, kTickNs - (span_.t_ns + now) % kTickNs, span_.dt_ns - now});
  }
  [[nodiscard]] double share(std::int64_t h_ns) const noexcept {
    return static_cast<double>(h_ns) / static_cast<double>(span_.dt_ns);
  }
  void begin_last(std::int64_t now, std::size_t interval) noexcept {
    actuator_.begin(state_, last_, seconds(span_.dt_ns - now), {0.0, held_[interval].voltage, held_[interval].terminal});
  }
  void add(actuator::SegmentResult& sum, const actuator::SegmentResult& r, std::int64_t now, std::int64_t h) const noexcept {
    sum.torque += r.torque * share(h);
    // r.slope is for the segment's own end; with the whole path its start moves too. 1 for a single segment.
    sum.slope += r.slope * share(h) * (2.0 * share(now) + share(h));
  }

  actuator::Actuator& actuator_;
  actuator::ActuatorState& state_;
  std::optional<actuator::ActuatorState> start_;
  std::span<const Held> held_;
  Span span_;
  actuator::Segment last_;
};

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
    in.current_adc[i] = sensor::current_adc(actuator_.motor_current(s.actuator, i, s.held.voltage[i], s.held.terminal));
  drive::BridgeParams bridge = p.bridge;
  if (!s.supply_on) bridge.supply_V = 0.0;
  in.supply_adc = sensor::supply_adc(bridge.supply_V);
  // The duty goes out before this tick's supply reading changes the limit.
  const std::int32_t limit = config_.loop.supply_limit ? s.loop.limit_pct : 100;
  firmware::tick(config_.loop, s.loop, in);
  const bool off = !s.loop.motors_on;
  s.held.terminal = off && !bridge.brake_when_off ? drive::Terminal::open : drive::Terminal::driven;
  for (int i = 0; i < 2; ++i) {
    const double output = limit > 0 ? s.loop.duty[i] / static_cast<double>(limit) : 0.0;
    s.held.voltage[i] = off ? 0.0 : config_.polarity * drive::bridge_voltage(bridge, output, limit / kDutyScale);
  }
}

void Unit::run_ticks(UnitState& s, const Step& step, std::span<const TickMail> mail, std::span<Held> held) noexcept {
  std::size_t ticks = 0, intervals = 0;
  const auto next_mail = [&] { return ticks < mail.size() ? mail[ticks] : TickMail{}; };
  std::int64_t until = kTickNs - step.t_ns % kTickNs;
  if (until == kTickNs) tick(s, step.angle, next_mail()), ++ticks;
  held[intervals++] = s.held;
  if (until >= step.dt_ns) return;
  const actuator::ActuatorState start = s.actuator;
  const auto substep_ns = substep(config_);
  // What the host will do with the shaft if the prediction holds: q' = q + dt·v'.
  const double end_speed = 2.0 * step.dy / seconds(step.dt_ns) - step.speed;
  for (std::int64_t now = 0; until < step.dt_ns; until += kTickNs) {
    for (; now < until; now = std::min(now + substep_ns, until)) {
      const std::int64_t h_ns = std::min(substep_ns, until - now);
      const double share = static_cast<double>(h_ns) / static_cast<double>(step.dt_ns);
      actuator_.segment(s.actuator, seconds(h_ns), {step.dy * share, s.held.voltage, s.held.terminal});
    }
    tick(s, step.angle + seconds(now) * end_speed, next_mail());
    ++ticks;
    held[intervals++] = s.held;
  }
  s.actuator = start;
}

double Unit::step(UnitState& s, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in, std::span<const TickMail> mail) noexcept {
  const double dt = seconds(dt_ns);
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

  double dy = s.started ? free + c * s.applied_torque : free;
  std::array<Held, kMaxTicksPerStep + 1> held;
  run_ticks(s, {t_ns, dt_ns, in.angle, in.speed, dy}, mail, held);

  PathTrials trials(actuator_, s.actuator, held, {t_ns, dt_ns, substep(config_)});
  if (const auto foreseen = trials.foresee()) {
    const double yield = 1.0 / (1.0 + c * std::max(foreseen->slope, 0.0));
    dy = drive::solve_friction(shaft_friction_, u, (free + c * foreseen->torque) * yield, c * yield).displacement;
  }
  double low = -std::numeric_limits<double>::infinity(), high = -low, last_move = high;
  double torque = 0;
  actuator::SegmentResult path;
  double walked = dy;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    walked = dy;
    path = trials.at(walked);
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
  trials.finish();
  const double spring_work = path.torque * walked;
  const auto rub = actuator_.shaft_friction(s.actuator, walked);
  s.path_work = s.actuator.ledger.pending = spring_work + rub.torque * walked;
  s.start_y = y;
  s.applied_torque = torque;
  s.last_speed = in.speed;
  s.last_dt = dt;
  s.started = true;
  return torque;
}

}  // namespace vsa::device
