// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "vsa/checks.hpp"
#include "vsa/errors.hpp"
#include "vsa/experiment/recording.hpp"
#include "vsa/not_a_number.hpp"

namespace vsa::experiment {
namespace {

constexpr double kSameTorque = 1e-9;  // N·m: grid points of two files are one point

/// Samples first … last − 1 go one way.
struct Stretch {
  std::size_t first, last;
  bool rising;
};

/// A first turn before the torque has moved by the threshold is none.
std::vector<Stretch> stretches(const std::vector<double>& torque, double threshold) {
  std::vector<Stretch> out;
  if (torque.empty() || !(threshold > 0)) return out;
  std::size_t start = 0, high = 0, low = 0;
  int direction = 0;  // 0: not known yet
  for (std::size_t i = 1; i < torque.size(); ++i) {
    if (torque[i] > torque[high]) high = i;
    if (torque[i] < torque[low]) low = i;
    if (direction >= 0 && torque[high] - torque[i] > threshold) {
      if (direction > 0) {
        out.push_back({start, high, true});
        start = high;
      }
      low = i;
      direction = -1;
    } else if (direction <= 0 && torque[i] - torque[low] > threshold) {
      if (direction < 0) {
        out.push_back({start, low, false});
        start = low;
      }
      high = i;
      direction = 1;
    }
  }
  if (direction != 0) out.push_back({start, torque.size(), direction > 0});
  return out;
}

/// The sample at which the torque has changed its sign `half_cycles` times; a stretch that doesn't cross zero counts by its end.
std::size_t after_half_cycles(const std::vector<double>& torque, const std::vector<Stretch>& all, long half_cycles) {
  if (half_cycles <= 0 || all.empty()) return 0;
  // The sweep starts at zero: its first crossing is on the stretch after the first turning point.
  const std::size_t index = static_cast<std::size_t>(half_cycles);
  if (index >= all.size()) return torque.size();
  const Stretch& s = all[index];
  for (std::size_t i = s.first; i < s.last; ++i) {
    if (s.rising ? torque[i] >= 0 : torque[i] <= 0) return i;
  }
  return s.last;
}

/// Sums for a straight line through the samples about one grid point; torque counted from that point.
struct LineSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  bool left = false, right = false;

  void add(double dx, double value) {
    n += 1;
    x += dx;
    y += value;
    xx += dx * dx;
    xy += dx * value;
    yy += value * value;
    left = left || dx <= 0;
    right = right || dx >= 0;
  }
  [[nodiscard]] bool usable() const { return left && right; }
  [[nodiscard]] double slope() const {
    const double spread = xx - x * x / n;
    return spread > 1e-15 ? (xy - x * y / n) / spread : 0.0;
  }
  [[nodiscard]] double height() const { return usable() ? (y - slope() * x) / n : kNaN; }
  [[nodiscard]] double scatter() const {
    if (!usable()) return kNaN;
    const double covariance = xy - x * y / n;
    return std::sqrt(std::max(0.0, (yy - y * y / n - slope() * covariance) / n));
  }
};

void add_sample(std::vector<LineSums>& sums, double torque, double deflection, const BranchOptions& o, long reach) {
  const long nearest = std::lround(torque / o.grid_Nm);
  for (long k = nearest - 1; k <= nearest + 1; ++k) {  // a sample half way between belongs to both
    const double dx = torque - static_cast<double>(k) * o.grid_Nm;
    if (std::abs(k) > reach || std::abs(dx) > o.grid_Nm / 2 + kSameTorque) continue;
    sums[static_cast<std::size_t>(k + reach)].add(dx, deflection);
  }
}

double mean_square(const std::vector<double>& squares) {
  double sum = 0;
  for (double s : squares) sum += s;
  return squares.empty() ? kNaN : sum / static_cast<double>(squares.size());
}

void check(const BranchOptions& o) {
  const double halves = o.skip_cycles * 2;
  Problems problems;
  if (!(o.grid_Nm > 0)) problems.add({"", "grid_Nm", Checks::text(o.grid_Nm), "out of range", "more than 0"});
  if (!(o.max_Nm >= o.grid_Nm)) problems.add({"", "max_Nm", Checks::text(o.max_Nm), "out of range", "grid_Nm or more"});
  if (!(halves >= 0) || halves != std::floor(halves)) {
    problems.add({"", "skip_cycles", Checks::text(o.skip_cycles), "out of range", "0, 0.5, 1, …"});
  }
  if (!(o.turn_fraction > 0 && o.turn_fraction < 1)) {
    problems.add({"", "turn_fraction", Checks::text(o.turn_fraction), "out of range", "between 0 and 1"});
  }
  problems.throw_if_any();
}

}  // namespace

Branches branches(const LoadRecording& recording, const BranchOptions& o) {
  check(o);
  const std::vector<double>& torque = recording.torque_Nm;
  double peak = 0;
  for (double t : torque) peak = std::max(peak, std::abs(t));
  const std::vector<Stretch> all = stretches(torque, o.turn_fraction * peak);
  const std::size_t begin = after_half_cycles(torque, all, std::lround(o.skip_cycles * 2));
  const long reach = static_cast<long>(std::floor(o.max_Nm / o.grid_Nm + 1e-9));
  const std::size_t points = static_cast<std::size_t>(2 * reach + 1);
  std::vector<LineSums> rising(points), falling(points);
  for (const Stretch& s : all) {
    for (std::size_t i = std::max(s.first, begin); i < s.last; ++i) {
      add_sample(s.rising ? rising : falling, torque[i], recording.deflection_rad[i], o, reach);
    }
  }
  Branches out;
  for (std::size_t k = 0; k < points; ++k) {
    out.torque_Nm.push_back(static_cast<double>(static_cast<long>(k) - reach) * o.grid_Nm);
    out.rising_rad.push_back(rising[k].height());
    out.falling_rad.push_back(falling[k].height());
    out.sd_rising_rad.push_back(rising[k].scatter());
    out.sd_falling_rad.push_back(falling[k].scatter());
  }
  return out;
}

Branches subtract(const Branches& a, const Branches& b) {
  Branches out;
  for (std::size_t i = 0, k = 0; i < a.torque_Nm.size() && k < b.torque_Nm.size();) {
    const double gap = a.torque_Nm[i] - b.torque_Nm[k];
    if (std::abs(gap) <= kSameTorque) {
      out.torque_Nm.push_back(b.torque_Nm[k]);
      out.rising_rad.push_back(a.rising_rad[i] - b.rising_rad[k]);
      out.falling_rad.push_back(a.falling_rad[i] - b.falling_rad[k]);
    }
    if (gap <= kSameTorque) ++i;
    if (gap >= -kSameTorque) ++k;
  }
  return out;
}

Difference difference(const Branches& a, const Branches& b) {
  const Branches apart = subtract(a, b);
  const auto squares = [](const std::vector<double>& values) {
    std::vector<double> out;
    for (const double v : values) {
      if (std::isfinite(v)) out.push_back(v * v);
    }
    return out;
  };
  const std::vector<double> rising = squares(apart.rising_rad), falling = squares(apart.falling_rad);
  const std::size_t points = rising.size() + falling.size();
  if (points == 0) throw InputError({"", "branches", "", "the two have no torque in common", "overlapping torque grids"});
  std::vector<double> both = rising;
  both.insert(both.end(), falling.begin(), falling.end());
  return {std::sqrt(mean_square(both)), std::sqrt(mean_square(rising)), std::sqrt(mean_square(falling)), points};
}

}  // namespace vsa::experiment
