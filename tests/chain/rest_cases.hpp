// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Many chains that are left alone, in one table: which are quiet, and which have an unrest of their own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "chain/rest_meter.hpp"
#include "chain/serial_worlds.hpp"
#include "vsa/config/actuator_type.hpp"

namespace vsa::test {

struct RestCase {
  SerialWorld chain;
  bool supply = true;
  double held_rad = 0;  ///< every joint's equilibrium from the first step on: aside, where there is gravity
};

inline std::string named(const RestCase& c) {
  std::ostringstream s;
  const SerialWorld& w = c.chain;
  s << w.type << ", " << w.joints << (w.alternating ? " alternating" : " parallel") << ", preset " << w.preset << ", "
    << w.step_s * 1e3 << " ms, " << (w.gravity ? "gravity" : "no gravity") << (c.held_rad != 0 ? " held aside" : "") << ", supply "
    << (c.supply ? "on" : "off") << ", " << w.mass_kg << " kg, last " << w.last_inertia_kgm2 << " kg m^2";
  return s.str();
}

/// Parallel and alternating axes; no gravity, hanging, held aside; supply on and off; all of these presets that the type takes (a series
/// elastic one has none, a torque servo's stiffness goes as far as theirs) and steps.
inline void for_every_rest_case(const SerialWorld& chain, const std::vector<double>& presets, const std::vector<double>& steps_s,
                                const std::function<void(const RestCase&)>& each) {
  // Of the presets those that the type takes, and where that is none, none at all.
  const device::UnitConfig unit = config::TypeLibrary().load(chain.type).unit;
  const double most = unit.preset_max;
  std::vector<double> taken;
  std::copy_if(presets.begin(), presets.end(), std::back_inserter(taken), [&](double p) { return p <= most; });
  if (unit.is(control::ServoKind::torque_servo))
    for (double& p : taken = presets) p *= std::min(most, unit.servo->torque.stiffness_Nm_per_rad) / presets.back();
  if (taken.empty()) taken.push_back(0.8 * most);
  for (const double preset : taken) {
    for (const bool alternating : chain.joints == 1 ? std::vector<bool>{false} : std::vector<bool>{false, true}) {
      // What the root carries of a chain held aside is within every type's reach, 0.5 to 2.4 N·m.
      const double turned_rad = chain.joints > 4 ? 0.02 : chain.joints > 2 ? 0.1 : 0.3;
      const double aside_rad = unit.actuator.linear() ? 0.01 * turned_rad : turned_rad;  // m, of one that slides
      for (const double held_rad : {-1.0, 0.0, aside_rad}) {
        for (const bool supply : held_rad > 0 ? std::vector<bool>{true} : std::vector<bool>{true, false}) {
          for (const double step_s : steps_s) {
            RestCase c{chain, supply, std::max(held_rad, 0.0)};
            c.chain.preset = preset;
            c.chain.alternating = alternating;
            c.chain.gravity = held_rad >= 0;
            c.chain.step_s = step_s;
            each(c);
          }
        }
      }
    }
  }
}

/// Expects every case to be quiet, or no busier than it is in steps so short that they change nothing more: then the unrest is the
/// unit's own (its program answers single encoder counts) and no step length's. One case in a hundred may be busier than that, up to
/// twice as fast as a quiet one or as busy as any other is in short steps: a limit cycle's phase is the step's, too. Energy out of
/// nothing has no such excuse.
class RestTable {
 public:
  using Run = std::function<Rest(const RestCase&)>;
  /// A case in short steps, asked for where it isn't quiet, with 0 first and then 1, 2 …, as long as that isn't as busy; none:
  /// there are no more ways to try.
  using ShortRun = std::function<std::optional<Rest>(const RestCase&, int)>;
  static constexpr double kFactor = 2.5;

  RestTable(Run run, ShortRun in_short_steps) : run_(std::move(run)), in_short_steps_(std::move(in_short_steps)) {}

