// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Laws in shared libraries of users: found by VSA_LAW_PATH, loaded once, and refused with the reason where they don't fit.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/device/unit_batch.hpp"
#include "vsa/elastic/law_module.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vsa;

const fs::path kModules = fs::path(VSA_BINARY_DIR) / "tests/law_modules",
               kTypes = fs::path(VSA_SOURCE_DIR) / "examples/law_module/types";

/// VSA_LAW_PATH for a scope.
class LawPath {
 public:
  explicit LawPath(const std::string& value) { setenv("VSA_LAW_PATH", value.c_str(), 1); }
  ~LawPath() { unsetenv("VSA_LAW_PATH"); }
  LawPath(const LawPath&) = delete;
  LawPath& operator=(const LawPath&) = delete;
};

config::TypeLibrary library() { return config::TypeLibrary({kTypes, fs::path(VSA_SOURCE_DIR) / "actuators"}); }

std::string refusal(const std::string& path) {
  const LawPath set(path);
  try {
    (void)config::LawRegistry::standard();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LawPath, NamesLibrariesWhoseLawsTypesMayName) {
  for (const std::string& path : {(kModules / "good").string(), (kModules / "good/good.so").string(),
                                  ":" + (kModules / "good").string() + "::" + (kModules / "good/good.so").string()}) {
    const LawPath set(path);
    const config::ActuatorType type = library().load("cubic", {{"elastic.linear_Nm_per_rad", "2"}});
    const auto& law = *type.unit.actuator.transmission;
    EXPECT_NEAR(law.evaluate({0, {0.3, -0.3}}).curvature.qq, 2 * (2 + 3 * 10 * 0.09), 1e-12);
    EXPECT_TRUE(law.equals(*library().load("cubic", {{"elastic.linear_Nm_per_rad", "2"}}).unit.actuator.transmission));
    EXPECT_FALSE(law.equals(*library().load("qbmove_maker_pro_paper").unit.actuator.transmission));
  }
}

TEST(LawPath, LeavesProgramsWithoutItAsTheyAre) {
  EXPECT_THROW((void)library().load("cubic"), InputError);
  {
    const LawPath set((kModules / "good").string());
    EXPECT_NE(config::LawRegistry::standard().find("cubic"), nullptr);
  }
  EXPECT_EQ(config::LawRegistry::standard().find("cubic"), nullptr);
}

TEST(LawPath, LawsOutliveTheRegistryAndMayBeAskedForFromManyThreads) {
  const LawPath set((kModules / "good").string());
  std::array<std::shared_ptr<const elastic::Transmission>, 8> laws;
  std::vector<std::thread> threads;
  for (auto& law : laws) threads.emplace_back([&law] { law = library().load("cubic").unit.actuator.transmission; });
  for (std::thread& t : threads) t.join();
  for (const auto& law : laws) EXPECT_TRUE(law->equals(*laws[0]));
}

TEST(LawPath, UnitsSideBySideGoAsOneAlone) {
  const LawPath set((kModules / "good").string());
  const device::UnitConfig config = library().load("cubic").unit;
  device::UnitBatch batch(config, 3);
  device::Unit alone(config);
  device::UnitState state = alone.initial(0, 0, 0);
  alone.set_inputs(state, alone.inputs_for(0.4, 0.3));
  for (std::size_t i = 0; i < 3; ++i) batch.command(i, 0.4, 0.3);
  const std::vector<double> none(3, 0.0), inertia(3, 1 / 0.005);
  std::vector<double> torque(3);
  for (std::int64_t now = 0; now < 300'000'000; now += 1'000'000) {
    const double expected = alone.step(state, now, 1'000'000, {0, 0, inertia[0]});
    batch.step(1'000'000, none, none, inertia, torque);
    for (const double t : torque) ASSERT_EQ(t, expected) << now;
  }
  EXPECT_GT(torque[0], 0.5) << "it was driven";
}

TEST(LawPath, RefusesALibraryThatDoesntFitWithItsFileAndWhatWould) {
  const std::vector<std::array<std::string, 3>> reasons{
      {"interface", "interface = " + std::to_string(elastic::kLawInterface + 1),
       "allowed: " + std::to_string(elastic::kLawInterface)},
      {"version", "vsasim = 0.0.9: it was built with another version", "build it again"},
      {"abi", "compiler = another compiler's", VSA_LAW_ABI},
      {"layout", "its types have other sizes", "the same vsasim"},
      {"symbol", "vsa_law_module: the library exports no such symbol", "VSA_EXPORT_LAWS"},
      {"nameless", "law 1: has no name", "vsa/elastic/law.hpp"},
      {"taken", "law = two_sinh: the name is taken, by a law that ships", "a name of its own"}};
  for (const auto& [directory, message, allowed] : reasons) {
    for (int again = 0; again < 2; ++again) {
      const std::string text = refusal((kModules / directory).string());
      EXPECT_EQ(text.rfind((kModules / directory / (directory + ".so")).string(), 0), 0U) << text;
      EXPECT_NE(text.find(message), std::string::npos) << text;
      EXPECT_NE(text.find(allowed), std::string::npos) << text;
    }
  }
}

TEST(LawPath, RefusesTheSameNameFromTwoLibrariesAndTellsAllThatIsWrongAtOnce) {
  const std::string twice = refusal((kModules / "good").string() + ":" + (kModules / "again").string());
  EXPECT_NE(twice.find("again.so: law = cubic: the name is taken, of "), std::string::npos) << twice;
  EXPECT_NE(twice.find("good.so"), std::string::npos) << twice;
  const std::string both = refusal((kModules / "version").string() + ":" + (kModules / "symbol").string());
  EXPECT_NE(both.find("version.so"), std::string::npos) << both;
  EXPECT_NE(both.find("symbol.so"), std::string::npos) << both;
}

TEST(LawPath, RefusesWhatIsNoLibraryAndNoDirectory) {
  const fs::path scratch = fs::path(VSA_BINARY_DIR) / ("law_path_" + std::to_string(getpid()));
  fs::create_directories(scratch / "closed");
  std::ofstream(scratch / "text.so") << "this is no library";
  const std::string text = refusal(scratch.string());
  EXPECT_NE(text.find("text.so: can't be loaded: "), std::string::npos) << text;
  EXPECT_NE(text.find("a shared library for this machine"), std::string::npos) << text;
  const std::string nowhere = refusal((scratch / "nowhere").string());
  EXPECT_EQ(nowhere.rfind("VSA_LAW_PATH = " + (scratch / "nowhere").string() + ": there is no such directory or file", 0), 0U)
      << nowhere;
  EXPECT_NE(nowhere.find("separated by colons"), std::string::npos) << nowhere;
  EXPECT_EQ(refusal((scratch / "closed").string()), "") << "a directory without libraries";
  fs::permissions(scratch / "closed", fs::perms::none);
  if (geteuid() != 0) {
    EXPECT_NE(refusal((scratch / "closed").string()).find("can't be read: "), std::string::npos);
  }
  fs::permissions(scratch / "closed", fs::perms::owner_all);
  fs::remove_all(scratch);
}

}  // namespace
