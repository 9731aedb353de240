// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu_package/package.hpp"

#include "fmu_package/licences.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"

namespace vsa::fmu {
namespace fs = std::filesystem;

void write_package(const Model& model, const Resources& resources, const PackagePlan& plan, const fs::path& file) {
  const auto library = read_file(plan.library);
  if (!library)
    throw InputError({plan.library.string(), "", "", "isn't there: the library that goes into an FMU",
                      "an installation, or a build of the targets vsa_fmu_unit and vsa_fmu_world_library"});
  const std::string id = identifier_of(plan.name);
  const bool two = plan.version == Version::fmi2;
  std::map<std::string, std::string> files;
  files["modelDescription.xml"] = model_description(model, plan, token_of(resources));
  files[std::string("binaries/") + (two ? "linux64/" : "x86_64-linux/") + id + ".so"] = *library;
  for (const auto& [name, bytes] : resources) files["resources/" + name] = bytes;
  files["documentation/index.html"] = documentation_page(model, plan);
  files["documentation/licenses/license.txt"] = plan.licence;
  files["documentation/licenses/third_party.txt"] = third_party_licences();
  files[two ? "model.png" : "terminalsAndIcons/icon.png"] = icon_png();
  write_zip(files, file);
}

}  // namespace vsa::fmu
