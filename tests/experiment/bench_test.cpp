// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The benches: what loads the shaft, when samples are taken, what the unit measures, and that runs repeat.
#include "vsa/experiment/bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bench_support.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

constexpr double kLoad_Nm = 1.0 * 9.81 * 0.15;  // 1 kg on 0.15 m, the paper's IV-A

/// Bit for bit: a sample is doubles only.
bool equal_bits(const BenchRun& a, const BenchRun& b) {
  static_assert(std::is_trivially_copyable_v<BenchSample>);
  static_assert(sizeof(BenchSample) % sizeof(double) == 0);
  return a.samples.size() == b.samples.size() && !a.samples.empty() &&
         std::memcmp(a.samples.data(), b.samples.data(), a.samples.size() * sizeof(BenchSample)) == 0;
}

TEST(Bench, TheLeversLoadIsOneKilogramOnFifteenCentimetres) {
  const BenchRun run = run_stiffness(specimen(), short_sweep(0.3));
  EXPECT_NEAR(run.load_peak_Nm, kLoad_Nm, 1e-6) << "of mass, rod and flange together, read from the links";
  EXPECT_EQ(run_speed(specimen(), short_square()).load_peak_Nm, 0);
}

TEST(Bench, TheShaftObeysNewtonUnderTheActuatorAndTheWeight) {
  constexpr double kInertia_kgm2 = 1.54392857e-3 + 1.05 * 0.142857143 * 0.142857143;  // of the flange link about the shaft
  StiffnessOptions o = short_sweep(0.4602);
  o.sample_s = 0.001;
  const BenchRun run = run_stiffness(specimen(), o);
  constexpr std::size_t kWindow = 100;
  double largest_impulse = 0;
  for (std::size_t i = 0; i + kWindow < run.samples.size(); i += kWindow) {
    double impulse = 0;
    // A reading is of its step's end, its mean torque of the way there; the engine takes the weight at the step's start.
    for (std::size_t k = i; k < i + kWindow; ++k) {
      const BenchSample& s = run.samples[k];
      const double torque = run.samples[k + 1].mean_torque_Nm;
      impulse += 1e-3 * (torque - kLoad_Nm * std::sin(s.shaft_rad));
      largest_impulse = std::max(largest_impulse, 1e-3 * std::abs(torque) * kWindow);
      EXPECT_NEAR(s.measured_load_Nm, -kLoad_Nm * std::sin(s.measured_shaft_rad), 1e-6);
    }
    const double change = run.samples[i + kWindow].shaft_speed_rad_per_s - run.samples[i].shaft_speed_rad_per_s;
    EXPECT_NEAR(impulse, kInertia_kgm2 * change, 1e-6) << run.samples[i].time_s;
  }
  EXPECT_GT(largest_impulse, 0.13) << "the balance is of large numbers";
}

TEST(Bench, TheUnitReadsItsShaftAndDeflectionWithinItsEncoders) {
  constexpr double kCount_rad = 2 * kPi / 4096;
  const BenchRun run = run_stiffness(specimen("qbmove_maker_pro", {{"sensor.shaft_zero_rad", "0"}}), short_sweep(0.2));
  double largest = 0;
  for (const BenchSample& s : run.samples) {
    const double late_rad = std::abs(s.shaft_speed_rad_per_s) * 0.003;  // the reading is up to three ticks old
    EXPECT_NEAR(s.measured_shaft_rad, s.shaft_rad, kCount_rad + late_rad);
    EXPECT_NEAR(s.measured_deflection_rad, s.shaft_rad - s.equilibrium_rad, 2 * kCount_rad + 2 * late_rad);
    const double half_counts = s.measured_deflection_rad / (kCount_rad / 2);
    EXPECT_NEAR(half_counts, std::round(half_counts), 1e-6) << "a difference of counts and a mean of two";
    largest = std::max(largest, s.measured_deflection_rad);
  }
  EXPECT_GT(largest, 0.3);
}

