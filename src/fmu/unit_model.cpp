// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu/unit_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fmu/unit_variables.hpp"
#include "vsa/actuator/heat.hpp"
#include "vsa/config/text.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/errors.hpp"

namespace vsa::fmu {
namespace {

constexpr std::int64_t kLongestImplicit_ns = (device::kMaxTicksPerStep - 1) * firmware::kTickNs;
constexpr double kStiffnessStep_rad = 1e-5;

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

/// Equilibrium, preset and what goes past the law, as the unit was told last.
using Commands = std::array<double, 4>;

}  // namespace

struct UnitModel::Places : UnitPlaces {};

struct UnitModel::Run {
  Run(const device::UnitConfig& config, std::vector<double> made_with) : unit(config), parameters(std::move(made_with)) {}
  device::Unit unit;
  std::vector<double> parameters;  // that the unit was made with
  device::UnitState state;
  Commands sent{};
  double mean_torque = 0;
  bool warned_preset = false, warned_step = false;
};

UnitModel::UnitModel(config::TypeFile file, UnitStart start, Names names)
    : file_(std::move(file)), set_(std::move(start.set)), type_(file_.make(set_)), places_(std::make_unique<Places>()) {
  add_variables(unit_variables(type_, names, *places_));
  if (start.coupling) set(places_->coupling, *start.coupling == Coupling::prescribed ? 1 : 2);
  if (start.load_inertia_kgm2) set(places_->load_inertia, *start.load_inertia_kgm2);
  make_start_values();
}

UnitModel::~UnitModel() = default;

const config::ActuatorType& UnitModel::type() const noexcept { return type_; }

/// The type with what the importer changed.
config::ActuatorType UnitModel::made() const {
  std::vector<config::Override> all = set_;
  for (const Reference r : places_->keys) {
    const Variable& v = variables()[r];
    if (value(r) == v.start) continue;
    const auto same = [&](const config::Override& o) { return o.key == v.name; };
    all.erase(std::remove_if(all.begin(), all.end(), same), all.end());
    all.push_back({v.name, value_text(v, value(r))});
  }
  return file_.make(all);
}

std::unique_ptr<UnitModel::Run> UnitModel::new_run() const {
  std::vector<double> parameters;
  for (const Reference r : places_->keys) parameters.push_back(value(r));
  return std::make_unique<Run>(made().unit, std::move(parameters));
}

void UnitModel::begin_own() {
  const UnitPlaces& p = *places_;
  if (implicit() && !(value(p.load_inertia) > 0))
    throw InputError({"", std::string(kLoadInertia), config::number_text(value(p.load_inertia)),
                      "coupling is implicit, which foresees the shaft's motion", "the inertia behind the shaft, above 0"});
  auto run = new_run();
  run->sent = {p.equilibrium ? value(*p.equilibrium) : 0, p.preset ? value(*p.preset) : 0, p.direct[0] ? value(*p.direct[0]) : 0,
               p.direct[1] ? value(*p.direct[1]) : 0};
  run->state = run->unit.initial(run->sent[0], run->sent[1], value(p.angle));
  if (p.direct[0]) device::Unit::command_direct(run->state, {run->sent[2], run->sent[3]});
  run->state.reached = {value(p.angle), value(p.speed)};
  run_ = std::move(run);
}

/// The shaft is where the importer says, from now on.
void UnitModel::input_changed(Reference variable) {
  if (variable == places_->angle) run_->state.reached.angle = value(variable);
  if (variable == places_->speed) run_->state.reached.speed = value(variable);
}

bool UnitModel::implicit() const { return value(places_->coupling) == 2; }

void UnitModel::send_commands() {
  const UnitPlaces& p = *places_;
  Run& r = *run_;
  const Commands now{p.equilibrium ? value(*p.equilibrium) : 0, p.preset ? value(*p.preset) : 0,
                     p.direct[0] ? value(*p.direct[0]) : 0, p.direct[1] ? value(*p.direct[1]) : 0};
  if (now[0] != r.sent[0] || now[1] != r.sent[1]) r.unit.command(r.state, now[0], now[1]);
  if (now[2] != r.sent[2] || now[3] != r.sent[3]) device::Unit::command_direct(r.state, {now[2], now[3]});
  r.sent = now;
  const double most = r.unit.config().preset_max;
  if (std::abs(now[1]) > most && !r.warned_preset) {
    r.warned_preset = true;
    tell("preset " + config::number_text(now[1]) + " is beyond ±" + config::number_text(most) + ": clamped, as the device does");
  }
}

void UnitModel::warn_of_step(double h_s) {
  const double inertia = value(places_->load_inertia);
  if (run_->warned_step || !(inertia > 0)) return;
  const double slope = -device::torque_slope(run_->unit, run_->state);
  const double x = h_s * std::sqrt(std::max(slope, 0.0) / inertia);
  if (x <= kExplicitLimit) return;
  run_->warned_step = true;
  tell("a shaft of " + config::number_text(inertia) + " kg.m2 on " + config::number_text(std::round(slope * 1e3) / 1e3) +
       " N.m/rad swings with x = h*sqrt(stiffness/inertia) = " + config::number_text(std::round(x * 100) / 100) +
       " at this communication step: explicit coupling feeds such a swing. Make the step " +
       config::number_text(std::ceil(10 * x / kExplicitLimit) / 10) +
       " times shorter, or step this unit first, apply mean_torque over the same step and set coupling to implicit");
}

/// Piece by piece along the path that the importer's shaft is taken to go.
double UnitModel::walk(std::int64_t dt_ns) {
  const UnitPlaces& p = *places_;
  Run& r = *run_;
  const double q = value(p.angle), v = value(p.speed), a = value(p.acceleration);
  double impulse = 0;
  for (std::int64_t gone = 0; gone < dt_ns;) {
    const std::int64_t t = time_ns() + gone;
    const std::int64_t piece = std::min(dt_ns - gone, firmware::kTickNs - t % firmware::kTickNs);
    const double s = seconds(gone), speed = v + a * s;
    // What the unit takes for the acceleration by all else is the importer's, not what jumped between two communication points.
    r.state.last_speed = speed - a * r.state.last_dt;
    impulse += seconds(piece) * r.unit.step(r.state, t, piece, {q + s * (v + 0.5 * a * s), speed, 0.0});
    gone += piece;
  }
  const double h = seconds(dt_ns);
  r.state.reached = {q + h * (v + 0.5 * a * h), v + a * h};
  return impulse / h;
}

void UnitModel::step_own(std::int64_t dt_ns) {
  Run& r = *run_;
  const UnitPlaces& p = *places_;
  if (implicit() && !(value(p.load_inertia) > 0))
    throw InputError({"", std::string(kLoadInertia), config::number_text(value(p.load_inertia)), "must be above 0 here",
                      "coupling is implicit"});
  if (implicit() && dt_ns > kLongestImplicit_ns)
    throw InputError({"", "communicationStepSize", config::number_text(seconds(dt_ns)) + " s", "is too long for implicit coupling",
                      "up to 0.016 s"});
  send_commands();
  if (implicit()) {
    r.mean_torque = r.unit.step(r.state, time_ns(), dt_ns, {value(p.angle), value(p.speed), 1.0 / value(p.load_inertia)});
  } else {
    warn_of_step(seconds(dt_ns));
    r.mean_torque = walk(dt_ns);
  }
}

void UnitModel::evaluate(std::span<double> values) {
  const UnitPlaces& p = *places_;
  const Run& r = *run_;
  const device::UnitReading now = device::read(r.unit, r.state);
  values[p.torque] = now.torque_Nm;
  values[p.mean_torque] = r.mean_torque;
  values[p.stiffness] = now.stiffness_Nm_per_rad;
  values[p.deflection] = now.shaft_rad - now.equilibrium_rad;
  values[p.equilibrium_attained] = now.equilibrium_rad;
  if (p.preset_attained) values[*p.preset_attained] = now.preset;
  for (std::size_t m = 0; m < p.motors; ++m) {
    values[p.motor[m].angle] = now.motor_rad[m];
    values[p.motor[m].speed] = now.motor_speed_rad_per_s[m];
    values[p.motor[m].current] = now.current_A[m];
  }
  const actuator::Ledger& l = r.state.actuator.ledger;
  values[p.energy_supply] = l.supply;
  values[p.energy_delivered] = l.delivered + l.pending;
  values[p.energy_stored] = l.stored() - l.stored_at_start;
  values[p.energy_lost] = actuator::heat(l);
}

double UnitModel::derivative(Reference output, Reference input) const {
  const UnitPlaces& p = *places_;
  if (input != p.angle || !run_) return 0;
  if (output == p.torque) return device::torque_slope(run_->unit, run_->state);
  if (output == p.deflection) return 1;
  if (output != p.stiffness) return 0;
  const device::UnitState& s = run_->state;
  const auto stiffness = [&](double shaft) {
    device::UnitState there = s;
    there.reached.angle = shaft;
    return device::read(run_->unit, there).stiffness_Nm_per_rad;
  };
  const double here = s.reached.angle;
  return (stiffness(here + kStiffnessStep_rad) - stiffness(here - kStiffnessStep_rad)) / (2 * kStiffnessStep_rad);
}

namespace {

constexpr std::size_t kOwn = 7;  // sent, mean torque, two flags

}  // namespace

std::size_t UnitModel::own_size() const { return device::Unit::state_size() + kOwn; }

void UnitModel::save_own(std::span<double> out) const {
  const Run& r = *run_;
  std::copy(r.sent.begin(), r.sent.end(), out.begin());
  out[4] = r.mean_torque;
  out[5] = r.warned_preset ? 1 : 0;
  out[6] = r.warned_step ? 1 : 0;
  device::Unit::save(r.state, out.subspan(kOwn));
}

void UnitModel::restore_own(std::span<const double> in) {
  const auto same = [&] {
    for (std::size_t i = 0; i < places_->keys.size(); ++i)
      if (run_->parameters[i] != value(places_->keys[i])) return false;
    return true;
  };
  device::UnitState state;
  device::Unit::restore(state, in.subspan(kOwn));
  if (!run_ || !same()) run_ = new_run();
  Run& r = *run_;
  r.state = state;
  std::copy_n(in.begin(), r.sent.size(), r.sent.begin());
  r.mean_torque = in[4];
  r.warned_preset = in[5] != 0;
  r.warned_step = in[6] != 0;
}

}  // namespace vsa::fmu
