// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an FMU carries in its folder resources/, and from which its library makes the model again:
//
//   unit.toml        of an actuator
//     written_by = "vsasim 0.1.0"
//     type = "qbmove_maker_pro"
//     names = "vsasim"                       or "gazebo_fmi"
//     coupling = "prescribed"                or "implicit"
//     load_inertia_kg_m2 = 0.0
//     set = { "drive.supply_V" = "12" }      values that replaced the type's
//   actuators/       the type's file, those it is made of, and the numbers of its law
//
// The instantiation token (FMI 2: GUID) is a hash of all of that, so that a modelDescription.xml and a folder of different exports
// are told apart.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/fmu/unit_model.hpp"

namespace vsa::fmu {

/// Paths below resources/, with '/' between, and their bytes.
using Resources = std::map<std::string, std::string>;

/// What an FMU of one actuator is to be.
struct UnitPlan {
  std::string type;             ///< of the library
  UnitStart start{};            ///< until the importer sets something else
  Names names = Names::vsasim;  ///< of the variables
};

/// Throws InputError: an unknown type, one whose law an FMU's library doesn't have, a file that lies outside of the type's folder, and
/// all that TypeLibrary::load finds.
[[nodiscard]] Resources unit_resources(const config::TypeLibrary& library, const UnitPlan& plan);
/// From a folder with those. Throws InputError with every problem.
[[nodiscard]] std::unique_ptr<UnitModel> open_unit(const std::filesystem::path& resources);

/// The laws that an FMU's library has in it: nothing that this machine adds.
[[nodiscard]] config::LawRegistry built_in_laws();
/// Adds a type's file, those it is made of and its law's numbers, below actuators/. Throws InputError as unit_resources().
void add_type_files(Resources& to, const config::TypeLibrary& library, const std::string& type);

/// All files below a folder. Throws InputError where it isn't there or can't be read.
[[nodiscard]] Resources read_resources(const std::filesystem::path& folder);
/// Throws OutputError.
void write_resources(const Resources& resources, const std::filesystem::path& folder);
/// "{8-4-4-4-12}" hexadecimal digits.
[[nodiscard]] std::string token_of(const Resources& resources);

/// "file:///some%20where/resources" → "/some where/resources"; a plain path stays. Throws InputError for another scheme or host.
[[nodiscard]] std::filesystem::path path_of_uri(std::string_view uri);

/// A TOML string: quoted, with escapes.
[[nodiscard]] std::string toml_text(std::string_view text);

}  // namespace vsa::fmu
