// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/law_modules.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "vsa/config/text.hpp"
#include "vsa/elastic/law_module.hpp"

namespace vsa::config {
namespace {

namespace fs = std::filesystem;
using elastic::LawModule;

static_assert(std::string_view(VSA_LAW_VERSION) == VSA_VERSION,
              "vsa/elastic/law_module.hpp has another version than CMakeLists.txt");

constexpr const char* kVariable = "VSA_LAW_PATH";
constexpr const char* kModuleEnding = ".so";
constexpr const char* kSymbol = "vsa_law_module";

/// What a part of the path names.
std::vector<fs::path> libraries_of(const std::string& part, Problems& problems) {
  std::error_code error;
  const fs::path given(part);
  const auto wrong = [&](const std::string& message) {
    problems.add({"", kVariable, part, message, "directories with *.so, and such files, separated by colons"});
    return std::vector<fs::path>{};
  };
  if (!fs::exists(given, error)) return wrong("there is no such directory or file");
  if (!fs::is_directory(given, error)) return {given};
  std::vector<fs::path> out;
  fs::directory_iterator it(given, error);
  for (const fs::directory_iterator end; !error && it != end; it.increment(error))
    if (it->path().extension() == kModuleEnding) out.push_back(it->path());
  if (error) return wrong("can't be read: " + error.message());
  std::sort(out.begin(), out.end());
  return out;
}

std::string loader_error() {
  const char* text = dlerror();
  return text != nullptr ? text : "for a reason that the loader doesn't tell";
}

/// Why it can't be used with this program; none: it can.
std::optional<Problem> mismatch(const LawModule& module, const std::string& file) {
  const std::string again = ": build it again, with this vsasim";
  if (module.interface != elastic::kLawInterface)
    return Problem{file, "interface", std::to_string(module.interface), "its laws are of another interface",
                   std::to_string(elastic::kLawInterface) + again};
  if (std::string_view(module.version) != VSA_LAW_VERSION)
    return Problem{file, "vsasim", module.version, "it was built with another version", std::string(VSA_LAW_VERSION) + again};
  if (std::string_view(module.abi) != VSA_LAW_ABI)
    return Problem{file, "compiler", module.abi, "it was built by another compiler", VSA_LAW_ABI};
  if (module.layout != elastic::law_layout())
    return Problem{file, "layout", "", "its types have other sizes", "those of the same vsasim, compiler and options" + again};
  for (std::size_t i = 0; i < module.count; ++i) {
    if (module.laws[i]->name.empty() || module.laws[i]->make == nullptr)
      return Problem{file, "law " + std::to_string(i + 1), "", "has no name, or nothing that makes it", "vsa/elastic/law.hpp"};
  }
  return std::nullopt;
}

/// Throws InputError.
const LawModule* load(const fs::path& file) {
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw InputError(Problem{file.string(), "", "", "can't be loaded: " + loader_error(),
                             "a shared library for this machine, linked with vsa::elastic"});
  const auto* module = static_cast<const LawModule*>(dlsym(library, kSymbol));
  auto problem = module != nullptr ? mismatch(*module, file.string())
                                   : Problem{file.string(), kSymbol, "", "the library exports no such symbol",
                                             "VSA_EXPORT_LAWS(…) of vsa/elastic/law_module.hpp in it"};
  if (!problem) return module;
  dlclose(library);
  throw InputError(std::move(*problem));
}

class Modules {
 public:
  const LawModule& find(const fs::path& file) {
    const std::scoped_lock lock(mutex_);
    const LawModule*& known = loaded_[file];
    if (known == nullptr) known = load(file);
    return *known;
  }

 private:
  std::mutex mutex_;
  std::map<fs::path, const LawModule*> loaded_;
};

Modules modules;

}  // namespace

std::vector<ForeignLaw> laws_of_path(Problems& problems) {
  const char* path = std::getenv(kVariable);
  std::vector<fs::path> files;
  for (const std::string& part : split(path == nullptr ? "" : path, ':')) {
    if (part.empty()) continue;
    for (const fs::path& file : libraries_of(part, problems)) {
      std::error_code error;
      const fs::path whole = fs::canonical(file, error);
      if (error) problems.add({file.string(), "", "", "can't be read: " + error.message(), "a shared library"});
      if (!error && std::find(files.begin(), files.end(), whole) == files.end()) files.push_back(whole);
    }
  }
  std::vector<ForeignLaw> out;
  for (const fs::path& file : files) {
    try {
      const LawModule& module = modules.find(file);
      for (std::size_t i = 0; i < module.count; ++i) out.push_back({module.laws[i], file});
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  return out;
}

}  // namespace vsa::config
