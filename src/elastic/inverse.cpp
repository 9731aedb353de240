// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/elastic/inverse.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "vsa/checks.hpp"

namespace vsa::elastic {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kEqual = 1e-9;  // stiffnesses this close are the same

Response at(const Transmission& law, double q, const EquilibriumPreset& command) noexcept {
  return law.evaluate({q, law.references(command)});
}

/// The zero of f between a and b, where it changes its sign: regula falsi, weighted as Illinois does, halved where that is slow.
template <class F>
double root(const F& f, double a, double fa, double b, double fb) noexcept {
  for (int i = 0; i < kMaxIterations && fa != 0 && fb != 0; ++i) {
    const double falsi = (a * fb - b * fa) / (fb - fa);
    const bool inside = falsi > std::min(a, b) && falsi < std::max(a, b);
    const double c = i % 4 == 3 || !inside ? 0.5 * (a + b) : falsi;
    if (c == a || c == b) break;
    const double fc = f(c);
    if (!((fc < 0) == (fb < 0))) {
      a = b;
      fa = fb;
    } else {
      fa *= 0.5;
    }
    b = c;
    fb = fc;
    if (std::abs(b - a) <= 1e-15 * std::max(std::abs(a), std::abs(b))) break;
  }
  return std::abs(fa) < std::abs(fb) ? a : b;
}

struct Sample {
  double preset = 0;
  EquilibriumPreset command;
  double stiffness = 0;
};

std::optional<Sample> sample(const Transmission& law, const Wanted& w, double preset) noexcept {
  const auto equilibrium = equilibrium_for(law, w.q, w.torque_Nm, preset);
  if (!equilibrium) return std::nullopt;
  const EquilibriumPreset command{*equilibrium, preset};
  return Sample{preset, command, at(law, w.q, command).curvature.qq};
}

struct Search {
  std::optional<Sample> nearest;  ///< to the wanted stiffness
  double least = 0, most = 0;

  void see(const Sample& now, double goal) noexcept {
    least = nearest ? std::min(least, now.stiffness) : now.stiffness;
    most = nearest ? std::max(most, now.stiffness) : now.stiffness;
    constexpr double kRounding = 1e-12;
    if (!nearest || std::abs(now.stiffness - goal) + kRounding * goal < std::abs(nearest->stiffness - goal)) nearest = now;
  }
};

/// Where the stiffness along the curve is extreme between two presets, it may pass the goal unseen by samples: golden sections,
/// until it has.
std::optional<Sample> extreme(const Transmission& law, const Wanted& w, double from, double to, bool least, Search& out) noexcept {
  constexpr double kGolden = 0.6180339887498949;
  const double sign = least ? 1 : -1, goal = w.stiffness_Nm_per_rad;
  for (int i = 0; i < kMaxIterations && to - from > 1e-9 * (1 + to); ++i) {
    const auto a = sample(law, w, to - kGolden * (to - from)), b = sample(law, w, from + kGolden * (to - from));
    if (!a || !b) return std::nullopt;
    const Sample& better = sign * a->stiffness <= sign * b->stiffness ? *a : *b;
    out.see(better, goal);
    if (sign * (better.stiffness - goal) <= 0) return better;
    (sign * a->stiffness <= sign * b->stiffness ? to : from) = sign * a->stiffness <= sign * b->stiffness ? b->preset : a->preset;
  }
  return std::nullopt;
}

/// Samples in the order of their presets, with the borders of what reaches the torque.
class Curve {
 public:
  Curve(const Transmission& law, const Wanted& w) noexcept : law_(law), wanted_(w) {}