TEST(Bench, SamplesAreTheCyclesAfterTheLeadIn) {
  StiffnessOptions o = short_sweep(0.3);
  o.amplitude_rad = 0.4;
  o.lead_in_cycles = 2;
  o.cycles = 3;
  o.sample_s = 0.02;
  const BenchRun run = run_stiffness(specimen(), o);
  ASSERT_EQ(run.samples.size(), 1501u);
  EXPECT_NEAR(run.samples.front().time_s, 20, 1e-9);
  EXPECT_NEAR(run.samples.back().time_s, 50, 1e-9);
  EXPECT_EQ(run.amplitude_rad, 0.4);
  for (const BenchSample& s : run.samples) {
    const double command = 0.4 * std::sin(2 * kPi * s.time_s / 10);
    EXPECT_NEAR(s.equilibrium_command_rad, command, 0.4 * 2 * kPi / 10 * 1.01e-3) << "the command of the step before";
    EXPECT_EQ(s.preset_command, 0.3);
  }
}

TEST(Bench, TheAmplitudeBringsTheShaftWhereTheRecordingsShaftWas) {
  const double target_deg[] = {94, 90, 81, 81}, presets[] = {0, 0.46, 0.6903, 0.78};
  for (int i = 0; i < 4; ++i) {
    const BenchRun run = run_stiffness(specimen(), short_sweep(presets[i]));
    double reached = 0;
    for (const BenchSample& s : run.samples) reached = std::max(reached, s.shaft_rad * 180 / kPi);
    EXPECT_NEAR(reached, target_deg[i], 1.5) << presets[i];
    for (const std::string& notice : run.notices) EXPECT_EQ(notice.find("wanted"), std::string::npos) << notice;
  }
  const SweepAmplitude found = sweep_amplitude(specimen(), 0.46, 10);
  EXPECT_NEAR(found.target_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(found.reached_rad, found.target_rad, 0.3 * kPi / 180);
}

TEST(Bench, AWeakUnitIsReportedAndNotPretended) {
  const BenchRun run = run_stiffness(specimen("qbmove_maker_pro", {{"drive.supply_V", "4"}}), short_sweep(0.4602));
  ASSERT_FALSE(run.notices.empty());
  EXPECT_NE(run.notices.back().find("90° was wanted"), std::string::npos) << run.notices.back();
}

TEST(Bench, TheRecordingIsWhatTheUnitMeasures) {
  const BenchRun run = run_stiffness(specimen(), short_sweep(0.3));
  const LoadRecording r = as_recording(run, 0.3);
  ASSERT_EQ(r.time_s.size(), run.samples.size());
  EXPECT_EQ(r.preset, 0.3);
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    EXPECT_EQ(r.torque_Nm[i], run.samples[i].measured_load_Nm);
    EXPECT_EQ(r.deflection_rad[i], run.samples[i].measured_deflection_rad);
  }
}

TEST(Bench, TheSquareWaveGoesUpAndDown) {
  const BenchRun run = run_speed(specimen(), short_square());
  ASSERT_EQ(run.samples.size(), 1201u);
  for (const BenchSample& s : run.samples) {
    const double since_s = std::fmod(s.time_s, 0.6);
    if (since_s < 0.0015 || since_s > 0.5985) continue;
    EXPECT_EQ(s.equilibrium_command_rad, s.time_s < 0.6 ? 1.57 : 0.0) << s.time_s;
  }
  EXPECT_NEAR(run.samples[599].shaft_rad, 1.57, 0.15);
  EXPECT_NEAR(run.samples[1200].shaft_rad, 0, 0.15);
}

TEST(Bench, TheSquareWavesSamplesRepeatBitForBit) {
  EXPECT_TRUE(equal_bits(run_speed(specimen(), short_square()), run_speed(specimen(), short_square())));
  SpeedOptions other = short_square();
  other.preset = 0.31;
  EXPECT_FALSE(equal_bits(run_speed(specimen(), short_square()), run_speed(specimen(), other)));
}

