// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu/instance.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::fmu {
namespace {

const char* name_of(Mode mode) {
  switch (mode) {
    case Mode::instantiated:
      return "instantiated";
    case Mode::initialization:
      return "initialization";
    case Mode::stepping:
      return "stepping";
    case Mode::terminated:
      return "terminated";
    case Mode::failed:
      return "failed";
  }
  return "";
}

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::real:
      return "a real number";
    case Kind::integer:
      return "an integer";
    case Kind::boolean:
      return "a boolean";
    case Kind::enumeration:
      return "an enumeration";
  }
  return "";
}

/// What FMI 2 asks for as an integer may be an enumeration.
bool fits(Kind asked, Kind is) { return asked == is || (asked == Kind::integer && is == Kind::enumeration); }

}  // namespace

Instance::Instance(std::unique_ptr<Model> model, std::uint64_t token, Logger logger)
    : model_(std::move(model)), token_(token), logger_(std::move(logger)), first_(model_->state_size()) {
  model_->save(first_);
  model_->warn = [this](const std::string& line) { tell(Status::warning, kLogWarning, line); };
}

void Instance::tell(Status status, const char* category, const std::string& text) noexcept {
  try {
    if (logger_) logger_(status, category, text);
  } catch (...) {  // the importer's own: it has its status
  }
}

Status Instance::guarded(const char* call, const std::function<void()>& work) noexcept {
  try {
    work();
    return Status::ok;
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) tell(Status::error, kLogError, std::string(call) + ": " + p.text());
  } catch (const std::exception& error) {
    tell(Status::error, kLogError, std::string(call) + ": " + error.what());
  } catch (...) {
    tell(Status::error, kLogError, std::string(call) + ": failed");
  }
  return Status::error;
}

Status Instance::refuse(const char* call, const std::string& why) noexcept {
  tell(Status::error, kLogError, std::string(call) + ": " + why);
  return Status::error;
}

bool Instance::allowed(const char* call, std::initializer_list<Mode> modes) noexcept {
  if (std::find(modes.begin(), modes.end(), mode_) != modes.end()) return true;
  std::string text = std::string("isn't allowed in the mode ") + name_of(mode_) + ", only in ";
  for (const Mode m : modes) text += std::string(m == *modes.begin() ? "" : ", ") + name_of(m);
  refuse(call, text);
  return false;
}

Status Instance::set_up(const char* call, double start_s, bool has_stop, double stop_s) noexcept {
  if (!allowed(call, {Mode::instantiated})) return Status::error;
  if (!std::isfinite(start_s)) return refuse(call, "the start time isn't finite");
  if (has_stop && !(stop_s > start_s)) return refuse(call, "the stop time isn't after the start time");
  start_s_ = start_s;
  has_stop_ = has_stop;
  stop_s_ = stop_s;
  return Status::ok;
}

Status Instance::enter_initialization(const char* call) noexcept {
  if (!allowed(call, {Mode::instantiated})) return Status::error;
  mode_ = Mode::initialization;
  fresh_ = false;
  return Status::ok;
}

Status Instance::exit_initialization(const char* call) noexcept {
  if (!allowed(call, {Mode::initialization})) return Status::error;
  const Status status = guarded(call, [&] {
    if (!fresh_) model_->begin();
  });
  if (status != Status::ok) return status;
  fresh_ = true;
  mode_ = Mode::stepping;
  if (talks_) tell(Status::ok, kLogInfo, std::string(call) + ": begins at " + config::number_text(start_s_) + " s");
  return Status::ok;
}

Status Instance::terminate(const char* call) noexcept {
  if (!allowed(call, {Mode::stepping, Mode::failed})) return Status::error;
  mode_ = Mode::terminated;
  return Status::ok;
}

Status Instance::reset(const char* call) noexcept {
  const Status status = guarded(call, [&] { model_->restore(first_); });
  if (status != Status::ok) return status;
  mode_ = Mode::instantiated;
  start_s_ = stop_s_ = 0;
  has_stop_ = fresh_ = false;
  return Status::ok;
}

const Variable& Instance::variable(Reference reference, Kind kind) const {
  const std::vector<Variable>& all = model_->variables();
  if (reference >= all.size())
    throw InputError(
        {"", "value reference", std::to_string(reference), "there is no such variable", "0 … " + std::to_string(all.size() - 1)});
  if (!fits(kind, all[reference].kind))
    throw InputError({"", all[reference].name, "", std::string("is no such value: it is ") + name_of(all[reference].kind), ""});
  return all[reference];
}

void Instance::check_readable(Reference, const Variable& v) const {
  if (v.causality == Causality::output && mode_ == Mode::instantiated)
    throw InputError({"", v.name, "", "has no value before the initialization", ""});
}

void Instance::check_writable(const Variable& v, double value) const {
  const std::string text = config::number_text(value);
  if (v.causality == Causality::output || v.causality == Causality::independent)
    throw InputError({"", v.name, text, "isn't the importer's to set", "inputs and parameters"});
  if (v.causality == Causality::parameter && v.variability == Variability::fixed && mode_ == Mode::stepping)
    throw InputError({"", v.name, text, "can't be changed any more: it is fixed by the end of the initialization", ""});
  const bool inside = (!v.min || value >= *v.min) && (!v.max || value <= *v.max);
  if (std::isfinite(value) && inside) return;
  throw InputError(
      {"", v.name, std::isfinite(value) ? text : "not finite", "is out of range",
       config::range_text(v.min.value_or(-INFINITY), v.max.value_or(INFINITY)) + (v.unit.empty() ? "" : " " + v.unit)});
}

