// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Places at rest, of a unit that someone else built: a spring's constant from weights on a lever.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "closed_form.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/identification.hpp"

namespace vsa::identify {
namespace {

const std::filesystem::path kPass = std::filesystem::path(VSA_SOURCE_DIR) / "data/anydrive/AD119E20_pass_1_points.csv";
constexpr const char* kSpringAndZero = "elastic.stiffness_Nm_per_rad,sensor.shaft_zero_rad";

struct Fitted {
  Identification found;
  std::vector<Parameter> parameters;
};

Fitted fitted(const std::vector<Observation>& observations, double start = 100, const char* parameters = kSpringAndZero) {
  experiment::Specimen specimen;
  specimen.library = test::shipped();
  specimen.type = "sea_example";
  specimen.overrides = {{"elastic.stiffness_Nm_per_rad", config::number_text(start)}};
  const config::ActuatorType type = specimen.library.load(specimen.type, specimen.overrides);
  const MakeTask make = [=](unsigned threads) {
    Task task;
    task.parameters = parse_parameters(parameters, type);
    task.observations = observations;
    use_bench(task, specimen, {}, nullptr, threads);
    return task;
  };
  IdentificationOptions o;
  o.draws = 50;
  return {identify(make, o, one_by_one(make, o.fit)), parse_parameters(parameters, type)};
}

Observation pass() { return read_observation(kPass, test::shipped().load("sea_example")); }

/// Deflection over torque by the textbook: slope and its standard error.
struct Line {
  double slope, zero, error;
};
Line line_through(const experiment::Branches& b) {
  const auto n = static_cast<double>(b.torque_Nm.size());
  double mx = 0, my = 0, xx = 0, xy = 0, rr = 0;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) mx += b.torque_Nm[i] / n, my += b.rising_rad[i] / n;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) {
    xx += (b.torque_Nm[i] - mx) * (b.torque_Nm[i] - mx);
    xy += (b.torque_Nm[i] - mx) * (b.rising_rad[i] - my);
  }
  const double slope = xy / xx, zero = my - slope * mx;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) rr += std::pow(b.rising_rad[i] - zero - slope * b.torque_Nm[i], 2);
  return {slope, zero, std::sqrt(rr / (n - 2) / xx)};
}

TEST(Points, OfTheAnydriveGiveTheLineOfTheTextbook) {
  const Observation o = pass();
  ASSERT_EQ(o.data.torque_Nm.size(), 18u);
  EXPECT_TRUE(o.points);
  const Line line = line_through(o.data);
  for (const double start : {20.0, 150.0, 2000.0}) {
    const Identification r = fitted({o}, start).found;
    EXPECT_NEAR(r.fit.values[0], 1 / line.slope, 1e-3 / line.slope) << "from " << start;
    EXPECT_NEAR(r.fit.values[1], line.zero, 2e-6);
    EXPECT_FALSE(r.uncertainty.deficient());
    // A spring's constant is counted in its logarithm; neighbours along the torque are hardly correlated.
    EXPECT_NEAR(r.uncertainty.standard_error[0] / r.fit.values[0], line.error / line.slope, 0.5 * line.error / line.slope);
    EXPECT_NEAR(r.bootstrap->standard_error[0] / r.fit.values[0], line.error / line.slope, 0.5 * line.error / line.slope);
    EXPECT_TRUE(r.left_out.empty());
  }
}

TEST(Points, OfOneHalfPredictTheOther) {
  const Observation o = pass();
  for (const std::size_t kept : {0u, 1u}) {
    Observation half = o;
    half.data = {};
    experiment::Branches rest;
    for (std::size_t i = 0; i < o.data.torque_Nm.size(); ++i) {
      experiment::Branches& to = i % 2 == kept ? half.data : rest;
      to.torque_Nm.push_back(o.data.torque_Nm[i]);
      to.rising_rad.push_back(o.data.rising_rad[i]);
    }
    half.data.falling_rad = half.data.sd_rising_rad = half.data.sd_falling_rad =
        std::vector<double>(half.data.torque_Nm.size(), std::nan(""));
    const std::vector<double> v = fitted({half}).found.fit.values;
    double squares = 0;
    for (std::size_t i = 0; i < rest.torque_Nm.size(); ++i)
      squares += std::pow(v[0] * (rest.rising_rad[i] - v[1]) - rest.torque_Nm[i], 2);
    std::printf("half %zu predicts the other within %.3f N·m\n", kept,
                std::sqrt(squares / static_cast<double>(rest.torque_Nm.size())));
    EXPECT_LT(std::sqrt(squares / static_cast<double>(rest.torque_Nm.size())), 0.095) << "N·m, half " << kept;
  }
}

TEST(Points, TellOfNothingButTheSpring) {
  const Identification r = fitted({pass()}, 100, "elastic.stiffness_Nm_per_rad,drive.friction_Nm").found;
  EXPECT_EQ(r.uncertainty.without_effect, std::vector<std::size_t>{1});
}

