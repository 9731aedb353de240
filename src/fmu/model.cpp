// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu/model.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/errors.hpp"
#include "vsa/state.hpp"

namespace vsa::fmu {
namespace {

constexpr double kTwo32 = 4294967296.0;

bool is_whole(double v, double low, double high) { return v >= low && v <= high && std::trunc(v) == v; }

}  // namespace

void Model::add_variables(std::vector<Variable> variables) {
  variables_ = std::move(variables);
  for (const Variable& v : variables_) values_.push_back(v.start);
}

void Model::make_start_values() {
  for (std::size_t i = 0; i < variables_.size(); ++i) variables_[i].start = values_[i];
}

double Model::get(Reference variable) {
  if (begun_ && stale_) {
    evaluate(values_);
    stale_ = false;
  }
  return values_[variable];
}

void Model::set(Reference variable, double value) {
  values_[variable] = value;
  stale_ = true;
  if (begun_ && variables_[variable].causality == Causality::input) input_changed(variable);
}

void Model::begin() {
  begin_own();
  time_ns_ = 0;
  begun_ = stale_ = true;
}

void Model::step(std::int64_t dt_ns) {
  step_own(dt_ns);
  time_ns_ += dt_ns;
  stale_ = true;
}

double Model::derivative(Reference, Reference) const { return 0; }

void Model::save(std::span<double> out) const {
  check_state_size(out.size(), state_size());
  const auto head = std::copy(values_.begin(), values_.end(), out.begin());
  // Nanoseconds as two whole numbers, as vsa/state.hpp has them: a double holds no 64 bits.
  head[0] = begun_ ? 1 : 0;
  head[1] = static_cast<double>(time_ns_ >> 32);
  head[2] = static_cast<double>(time_ns_ & 0xFFFFFFFF);
  const std::span<double> own = out.subspan(values_.size() + kHead);
  if (begun_) save_own(own);
  if (!begun_) std::fill(own.begin(), own.end(), 0.0);
}

void Model::restore(std::span<const double> in) {
  check_state_size(in.size(), state_size());
  const std::span<const double> head = in.subspan(values_.size(), kHead);
  if (!is_whole(head[0], 0, 1) || !is_whole(head[1], 0, 1e9) || !is_whole(head[2], 0, kTwo32 - 1))
    throw InputError({"", "time", "", "is no time of a model", "whole nanoseconds from 0"});
  std::vector<double> values(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(values_.size()));
  values_.swap(values);
  try {
    if (head[0] != 0) restore_own(in.subspan(values_.size() + kHead));
  } catch (...) {
    values_.swap(values);
    throw;
  }
  begun_ = head[0] != 0;
  time_ns_ = (static_cast<std::int64_t>(head[1]) << 32) + static_cast<std::int64_t>(head[2]);
  stale_ = true;
}

}  // namespace vsa::fmu
