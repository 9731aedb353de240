// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A functional mock-up unit as a file: a zip of
//   modelDescription.xml                          FMI 2.0.4 or 3.0.2
//   binaries/linux64/ID.so, x86_64-linux/ID.so    2.0, 3.0: the library that makes the model of resources/
//   resources/                                    vsa/fmu/resources.hpp
//   documentation/index.html, documentation/licenses/…
//   model.png, terminalsAndIcons/icon.png         2.0, 3.0
// The same inputs give the same bytes.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "vsa/fmu/model.hpp"
#include "vsa/fmu/resources.hpp"

namespace vsa::fmu {

/// Which standard the file follows.
enum class Version { fmi2 = 2, fmi3 = 3 };

/// An FMU to be written.
struct PackagePlan {
  std::string name;                 ///< of the type or world; the model identifier is made of it
  std::string title;                ///< one line for people
  std::string note{};               ///< a paragraph on how to step it, for the documentation page
  Version version = Version::fmi2;  ///< of the standard
  double step_s = 1e-3;             ///< suggested communication step
  std::filesystem::path library;    ///< that makes the model of resources/
  std::string licence;              ///< text of the project's
};

/// A C identifier: "qbmove_maker_pro_6_1".
[[nodiscard]] std::string identifier_of(std::string_view name);
/// modelDescription.xml; `token` as token_of() has it.
[[nodiscard]] std::string model_description(const Model& model, const PackagePlan& plan, const std::string& token);
[[nodiscard]] std::string documentation_page(const Model& model, const PackagePlan& plan);  ///< documentation/index.html
[[nodiscard]] std::string icon_png();                                                       ///< model.png

/// Beside `file` first, then renamed. Throws OutputError with the reason; then nothing is left.
void write_zip(const std::map<std::string, std::string>& files, const std::filesystem::path& file);

/// Throws InputError where the library isn't there, else OutputError.
void write_package(const Model& model, const Resources& resources, const PackagePlan& plan, const std::filesystem::path& file);

}  // namespace vsa::fmu
