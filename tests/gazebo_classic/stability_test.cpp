// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every type on a light flange (1e-4 kg·m²), kicked and run into hard stops, at Gazebo's own step of 1 ms: what the joint and the
// springs hold never grows beyond what they were given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include "classic_world.hpp"

namespace vsa::test {
namespace {

constexpr double kInertia_kgm2 = 1e-4, kStep_s = 1e-3;

/// Those that stand by themselves and run the qbmove's program. One on a base has the motors of another, a servo's gains are made for
/// other loads; their presets and their reach aren't those that these tests ask for.
std::vector<std::string> shipped_presets() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(VSA_SOURCE_DIR "/actuators")) {
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (entry.path().extension() == ".toml" && text.find("\nbase = ") == std::string::npos &&
        text.find("[control]") == std::string::npos)
      names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// The free bench with this type, its flange's inertia, at its stiffest or at its softest.
std::string flange(const std::string& type, bool stiffest = true) {
  std::string model = replaced(model_text("qbmove_bench_free"), "<izz>2.25e-05</izz>", "<izz>1e-4</izz>");
  const auto at = model.find("<ixx>1.16666667e-05</ixx>");
  model = model.substr(0, at) +
          replaced(replaced(model.substr(at), "1.16666667e-05</ixx>", "6e-5</ixx>"), "1.16666667e-05</iyy>", "6e-5</iyy>");
  const bool has_presets = read_file(VSA_SOURCE_DIR "/actuators/" + type + ".toml").find("preset_max") != std::string::npos;
  model = replaced(model, "preset_rad=\"0.2\"", !has_presets ? "" : stiffest ? "preset_rad=\"0.785\"" : "preset_rad=\"0\"");
  return replaced(model, "<type>qbmove_maker_pro_6_1</type>", "<type>" + type + "</type>");
}

/// Follows a flange through the run: the most that its speed and its spring have held, less what the supply has given since.
class Watch {
 public:
  Watch(RobotWorld& world, gazebo::physics::JointPtr shaft) : world_(world), shaft_(std::move(shaft)) {
    connection_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { look(); });
  }

  bool finite = true;
  double first_J = std::numeric_limits<double>::quiet_NaN();  ///< after the first step
  double most_J = 0;                                          ///< later
  double farthest_rad = 0;                                    ///< of the angle that goes with the speed, docs/explanation/7-host.md
  double lowest_rad = 0, highest_rad = 0;                     ///< as the engine shows it

 private:
  void look() {
    const double q = shaft_->Position(0), v = shaft_->GetVelocity(0);
    finite = finite && std::isfinite(q) && std::isfinite(v);
    const auto ledger = world_.robot().ledger(0);
    const double held_J = 0.5 * kInertia_kgm2 * v * v + ledger.stored() - ledger.supply;
    if (std::isnan(first_J)) first_J = held_J;
    most_J = std::max(most_J, held_J);
    farthest_rad = std::max(farthest_rad, std::abs(q - 0.5 * kStep_s * v));
    lowest_rad = std::min(lowest_rad, q);
    highest_rad = std::max(highest_rad, q);
  }

  RobotWorld& world_;
  gazebo::physics::JointPtr shaft_;
  gazebo::event::ConnectionPtr connection_;
};

class Stability : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  [[nodiscard]] std::string type() const { return std::get<0>(GetParam()); }
  [[nodiscard]] std::string engine() const { return std::get<1>(GetParam()); }
};

TEST_P(Stability, ALightFlangeKickedFarNeverGainsEnergy) {
  for (const double kick_rad : {0.2, 0.8}) {
    RobotWorld w("kicked", flange(type()), engine(), "", false);
    const auto shaft = w.joint("qbmove_bench_free");
    shaft->SetPosition(0, kick_rad);
    Watch watch(w, shaft);
    w.run(1000);
    const double first_rad = std::exchange(watch.farthest_rad, 0.0);
    w.run(1000);
    EXPECT_TRUE(watch.finite) << kick_rad;
    std::cout << type() << ' ' << engine() << ' ' << kick_rad << ": " << watch.first_J << " J, grows to "
              << watch.most_J / watch.first_J << ", swings to " << first_rad << ", then to " << watch.farthest_rad << '\n';
    EXPECT_LT(watch.most_J, watch.first_J * 1.005) << kick_rad;
    // The springs' kilonewton metres drag the pulleys along, and the shaft swings about where these are then.
    EXPECT_LT(first_rad, kick_rad + (kick_rad > 0.5 ? 1.0 : 0.02)) << kick_rad;
    EXPECT_LE(watch.farthest_rad, first_rad) << kick_rad;
  }
}

TEST_P(Stability, AHardStopIsHitAndLeanedOnWithoutGain) {
  for (const bool stiffest : {false, true}) {
    const std::string stopped = replaced(replaced(flange(type(), stiffest), "<lower>-1e16</lower>", "<lower>-0.1</lower>"),
                                         "<upper>1e16</upper>", "<upper>0.1</upper>");
    RobotWorld w("stopped", stopped, engine(), "", false);
    const auto shaft = w.joint("qbmove_bench_free");
    shaft->SetVelocity(0, 40);
    {
      Watch watch(w, shaft);
      w.run(2000);
      std::cout << type() << ' ' << engine() << " hit: " << watch.first_J << " J, grows to " << watch.most_J / watch.first_J
                << ", from " << watch.lowest_rad << " to " << watch.highest_rad << '\n';
      EXPECT_TRUE(watch.finite);
      EXPECT_LT(watch.most_J, watch.first_J * 1.05);
      EXPECT_GT(watch.highest_rad, stiffest ? 0.0 : 0.099) << "it gets there";
      EXPECT_LT(watch.highest_rad, 0.15);
    }
    Watch watch(w, shaft);
    ASSERT_TRUE(w.robot().command(0, 0.8, std::nullopt));
    w.run(2000);
    const double highest = std::exchange(watch.highest_rad, 0.0);
    watch.lowest_rad = 1;
    w.run(3000);
    std::cout << type() << ' ' << engine() << " lean: up to " << highest << ", then from " << watch.lowest_rad << " to "
              << watch.highest_rad << ", " << shaft->GetVelocity(0) << " rad/s, " << w.robot().read(0).torque_Nm << " N·m\n";
    EXPECT_TRUE(watch.finite);
    EXPECT_LT(highest, 0.15);
    // ODE's stop throws a light flange back, and stiff springs press it on again: it may chatter there, but no further.
    EXPECT_LE(watch.highest_rad, highest + 1e-3);
    EXPECT_GT(watch.lowest_rad, 0.07);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, Stability, testing::Combine(testing::ValuesIn(shipped_presets()), testing::Values("ode", "dart")),
                         [](const auto& c) { return std::get<0>(c.param) + "_" + std::get<1>(c.param); });

}  // namespace
}  // namespace vsa::test
