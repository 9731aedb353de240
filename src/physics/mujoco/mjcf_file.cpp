// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "physics/mujoco/mjcf_file.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

#include "physics/mujoco/mjcf.hpp"
#include "physics/mujoco/versions.hpp"
#include "physics/tree.hpp"
#include "vsa/files.hpp"
#include "vsa/physics/mjcf.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::physics {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr std::string_view kRobot = "vsa::Robot";       // of a <text>: this, or this, a blank and the model
constexpr std::string_view kNameless = "MuJoCo Model";  // what MuJoCo calls a file's model that has no name

fs::path beside_of(fs::path file) { return file.replace_extension(".vsa.xml"); }

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string name_of(const mjModel& m, const fs::path& path) {
  std::string own = m.names;  // the first of the names
  if (!own.empty() && own != kNameless) return own;
  return path.empty() ? "model" : path.stem().string();
}

/// MuJoCo reads the first element of a file, and of those that it includes: another one or text beside it is a problem. What can't be read here,
/// MuJoCo tells of.
class Roots {
 public:
  Roots(fs::path folder, Problems& problems) : folder_(std::move(folder)), problems_(problems) {}

  void check(const XMLElement& root, const std::string& file) {
    bool doctype = false;  // tinyxml2 ends one at its first >: the rest is a text before the root
    for (const tinyxml2::XMLNode* n = root.GetDocument()->FirstChild(); n != nullptr; n = n->NextSibling()) {
      doctype = n != &root && (doctype || n->ToUnknown() != nullptr);
      const bool element = n->ToElement() != nullptr;
      if (n == &root || !(element || (n->ToText() != nullptr && !doctype))) continue;
      problems_.add({fmt::format("{}:{}", file, n->GetLineNum()), element ? fmt::format("<{}>", n->Value()) : "",
                     element ? "" : n->Value(), "stands outside the file's first element",
                     fmt::format("one <{}> a file", root.Name())});
    }
    includes(root);
  }

 private:
  void includes(const XMLElement& parent) {
    for (const XMLElement* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const char* name = std::string_view(e->Name()) == "include" ? e->Attribute("file") : nullptr;
      const std::string path = name == nullptr ? std::string() : (folder_ / name).string();
      tinyxml2::XMLDocument part;
      if (name == nullptr) {
        includes(*e);
      } else if (seen_.insert(path).second && part.LoadFile(path.c_str()) == tinyxml2::XML_SUCCESS &&
                 part.RootElement() != nullptr) {
        check(*part.RootElement(), path);
      }
    }
  }

  fs::path folder_;  // of the file that includes the others, from which their names count
  Problems& problems_;
  std::set<std::string> seen_;
};

/// Whether a text under another name was meant to be a robot: by how that begins, or by the element that it holds.
bool is_misspelt(std::string_view name, std::string_view data) {
  std::string begins(name.substr(0, 3));
  std::transform(begins.begin(), begins.end(), begins.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return begins == "vsa" || data.find(kRobot) != std::string_view::npos || data.find("vsa-robot") != std::string_view::npos;
}

void read_texts(const mjModel& m, const std::string& file, description::World& out, std::vector<std::string>& warnings) {
  for (int i = 0; i < m.ntext; ++i) {
    const std::string_view name = m.names + m.name_textadr[i];
    const char* data = m.text_data + m.text_adr[i];
    if (!name.starts_with(kRobot) || (name.size() > kRobot.size() && !is_blank(name[kRobot.size()]))) {
      if (is_misspelt(name, data))
        warnings.push_back(fmt::format("<text name=\"{}\"> is left out, did you mean {}? ({})", name, kRobot, file));
      continue;
    }
    const bool says = name.size() > kRobot.size() + 1;
    const std::string model = speakable(std::string(says ? name.substr(kRobot.size() + 1) : std::string_view(out.name)));
    out.plugins.push_back({model, std::string(outermost(model)), data});
  }
}

/// What MuJoCo has and this simulator leaves out or can't.
void look_for_limits(const mjModel& m, const std::string& file, std::vector<std::string>& warnings, Problems& problems) {
  const auto warn = [&](const std::string& text) { warnings.push_back(text + " (" + file + ")"); };
  if (m.na > 0) {
    std::string with_states;
    for (int a = 0; a < m.nu; ++a)
      if (m.actuator_dyntype[a] != mjDYN_NONE) with_states += (with_states.empty() ? "" : ", ") + actuator_name(m, a);
    problems.add({file, "actuator", with_states, "states of their own", "actuators without activation"});
  }
  if (m.nu > 0 && !switched_off(m, {"Actuation"})) {
    warn("MuJoCo's own actuators stay at control 0, or what of their ctrlrange is nearest");
    for (int a = 0; a < m.nu; ++a)
      if (const double control = control_of(m, a); control != 0)
        warn(fmt::format("actuator {} has no control 0 in its ctrlrange: MuJoCo takes {:g}", actuator_name(m, a), control));
  }
  if (m.opt.integrator != mjINT_EULER) warn("the integrator is semi-implicit Euler, whatever <option> says");
  if (m.nkey > 0) warn("keyframes are left out");
  if (m.nsensor > 0) warn("sensors are left out");
}

}  // namespace

