// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A law of a user's own in a shared library, as the built command takes it (VSA_LAW_PATH).
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "subprocess.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::Result;
using vsa::test::run_vsa;

const fs::path kModules = fs::path(VSA_BINARY_DIR) / "tests/law_modules";

Result with_laws_of(const std::string& directory, const std::vector<std::string>& arguments) {
  vsa::test::Surroundings s;
  s.environment = {{"VSA_LAW_PATH", (kModules / directory).string()},
                   {"VSA_ACTUATOR_PATH", (fs::path(VSA_SOURCE_DIR) / "examples/law_module/types").string()}};
  return run_vsa(arguments, s);
}

TEST(LawPathOfVsa, ShowsAndRunsATypeOfTheLaw) {
  const Result shown = with_laws_of("good", {"actuators", "cubic"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_NE(shown.out.find("elastic law: cubic, 2 … 23.6 N·m/rad at rest"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("elastic.cubic_Nm_per_rad3"), std::string::npos) << shown.out;
  const Result run = with_laws_of("good", {"run", "bench_free", "--type", "cubic", "--duration-s", "0.2", "--no-topics"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Result unknown = run_vsa({"run", "bench_free", "--type", "cubic", "--duration-s", "0.2", "--no-topics"});
  EXPECT_EQ(unknown.exit_code, 2) << "without the path there is no such type";
}

TEST(LawPathOfVsa, ListsTheLawsOfOnesOwnBesideTheOthers) {
  const Result listed = with_laws_of("good", {"actuators", "--laws"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  for (const char* part : {"\ncubic ", "elastic.cubic_Nm_per_rad3", "\ntwo_exp "})
    EXPECT_NE(listed.out.find(part), std::string::npos) << part << listed.out;
  EXPECT_EQ(run_vsa({"actuators", "--laws"}).out.find("\ncubic "), std::string::npos);
  EXPECT_EQ(with_laws_of("taken", {"actuators", "--laws"}).exit_code, 2);
}

TEST(LawPathOfVsa, EndsWithBadInputAndTheFileWhereALibraryDoesntFit) {
  for (const std::string wrong : {"interface", "version", "abi", "layout", "symbol", "nameless", "taken", "nowhere"}) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"actuators"}, {"run", "bench_free", "--duration-s", "0.1", "--no-topics"}}) {
      const Result r = with_laws_of(wrong, arguments);
      EXPECT_EQ(r.exit_code, 2) << wrong << r.err;
      EXPECT_NE(r.err.find((kModules / wrong).string()), std::string::npos) << r.err;
      EXPECT_NE(r.err.find("allowed: "), std::string::npos) << r.err;
    }
  }
  EXPECT_EQ(with_laws_of("version", {"--help"}).exit_code, 0);
}

}  // namespace
