// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// modelDescription.xml and the rest of the file.
#include <elf.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cstring>
#include <set>

#include "importer.hpp"
#include "vsa/config/text.hpp"
#include "vsa/files.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // its runtime is needed besides
#else
constexpr bool kSanitized = false;
#endif

std::vector<const tinyxml2::XMLElement*> children(const tinyxml2::XMLElement* of, const char* name) {
  std::vector<const tinyxml2::XMLElement*> out;
  if (of == nullptr) return out;
  for (const auto* e = of->FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name)) out.push_back(e);
  return out;
}

std::set<std::string> names(const std::vector<const tinyxml2::XMLElement*>& elements) {
  std::set<std::string> out;
  for (const auto* e : elements) out.insert(e->Attribute("name"));
  return out;
}

/// What the standard asks of a description and no schema can check.
void check(const Package& p, bool two) {
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(p.text().c_str()), tinyxml2::XML_SUCCESS);
  const auto* root = xml.RootElement();
  const std::set<std::string> units = names(children(root->FirstChildElement("UnitDefinitions"), "Unit"));
  const std::set<std::string> types =
      names(children(root->FirstChildElement("TypeDefinitions"), two ? "SimpleType" : "EnumerationType"));
  std::set<std::string> references, seen, outputs, used;
  for (std::size_t i = 0; i < p.variables().size(); ++i) {
    const Described& v = p.variables()[i];
    EXPECT_TRUE(references.insert(v.reference).second) << v.name;
    EXPECT_TRUE(seen.insert(v.name).second) << v.name;
    EXPECT_EQ(types.count(v.name), 0U) << v.name;
    if (!v.unit.empty()) {
      EXPECT_EQ(units.count(v.unit), 1U) << v.name << " in " << v.unit;
      used.insert(v.unit);
    }
    if (!v.declared.empty()) {
      EXPECT_EQ(types.count(v.declared), 1U) << v.name;
    }
    const bool starts = v.causality == "input" || v.causality == "parameter";
    EXPECT_EQ(!v.start.empty(), starts) << v.name;
    if (starts && !v.min.empty()) {
      EXPECT_LE(std::stod(v.min), std::stod(v.start)) << v.name;
      EXPECT_GE(std::stod(v.max), std::stod(v.start)) << v.name;
    }
    if (v.causality == "output") outputs.insert(two ? std::to_string(i + 1) : v.reference);
  }
  EXPECT_EQ(used, units);
  const auto* structure = root->FirstChildElement("ModelStructure");
  const char* place = two ? "index" : "valueReference";
  for (const bool initial : {false, true}) {
    std::set<std::string> listed;
    const auto unknowns = two ? children(structure->FirstChildElement(initial ? "InitialUnknowns" : "Outputs"), "Unknown")
                              : children(structure, initial ? "InitialUnknown" : "Output");
    for (const auto* e : unknowns) EXPECT_TRUE(listed.insert(e->Attribute(place)).second);
    EXPECT_EQ(listed, outputs) << (initial ? "InitialUnknowns" : "Outputs");
  }
}

TEST(Description, IsConsistentForEveryTypeThatShips) {
  for (const std::string& type : config::TypeLibrary().names()) {
    SCOPED_TRACE(type);
    for (const auto version : {fmu::Version::fmi2, fmu::Version::fmi3}) {
      const vsa::TemporaryFolder folder;
      const auto resources = fmu::unit_resources(config::TypeLibrary(), {.type = type});
      fmu::write_resources(resources, folder.path());
      const auto model = fmu::open_unit(folder.path());
      // Without the library, which takes a second to pack.
      std::map<std::string, std::string> files;
      files["modelDescription.xml"] = fmu::model_description(*model, plan_of(type, version, ""), fmu::token_of(resources));
      fmu::write_zip(files, folder.path() / "x.fmu");
      check(Package(folder.path() / "x.fmu"), version == fmu::Version::fmi2);
    }
  }
}

TEST(Description, IsConsistentForWorlds) {
  check(*exported_world("snake_flat"), true);
  check(*exported_world("gripper_soft", fmu::Version::fmi3), false);
}

TEST(Description, HasEveryParameterOfTheTypeWithItsValueAndBounds) {
  const auto package = exported({.start = {.set = {{"drive.supply_V", "13"}}}});
  const config::ActuatorType type = config::TypeLibrary().load("qbmove_maker_pro_6_1");
  std::size_t numbers = 0;
  for (const config::Entry& e : type.entries) {
    if (e.kind != config::Kind::number) continue;
    ++numbers;
    const Described& v = package->variable(e.key);
    EXPECT_EQ(v.type, "Real");
    EXPECT_EQ(v.unit, fmu::unit_name(e.unit)) << e.key;
    EXPECT_EQ(std::stod(v.min), e.min) << e.key;
    EXPECT_EQ(std::stod(v.max), e.max) << e.key;
    EXPECT_EQ(std::stod(v.start), e.key == "drive.supply_V" ? 13 : e.number) << e.key;
  }
  EXPECT_GT(numbers, 25U);
}