std::string speakable(std::string name) {
  for (std::size_t i = 0; i < name.size(); ++i)
    if (is_blank(name[i]) || name[i] == '@' || name[i] == '~' || (name[i] == ':' && name.substr(i + 1, 1) == "=")) name[i] = '_';
  return name;
}

std::string actuator_name(const mjModel& m, int actuator) {
  const char* name = mj_id2name(&m, mjOBJ_ACTUATOR, actuator);
  return name == nullptr ? fmt::format("number {}", actuator) : name;
}

double control_of(const mjModel& m, int actuator) {
  const mjtNum* range = m.actuator_ctrlrange + 2 * actuator;
  const bool limited = m.actuator_ctrllimited[actuator] != 0 && !switched_off(m, {"Clampctrl"});
  return limited ? std::clamp(0.0, range[0], std::max(range[0], range[1])) : 0.0;
}

bool gives_attribute(std::string_view xml, std::string_view name, std::string_view value) {
  const auto word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t at = 0; (at = xml.find(name, at)) != std::string_view::npos;) {
    const bool begins = at == 0 || !word(xml[at - 1]);
    at += name.size();
    const auto skip_blanks = [&] {
      while (at < xml.size() && is_blank(xml[at])) ++at;
    };
    skip_blanks();
    if (!begins || at == xml.size() || xml[at] != '=') continue;
    ++at;
    skip_blanks();
    if (value.empty()) return true;
    const std::string_view rest = xml.substr(std::min(at + 1, xml.size()));
    if (at < xml.size() && (xml[at] == '"' || xml[at] == '\'') && rest.substr(0, value.size()) == value &&
        rest.substr(std::min(value.size(), rest.size()), 1) == xml.substr(at, 1))
      return true;
  }
  return false;
}

std::vector<fs::path> files_of_mjcf(const fs::path& path) { return {path, beside_of(path)}; }

bool is_mjcf(const fs::path& path, std::string_view text) {
  if (!path.empty()) return path.extension() == ".xml" || path.extension() == ".mjcf";
  const std::size_t root = text.find("<mujoco");
  return root != std::string_view::npos && text.substr(0, root).find("<sdf") == std::string_view::npos;
}

