// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A measured grid: the torque that holds the joint at each of some deflections and presets (vsa/elastic/law.hpp's file).
//
//   H(δ, p) = s ∫₀ T(δ', p) dδ',   δ = q − x₀,   p = x₁;   T: torque_grid.hpp
//
// T(0, p) is 0, by what a deflection is; what was measured there is taken off every row, up to 5 % of its largest torque. A file
// that begins at δ = 0 is one side of an odd law. A grid doesn't tell what motor 2 holds at rest: nothing, as with levers. One
// preset: a series elastic actuator, without preset. Beyond the grid torques follow their tangents, presets fade within ⅔ of an
// interval.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "elastic/laws/shapes.hpp"
#include "elastic/laws/torque_grid.hpp"
#include "vsa/elastic/law.hpp"

namespace vsa::elastic {
namespace {

constexpr double kMostOffset = 0.05;  // of a row's largest torque
constexpr std::size_t kFewest = 3;    // deflections

constexpr LawParameter kParameters[] = {{"torque_scale", "1", 1e-3, 1e3, "what the file's torques are multiplied by, s"}};
constexpr LawColumn kColumns[] = {
    {"deflection_rad", -100, 100, true, "of the shaft from where it rests unloaded"},
    {"load_torque_Nm", -1e6, 1e6, true, "that holds it there: positive with the deflection"},
    {"preset_rad", -100, 100, false, "the angle of motor 2; left out: one preset"},
};
constexpr LawFile kFile{"grid", "CSV file of a whole grid, any order of rows", kColumns};

std::string text(double v) {
  char out[32];
  std::snprintf(out, sizeof out, "%.4g", v);
  return out;
}

/// The file's points, each a number of its row.
struct Points {
  std::span<const double> values;
  [[nodiscard]] std::size_t size() const { return values.size() / std::size(kColumns); }
  [[nodiscard]] double deflection(std::size_t i) const { return values[3 * i]; }
  [[nodiscard]] double torque(std::size_t i) const { return values[3 * i + 1]; }
  [[nodiscard]] double preset(std::size_t i) const { return values[3 * i + 2]; }
  [[nodiscard]] std::string place(std::size_t i) const {
    return "at deflection " + text(deflection(i)) + " rad, preset " + text(preset(i)) + " rad";
  }
};
Points points_of(std::span<const double> values) { return {values.subspan(std::size(kParameters))}; }

/// By preset, then by deflection: the row of the file.
using Grid = std::map<double, std::map<double, std::size_t>>;

LawFault wrong(std::string message, std::string allowed, std::optional<std::size_t> row = std::nullopt) {
  return {kFile.key, std::move(message), std::move(allowed), row};
}

std::optional<LawFault> doubled(const Points& points, Grid& out) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [known, fresh] = out[points.preset(i)].try_emplace(points.deflection(i), i);
    if (fresh) continue;
    const double there = points.torque(known->second), here = points.torque(i);
    if (there == here) return wrong("the point " + points.place(i) + " is given twice", "once", i);
    return wrong("two torques " + points.place(i) + ": " + text(there) + " and " + text(here) + " N·m",
                 "one: a potential has no loop; of its branches give the mean", i);
  }
  return std::nullopt;
}

std::optional<LawFault> not_whole(const Points& points, const Grid& grid) {
  std::map<double, std::size_t> deflections;
  for (std::size_t i = 0; i < points.size(); ++i) deflections.try_emplace(points.deflection(i), i);
  for (const auto& [preset, row] : grid) {
    for (const auto& [deflection, like] : deflections) {
      if (row.find(deflection) == row.end())
        return wrong(
            "at preset " + text(preset) + " rad there is no point at deflection " + text(deflection) + " rad, as elsewhere",
            "a whole grid: every preset at the same deflections", like);
    }
  }
  if (deflections.size() < kFewest)
    return wrong(std::to_string(deflections.size()) + " deflections", "at least " + std::to_string(kFewest));
  if (deflections.begin()->first > 0 || deflections.rbegin()->first <= 0)
    return wrong(
        "the deflections go from " + text(deflections.begin()->first) + " to " + text(deflections.rbegin()->first) + " rad",
        "from 0 or below to above 0");
  return std::nullopt;
}

