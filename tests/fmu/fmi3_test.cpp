// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// FMI 3.0: the same instances through its functions.
#include "fmi3.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "importer.hpp"

namespace vsa::test {
namespace {

void note(fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
  static_cast<std::vector<std::string>*>(environment)->emplace_back(message);
}

class Instance3 {
 public:
  explicit Instance3(const Package& package, bool events = false)
      : package_(package),
        c_(FMI(package, fmi3InstantiateCoSimulation)("unit", package.token().c_str(),
                                                     ((package.folder() / "resources").string() + "/").c_str(), false, false,
                                                     events, false, nullptr, 0, &log, note, nullptr)) {}
  ~Instance3() { FMI(package_, fmi3FreeInstance)(c_); }
  Instance3(const Instance3&) = delete;
  Instance3& operator=(const Instance3&) = delete;

  [[nodiscard]] fmi3Instance c() const { return c_; }
  [[nodiscard]] fmi3Status set(const std::string& name, double value) {
    const unsigned vr = package_.reference(name);
    return FMI(package_, fmi3SetFloat64)(c_, &vr, 1, &value, 1);
  }
  [[nodiscard]] double get(const std::string& name) {
    const unsigned vr = package_.reference(name);
    double value = 0;
    EXPECT_EQ(FMI(package_, fmi3GetFloat64)(c_, &vr, 1, &value, 1), fmi3OK);
    return value;
  }
  [[nodiscard]] fmi3Status step(double t, double h) {
    bool event = true, terminate = true, early = true;
    double last = 0;
    const fmi3Status status = FMI(package_, fmi3DoStep)(c_, t, h, true, &event, &terminate, &early, &last);
    EXPECT_FALSE(event || terminate || early);
    EXPECT_NEAR(last, status == fmi3OK ? t + h : t, 1e-9);
    return status;
  }
  void start() {
    ASSERT_EQ(FMI(package_, fmi3EnterInitializationMode)(c_, false, 0, 0, false, 0), fmi3OK);
    ASSERT_EQ(FMI(package_, fmi3ExitInitializationMode)(c_), fmi3OK);
  }

  std::vector<std::string> log;