TEST(Description, UnitsAreGivenInTheBaseOfTheSi) {
  using Exponents = std::map<std::string, int>;
  EXPECT_EQ(fmu::base_units(fmu::unit_name("N·m·s/rad")), (Exponents{{"kg", 1}, {"m", 2}, {"s", -1}, {"rad", -1}}));
  EXPECT_EQ(fmu::base_units(fmu::unit_name("kg·m²")), (Exponents{{"kg", 1}, {"m", 2}}));
  EXPECT_EQ(fmu::base_units(fmu::unit_name("Ω")), (Exponents{{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -2}}));
  EXPECT_EQ(fmu::base_units(fmu::unit_name("N·m/rad³")), (Exponents{{"kg", 1}, {"m", 2}, {"s", -2}, {"rad", -3}}));
  EXPECT_EQ(fmu::base_units(fmu::unit_name("1/s")), (Exponents{{"s", -1}}));
  EXPECT_EQ(fmu::base_units("%/tick"), std::nullopt);
  EXPECT_EQ(fmu::unit_name("1"), "");
}

TEST(Package, HasAllPartsAndTheSameBytesAgain) {
  const auto package = exported();
  for (const char* name : {"binaries/linux64/qbmove_maker_pro_6_1.so", "documentation/index.html",
                           "documentation/licenses/license.txt", "documentation/licenses/third_party.txt", "model.png",
                           "resources/unit.toml", "resources/actuators/qbmove_maker_pro_6_1.toml"})
    EXPECT_TRUE(fs::is_regular_file(package->folder() / name)) << name;
  EXPECT_EQ(read_file(package->folder() / "model.png").value().substr(1, 3), "PNG");
  const vsa::TemporaryFolder folder;
  fmu::write_zip({{"a", "x"}, {"b/c", std::string(1000, 'y')}}, folder.path() / "1");
  fmu::write_zip({{"a", "x"}, {"b/c", std::string(1000, 'y')}}, folder.path() / "2");
  EXPECT_EQ(read_file(folder.path() / "1"), read_file(folder.path() / "2"));
}

TEST(Package, OfATypeMadeOfOthersTakesThemAndItsNumbersAlong) {
  for (const char* type : {"table_example", "qbmove_maker_pro_datasheet"}) {
    const auto resources = fmu::unit_resources(config::TypeLibrary(), {.type = type});
    const config::ActuatorType loaded = config::TypeLibrary().load(type);
    EXPECT_EQ(resources.count("actuators/" + std::string(type) + ".toml"), 1U);
    if (!loaded.base.empty()) {
      EXPECT_EQ(resources.count("actuators/" + loaded.base + ".toml"), 1U) << type;
    }
  }
  EXPECT_EQ(fmu::unit_resources(config::TypeLibrary(), {.type = "table_example"}).count("actuators/table_example.csv"), 1U);
}

/// What the dynamic linker sees of a library: names that it shows, and libraries that it needs.
struct Linked {
  std::set<std::string> shown, needed;
};

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T out;
  std::memcpy(&out, bytes.data() + offset, sizeof out);
  return out;
}

Linked linked(const fs::path& library) {
  const std::string bytes = read_file(library).value();
  const auto head = at<Elf64_Ehdr>(bytes, 0);
  const auto section = [&](std::size_t i) { return at<Elf64_Shdr>(bytes, head.e_shoff + i * sizeof(Elf64_Shdr)); };
  Linked out;
  for (std::size_t i = 0; i < head.e_shnum; ++i) {
    const Elf64_Shdr s = section(i);
    if (s.sh_type != SHT_DYNSYM && s.sh_type != SHT_DYNAMIC) continue;
    const auto text = [&](std::size_t offset) { return std::string(&bytes[section(s.sh_link).sh_offset + offset]); };
    for (std::size_t k = 0; k < s.sh_size / s.sh_entsize; ++k) {
      const std::size_t offset = s.sh_offset + k * s.sh_entsize;
      if (s.sh_type == SHT_DYNSYM) {
        const auto symbol = at<Elf64_Sym>(bytes, offset);
        if (symbol.st_shndx != SHN_UNDEF) out.shown.insert(text(symbol.st_name));
      } else if (const auto entry = at<Elf64_Dyn>(bytes, offset); entry.d_tag == DT_NEEDED) {
        out.needed.insert(text(entry.d_un.d_val));
      }
    }
  }
  return out;
}

TEST(Package, LibrariesShowTheStandardsFunctionsOnlyAndAnActuatorsNeedsTheCLibraryOnly) {
  for (const char* name : {"libvsa-fmu.so", "libvsa-fmu-world.so"}) {
    const Linked l = linked(fs::path(VSA_BINARY_DIR) / "lib/vsasim/fmu" / name);
    for (const std::string& symbol : l.shown) EXPECT_TRUE(symbol.starts_with("fmi2") || symbol.starts_with("fmi3")) << symbol;
    EXPECT_EQ(l.shown.count("fmi2DoStep"), 1U);
    EXPECT_EQ(l.shown.count("fmi3DoStep"), 1U);
    EXPECT_EQ(l.shown.size(), 34U + 75U) << name;
    if (std::string(name) == "libvsa-fmu.so" && !kSanitized) {
      for (const std::string& needed : l.needed)
        EXPECT_TRUE(needed == "libc.so.6" || needed == "libm.so.6" || needed.starts_with("ld-linux")) << needed;
    }
  }
}

}  // namespace
}  // namespace vsa::test