MjcfRead read_mjcf(const fs::path& path, std::string_view given, std::vector<std::string>& warnings, Problems& problems) {
  MjcfRead out;
  const std::string file = path.empty() ? "MJCF text" : path.string();
  std::string text(given);
  if (!path.empty()) {
    const std::optional<std::string> bytes = read_file(path);
    if (!bytes) {
      problems.add({file, "", "", "can't be read", "an MJCF file"});
      return out;
    }
    text = *bytes;
  }
  tinyxml2::XMLDocument xml;
  if (xml.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS && xml.RootElement() != nullptr) {
    if (const std::string root = xml.RootElement()->Name();
        root == "robot" || root == "sdf") {  // MuJoCo would take a part of a URDF
      const std::string ending = root == "sdf" ? ".sdf" : ".urdf";
      problems.add({file, root, "", "isn't MJCF", "<mujoco>, or the file's name with " + ending});
      return out;
    }
    Roots(path.parent_path(), problems).check(*xml.RootElement(), file);
    if (!problems.empty()) return out;
  }
  out.names_others = gives_attribute(text, "file");
  auto native = std::make_shared<MjcfFile>();
  std::string reason;
  std::vector<std::string> told;
  native->model = path.empty() ? compile(text, {}, reason, &told) : load_file(path.string(), reason, &told);
  if (!native->model) {
    problems.add({file, "", "", "MuJoCo refuses it: " + reason, "MJCF of MuJoCo " + std::string(mj_versionString())});
    return out;
  }
  const mjModel& model = *native->model;
  for (const std::string& text_of_mujoco : told) warnings.push_back("MuJoCo says: " + text_of_mujoco + " (" + file + ")");
  check_finite(model, file, problems);
  look_for_limits(model, file, warnings, problems);
  const std::string own_name = name_of(model, path);
  out.world.name = speakable(own_name);
  out.world.step_s = model.opt.timestep;
  out.world.gravity = {model.opt.gravity[0], model.opt.gravity[1], model.opt.gravity[2]};
  read_texts(model, file, out.world, warnings);
  Beside beside;
  const std::optional<std::string> more = path.empty() ? std::nullopt : read_file(beside_of(path));
  std::error_code none;
  if (!path.empty() && !more && fs::symlink_status(beside_of(path), none).type() != fs::file_type::not_found)
    problems.add({beside_of(path).string(), "", "", "can't be read", "a file, or none"});
  if (more) beside = read_beside(*more, beside_of(path).string(), out.world.name, problems);
  if (!problems.empty()) return out;
  describe(model, more ? beside_of(path).string() : file, beside, out.world, native->objects, problems);
  if (!beside.world_name.empty()) {
    out.world.name = beside.world_name;
  } else if (out.world.name != own_name) {
    warnings.push_back(
        fmt::format("model {} is called {} here: topics' names carry no blanks, @, ~ and := ({})", own_name, out.world.name, file));
  }
  out.world.plugins.insert(out.world.plugins.end(), beside.plugins.begin(), beside.plugins.end());
  if (out.world.links.empty() && problems.empty()) problems.add({file, "", "", "holds no body", "a <worldbody> with one"});
  out.world.native = std::move(native);
  return out;
}

std::vector<WrittenFile> write_mjcf_files(const description::World& world, const std::string& name, std::string_view file,
                                          Problems& problems) {
  std::vector<WrittenFile> out;
  if (world.native) {
    problems.add({std::string(file), "", "", "is MJCF already", "an SDF or URDF file"});
    return out;
  }
  const std::vector<TreeNode> tree = build_tree(world, file, problems);
  if (!problems.empty()) return out;
  Mjcf mjcf = write_mjcf_file(world, tree, world.step_s, capacity_for(world), name);
  out.push_back({name + ".xml", std::move(mjcf.xml)});
  for (VirtualFile& part : mjcf.parts) out.push_back({part.name, std::move(part.bytes)});
  for (std::size_t h = 0; h < mjcf.heightmaps.size(); ++h) {
    const Heightmap& map = *mjcf.heightmaps[h];
    // MuJoCo spreads what it reads over 0 … 1, so that only a map that has both keeps its heights.
    const auto lowest = std::min_element(map.heights.begin(), map.heights.end());
    if (lowest == map.heights.end() || *lowest != 0 || map.highest() <= 0)
      problems.add({std::string(file), "heightmap", "", "doesn't begin at height 0, which MJCF's would", "a lowest point at 0"});
    std::string bytes;
    const auto put = [&](const auto& value) {
      char raw[sizeof value];
      std::memcpy(raw, &value, sizeof value);
      bytes.append(raw, sizeof value);
    };
    put(static_cast<std::int32_t>(map.rows));
    put(static_cast<std::int32_t>(map.columns));
    for (const double height : map.heights) put(static_cast<float>(height / heightmap_scale(map)));
    out.push_back({fmt::format("{}.h{}.bin", name, h), std::move(bytes)});
  }
  out.push_back({name + ".vsa.xml", write_beside(world)});
  return out;
}

}  // namespace vsa::physics