  /// The next one, wherever the torque is reached there. `visit` gets it with the one before it, if the curve joins them, and says
  /// whether to go on.
  template <class Visit>
  bool add(double preset, const Visit& visit) noexcept {
    const std::optional<Sample> now = sample(law_, wanted_, preset);
    if (preset > 0 && now.has_value() != there_) {
      const Sample edge = border(now ? *now : all_[count_ - 1], now ? at_ : preset);
      if (!put(edge, visit)) return false;
    }
    there_ = now.has_value();
    at_ = preset;
    return !now || put(*now, visit);
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const Sample& operator[](std::size_t i) const noexcept { return all_[i]; }
  [[nodiscard]] double before(std::size_t i) const noexcept { return i > 0 && joined_[i] ? all_[i - 1].preset : all_[i].preset; }
  [[nodiscard]] double after(std::size_t i) const noexcept {
    return i + 1 < count_ && joined_[i + 1] ? all_[i + 1].preset : all_[i].preset;
  }

  static constexpr std::size_t kSteps = 16;

 private:
  template <class Visit>
  bool put(const Sample& s, const Visit& visit) noexcept {
    joined_[count_] = there_ && count_ > 0;
    all_[count_] = s;
    ++count_;
    there_ = true;
    return visit(s, joined_[count_ - 1] ? &all_[count_ - 2] : nullptr);
  }
  /// The farthest from `inside` that reaches the torque.
  [[nodiscard]] Sample border(Sample inside, double outside) const noexcept {
    for (int i = 0; i < 40; ++i) {
      const auto middle = sample(law_, wanted_, 0.5 * (inside.preset + outside));
      if (middle) {
        inside = *middle;
      } else {
        outside = 0.5 * (inside.preset + outside);
      }
    }
    return inside;
  }

  const Transmission& law_;
  const Wanted& wanted_;
  std::array<Sample, 2 * (kSteps + 1)> all_;
  std::array<bool, 2 * (kSteps + 1)> joined_{};
  std::size_t count_ = 0;
  bool there_ = false;
  double at_ = 0;  ///< preset that was looked at last
};

Search search(const Transmission& law, const Wanted& w, double preset_max) noexcept {
  const std::size_t steps = preset_max > 0 ? Curve::kSteps : 0;
  const double goal = w.stiffness_Nm_per_rad, width = steps > 0 ? preset_max / static_cast<double>(steps) : 0.0;
  Search out;
  Curve curve(law, w);
  const auto close_in = [&](const Sample& a, const Sample& b) {
    const auto missing = [&](double p) {
      const auto there = sample(law, w, p);
      return there ? there->stiffness - goal : 0.0;
    };
    if (const auto there = sample(law, w, root(missing, a.preset, a.stiffness - goal, b.preset, b.stiffness - goal)))
      out.see(*there, goal);
  };
  const auto look = [&](const Sample& now, const Sample* last) {
    out.see(now, goal);
    if (last == nullptr || (last->stiffness - goal) * (now.stiffness - goal) > 0) return true;
    close_in(*last, now);
    return false;
  };
  for (std::size_t i = 0; i <= steps; ++i)
    if (!curve.add(width * static_cast<double>(i), look)) return out;
  if (curve.size() == 0 || steps == 0) return out;
  const bool least = goal < out.least;
  std::size_t at = 0;
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (least ? curve[i].stiffness < curve[at].stiffness : curve[i].stiffness > curve[at].stiffness) at = i;
  const double from = curve.before(at);
  const auto beyond = extreme(law, w, from, curve.after(at), least, out);
  if (const auto first = sample(law, w, from); beyond && first) close_in(*first, *beyond);
  return out;
}

/// Where f, which is below 0 at `from` and grows from there, is largest up to `to`; the first point seen where it isn't below 0.
template <class F>
double peak(const F& f, double from, double to) noexcept {
  constexpr double kGolden = 0.6180339887498949;
  double best = from, f_best = f(from);
  for (int i = 0; i < kMaxIterations && std::abs(to - from) > 1e-9; ++i) {
    const double a = to - kGolden * (to - from), b = from + kGolden * (to - from), fa = f(a), fb = f(b);
    for (const auto& [x, fx] : {std::pair{a, fa}, std::pair{b, fb}}) {
      if (!(fx > f_best)) continue;
      best = x;
      f_best = fx;
    }
    if (f_best >= 0) break;
    (fa < fb ? from : to) = fa < fb ? a : b;
  }
  return best;
}

}  // namespace

std::optional<double> equilibrium_for(const Transmission& law, double q, double torque_Nm, double preset,
                                      double reach_rad) noexcept {
  for (const double x : {q, torque_Nm, preset})
    if (!std::isfinite(x)) return std::nullopt;
  const auto missing = [&](double e) { return at(law, q, {e, preset}).torque - torque_Nm; };
  const double here = missing(q);
  if (here == 0) return q;
  constexpr double kFirst_rad = 0.01;
  constexpr double kSlope_rad = 1e-4, kFlat = 1e-12;
  double near = q, f_near = here, before = q, f_before = here;
  for (double step = std::min(kFirst_rad, reach_rad);; step = std::min(2 * step, reach_rad)) {
    const double far = here < 0 ? q + step : q - step;  // the torque grows with the equilibrium
    const double f_far = missing(far);
    if (std::isnan(f_far)) return std::nullopt;
    if ((f_far < 0) != (here < 0)) {
      if (std::isfinite(f_far)) return root(missing, near, f_near, far, f_far);
      // An exponential law has no numbers there: bisect back to where it has.
      double low = near, high = far;
      for (int i = 0; i < kMaxIterations && !std::isfinite(missing(high)); ++i) {
        const double middle = 0.5 * (low + high), f = missing(middle);
        ((f < 0) == (here < 0) ? low : high) = middle;
      }
      return root(missing, low, missing(low), high, missing(high));
    }
    // A lever's torque has a peak, which a step may pass unseen: behind it the torque falls.
    const double side = here < 0 ? 1 : -1, slope = side * (f_far - missing(far - side * kSlope_rad));
    if (slope < -kFlat * (1 + std::abs(f_far))) {
      const double top = peak([&](double e) { return side * missing(e); }, before, far), f_top = missing(top);
      if ((f_top < 0) != (here < 0)) return root(missing, before, f_before, top, f_top);
    }
    if (step >= reach_rad) return std::nullopt;
    before = near;
    f_before = f_near;
    near = far;
    f_near = f_far;
  }
}

std::optional<double> rest_under(const Transmission& law, const std::array<double, 2>& x, double load_Nm,
                                 double reach_rad) noexcept {
  for (const double v : {x[0], x[1], load_Nm})
    if (!std::isfinite(v)) return std::nullopt;
  const double from = law.attained(x).equilibrium, there = law.evaluate({from, x}).torque + load_Nm;
  if (!(reach_rad > 0) || !std::isfinite(reach_rad) || !std::isfinite(there)) return std::nullopt;
  if (there == 0) return from;
  const double side = there < 0 ? -1 : 1;
  const auto pushed = [&](double size) { return side * (law.evaluate({from + side * size, x}).torque + load_Nm) > 0; };
  double low = 0, high = std::min(1e-3, reach_rad);
  while (pushed(high)) {
    if (high >= reach_rad) return std::nullopt;
    low = high;
    high = std::min(2 * high, reach_rad);
  }
  for (double mid = 0.5 * (low + high); mid > low && mid < high; mid = 0.5 * (low + high)) (pushed(mid) ? low : high) = mid;
  return from + side * high;
}

bool antagonistic(const Transmission& law) noexcept {
  if (law.motor_count() != 2) return false;
  constexpr EquilibriumPreset kAny{0.25, 0.125};
  const auto x = law.references(kAny);
  return std::abs(x[0] - 0.375) < 1e-9 && std::abs(x[1] - 0.125) < 1e-9;
}

Command command_for(const Transmission& law, const Wanted& wanted, double preset_max) noexcept {
  using Outcome = Command::Outcome;
  Command result;
  const double goal = wanted.stiffness_Nm_per_rad;
  if (!std::isfinite(wanted.q) || !std::isfinite(wanted.torque_Nm) || !std::isfinite(goal) || goal < 0) return result;
  if (!std::isfinite(preset_max) || preset_max < 0) return result;
  if (const auto exact = law.command_exactly(wanted.q, wanted.torque_Nm, goal); exact && exact->preset <= preset_max) {
    return {Outcome::found, *exact, goal, goal};
  }
  const Search found = search(law, wanted, preset_max);
  if (!found.nearest) {
    result.outcome = Outcome::torque_unreachable;
    return result;
  }
  result.stiffness_min = found.least;
  result.stiffness_max = found.most;
  result.command = found.nearest->command;
  const double reached = found.nearest->stiffness;
  const bool equal = std::abs(reached - goal) <= kEqual * std::max(goal, 1e-12);
  result.outcome = equal ? Outcome::found : goal < reached ? Outcome::too_soft : Outcome::too_stiff;
  return result;
}

std::string Command::text() const {
  const std::string range = " (" + Checks::text(stiffness_min) + " … " + Checks::text(stiffness_max) + " N·m/rad at this torque)";
  switch (outcome) {
    case Outcome::found:
      return "found";
    case Outcome::too_soft:
      return "softer than the actuator can be" + range;
    case Outcome::too_stiff:
      return "stiffer than the actuator can be" + range;
    case Outcome::torque_unreachable:
      return "no preset reaches the torque within a turn";
    case Outcome::not_a_number:
      break;
  }
  return "an argument isn't a finite number, or negative where it can't be";
}

}  // namespace vsa::elastic
