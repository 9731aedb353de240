// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An importer of FMUs: unzips, reads modelDescription.xml with a reader of its own, loads the library and calls it as the standard
// has it. It knows nothing of the exporter's rooms but how to call them for a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fmi2.hpp"
#include "vsa/fmu_package/package.hpp"
#include "vsa/temporary_folder.hpp"

namespace vsa::test {

namespace fs = std::filesystem;

/// What modelDescription.xml says of a variable, as texts; absent attributes are empty.
struct Described {
  std::string name, reference, causality, variability, initial, type, unit, start, min, max, declared;
};

/// An FMU on disk and unzipped. Throws std::runtime_error for a file that is none.
class Package {
 public:
  explicit Package(const fs::path& file);
  ~Package();
  Package(const Package&) = delete;
  Package& operator=(const Package&) = delete;

  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }
  [[nodiscard]] std::string uri() const;  ///< of resources/, escaped
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<Described>& variables() const { return variables_; }
  [[nodiscard]] const Described& variable(const std::string& name) const;
  [[nodiscard]] unsigned reference(const std::string& name) const;
  [[nodiscard]] const std::string& token() const { return token_; }
  [[nodiscard]] const std::string& identifier() const { return identifier_; }

  /// A function of the library, loaded at the first call.
  template <class F>
  [[nodiscard]] F* function(const char* name) const {
    return reinterpret_cast<F*>(symbol(name));
  }
  [[nodiscard]] void* symbol(const char* name) const;  ///< null: it hasn't that

 private:
  void read_description();

  vsa::TemporaryFolder folder_;
  std::string text_, token_, identifier_;
  std::vector<Described> variables_;
  mutable void* library_ = nullptr;
};

#define FMI(package, name) (package).function<decltype(name)>(#name)

/// An instance of FMI 2.0 with what it logged.
class Instance2 {
 public:
  explicit Instance2(const Package& package, const std::string& name = "unit");
  /// Another token or folder than the package's.
  Instance2(const Package& package, const std::string& name, const std::string& guid, const std::string& resources,
            fmi2Type type = fmi2CoSimulation);
  ~Instance2();
  Instance2(const Instance2&) = delete;
  Instance2& operator=(const Instance2&) = delete;

  [[nodiscard]] bool made() const { return c_ != nullptr; }
  [[nodiscard]] fmi2Component c() const { return c_; }
  [[nodiscard]] const Package& package() const { return package_; }

  /// From instantiated into stepping.
  void start(double start_s = 0);
  /// Fails the test unless ok.
  void set(const std::string& name, double value);
  void set_word(const std::string& name, int value);
  [[nodiscard]] double get(const std::string& name);
  [[nodiscard]] std::vector<double> all();  ///< every real value
  void step(double t_s, double h_s);
  [[nodiscard]] std::vector<char> bytes();  ///< of its state
  void restore(const std::vector<char>& bytes);

  std::vector<std::string> log;  ///< "status category text"

 private:
  const Package& package_;
  std::unique_ptr<fmi2CallbackFunctions> callbacks_;
  fmi2Component c_ = nullptr;
};

/// Written to a folder of its own and unzipped.
struct UnitExport {
  std::string type = "qbmove_maker_pro_6_1";
  fmu::Version version = fmu::Version::fmi2;
  fmu::UnitStart start{};
  fmu::Names names = fmu::Names::vsasim;
};
[[nodiscard]] std::unique_ptr<Package> exported(const UnitExport& options = {});
[[nodiscard]] std::unique_ptr<Package> exported_world(const std::string& world, fmu::Version version = fmu::Version::fmi2);
[[nodiscard]] fmu::PackagePlan plan_of(const std::string& name, fmu::Version version, const char* library);

}  // namespace vsa::test
