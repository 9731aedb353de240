// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "importer.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>
#include <zip.h>

#include <cstdarg>
#include <cstdio>
#include <stdexcept>

#include "vsa/files.hpp"
#include "vsa/fmu_world/world_model.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::test {
namespace {

void unzip(const fs::path& file, const fs::path& to) {
  int error = 0;
  zip_t* archive = zip_open(file.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error);
  if (archive == nullptr) {
    zip_error_t e;
    zip_error_init_with_code(&e, error);
    throw std::runtime_error(file.string() + ": no FMU: " + zip_error_strerror(&e));
  }
  fmu::Resources files;
  bool whole = true;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t stat;
    whole = whole && zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat) == 0;
    zip_file_t* in = whole ? zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0) : nullptr;
    if (in == nullptr) break;
    std::string bytes(stat.size, '\0');
    whole = zip_fread(in, bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size());
    whole = zip_fclose(in) == 0 && whole;
    files[stat.name] = std::move(bytes);
  }
  zip_discard(archive);
  if (!whole) throw std::runtime_error(file.string() + ": no FMU: it is damaged");
  fmu::write_resources(files, to);
}

std::string text_of(const tinyxml2::XMLElement* e, const char* attribute) {
  const char* text = e == nullptr ? nullptr : e->Attribute(attribute);
  return text == nullptr ? "" : text;
}

void log_to(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status, fmi2String category, fmi2String format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::string text(4096, '\0');
  const int size = std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  text.resize(static_cast<std::size_t>(std::max(size, 0)));
  static_cast<Instance2*>(environment)->log.push_back(std::to_string(status) + " " + category + " " + text);
}

}  // namespace

Package::Package(const fs::path& file) {
  unzip(file, folder_.path());
  read_description();
}

Package::~Package() {
  if (library_ != nullptr) dlclose(library_);
}

std::string Package::uri() const {
  std::string out = "file://";
  for (const char c : (folder_.path() / "resources").string()) out += c == ' ' ? std::string("%20") : std::string(1, c);
  return out;
}

void Package::read_description() {
  text_ = read_file(folder_.path() / "modelDescription.xml").value();
  tinyxml2::XMLDocument xml;
  if (xml.Parse(text_.c_str(), text_.size()) != tinyxml2::XML_SUCCESS) throw std::runtime_error("modelDescription.xml is no XML");
  const tinyxml2::XMLElement* root = xml.RootElement();
  const bool two = text_of(root, "fmiVersion") == "2.0";
  token_ = text_of(root, two ? "guid" : "instantiationToken");
  identifier_ = text_of(root->FirstChildElement("CoSimulation"), "modelIdentifier");
  const auto* variables = root->FirstChildElement("ModelVariables");
  for (const auto* e = variables->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    const tinyxml2::XMLElement* value = two ? e->FirstChildElement() : e;
    variables_.push_back({text_of(e, "name"), text_of(e, "valueReference"), text_of(e, "causality"), text_of(e, "variability"),
                          text_of(e, "initial"), value->Name(), text_of(value, "unit"), text_of(value, "start"),
                          text_of(value, "min"), text_of(value, "max"), text_of(value, "declaredType")});
  }
}

const Described& Package::variable(const std::string& name) const {
  for (const Described& v : variables_)
    if (v.name == name) return v;
  throw std::runtime_error("no variable " + name);
}

unsigned Package::reference(const std::string& name) const { return static_cast<unsigned>(std::stoul(variable(name).reference)); }

void* Package::symbol(const char* name) const {
  if (library_ == nullptr) {
    for (const char* platform : {"linux64", "x86_64-linux"}) {
      const fs::path file = folder_.path() / "binaries" / platform / (identifier_ + ".so");
      if (fs::exists(file)) library_ = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    }
    if (library_ == nullptr) throw std::runtime_error(std::string("no library: ") + dlerror());
  }
  return dlsym(library_, name);
}

Instance2::Instance2(const Package& package, const std::string& name) : Instance2(package, name, package.token(), package.uri()) {}

Instance2::Instance2(const Package& package, const std::string& name, const std::string& guid, const std::string& resources,
                     fmi2Type type)
    : package_(package),
      callbacks_(std::make_unique<fmi2CallbackFunctions>(fmi2CallbackFunctions{log_to, nullptr, nullptr, nullptr, this})),
      c_(FMI(package, fmi2Instantiate)(name.c_str(), type, guid.c_str(), resources.c_str(), callbacks_.get(), 0, 0)) {}

Instance2::~Instance2() { FMI(package_, fmi2FreeInstance)(c_); }

