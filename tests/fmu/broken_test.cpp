// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Bad input: one readable line, the host alive, nothing half written.
#include <gtest/gtest.h>

#include <fstream>

#include "importer.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::test {
namespace {

std::string why_not(const Instance2& i) {
  EXPECT_FALSE(i.made());
  EXPECT_FALSE(i.log.empty());
  return i.log.empty() ? "" : i.log[0];
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

TEST(Broken, AnInstanceThatCannotBeMadeIsToldWhy) {
  const auto package = exported();
  const std::string token = package->token(), uri = package->uri();
  const auto refused = [&](const std::string& name, const std::string& guid, const std::string& where,
                           fmi2Type type = fmi2CoSimulation) { return why_not(Instance2(*package, name, guid, where, type)); };
  EXPECT_PRED2(has, refused("a", "{0}", uri), "different exports");
  EXPECT_PRED2(has, refused("a", token, "file:///no/such/folder"), "is no folder");
  EXPECT_PRED2(has, refused("a", token, "http://example.org/resources"), "isn't on this machine");
  EXPECT_PRED2(has, refused("a", token, "file://elsewhere/resources"), "on another machine");
  EXPECT_PRED2(has, refused("a", token, "file:///a%2"), "two hexadecimal digits");
  EXPECT_PRED2(has, refused("a", token, ""), "is empty");
  EXPECT_PRED2(has, refused("", token, uri), "needs a name");
  EXPECT_PRED2(has, refused("a", token, uri, fmi2ModelExchange), "co-simulation only");
  EXPECT_EQ(FMI(*package, fmi2Instantiate)("a", fmi2CoSimulation, token.c_str(), uri.c_str(), nullptr, 0, 0), nullptr);
  // As URIs come, and as some importers give it: a path.
  const std::string path = (package->folder() / "resources").string();
  for (const std::string& where : {uri, uri + "/", "file:" + path, "file://localhost" + path, path})
    EXPECT_TRUE(Instance2(*package, "a", token, where).made()) << where;
}

TEST(Broken, ResourcesThatWereChangedAreRefused) {
  const auto package = exported();
  const fs::path type = package->folder() / "resources/actuators/qbmove_maker_pro_6_1.toml";
  const std::string text = read_file(type).value();
  write(type, text + "\n");
  EXPECT_PRED2(has, why_not(Instance2(*package)), "different exports");
  write(type, text);
  EXPECT_TRUE(Instance2(*package).made());
  // With the token of what stands there now the type's own reader speaks.
  const auto with_own_token = [&] {
    const std::string token = fmu::token_of(fmu::read_resources(package->folder() / "resources"));
    return why_not(Instance2(*package, "a", token, package->uri()));
  };
  write(type, "nonsense");
  EXPECT_PRED2(has, with_own_token(), "qbmove_maker_pro_6_1.toml");
  fs::remove(type);
  EXPECT_PRED2(has, with_own_token(), "qbmove_maker_pro_6_1");
  write(package->folder() / "resources/unit.toml", "type = 3\nwheels = 4\n");
  EXPECT_PRED2(has, with_own_token(), "unit.toml");
}

TEST(Broken, ResourceFoldersWithBlanksAreFound) {
  const auto package = exported();
  const fs::path other = package->folder() / "un pl%ace";
  fs::create_directories(other);
  fs::copy(package->folder() / "resources", other / "resources", fs::copy_options::recursive);
  std::string uri = "file://" + package->folder().string() + "/un%20pl%25ace/resources";
  EXPECT_TRUE(Instance2(*package, "a", package->token(), uri).made());
}

TEST(Broken, AZipThatIsDamagedIsNoPackage) {
  const vsa::TemporaryFolder folder;
  const fs::path file = folder.path() / "x.fmu";
  fmu::write_zip({{"modelDescription.xml", std::string(5000, 'x')}}, file);
  const std::string whole = read_file(file).value();
  for (const std::string& bytes : {std::string("no zip"), whole.substr(0, whole.size() / 2), std::string()}) {
    write(file, bytes);
    EXPECT_THROW(Package{file}, std::runtime_error);
  }
}

TEST(Broken, WhatCannotBeWrittenLeavesNothing) {
  const vsa::TemporaryFolder folder;
  const fs::path there = folder.path() / "there";
  fs::create_directories(there / "x.fmu");  // a directory in the way
  EXPECT_THROW(fmu::write_zip({{"a", "b"}}, there / "x.fmu"), OutputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(there), {}), 1) << "nothing is left beside it";
  EXPECT_THROW(fmu::write_zip({{"a", "b"}}, folder.path() / "nowhere/x.fmu"), OutputError);
  EXPECT_FALSE(fs::exists(folder.path() / "nowhere"));
}

TEST(Broken, TypesAndLibrariesThatAreNotThereAreNamed) {
  const config::TypeLibrary library;
  EXPECT_THROW(static_cast<void>(fmu::unit_resources(library, {.type = "qbmove"})), InputError);
  EXPECT_THROW(static_cast<void>(fmu::unit_resources(library, {.type = "sea_example", .start = {.set = {{"drive.wheels", "4"}}}})),
               InputError);
  const vsa::TemporaryFolder folder;
  const auto resources = fmu::unit_resources(library, {.type = "sea_example"});
  fmu::write_resources(resources, folder.path() / "r");
  const auto model = fmu::open_unit(folder.path() / "r");
  try {
    fmu::write_package(*model, resources, plan_of("sea_example", fmu::Version::fmi2, "no.so"), folder.path() / "x.fmu");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_PRED2(has, error.what(), "no.so");
  }
  EXPECT_FALSE(fs::exists(folder.path() / "x.fmu"));
}

TEST(Broken, ALawOfALibraryOfItsOwnIsNotExported) {
  config::LawRegistry laws = fmu::built_in_laws();
  laws.add("mine", *laws.find("series_spring"));
  const vsa::TemporaryFolder folder;
  std::string text = read_file(config::TypeLibrary().find("sea_example")).value();
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"name = \"sea_example\"", "name = \"mine\""},
                                 {"law = \"series_spring\"", "law = \"mine\""}}) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  }
  write(folder.path() / "mine.toml", text);
  try {
    static_cast<void>(fmu::unit_resources(config::TypeLibrary({folder.path()}, laws), {.type = "mine"}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_PRED2(has, error.what(), "library of its own");
  }
}

}  // namespace
}  // namespace vsa::test
