// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How far the snake gets: worlds × gaits × starts. Prints a table in Markdown and, with --json, writes every run.
//
//   snake_travel [--worlds flat,rubble,hills] [--gaits sidewind,steered_soft,…] [--starts 8] [--duration-s 60] [--jobs 1]
//                [--json FILE]
//
// Path and net displacement are those of the cycle-averaged centre of mass: its mean over one gait period, one value a period. A
// start differs from the others by its yaw (−2° … +2°) and by ±1 mm in x and y: a tiny difference that grows, so look at medians.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <thread>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/units.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::engine::World;
using vsa::motion::Gait;

const fs::path kModels = fs::path(VSA_SOURCE_DIR) / "models";

struct Options {
  std::vector<std::string> worlds{"flat", "rubble", "hills"};
  std::vector<std::string> gaits{"sidewind_soft", "sidewind", "sidewind_stiff", "steered_soft", "steered", "steered_stiff"};
  int starts = 8;
  double duration_s = 60;
  int jobs = 1;
  std::string json;
};

struct Run {
  std::string world, gait;
  int start = 0;
  double path_m = 0, net_m = 0, x_m = 0, y_m = 0;
  double torque_peak_Nm = 0, preset_mean_rad = 0, supply_J = 0, wall_s = 0;
  std::string error;
  std::vector<std::array<double, 3>> track;  // one a gait period
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(',', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

Options parsed(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; i += 2) {
    const std::string flag = argv[i];
    if (i + 1 == argc) throw vsa::InputError(vsa::Problem{"command line", flag, "", "a value is missing", ""});
    const std::string value = argv[i + 1];
    if (flag == "--worlds")
      o.worlds = split(value);
    else if (flag == "--gaits")
      o.gaits = split(value);
    else if (flag == "--starts")
      o.starts = std::max(1, std::stoi(value));
    else if (flag == "--duration-s")
      o.duration_s = std::stod(value);
    else if (flag == "--jobs")
      o.jobs = std::max(1, std::stoi(value));
    else if (flag == "--json")
      o.json = value;
    else
      throw vsa::InputError(
          vsa::Problem{"command line", flag, "", "unknown option", "--worlds --gaits --starts --duration-s --jobs --json"});
  }
  return o;
}

/// Adds up the centre of mass over a gait period and measures the way from one mean to the next.
class Track {
 public:
  explicit Track(double period_s) : period_s_(period_s) {}
  void add(double t_s, const std::array<double, 3>& center) {
    for (std::size_t i = 0; i < 3; ++i) sum_[i] += center[i];
    ++count_;
    if (t_s < static_cast<double>(points_.size() + 1) * period_s_) return;
    points_.push_back({sum_[0] / count_, sum_[1] / count_, sum_[2] / count_});
    sum_ = {};
    count_ = 0;
  }
  void report(Run& run) const {
    if (points_.size() < 2) throw std::runtime_error("the run is shorter than two gait periods");
    for (std::size_t i = 1; i < points_.size(); ++i) {
      run.path_m += std::hypot(points_[i][0] - points_[i - 1][0], points_[i][1] - points_[i - 1][1]);
    }
    run.x_m = points_.back()[0] - points_.front()[0];
    run.y_m = points_.back()[1] - points_.front()[1];
    run.net_m = std::hypot(run.x_m, run.y_m);
    run.track = points_;
  }

