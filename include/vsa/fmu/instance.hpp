// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One instance of an FMU between the standard's calls and a model: which call is allowed when, what is wrong with its arguments, time,
// saved states. FMI 2.0 and 3.0 differ in their C functions (plugins/fmu), which only forward to this.
//
//   instantiated ─ enter_initialization ▶ initialization ─ exit_initialization ▶ stepping ─ terminate ▶ terminated
//        ▲                                                                          │ a step that failed ▶ failed
//        └───────────────────────────── reset (from any of them) ───────────────────┘
//
// Nothing throws: what is wrong becomes a status and one line for the importer's logger. A call that is refused has changed nothing; a
// step that failed has moved nothing, and only states, reset and the end are left.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vsa/fmu/model.hpp"
#include "vsa/units.hpp"

namespace vsa::fmu {

/// What the standard's calls return, in its own order.
enum class Status { ok, warning, discard, error, fatal };
/// How far an instance is, which decides what calls are allowed.
enum class Mode { instantiated, initialization, stepping, terminated, failed };

/// Names of the log's categories, as both versions of the standard have them.
inline constexpr const char* kLogInfo = "logAll";
inline constexpr const char* kLogWarning = "logStatusWarning";  ///< of the log's categories
inline constexpr const char* kLogError = "logStatusError";      ///< of the log's categories

/// One instance of an FMU: which of the standard's calls is allowed when, what is wrong with its arguments, time and saved states.
/// Nothing throws. One thread.
class Instance {
 public:
  /// Gets every line that the importer asked for.
  using Logger = std::function<void(Status status, const char* category, const std::string& text)>;

  /// `token`: the one of modelDescription.xml, for states.
  Instance(std::unique_ptr<Model> model, std::uint64_t token, Logger logger);

  [[nodiscard]] Mode mode() const noexcept { return mode_; }             ///< which decides what calls are allowed
  [[nodiscard]] const Model& model() const noexcept { return *model_; }  ///< what it stands on
  void set_logging(bool on) noexcept { talks_ = on; }                    ///< whether what isn't wrong is told, too

  /// `call`: the standard's name of the function, for messages.
  Status set_up(const char* call, double start_s, bool has_stop, double stop_s) noexcept;  ///< `has_stop` false: no end is known
  Status enter_initialization(const char* call) noexcept;                                  ///< the values count from here on
  Status exit_initialization(const char* call) noexcept;                                   ///< the model begins with them
  Status terminate(const char* call) noexcept;                                             ///< from stepping and failed
  Status reset(const char* call) noexcept;  ///< from any mode; time 0, values as they were instantiated

  /// All or nothing. `values`: whole numbers, switches (0, 1) and words (from 1) as doubles.
  Status get(const char* call, Kind kind, std::span<const Reference> references, std::span<double> values) noexcept;
  /// In the modes that Variability allows.
  Status set(const char* call, Kind kind, std::span<const Reference> references, std::span<const double> values) noexcept;
  /// sensitivity[u] = Σ_k ∂unknown_u/∂known_k seed[k]
  Status derivatives(const char* call, std::span<const Reference> unknowns, std::span<const Reference> knowns,
                     std::span<const double> seed, std::span<double> sensitivity) noexcept;
  /// sensitivity[k] = Σ_u ∂unknown_u/∂known_k seed[u]
  Status adjoint(const char* call, std::span<const Reference> unknowns, std::span<const Reference> knowns,
                 std::span<const double> seed, std::span<double> sensitivity) noexcept;

  /// From t to t + h, h > 0, t where the last step ended.
  Status step(const char* call, double t_s, double h_s) noexcept;
  /// Start plus what was stepped.
  [[nodiscard]] double time_s() const noexcept { return start_s_ + seconds_of(model_->time_ns()); }

  /// Saved states: values, time and mode. They are the instance's, and go with it at the latest; a pointer that is none of them is
  /// refused, whatever it points to.
  /// `*state`: null, or one of them, which is used again.
  Status save(const char* call, void** state) noexcept;
  Status restore(const char* call, const void* state) noexcept;  ///< mode and times, too; refused: not one of ours
  Status free_state(const char* call, void** state) noexcept;    ///< null is content
  /// A state's bytes are the same on every machine: "VSAFMU1\n", token, mode, times, numbers, a hash.
  Status size_of_state(const char* call, const void* state, std::size_t* size) noexcept;
  Status serialize(const char* call, const void* state, std::span<char> out) noexcept;    ///< size_of_state() bytes
  Status deserialize(const char* call, std::span<const char> in, void** state) noexcept;  ///< of another FMU, or damaged: an error

  /// A call that the FMU doesn't have: an error with what it says.
  Status refuse(const char* call, const std::string& why) noexcept;
  /// Whether a call is allowed now; if not, that is told.
  bool allowed(const char* call, std::initializer_list<Mode> modes) noexcept;

 private:
  struct Saved {
    Mode mode = Mode::instantiated;
    double start_s = 0, stop_s = 0;
    bool has_stop = false;
    std::vector<double> numbers;
  };
  [[nodiscard]] Saved* known(const void* state) const noexcept;
  Status guarded(const char* call, const std::function<void()>& work) noexcept;
  void tell(Status status, const char* category, const std::string& text) noexcept;
  /// Throws InputError where a reference is none of this kind.
  const Variable& variable(Reference reference, Kind kind) const;
  void check_readable(Reference reference, const Variable& v) const;
  void check_writable(const Variable& v, double value) const;
  void refresh();
  void check_slopes(std::span<const Reference> unknowns, std::span<const Reference> knowns) const;

  std::unique_ptr<Model> model_;
  std::uint64_t token_;
  Logger logger_;
  bool talks_ = false;
  Mode mode_ = Mode::instantiated;
  bool fresh_ = false;  ///< in the initialisation: the model has begun with the values as they are
  double start_s_ = 0, stop_s_ = 0;
  bool has_stop_ = false;
  std::vector<std::unique_ptr<Saved>> states_;
  std::vector<double> first_;  ///< the model's numbers at instantiation
};

}  // namespace vsa::fmu
