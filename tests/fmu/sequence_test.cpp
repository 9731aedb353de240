// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The standard's call sequence: what is refused, when, and that nothing has changed then.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "importer.hpp"

namespace vsa::test {
namespace {

struct Call {
  const char* name;
  std::function<fmi2Status(Instance2&)> call;
  std::string allowed;  ///< of "instantiated initialization stepping terminated failed", by first letters; f for failed
};

std::vector<Call> calls() {
  return {
      {"setup", [](Instance2& i) { return FMI(i.package(), fmi2SetupExperiment)(i.c(), 0, 0, 0, 0, 0); }, "0"},
      {"enter", [](Instance2& i) { return FMI(i.package(), fmi2EnterInitializationMode)(i.c()); }, "0"},
      {"exit", [](Instance2& i) { return FMI(i.package(), fmi2ExitInitializationMode)(i.c()); }, "1"},
      {"step", [](Instance2& i) { return FMI(i.package(), fmi2DoStep)(i.c(), 0, 1e-3, 1); }, "2"},
      {"terminate", [](Instance2& i) { return FMI(i.package(), fmi2Terminate)(i.c()); }, "24"},
      {"reset", [](Instance2& i) { return FMI(i.package(), fmi2Reset)(i.c()); }, "01234"},
      {"get an output",
       [](Instance2& i) {
         const unsigned vr = i.package().reference("torque");
         double v = 0;
         return FMI(i.package(), fmi2GetReal)(i.c(), &vr, 1, &v);
       },
       "1234"},
      {"get a parameter",
       [](Instance2& i) {
         const unsigned vr = i.package().reference("drive.supply_V");
         double v = 0;
         return FMI(i.package(), fmi2GetReal)(i.c(), &vr, 1, &v);
       },
       "01234"},
      {"set an input",
       [](Instance2& i) {
         const unsigned vr = i.package().reference("shaft_angle");
         const double v = 0.1;
         return FMI(i.package(), fmi2SetReal)(i.c(), &vr, 1, &v);
       },
       "012"},
      {"set a fixed parameter",
       [](Instance2& i) {
         const unsigned vr = i.package().reference("drive.supply_V");
         const double v = 12;
         return FMI(i.package(), fmi2SetReal)(i.c(), &vr, 1, &v);
       },
       "01"},
      {"set a tunable parameter",
       [](Instance2& i) {
         const unsigned vr = i.package().reference("load_inertia_kg_m2");
         const double v = 1;
         return FMI(i.package(), fmi2SetReal)(i.c(), &vr, 1, &v);
       },
       "012"},
      {"derivative",
       [](Instance2& i) {
         const unsigned u = i.package().reference("torque"), k = i.package().reference("shaft_angle");
         const double seed = 1;
         double v = 0;
         return FMI(i.package(), fmi2GetDirectionalDerivative)(i.c(), &u, 1, &k, 1, &seed, &v);
       },
       "12"},
  };
}

void bring_to(Instance2& i, int mode) {
  const Package& p = i.package();
  if (mode == 4) {  // a step that fails: too long for implicit coupling
    i.set_word("coupling", 2);
    i.set("load_inertia_kg_m2", 1.0);
  }
  if (mode >= 1) {
    ASSERT_EQ(FMI(p, fmi2EnterInitializationMode)(i.c()), fmi2OK);
  }
  if (mode >= 2) {
    ASSERT_EQ(FMI(p, fmi2ExitInitializationMode)(i.c()), fmi2OK);
  }
  if (mode == 3) {
    ASSERT_EQ(FMI(p, fmi2Terminate)(i.c()), fmi2OK);
  }
  if (mode == 4) {
    ASSERT_EQ(FMI(p, fmi2DoStep)(i.c(), 0, 1, 1), fmi2Error);
  }
}

TEST(Sequence, EachCallIsTakenInItsModesAndRefusedWithALineInTheOthers) {
  const auto package = exported();
  for (int mode = 0; mode <= 4; ++mode) {
    for (const Call& c : calls()) {
      Instance2 fmu(*package);
      bring_to(fmu, mode);
      fmu.log.clear();
      const bool allowed = c.allowed.find(static_cast<char>('0' + mode)) != std::string::npos;
      const std::vector<char> before = fmu.bytes();
      EXPECT_EQ(c.call(fmu), allowed ? fmi2OK : fmi2Error) << c.name << " in mode " << mode;
      EXPECT_EQ(fmu.log.size(), allowed ? 0U : 1U) << c.name << " in mode " << mode;
      if (!allowed) {
        EXPECT_EQ(fmu.bytes(), before) << c.name << " in mode " << mode;
      }
    }
  }
}

TEST(Sequence, RefusesValuesThatAreNoneAndSetsNothingOfACallWithOne) {
  const auto package = exported();
  Instance2 fmu(*package);
  const unsigned angle = package->reference("shaft_angle"), torque = package->reference("torque"),
                 supply = package->reference("drive.supply_V"), word = package->reference("drive.off_mode"),
                 time = package->reference("time"), none = 100000;
  struct Case {
    unsigned vr;
    double value;
    const char* says;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Case& c :
       {Case{none, 0, "no such variable"}, Case{torque, 1, "isn't the importer's to set"},
        Case{time, 1, "isn't the importer's to set"}, Case{supply, 1e6, "out of range"}, Case{supply, kNan, "not finite"},
        Case{angle, INFINITY, "not finite"}, Case{word, 1, "it is an enumeration"}}) {
    fmu.log.clear();
    const unsigned both[] = {angle, c.vr};
    const double values[] = {0.25, c.value};
    EXPECT_EQ(FMI(*package, fmi2SetReal)(fmu.c(), both, 2, values), fmi2Error);
    ASSERT_EQ(fmu.log.size(), 1U);
    EXPECT_NE(fmu.log[0].find(c.says), std::string::npos) << fmu.log[0];
    EXPECT_EQ(fmu.get("shaft_angle"), 0.0);
  }
  const int three = 3;
  EXPECT_EQ(FMI(*package, fmi2SetInteger)(fmu.c(), &word, 1, &three), fmi2Error);
  double v = 0;
  EXPECT_EQ(FMI(*package, fmi2GetReal)(fmu.c(), &none, 1, &v), fmi2Error);
  fmi2String text = nullptr;
  EXPECT_EQ(FMI(*package, fmi2GetString)(fmu.c(), &angle, 1, &text), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2SetReal)(fmu.c(), nullptr, 1, &v), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2SetReal)(nullptr, &angle, 1, &v), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2SetRealInputDerivatives)(fmu.c(), &angle, 1, &three, &v), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2GetRealOutputDerivatives)(fmu.c(), &torque, 1, &three, &v), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2CancelStep)(fmu.c()), fmi2Error);
}