TEST(Points, NeedNoOrderAndAreRefusedWhereTheyAreNoNumbers) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("vsa_points_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const config::ActuatorType sea = test::shipped().load("sea_example"), vsa = test::shipped().load("qbmove_maker_pro_paper");
  const auto read = [&](const std::string& name, const std::string& text, const config::ActuatorType& type) {
    std::ofstream(folder / name) << text;
    return read_observation(folder / name, type);
  };
  const Observation o = read("a_points.csv", "load_torque_Nm,deflection_rad\n2,0.2\n-1,-0.1\n1,0.1\n1,0.12\n", sea);
  EXPECT_EQ(o.data.torque_Nm, (std::vector<double>{-1, 1, 1, 2}));
  EXPECT_EQ(o.data.rising_rad, (std::vector<double>{-0.1, 0.1, 0.12, 0.2}));
  const Identification r = fitted({o}).found;
  EXPECT_NEAR(r.fit.values[0], 10, 0.5) << "two readings of one load count as two";
  const Observation lowest = read("g_points.csv", "load_torque_Nm,deflection_rad\n-2,-0.2\n-2,-0.2\n-2,-0.2\n1,0.1\n2,0.2\n", sea);
  const Fitted line = fitted({lowest});
  EXPECT_NEAR(line.found.fit.values[0], 10, 1e-3) << "so do those of the lowest";
  EXPECT_LT(line.found.fit.rms_rad, 1e-5);
  EXPECT_EQ(read("b_preset_0.4000rad_points.csv", "load_torque_Nm,deflection_rad\n1,0.1\n2,0.2\n", vsa).preset, 0.4);
  EXPECT_THROW((void)read("c_points.csv", "load_torque_Nm,deflection_rad\n1,0.1\n2,0.2\n", vsa), InputError) << "at which preset?";
  EXPECT_THROW((void)read("d_points.csv", "load_torque_Nm,deflection_rad\n1,nan\n2,0.2\n", sea), InputError);
  EXPECT_THROW((void)read("e_points.csv", "load_torque,deflection_rad\n1,0.1\n2,0.2\n", sea), InputError);
  EXPECT_THROW((void)read("f_points.csv", "", sea), InputError);
  std::filesystem::remove_all(folder);
}

/// They rest beside the command, which a small load doesn't change: the loads around 0 tell of it.
TEST(Points, OfUnequalSpringsGiveBackBoth) {
  experiment::Specimen specimen;
  specimen.library = test::shipped();
  specimen.type = "amasc_example";
  const auto with = [](double k1, double k2) {
    return std::vector<config::Override>{{"elastic.K1_Nm_per_rad2", config::number_text(k1)},
                                         {"elastic.K2_Nm_per_rad2", config::number_text(k2)}};
  };
  const config::ActuatorType made = specimen.library.load(specimen.type, with(4, 9));
  const elastic::Transmission& law = *made.unit.actuator.transmission;
  std::vector<Observation> observations;
  for (const double preset : {0.1, 0.3}) {
    Observation o;
    o.preset = preset;
    o.points = true;
    for (int i = -10; i <= 10; ++i) {
      // The load that holds the shaft there: no root is looked for.
      const double at = 0.01 * i;
      o.data.torque_Nm.push_back(-law.evaluate({at, law.references({0, preset})}).torque);
      o.data.rising_rad.push_back(at);
    }
    o.data.falling_rad = o.data.sd_rising_rad = o.data.sd_falling_rad = std::vector<double>(21, std::nan(""));
    observations.push_back(o);
  }
  specimen.overrides = with(6, 6);
  const config::ActuatorType type = specimen.library.load(specimen.type, specimen.overrides);
  const MakeTask make = [=](unsigned threads) {
    Task task;
    task.parameters = parse_parameters("elastic.K1_Nm_per_rad2,elastic.K2_Nm_per_rad2", type);
    task.observations = observations;
    use_bench(task, specimen, {}, nullptr, threads);
    return task;
  };
  IdentificationOptions o;
  o.draws = 0;
  const Identification r = identify(make, o, one_by_one(make, o.fit));
  EXPECT_NEAR(r.fit.values[0], 4, 1e-3);
  EXPECT_NEAR(r.fit.values[1], 9, 1e-3);
}

/// A sweep of another load fills a grid of another width.
TEST(Samples, AreReadOnAGridAsWideAsTheirLoad) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("vsa_samples_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "stiffness_preset_0.3000rad.csv";
  {
    std::ofstream out(file);
    out << "load_torque_Nm,deflection_rad\n";
    for (int k = 0; k < 2000; ++k) out << 50 * std::sin(k * 0.005) << ',' << std::sin(k * 0.005) << '\n';
  }
  const config::ActuatorType type = test::shipped().load("qbmove_maker_pro_paper");
  const auto points = [](const Observation& o) {
    return std::count_if(o.data.rising_rad.begin(), o.data.rising_rad.end(), [](double v) { return std::isfinite(v); });
  };
  const Observation right = read_observation(file, type, 50.0 / 1.4);
  EXPECT_NEAR(right.data.torque_Nm.back(), 50, 1e-9);
  EXPECT_GT(points(right), 50);
  EXPECT_EQ(right.beyond, 0);
  EXPECT_NEAR(right.data.rising_rad[10], right.data.torque_Nm[10] / 50, 1e-3);
  EXPECT_NEAR(read_observation(file, type, 5).beyond, 1 - 2 / 3.14159 * std::asin((7 + 0.125) / 50), 0.02) << "most of it";
  EXPECT_THROW((void)read_observation(file, type), InputError) << "no load of 1 kg gives 50 N·m";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace vsa::identify