Status Instance::get(const char* call, Kind kind, std::span<const Reference> references, std::span<double> values) noexcept {
  if (references.size() != values.size()) return refuse(call, "as many values as value references, please");
  return guarded(call, [&] {
    Problems problems;
    bool outputs = false;
    for (const Reference r : references) {
      try {
        const Variable& v = variable(r, kind);
        check_readable(r, v);
        outputs = outputs || v.causality == Causality::output;
      } catch (const InputError& error) {
        problems.add_all(error);
      }
    }
    problems.throw_if_any();
    if (outputs) refresh();
    for (std::size_t i = 0; i < references.size(); ++i) {
      const bool time = model_->variables()[references[i]].causality == Causality::independent;
      values[i] = time ? time_s() : model_->get(references[i]);
    }
  });
}

Status Instance::set(const char* call, Kind kind, std::span<const Reference> references, std::span<const double> values) noexcept {
  if (references.size() != values.size()) return refuse(call, "as many values as value references, please");
  if (!allowed(call, {Mode::instantiated, Mode::initialization, Mode::stepping})) return Status::error;
  return guarded(call, [&] {
    Problems problems;
    for (std::size_t i = 0; i < references.size(); ++i) {
      try {
        check_writable(variable(references[i], kind), values[i]);
      } catch (const InputError& error) {
        problems.add_all(error);
      }
    }
    problems.throw_if_any();
    for (std::size_t i = 0; i < references.size(); ++i) model_->set(references[i], values[i]);
    if (mode_ != Mode::stepping) fresh_ = false;
  });
}

/// In the initialisation: the model begins with what has been set so far.
void Instance::refresh() {
  if (mode_ != Mode::initialization || fresh_) return;
  model_->begin();
  fresh_ = true;
}

void Instance::check_slopes(std::span<const Reference> unknowns, std::span<const Reference> knowns) const {
  if (!model_->has_derivatives()) throw InputError({"", "derivatives", "", "this FMU has none", ""});
  Problems problems;
  const auto check = [&](Reference r, Causality causality, const char* what) {
    try {
      if (const Variable& v = variable(r, Kind::real); v.causality != causality) problems.add({"", v.name, "", what, ""});
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  };
  for (const Reference r : unknowns) check(r, Causality::output, "is no output, so it has no derivative");
  for (const Reference r : knowns) check(r, Causality::input, "is no input, so nothing is derived by it");
  problems.throw_if_any();
}

Status Instance::derivatives(const char* call, std::span<const Reference> unknowns, std::span<const Reference> knowns,
                             std::span<const double> seed, std::span<double> sensitivity) noexcept {
  if (!allowed(call, {Mode::initialization, Mode::stepping})) return Status::error;
  if (seed.size() != knowns.size() || sensitivity.size() != unknowns.size())
    return refuse(call, "a seed for each known and a place for each unknown, please");
  return guarded(call, [&] {
    check_slopes(unknowns, knowns);
    refresh();
    for (std::size_t u = 0; u < unknowns.size(); ++u) {
      sensitivity[u] = 0;
      for (std::size_t k = 0; k < knowns.size(); ++k) sensitivity[u] += model_->derivative(unknowns[u], knowns[k]) * seed[k];
    }
  });
}

Status Instance::adjoint(const char* call, std::span<const Reference> unknowns, std::span<const Reference> knowns,
                         std::span<const double> seed, std::span<double> sensitivity) noexcept {
  if (!allowed(call, {Mode::initialization, Mode::stepping})) return Status::error;
  if (seed.size() != unknowns.size() || sensitivity.size() != knowns.size())
    return refuse(call, "a seed for each unknown and a place for each known, please");
  return guarded(call, [&] {
    check_slopes(unknowns, knowns);
    refresh();
    for (std::size_t k = 0; k < knowns.size(); ++k) {
      sensitivity[k] = 0;
      for (std::size_t u = 0; u < unknowns.size(); ++u) sensitivity[k] += model_->derivative(unknowns[u], knowns[k]) * seed[u];
    }
  });
}

Status Instance::step(const char* call, double t_s, double h_s) noexcept {
  if (!allowed(call, {Mode::stepping})) return Status::error;
  if (!std::isfinite(t_s) || !std::isfinite(h_s) || !(h_s > 0))
    return refuse(call, "a communication step of " + config::number_text(h_s) + " s: it must be finite and above 0");
  // What doubles of that size can't tell apart is the same time.
  const double slack = 1e-9 + 8 * 2.3e-16 * std::abs(t_s);
  if (std::abs(t_s - time_s()) > slack)
    return refuse(call, "the communication point " + config::number_text(t_s) + " s isn't where the last step ended, " +
                            config::number_text(time_s()) + " s");
  const double end_s = t_s + h_s;
  if (has_stop_ && end_s > stop_s_ + slack)
    return refuse(
        call, "the step to " + config::number_text(end_s) + " s goes beyond the stop time, " + config::number_text(stop_s_) + " s");
  if (!((end_s - start_s_) * 1e9 < 4e18)) return refuse(call, "more than 4e9 s after the start");
  // From the start, so that rounding doesn't add up.
  const std::int64_t dt_ns = std::llround((end_s - start_s_) * 1e9) - model_->time_ns();
  if (dt_ns <= 0) return Status::ok;  // less than a nanosecond: nothing has moved yet
  const Status status = guarded(call, [&] { model_->step(dt_ns); });
  if (status != Status::ok) mode_ = Mode::failed;
  return status;
}

}  // namespace vsa::fmu