TEST(Sequence, AStepGoesOnWhereTheLastOneEndedAndNotBeyondTheStopTime) {
  const auto package = exported();
  Instance2 fmu(*package);
  ASSERT_EQ(FMI(*package, fmi2SetupExperiment)(fmu.c(), 0, 0, 1.0, 1, 1.01), fmi2OK);
  ASSERT_EQ(FMI(*package, fmi2EnterInitializationMode)(fmu.c()), fmi2OK);
  ASSERT_EQ(FMI(*package, fmi2ExitInitializationMode)(fmu.c()), fmi2OK);
  const auto step = [&](double t, double h) { return FMI(*package, fmi2DoStep)(fmu.c(), t, h, 1); };
  EXPECT_EQ(step(0.0, 1e-3), fmi2Error);
  EXPECT_EQ(step(1.0, 0.0), fmi2Error);
  EXPECT_EQ(step(1.0, -1e-3), fmi2Error);
  EXPECT_EQ(step(1.0, NAN), fmi2Error);
  EXPECT_EQ(step(1.0, 0.02), fmi2Error);
  EXPECT_EQ(fmu.log.size(), 5U);
  EXPECT_EQ(step(1.0, 0.01), fmi2OK);
  EXPECT_EQ(step(1.0, 0.01), fmi2Error);
  double last = 0;
  EXPECT_EQ(FMI(*package, fmi2GetRealStatus)(fmu.c(), fmi2LastSuccessfulTime, &last), fmi2OK);
  EXPECT_DOUBLE_EQ(last, 1.01);
}

