// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What stands behind an FMU's instance, whatever version of FMI asks: one actuator (vsa/fmu/unit_model.hpp) or a world
// (vsa/fmu_world/world_model.hpp).
//
// Parameters and inputs are numbers that the importer sets; outputs follow from them and from the model's state. Time is the model's
// own, in whole nanoseconds from 0.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "vsa/fmu/variables.hpp"

namespace vsa::fmu {

/// What stands behind an FMU's instance, whatever version of FMI asks: values by reference, a step, and a state as numbers.
class Model {
 public:
  virtual ~Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// By reference; fixed after the constructor.
  [[nodiscard]] const std::vector<Variable>& variables() const noexcept { return variables_; }
  [[nodiscard]] std::int64_t time_ns() const noexcept { return time_ns_; }  ///< since begin()

  /// Parameters and inputs as set, outputs as they are now. Before begin(): parameters and inputs only.
  [[nodiscard]] double get(Reference variable);
  /// A parameter or an input; whoever calls has checked kind, bounds and time.
  void set(Reference variable, double value);

  /// Parameters and inputs count from here on; time 0. Throws InputError with all that doesn't fit, by the variables' names. May come
  /// again, and begins anew then.
  void begin();
  /// Throws InputError for a step that the model can't make, physics' errors as they are; then nothing has moved.
  void step(std::int64_t dt_ns);

  /// ∂output/∂input at the communication point; nothing where the model has no derivatives.
  [[nodiscard]] virtual bool has_derivatives() const noexcept { return false; }
  [[nodiscard]] virtual double derivative(Reference output, Reference input) const;  ///< 0 without derivatives

  /// Values, time and state as numbers; what restore() takes save() gives back. Throws InputError for other numbers, and nothing
  /// has changed.
  [[nodiscard]] std::size_t state_size() const { return variables_.size() + kHead + own_size(); }
  void save(std::span<double> out) const;    ///< state_size() numbers
  void restore(std::span<const double> in);  ///< what save() gave

  /// Gets a readable line where something should be known of the run: clamped commands, steps too long.
  std::function<void(const std::string&)> warn{};

 protected:
  Model() = default;
  void add_variables(std::vector<Variable> variables);                                ///< in the constructor, once
  void make_start_values();                                                           ///< of the parameters as they are set now
  [[nodiscard]] double value(Reference variable) const { return values_[variable]; }  ///< as it was set or evaluated
  /// To whoever listens.
  void tell(const std::string& line) const {
    if (warn) warn(line);
  }

 private:
  virtual void begin_own() = 0;
  virtual void step_own(std::int64_t dt_ns) = 0;
  virtual void input_changed(Reference variable) = 0;   ///< after begin()
  virtual void evaluate(std::span<double> values) = 0;  ///< writes the outputs' places
  [[nodiscard]] virtual std::size_t own_size() const = 0;
  virtual void save_own(std::span<double> out) const = 0;
  virtual void restore_own(std::span<const double> in) = 0;  ///< the values are restored already

  static constexpr std::size_t kHead = 3;  // begun, time
  std::vector<Variable> variables_;
  std::vector<double> values_;
  std::int64_t time_ns_ = 0;
  bool begun_ = false, stale_ = true;  // stale_: outputs aren't those of now
};

}  // namespace vsa::fmu