void Instance2::start(double start_s) {
  ASSERT_EQ(FMI(package_, fmi2SetupExperiment)(c_, 0, 0, start_s, 0, 0), fmi2OK);
  ASSERT_EQ(FMI(package_, fmi2EnterInitializationMode)(c_), fmi2OK);
  ASSERT_EQ(FMI(package_, fmi2ExitInitializationMode)(c_), fmi2OK) << (log.empty() ? "" : log.back());
}

void Instance2::set(const std::string& name, double value) {
  const unsigned vr = package_.reference(name);
  ASSERT_EQ(FMI(package_, fmi2SetReal)(c_, &vr, 1, &value), fmi2OK) << name << ": " << (log.empty() ? "" : log.back());
}

void Instance2::set_word(const std::string& name, int value) {
  const unsigned vr = package_.reference(name);
  ASSERT_EQ(FMI(package_, fmi2SetInteger)(c_, &vr, 1, &value), fmi2OK) << name << ": " << (log.empty() ? "" : log.back());
}

double Instance2::get(const std::string& name) {
  const unsigned vr = package_.reference(name);
  double value = 0;
  EXPECT_EQ(FMI(package_, fmi2GetReal)(c_, &vr, 1, &value), fmi2OK) << name << ": " << (log.empty() ? "" : log.back());
  return value;
}

std::vector<double> Instance2::all() {
  std::vector<unsigned> references;
  for (const Described& v : package_.variables())
    if (v.type == "Real") references.push_back(static_cast<unsigned>(std::stoul(v.reference)));
  std::vector<double> out(references.size());
  EXPECT_EQ(FMI(package_, fmi2GetReal)(c_, references.data(), references.size(), out.data()), fmi2OK);
  return out;
}

void Instance2::step(double t_s, double h_s) {
  ASSERT_EQ(FMI(package_, fmi2DoStep)(c_, t_s, h_s, 1), fmi2OK) << (log.empty() ? "" : log.back());
}

std::vector<char> Instance2::bytes() {
  fmi2FMUstate state = nullptr;
  EXPECT_EQ(FMI(package_, fmi2GetFMUstate)(c_, &state), fmi2OK);
  std::size_t size = 0;
  EXPECT_EQ(FMI(package_, fmi2SerializedFMUstateSize)(c_, state, &size), fmi2OK);
  std::vector<char> out(size);
  EXPECT_EQ(FMI(package_, fmi2SerializeFMUstate)(c_, state, out.data(), size), fmi2OK);
  EXPECT_EQ(FMI(package_, fmi2FreeFMUstate)(c_, &state), fmi2OK);
  EXPECT_EQ(state, nullptr);
  return out;
}

void Instance2::restore(const std::vector<char>& bytes) {
  fmi2FMUstate state = nullptr;
  ASSERT_EQ(FMI(package_, fmi2DeSerializeFMUstate)(c_, bytes.data(), bytes.size(), &state), fmi2OK);
  ASSERT_EQ(FMI(package_, fmi2SetFMUstate)(c_, state), fmi2OK);
  ASSERT_EQ(FMI(package_, fmi2FreeFMUstate)(c_, &state), fmi2OK);
}

fmu::PackagePlan plan_of(const std::string& name, fmu::Version version, const char* library) {
  fmu::PackagePlan plan;
  plan.name = name;
  plan.title = "of a test";
  plan.version = version;
  plan.library = fs::path(VSA_BINARY_DIR) / "lib/vsasim/fmu" / library;
  plan.licence = "of a test";
  return plan;
}

std::unique_ptr<Package> exported(const UnitExport& o) {
  const fmu::Resources resources = fmu::unit_resources(config::TypeLibrary(), {o.type, o.start, o.names});
  const vsa::TemporaryFolder folder;
  fmu::write_resources(resources, folder.path() / "resources");
  const auto model = fmu::open_unit(folder.path() / "resources");
  fmu::write_package(*model, resources, plan_of(o.type, o.version, "libvsa-fmu.so"), folder.path() / "a unit.fmu");
  return std::make_unique<Package>(folder.path() / "a unit.fmu");
}

std::unique_ptr<Package> exported_world(const std::string& world, fmu::Version version) {
  const fmu::Resources resources = fmu::world_resources(config::TypeLibrary(), {world, {}});
  const vsa::TemporaryFolder folder;
  fmu::write_resources(resources, folder.path() / "resources");
  const auto model = fmu::open_world(folder.path() / "resources");
  fmu::write_package(*model, resources, plan_of(world, version, "libvsa-fmu-world.so"), folder.path() / "world.fmu");
  return std::make_unique<Package>(folder.path() / "world.fmu");
}

}  // namespace vsa::test