std::optional<LawFault> falls(const Points& points, const Grid& grid) {
  for (const auto& [preset, row] : grid) {
    for (auto before = row.begin(), here = std::next(before); here != row.end(); before = here++) {
      const double was = points.torque(before->second), is = points.torque(here->second);
      if (is < was)
        return wrong("the torque falls from " + text(was) + " to " + text(is) + " N·m " + points.place(here->second),
                     "torques that don't fall as the deflection rises: smooth what was measured, and mind the sign", here->second);
    }
    if (points.torque(row.rbegin()->second) <= points.torque(row.begin()->second))
      return wrong("there is no torque at preset " + text(preset) + " rad", "a spring", row.begin()->second);
  }
  return std::nullopt;
}

struct Made {
  TorqueGrid grid;
  bool mirrored;
};

/// Of points without fault.
Made make_grid(std::span<const double> values) {
  const Points points = points_of(values);
  Grid grid;
  (void)doubled(points, grid);
  std::vector<double> deflections, presets;
  std::vector<std::vector<double>> torques;
  for (const auto& [deflection, i] : grid.begin()->second) deflections.push_back(deflection);
  const bool mirrored = deflections.front() == 0;
  for (const auto& [preset, row] : grid) {
    presets.push_back(preset);
    std::vector<double>& torque = torques.emplace_back();
    for (const auto& [deflection, i] : row) torque.push_back(values[0] * points.torque(i));
    if (!mirrored) continue;
    const double rest = torque.front();
    for (double& t : torque) t -= rest;
    for (std::size_t i = 1; i < row.size(); ++i) torque.insert(torque.begin(), -torque[2 * i - 1]);
  }
  for (std::size_t i = 1, n = deflections.size(); mirrored && i < n; ++i)
    deflections.insert(deflections.begin(), -deflections[2 * i - 1]);
  return {TorqueGrid(std::move(deflections), std::move(presets), torques), mirrored};
}

/// The law's largest distance from the points, and at which.
std::pair<double, std::size_t> misfit(std::span<const double> values, const TorqueGrid& grid) {
  const Points points = points_of(values);
  std::pair<double, std::size_t> most{0, 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = std::abs(grid.at(points.deflection(i), points.preset(i)).d - values[0] * points.torque(i));
    if (off > most.first) most = {off, i};
  }
  return most;
}

std::optional<LawFault> fault(std::span<const double> values) {
  const Points points = points_of(values);
  Grid grid;
  if (points.size() == 0) return wrong("has no points", "a grid of at least 3 deflections");
  if (auto found = doubled(points, grid)) return found;
  if (auto found = not_whole(points, grid)) return found;
  if (auto found = falls(points, grid)) return found;
  const TorqueGrid law = make_grid(values).grid;
  for (const auto& [preset, row] : grid) {
    const double at_rest = points.torque(row.begin()->second) - law.at(row.begin()->first, preset).d / values[0];
    const double largest = std::max(std::abs(points.torque(row.begin()->second)), std::abs(points.torque(row.rbegin()->second)));
    if (std::abs(at_rest) > kMostOffset * largest)
      return wrong("at preset " + text(preset) + " rad the torque at deflection 0 is " + text(at_rest) + " N·m",
                   "0, or up to 5 % of the row's largest: count deflections from where the shaft rests", row.begin()->second);
  }
  return std::nullopt;
}

std::string remark(std::span<const double> values) {
  const Points points = points_of(values);
  const Made made = make_grid(values);
  Grid grid;
  (void)doubled(points, grid);
  const auto& deflections = grid.begin()->second;
  std::string out = std::to_string(deflections.size()) + " deflections from " + text(deflections.begin()->first) + " to " +
                    text(deflections.rbegin()->first) + " rad, " + std::to_string(grid.size()) +
                    (grid.size() == 1 ? " preset" : " presets");
  if (made.mirrored) out += ", one side, of which the other is the mirror image";
  const auto [off, where] = misfit(values, made.grid);
  constexpr double kRounding_Nm = 1e-9;
  out += "; the law's largest distance from a point: " + text(off < kRounding_Nm ? 0 : off) + " N·m";
  if (off >= kRounding_Nm) out += ", " + points.place(where) + ": what the torque is at rest is taken off";
  return out;
}

class Table final : public Transmission {
 public:
  explicit Table(TorqueGrid grid) : grid_(std::move(grid)) {}