  void expect_quiet(const RestCase& c) {
    const Rest rest = run_(c);
    Row& row = rows_[{c.held_rad != 0, c.chain.step_s}];
    ++row.cases;
    top_speed_ = std::max(top_speed_, rest.top_speed);
    row.least_coupling = std::min(row.least_coupling, rest.coupling_part);
    EXPECT_GT(rest.coupling_part, kCreated) << named(c);
    if (rest.slow() && rest.steady()) {
      ++row.quiet;
      row.rms = std::max(row.rms, rest.rms_speed);
      row.scatter = std::max(row.scatter, rest.scatter);
      return;
    }
    row.busy_rms = std::max(row.busy_rms, rest.rms_speed);
    row.busy_scatter = std::max(row.busy_scatter, rest.scatter);
    Rest busiest;
    const auto explained = [&] {
      return (rest.slow() || rest.rms_speed < kFactor * busiest.rms_speed) &&
             (rest.steady() || rest.scatter < kFactor * busiest.scatter);
    };
    for (int attempt = 0; !explained(); ++attempt) {
      const std::optional<Rest> fine = in_short_steps_(c, attempt);
      if (!fine) break;
      if (attempt > 0) row.nearby = std::max(row.nearby, attempt);
      busiest.rms_speed = std::max(busiest.rms_speed, fine->rms_speed);
      fine_rms_ = std::max(fine_rms_, fine->rms_speed);
      busiest.scatter = std::max(busiest.scatter, fine->scatter);
    }
    if (!explained()) {
      ++unexplained_;
      std::printf("%s: %.3g rad/s, torque scatters by %.2g; in short steps %.3g rad/s and %.2g\n", named(c).c_str(), rest.rms_speed,
                  rest.scatter, busiest.rms_speed, busiest.scatter);
      EXPECT_LT(rest.rms_speed, std::max(2 * kQuiet_rad_per_s, kFactor * fine_rms_)) << named(c);
    }
    if (!rest.slow()) row.over_fine = std::max(row.over_fine, rest.rms_speed / busiest.rms_speed);
  }

  /// And expects that something has moved at all.
  void print(const std::string& title) const {
    EXPECT_GT(top_speed_, 0.01) << title;
    int cases = 0;
    for (const auto& [at, r] : rows_) cases += r.cases;
    EXPECT_LE(unexplained_, cases / 100) << title;
    std::printf(
        "%s\n            step cases | quiet  rad/s scatter | busy  rad/s  scatter  over short steps'  tried | coupling/moved\n",
        title.c_str());
    for (const auto& [at, r] : rows_) {
      std::printf("%-8s %4.2g ms %5d | %5d %.4f %5.2f %% | %4d %.4f %6.2f %% %18.2f %6d | %.1e\n", at.first ? "aside" : "at zero",
                  at.second * 1e3, r.cases, r.quiet, r.rms, r.scatter * 100, r.cases - r.quiet, r.busy_rms, r.busy_scatter * 100,
                  r.over_fine, r.nearby, r.least_coupling);
    }
    std::fflush(stdout);
  }

 private:
  struct Row {
    int cases = 0, quiet = 0, nearby = 0;
    double rms = 0, scatter = 0, busy_rms = 0, busy_scatter = 0, over_fine = 0, least_coupling = 0;
  };

  Run run_;
  ShortRun in_short_steps_;
  std::map<std::pair<bool, double>, Row> rows_;  ///< held aside, step
  double top_speed_ = 0, fine_rms_ = 0;          ///< the second: of all short runs
  int unexplained_ = 0;
};

/// The same posture, aside by up to 8 times 0.3 mrad to both sides: an encoder count of the qbmove is 0.77 mrad.
inline std::optional<RestCase> nearby(RestCase c, int attempt) {
  if (attempt > 16) return std::nullopt;
  const int farther = (attempt + 1) / 2;
  c.held_rad += 3e-4 * farther * (attempt % 2 == 0 ? -1 : 1);
  return c;
}

}  // namespace vsa::test