 private:
  const Package& package_;
  fmi3Instance c_;
};

TEST(Fmi3, GivesWhatFmi2Gives) {
  const auto two = exported(), three = exported({.version = fmu::Version::fmi3});
  Instance2 a(*two);
  Instance3 b(*three);
  ASSERT_NE(b.c(), nullptr);
  a.start();
  b.start();
  for (int k = 0; k < 200; ++k) {
    const double e = 0.4 * std::sin(0.05 * k);
    a.set("equilibrium", e);
    ASSERT_EQ(b.set("equilibrium", e), fmi3OK);
    a.step(k * 1e-3, 1e-3);
    ASSERT_EQ(b.step(k * 1e-3, 1e-3), fmi3OK);
    ASSERT_EQ(a.get("torque"), b.get("torque"));
    ASSERT_EQ(a.get("energy_supply"), b.get("energy_supply"));
  }
  EXPECT_GT(a.get("energy_supply"), 0.0);
}

TEST(Fmi3, ReadsAndSetsEachTypeOfValue) {
  const auto p = exported({.version = fmu::Version::fmi3});
  Instance3 i(*p);
  const unsigned whole = p->reference("firmware.limit_high_raw"), toggle = p->reference("firmware.limits_on"),
                 word = p->reference("drive.off_mode"), real = p->reference("drive.supply_V");
  EXPECT_EQ(p->variable("firmware.limit_high_raw").type, "Int32");
  fmi3Int32 n = 12345;
  EXPECT_EQ(FMI(*p, fmi3SetInt32)(i.c(), &whole, 1, &n, 1), fmi3OK);
  n = 0;
  EXPECT_EQ(FMI(*p, fmi3GetInt32)(i.c(), &whole, 1, &n, 1), fmi3OK);
  EXPECT_EQ(n, 12345);
  bool on = false;
  EXPECT_EQ(FMI(*p, fmi3SetBoolean)(i.c(), &toggle, 1, &on, 1), fmi3OK);
  on = true;
  EXPECT_EQ(FMI(*p, fmi3GetBoolean)(i.c(), &toggle, 1, &on, 1), fmi3OK);
  EXPECT_FALSE(on);
  fmi3Int64 w = 2;
  EXPECT_EQ(FMI(*p, fmi3SetInt64)(i.c(), &word, 1, &w, 1), fmi3OK);
  w = 0;
  EXPECT_EQ(FMI(*p, fmi3GetInt64)(i.c(), &word, 1, &w, 1), fmi3OK);
  EXPECT_EQ(w, 2);
  EXPECT_TRUE(i.log.empty());
  EXPECT_EQ(FMI(*p, fmi3GetInt64)(i.c(), &real, 1, &w, 1), fmi3Error);
  EXPECT_EQ(FMI(*p, fmi3GetInt32)(i.c(), &whole, 1, &n, 2), fmi3Error);
  float f = 0;
  EXPECT_EQ(FMI(*p, fmi3GetFloat32)(i.c(), &real, 1, &f, 1), fmi3Error);
  EXPECT_EQ(FMI(*p, fmi3GetFloat32)(i.c(), &real, 0, &f, 0), fmi3OK);
  EXPECT_EQ(i.log.size(), 3U);
}

TEST(Fmi3, WhatItHasNotGotIsRefusedWithALine) {
  const auto p = exported({.version = fmu::Version::fmi3});
  std::vector<std::string> log;
  EXPECT_EQ(FMI(*p, fmi3InstantiateModelExchange)("a", "", "", false, false, &log, note), nullptr);
  EXPECT_EQ(FMI(*p, fmi3InstantiateScheduledExecution)("a", "", "", false, false, &log, note, nullptr, nullptr, nullptr), nullptr);
  EXPECT_EQ(log.size(), 2U);
  EXPECT_EQ(Instance3(*p, true).c(), nullptr);
  Instance3 i(*p);
  EXPECT_EQ(FMI(*p, fmi3EnterEventMode)(i.c()), fmi3Error);
  EXPECT_EQ(FMI(*p, fmi3EnterConfigurationMode)(i.c()), fmi3Error);
  EXPECT_EQ(FMI(*p, fmi3EnterContinuousTimeMode)(i.c()), fmi3Error);
  EXPECT_EQ(FMI(*p, fmi3SetTime)(i.c(), 1), fmi3Error);
  EXPECT_EQ(i.step(0, 1e-3), fmi3Error);
  EXPECT_EQ(i.log.size(), 5U);
  EXPECT_EQ(FMI(*p, fmi3DoStep)(nullptr, 0, 1e-3, true, nullptr, nullptr, nullptr, nullptr), fmi3Error);
}

TEST(Fmi3, AdjointAndDirectionalDerivativesAgreeAndDependenciesAreThoseOfTheDescription) {
  const auto p = exported({.version = fmu::Version::fmi3});
  Instance3 i(*p);
  ASSERT_EQ(i.set("equilibrium", 0.3), fmi3OK);
  i.start();
  const unsigned u = p->reference("torque"), k = p->reference("shaft_angle"), none = p->reference("motor_1_angle");
  const double seed = 3;
  double forward = 0, back = 0;
  EXPECT_EQ(FMI(*p, fmi3GetDirectionalDerivative)(i.c(), &u, 1, &k, 1, &seed, 1, &forward, 1), fmi3OK);
  EXPECT_EQ(FMI(*p, fmi3GetAdjointDerivative)(i.c(), &u, 1, &k, 1, &seed, 1, &back, 1), fmi3OK);
  EXPECT_EQ(forward, back);
  EXPECT_LT(forward, -0.1);
  std::size_t n = 9;
  EXPECT_EQ(FMI(*p, fmi3GetNumberOfVariableDependencies)(i.c(), u, &n), fmi3OK);
  ASSERT_EQ(n, 1U);
  std::size_t of_u = 9, of_k = 9;
  unsigned found = 0;
  fmi3DependencyKind kind = fmi3Constant;
  EXPECT_EQ(FMI(*p, fmi3GetVariableDependencies)(i.c(), u, &of_u, &found, &of_k, &kind, 1), fmi3OK);
  EXPECT_EQ(found, k);
  EXPECT_EQ(FMI(*p, fmi3GetNumberOfVariableDependencies)(i.c(), none, &n), fmi3OK);
  EXPECT_EQ(n, 0U);
}

TEST(Fmi3, AStateComesBackAsBytes) {
  const auto p = exported({.version = fmu::Version::fmi3});
  Instance3 a(*p), b(*p);
  a.start();
  ASSERT_EQ(a.set("equilibrium", 0.4), fmi3OK);
  for (int k = 0; k < 20; ++k) ASSERT_EQ(a.step(k * 1e-3, 1e-3), fmi3OK);
  fmi3FMUState state = nullptr;
  ASSERT_EQ(FMI(*p, fmi3GetFMUState)(a.c(), &state), fmi3OK);
  std::size_t size = 0;
  ASSERT_EQ(FMI(*p, fmi3SerializedFMUStateSize)(a.c(), state, &size), fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  ASSERT_EQ(FMI(*p, fmi3SerializeFMUState)(a.c(), state, bytes.data(), size), fmi3OK);
  EXPECT_EQ(FMI(*p, fmi3SerializeFMUState)(a.c(), state, bytes.data(), size - 1), fmi3Error);
  ASSERT_EQ(FMI(*p, fmi3FreeFMUState)(a.c(), &state), fmi3OK);
  ASSERT_EQ(FMI(*p, fmi3DeserializeFMUState)(b.c(), bytes.data(), size, &state), fmi3OK);
  ASSERT_EQ(FMI(*p, fmi3SetFMUState)(b.c(), state), fmi3OK);
  ASSERT_EQ(FMI(*p, fmi3FreeFMUState)(b.c(), &state), fmi3OK);
  for (Instance3* i : {&a, &b})
    for (int k = 20; k < 40; ++k) ASSERT_EQ(i->step(k * 1e-3, 1e-3), fmi3OK);
  EXPECT_EQ(a.get("torque"), b.get("torque"));
  EXPECT_EQ(a.get("energy_supply"), b.get("energy_supply"));
}

}  // namespace
}  // namespace vsa::test