  [[nodiscard]] Response evaluate(const Positions& at) const noexcept override {
    return response_of(grid_.at(at.q - at.x[0], at.x[1]));
  }
  [[nodiscard]] SegmentMean mean_over(const Positions& from, const Positions& to) const noexcept override;
  [[nodiscard]] std::array<double, 2> references(const EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium, grid_.has_preset() ? c.preset : 0.0};
  }
  [[nodiscard]] EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return {x[0], grid_.has_preset() ? x[1] : 0.0};
  }
  [[nodiscard]] int motor_count() const noexcept override { return grid_.has_preset() ? 2 : 1; }
  [[nodiscard]] int spring_count() const noexcept override { return grid_.has_preset() ? 0 : 1; }
  [[nodiscard]] std::array<double, 2> signed_energies(const Positions& at) const noexcept override {
    const double d = at.q - at.x[0];
    return {grid_.has_preset() ? 0.0 : std::copysign(grid_.at(d, 0).energy, d), 0.0};
  }
  [[nodiscard]] bool equals(const Transmission& other) const noexcept override {
    const auto* same = dynamic_cast<const Table*>(&other);
    return same != nullptr && same->grid_ == grid_;
  }
  [[nodiscard]] std::string_view preset_unit() const noexcept override { return grid_.has_preset() ? "rad" : ""; }

 private:
  TorqueGrid grid_;
};

/// Knots that a straight way from `from` to `to` passes, one after the other, as parts of the way.
class Crossings {
 public:
  Crossings(std::span<const double> knots, double from, double to) noexcept : knots_(knots), from_(from), way_(to - from) {
    const auto above = std::upper_bound(knots.begin(), knots.end(), from);
    const auto first = way_ >= 0 ? above : std::lower_bound(knots.begin(), knots.end(), from);
    next_ = first - knots.begin() - (way_ >= 0 ? 0 : 1);
  }
  /// Of the next; 1 or more where there is none.
  [[nodiscard]] double next() const noexcept {
    if (way_ == 0 || next_ < 0 || next_ >= static_cast<std::ptrdiff_t>(knots_.size())) return 1;
    return (knots_[static_cast<std::size_t>(next_)] - from_) / way_;
  }
  void pass() noexcept { next_ += way_ >= 0 ? 1 : -1; }

 private:
  std::span<const double> knots_;
  double from_, way_;
  std::ptrdiff_t next_ = 0;
};

// Between knots torque, loads and curvature are polynomials of sixth order along the way: four points have their means exactly.
SegmentMean Table::mean_over(const Positions& from, const Positions& to) const noexcept {
  constexpr std::array<double, 4> kNodes{0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
  constexpr std::array<double, 4> kWeights{0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  const double d0 = from.q - from.x[0], d1 = to.q - to.x[0];
  Crossings deflections(grid_.deflection_knots(), d0, d1), presets(grid_.preset_knots(), from.x[1], to.x[1]);
  Potential mean, slope;
  for (double begin = 0; begin < 1;) {
    const double of_deflection = deflections.next(), of_preset = presets.next();
    const double end = std::min({of_deflection, of_preset, 1.0});
    if (of_deflection <= end) deflections.pass();
    if (of_preset <= end) presets.pass();
    for (std::size_t i = 0; i < kNodes.size() && end > begin; ++i) {
      const double s = begin + kNodes[i] * (end - begin), w = kWeights[i] * (end - begin);
      const Potential h = grid_.at(d0 + s * (d1 - d0), from.x[1] + s * (to.x[1] - from.x[1]));
      mean.d += w * h.d;
      mean.p += w * h.p;
      slope.dd += w * s * h.dd;
      slope.dp += w * s * h.dp;
      slope.pp += w * s * h.pp;
    }
    begin = std::max(begin, end);
  }
  return {-mean.d, {mean.d, -mean.p}, response_of(slope).curvature};
}

}  // namespace

extern const Law kTable{
    .name = "table",
    .title = "a measured grid of torques",
    .equation = "H = s ∫ T(δ, p) dδ,  p = x₁;  T: cubics through the points of a file",
    .source =
        "your own measurement; the cubics: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238, as a potential: "
        "derived here",
    .parameters = kParameters,
    .make = [](std::span<const double> v) -> std::shared_ptr<const Transmission> {
      return std::make_shared<Table>(make_grid(v).grid);
    },
    .fault = fault,
    .file = &kFile,
    .remark = remark,
};

}  // namespace vsa::elastic
