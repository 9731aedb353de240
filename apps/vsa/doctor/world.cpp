// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world: does it load here, has it robots of ours, and what would a Gazebo miss in it.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <optional>

#include "doctor/checks.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/older_plugin.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr double kShortestStep_s = 1e-6,
                 kLongestStep_s = 0.016;  // of a world, and of a robot: engine/world_load.cpp, host/robot.hpp

std::string text_of(const XMLElement& e) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  e.Accept(&printer);
  return printer.CStr();
}

/// Elements of older plug-ins, wherever in the file, in the new spelling.
void check_older(Findings& findings, const XMLElement& e) {
  for (const XMLElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const std::string xml = text_of(*child);
    if (std::string_view(child->Name()) != "plugin") {
      check_older(findings, *child);
    } else if (config::is_older_plugin(xml)) {
      try {
        (void)config::parse_plugin(xml, fmt::format("line {}", child->GetLineNum()), config::TypeLibrary());
      } catch (const InputError& error) {
        for (const Problem& p : error.problems())
          findings.problem("older plug-in", fmt::format("{}: {} {}: {}", p.file, p.key, p.value, p.message), p.allowed);
      }
    }
  }
}

const XMLElement* world_of(const tinyxml2::XMLDocument& document) {
  const XMLElement* root = document.RootElement();
  return root == nullptr ? nullptr : root->FirstChildElement("world");
}

void check_step(Findings& findings, const XMLElement& world) {
  for (const XMLElement* p = world.FirstChildElement("physics"); p != nullptr; p = p->NextSiblingElement("physics")) {
    const XMLElement* step = p->FirstChildElement("max_step_size");
    if (step == nullptr) continue;
    const std::string text(config::trim(step->GetText() == nullptr ? "" : step->GetText()));
    const auto value = config::parse_number(text);
    if (!(value && *value >= kShortestStep_s && *value <= kLongestStep_s))
      findings.problem("time step", fmt::format("<max_step_size> of {} s", value ? fmt::format("{}", *value) : "'" + text + "'"),
                       "a number from 1e-6 to 0.016; it is in seconds: 0.001 is 1 ms");
  }
}

/// gz-sim 6 to 8 add their default systems to a world without a <plugin> only; from 9 on always, but where <gz:policies> say no.
void check_physics_system(Findings& findings, const std::vector<Host>& hosts, const XMLElement& world) {
  bool any = false, physics = false;
  for (const XMLElement* p = world.FirstChildElement("plugin"); p != nullptr; p = p->NextSiblingElement("plugin")) {
    any = true;
    const char* file = p->Attribute("filename");
    physics = physics || (file != nullptr && std::string_view(file).find("physics-system") != std::string_view::npos);
  }
  const bool here = hosts[1].found || hosts[2].found;
  if (!any) {
    findings.ok("gz-sim's physics", "gz-sim adds it with its default systems: the world names none");
  } else if (physics) {
    findings.ok("gz-sim's physics", "is among the world's systems");
  } else {
    const std::string text = "not among the world's systems, and gz-sim 6 to 8 add their defaults only to a world without <plugin>";
    const std::string todo = "<plugin filename=\"gz-sim-physics-system\" name=\"gz::sim::systems::Physics\"/>";
    here ? findings.problem("gz-sim's physics", text, todo) : findings.note("gz-sim's physics", text, todo);
  }
}

void check_includes(Findings& findings, const std::vector<Host>& hosts, const XMLElement& world) {
  for (const Host& host : hosts) {
    if (!host.found) continue;
    for (const XMLElement* i = world.FirstChildElement("include"); i != nullptr; i = i->NextSiblingElement("include")) {
      const XMLElement* uri = i->FirstChildElement("uri");
      const std::string text = uri == nullptr || uri->GetText() == nullptr ? "" : std::string(config::trim(uri->GetText()));
      if (text.rfind("model://", 0) != 0) continue;
      bool found = false;
      for (const fs::path& directory : directories_of(host.model_path)) {
        std::error_code none;
        found = found || fs::exists(directory / text.substr(8), none);
      }
      if (!found)
        findings.problem(host.name, text + " isn't on " + host.model_path, ". PREFIX/share/vsa/setup.sh, or add its directory");
    }
  }
}

}  // namespace

void check_world(Findings& findings, const std::vector<Host>& hosts, const std::string& world, LoadingCheck check_loading) {
  const fs::path file = config::find_file(world, "world", "models/worlds", ".sdf");
  check_loading(findings, file);
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS || document.RootElement() == nullptr) return;  // told above
  check_older(findings, *document.RootElement());
  if (const XMLElement* element = world_of(document)) {
    check_step(findings, *element);
    check_physics_system(findings, hosts, *element);
    check_includes(findings, hosts, *element);
  }
}

}  // namespace vsa::app