TEST(Sequence, TimesThatNoDoubleHoldsExactlyDoNotAddUp) {
  const auto package = exported();
  Instance2 fmu(*package);
  fmu.start();
  double t = 0;
  for (int k = 0; k < 30000; ++k) {  // summed as importers do
    fmu.step(t, 1e-3 / 3);
    t += 1e-3 / 3;
  }
  EXPECT_NEAR(fmu.get("time"), 10.0, 2e-9);
}

TEST(Sequence, OutputsAreThoseOfTheValuesSetWhileItInitialises) {
  const auto package = exported();
  Instance2 fmu(*package);
  ASSERT_EQ(FMI(*package, fmi2EnterInitializationMode)(fmu.c()), fmi2OK);
  EXPECT_EQ(fmu.get("torque"), 0.0);
  fmu.set("equilibrium", 0.3);
  EXPECT_NEAR(fmu.get("equilibrium_attained"), 0.3, 1e-3);
  EXPECT_GT(fmu.get("torque"), 0.1);
  fmu.set("shaft_angle", 0.6);
  EXPECT_LT(fmu.get("torque"), -0.1);
}

TEST(Sequence, SavedStatesOfOthersAreRefused) {
  const auto package = exported(), other = exported({.type = "sea_example"});
  Instance2 a(*package), b(*other);
  const std::vector<char> good = a.bytes();
  const auto load = [&](Instance2& i, const std::vector<char>& bytes) {
    fmi2FMUstate state = nullptr;
    const fmi2Status status = FMI(i.package(), fmi2DeSerializeFMUstate)(i.c(), bytes.data(), bytes.size(), &state);
    EXPECT_EQ(state == nullptr, status != fmi2OK);
    static_cast<void>(FMI(i.package(), fmi2FreeFMUstate)(i.c(), &state));
    return status;
  };
  EXPECT_EQ(load(a, good), fmi2OK);
  EXPECT_EQ(load(b, good), fmi2Error);
  EXPECT_EQ(load(a, {}), fmi2Error);
  EXPECT_EQ(load(a, std::vector<char>(good.begin(), good.end() - 8)), fmi2Error);
  for (std::size_t at = 0; at < good.size(); at += 97) {
    std::vector<char> bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x10);
    EXPECT_EQ(load(a, bad), fmi2Error) << "byte " << at;
  }
  EXPECT_EQ(FMI(*package, fmi2SetFMUstate)(a.c(), nullptr), fmi2Error);
  std::size_t size = 0;
  EXPECT_EQ(FMI(*package, fmi2SerializedFMUstateSize)(a.c(), nullptr, &size), fmi2Error);
  // One of another instance, and one that was freed.
  Instance2 c(*package, "c");
  fmi2FMUstate state = nullptr, copy = nullptr;
  ASSERT_EQ(FMI(*package, fmi2GetFMUstate)(a.c(), &state), fmi2OK);
  EXPECT_EQ(FMI(*package, fmi2SetFMUstate)(c.c(), state), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2FreeFMUstate)(c.c(), &state), fmi2Error);
  copy = state;
  EXPECT_EQ(FMI(*package, fmi2FreeFMUstate)(a.c(), &state), fmi2OK);
  EXPECT_EQ(FMI(*package, fmi2SetFMUstate)(a.c(), copy), fmi2Error);
  EXPECT_EQ(FMI(*package, fmi2FreeFMUstate)(a.c(), &copy), fmi2Error);
  EXPECT_EQ(a.bytes(), good);
}

}  // namespace
}  // namespace vsa::test