TEST(Bench, TheNumberOfThreadsDoesNotChangeABit) {
  const double presets[] = {0, 0.1125, 0.3, 0.75};
  const auto all = [&](unsigned threads) {
    std::vector<BenchRun> runs(4);
    run_in_parallel(4, threads, [&](std::size_t i) {
      SpeedOptions o = short_square();
      o.preset = presets[i];
      runs[i] = run_speed(specimen(), o);
    });
    return runs;
  };
  const auto one = all(1), three = all(3);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(equal_bits(one[i], three[i])) << presets[i];
}

TEST(Bench, ThePresetStepsUpAndBack) {
  PresetStepOptions o;
  o.hold_s = 1;
  const BenchRun run = run_preset_step(specimen(), o);
  EXPECT_NEAR(run.samples.front().preset, 0, 0.1);
  EXPECT_GT(run.samples[1000].preset, 0.55);
  EXPECT_NEAR(run.samples.back().preset, 0, 0.15);
  EXPECT_EQ(run.amplitude_rad, 0);
}

TEST(Bench, TheLoadedPresetStepCarriesNearlyTheWholeWeight) {
  PresetStepOptions o;
  o.loaded = true;
  o.hold_s = 1;
  const BenchRun run = run_preset_step(specimen(), o);
  EXPECT_TRUE(run.notices.empty());
  for (const BenchSample& s : run.samples) {
    EXPECT_EQ(s.equilibrium_command_rad, run.amplitude_rad);
    EXPECT_LT(s.measured_load_Nm, -0.85 * kLoad_Nm) << s.time_s;
  }
  EXPECT_GT(run.samples[1000].preset, 0.4);
}

TEST(Bench, EveryShippedActuatorStandsOnIt) {
  for (const char* name : {"qbmove_advanced", "sea_example"}) {
    const bool has_preset = std::string(name) != "sea_example";
    StiffnessOptions o = short_sweep(has_preset ? 0.4 : 0.0);
    const BenchRun run = run_stiffness(specimen(name), o);
    EXPECT_EQ(run.preset_unit, has_preset ? "rad" : "");
    EXPECT_EQ(run.motors, has_preset ? 2 : 1);
    const auto& s = *std::max_element(run.samples.begin(), run.samples.end(),
                                      [](const auto& a, const auto& b) { return a.measured_load_Nm < b.measured_load_Nm; });
    EXPECT_GT(s.measured_load_Nm, 1.4) << name;
    EXPECT_GT(s.measured_deflection_rad, 0.05) << name << ": a positive load, a positive deflection";
  }
}

TEST(Bench, AWatchCountsAndStops) {
  Watch watch;
  const SpeedOptions o = short_square();
  static_cast<void>(run_speed(specimen(), o, &watch));
  EXPECT_NEAR(static_cast<double>(watch.simulated_ns) * 1e-9, simulated_s(o), 1e-9);
  watch.stop = true;
  EXPECT_THROW(static_cast<void>(run_speed(specimen(), o, &watch)), Stopped);
}

TEST(Bench, AStepOfTheCallersIsTaken) {
  Specimen s = specimen();
  s.step_s = 5e-4;
  const BenchRun run = run_speed(s, short_square());
  EXPECT_EQ(run.step_s, 5e-4);
  EXPECT_EQ(run.samples.size(), 1201u) << "sampled at the same times";
}

TEST(Bench, NoStepOfABareFlangeIsLeftUnsettled) {
  // A pulley's last correction that crossed an edge of its tendon's bristle was taken as found: the torque then depended on where the
  // solver came from, and ten steps of this run ended between two answers.
  for (const char* type : {"qbmove_maker_pro_6_1", "qbmove_maker_pro"}) {
    SpeedOptions o = short_square();
    o.preset = 0.75;
    const BenchRun run = run_speed(specimen(type), o);
    for (const std::string& notice : run.notices) EXPECT_EQ(notice.find("settle"), std::string::npos) << type << ": " << notice;
  }
}

}  // namespace
}  // namespace vsa::experiment
