// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/model.hpp"

#include <array>
#include <locale>
#include <mutex>

#include "physics/mujoco/versions.hpp"
#include "vsa/physics/error.hpp"

namespace vsa::physics {
namespace {

std::mutex compiling;  // mj_loadXML keeps its last model in a global

thread_local std::vector<std::string>* told = nullptr;  // while a model is compiled

/// Those of a step are counted in mjData, where every step looks.
void on_warning(const char* text) {
  if (told != nullptr) told->emplace_back(text);
}

[[noreturn]] void on_error(const char* text) { throw SimulationError(std::string("MuJoCo: ") + text); }

struct VfsDeleter {
  void operator()(mjVFS* vfs) const {
    mj_deleteVFS(vfs);
    delete vfs;
  }
};

void take_hooks() {
  mju_user_warning = on_warning;
  mju_user_error = on_error;
}

/// MuJoCo reads numbers as the program's global C++ locale has them: 0.5 isn't one where that has commas.
std::string about_locale() {
  const char point = std::use_facet<std::numpunct<char>>(std::locale()).decimal_point();
  if (point == '.') return "";
  return std::string(" (the decimal point of this program's global C++ locale is '") + point +
         "', by which MuJoCo reads numbers: std::locale::global(std::locale::classic()) before worlds are loaded)";
}

ModelPtr load(const std::string& path, const mjVFS* files, std::string& reason, std::vector<std::string>* warnings) {
  struct Listening {
    explicit Listening(std::vector<std::string>* to) { told = to; }
    ~Listening() { told = nullptr; }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;
  };
  std::array<char, 1000> error{};
  const Listening listening(warnings);
  ModelPtr model(mj_loadXML(path.c_str(), files, error.data(), static_cast<int>(error.size())));
  mj_freeLastXML();
  if (!model) reason = error.data() + about_locale();
  return model;
}

}  // namespace

ModelPtr compile(const std::string& xml, const std::vector<VirtualFile>& named, std::string& reason,
                 std::vector<std::string>* warnings) {
  const std::lock_guard lock(compiling);
  take_hooks();
  const std::unique_ptr<mjVFS, VfsDeleter> vfs(new mjVFS);
  mj_defaultVFS(vfs.get());
  bool all = add_file(*vfs, "world.xml", xml);
  for (const VirtualFile& file : named) all = all && add_file(*vfs, file.name, file.bytes);
  if (!all) {
    reason = "the world is too large for MuJoCo's virtual files";
    return nullptr;
  }
  return load("world.xml", vfs.get(), reason, warnings);
}

ModelPtr load_file(const std::string& path, std::string& reason, std::vector<std::string>* warnings) {
  const std::lock_guard lock(compiling);
  take_hooks();
  return load(path, nullptr, reason, warnings);
}

}  // namespace vsa::physics