 private:
  double period_s_;
  std::array<double, 3> sum_{};
  int count_ = 0;
  std::vector<std::array<double, 3>> points_;
};

void place(World& world, int start, int starts) {
  const double yaw_deg = starts == 1 ? 0.0 : -2.0 + 4.0 * start / (starts - 1);
  const double x = starts == 1 ? 0.0 : (start % 2 == 0 ? 1e-3 : -1e-3), y = starts == 1 ? 0.0 : (start / 2 % 2 == 0 ? 1e-3 : -1e-3);
  world.displace_model("qbmove_snake", yaw_deg * vsa::kPi / 180, {x, y, 0});
}

void travel(Run& run, const Options& o) {
  World world = World::load(kModels / "worlds" / ("snake_" + run.world + ".sdf"));
  const auto began = std::chrono::steady_clock::now();
  Gait gait = Gait::load(kModels / "gaits" / (run.gait + ".toml"));
  place(world, run.start, o.starts);
  Track track(2 * vsa::kPi / gait.params().frequency_rad_per_s);
  const auto steps = std::llround(o.duration_s / world.step_s());
  const auto every = std::max<std::int64_t>(1, std::llround(0.01 / world.step_s()));
  std::int64_t samples = 0;
  for (std::int64_t i = 0; i < steps; ++i) {
    gait.apply(world);
    world.step();
    if ((i + 1) % every != 0) continue;
    track.add(world.time_s(), world.center_of_mass("qbmove_snake"));
    for (const auto& actuator : world.actuators()) {
      const auto now = world.read(actuator);
      run.torque_peak_Nm = std::max(run.torque_peak_Nm, std::abs(now.torque_Nm));
      if (world.time_s() > 5) run.preset_mean_rad += now.preset;
      if (world.time_s() > 5) ++samples;
    }
  }
  track.report(run);
  if (samples > 0) run.preset_mean_rad /= static_cast<double>(samples);
  run.supply_J = world.ledger().supply;
  run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

struct Spread {
  double median, min, max;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2, values.front(), values.back()};
}

std::string shown(const std::vector<double>& values) {
  const Spread s = spread(values);
  return fmt::format("{:.2f} ({:.2f}–{:.2f})", s.median, s.min, s.max);
}

void print_table(const Options& o, const std::vector<Run>& runs) {
  fmt::print("{} s, {} starts; median (min–max)\n\n", o.duration_s, o.starts);
  fmt::print(
      "| world | gait | path m | net m | along +y m | peak torque N·m | attained preset rad | supply J | real-time factor | failed "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& world : o.worlds) {
    for (const auto& gait : o.gaits) {
      std::vector<double> path, net, along, torque, preset, supply, factor;
      int failed = 0;
      for (const Run& r : runs) {
        if (r.world != world || r.gait != gait) continue;
        if (!r.error.empty()) {
          ++failed;
          continue;
        }
        path.push_back(r.path_m);
        net.push_back(r.net_m);
        along.push_back(r.y_m);
        torque.push_back(r.torque_peak_Nm);
        preset.push_back(r.preset_mean_rad);
        supply.push_back(r.supply_J);
        factor.push_back(o.duration_s / r.wall_s);
      }
      if (path.empty()) {
        fmt::print("| {} | {} | – | – | – | – | – | – | – | {} |\n", world, gait, failed);
        continue;
      }
      fmt::print("| {} | {} | {} | {} | {} | {:.1f} | {:.3f} | {:.0f} | {:.1f} | {} |\n", world, gait, shown(path), shown(net),
                 shown(along), spread(torque).max, spread(preset).median, spread(supply).median, spread(factor).median, failed);
    }
  }
}

void write_json(const Options& o, const std::vector<Run>& runs) {
  std::ofstream out(o.json);
  out << "[\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& r = runs[i];
    std::string track;
    for (const auto& p : r.track) track += fmt::format("{}[{:.4f},{:.4f},{:.4f}]", track.empty() ? "" : ",", p[0], p[1], p[2]);
    std::string error = r.error;
    std::replace_if(
        error.begin(), error.end(), [](char c) { return c == '"' || c == '\\' || c < ' '; }, ' ');
    out << fmt::format(
        R"({{"world":"{}","gait":"{}","start":{},"duration_s":{},"path_m":{:.4f},"net_m":{:.4f},"x_m":{:.4f},"y_m":{:.4f},)"
        R"("torque_peak_Nm":{:.3f},"preset_mean_rad":{:.4f},"supply_J":{:.2f},"wall_s":{:.2f},"error":"{}","track_m":[{}]}}{})",
        r.world, r.gait, r.start, o.duration_s, r.path_m, r.net_m, r.x_m, r.y_m, r.torque_peak_Nm, r.preset_mean_rad, r.supply_J,
        r.wall_s, error, track, i + 1 < runs.size() ? ",\n" : "\n");
  }
  out << "]\n";
  if (!out.flush()) throw std::runtime_error("can't write " + o.json);
}

std::vector<Run> run_all(const Options& o) {
  std::vector<Run> runs;
  for (const auto& world : o.worlds) {
    for (const auto& gait : o.gaits) {
      for (int start = 0; start < o.starts; ++start) {
        Run run;
        run.world = world;
        run.gait = gait;
        run.start = start;
        runs.push_back(std::move(run));
      }
    }
  }
  std::atomic<std::size_t> next{0};
  std::mutex lock;
  const auto work = [&] {
    for (std::size_t i = next++; i < runs.size(); i = next++) {
      try {
        travel(runs[i], o);
      } catch (const std::exception& error) {
        runs[i].error = error.what();
      }
      const std::scoped_lock guard(lock);
      const Run& r = runs[i];
      fmt::print(stderr, "{:3}/{} {} {} {}: path {:.2f} m, net {:.2f} m ({:+.2f}, {:+.2f}) {:.1f} s {}\n", i + 1, runs.size(),
                 r.world, r.gait, r.start, r.path_m, r.net_m, r.x_m, r.y_m, r.wall_s, r.error);
    }
  };
  std::vector<std::thread> threads;
  for (int j = 0; j < o.jobs; ++j) threads.emplace_back(work);
  for (auto& thread : threads) thread.join();
  return runs;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parsed(argc, argv);
    const auto runs = run_all(options);
    print_table(options, runs);
    if (!options.json.empty()) write_json(options, runs);
    return std::any_of(runs.begin(), runs.end(), [](const Run& r) { return !r.error.empty(); }) ? 1 : 0;
  } catch (const vsa::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "snake_travel: {}\n", error.what());
    return 1;
  }
}
