// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-doctor [WORLD]: the checks of `vsa doctor` without the embedded engine. Exit codes: 0 no problem, 1 a problem, 2 bad usage or
// no such world.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <exception>
#include <iostream>
#include <string_view>

#include "doctor/checks.hpp"
#include "doctor/doctor.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/old_spellings.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

using tinyxml2::XMLElement;

/// Every <plugin name="vsa::Robot"> of the file, wherever; models that it includes aren't opened.
int check_robots(Findings& findings, const XMLElement& e, const std::string& file) {
  int found = 0;
  for (const XMLElement* child = e.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    const char* name = child->Attribute("name");
    if (std::string_view(child->Name()) != "plugin" || name == nullptr || name != config::kPluginName) {
      found += check_robots(findings, *child, file);
      continue;
    }
    ++found;
    tinyxml2::XMLPrinter printer(nullptr, true);
    child->Accept(&printer);
    try {
      const auto robot =
          config::parse_plugin(printer.CStr(), fmt::format("{}:{}", file, child->GetLineNum()), config::TypeLibrary());
      findings.ok("robot", fmt::format("{}:{}: {} actuators", file, child->GetLineNum(), robot.actuators.size()));
    } catch (const InputError& error) {
      for (const Problem& p : error.problems()) findings.problem("robot", p.text(), "mend the element");
    }
  }
  return found;
}

void read_elements(Findings& findings, const std::filesystem::path& file) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS || document.RootElement() == nullptr) {
    findings.problem("world", fmt::format("{}:{}: is not well-formed XML", file.string(), document.ErrorLineNum()),
                     "mend the file");
    return;
  }
  if (const XMLElement* second = document.RootElement()->NextSiblingElement())
    findings.problem(
        "world",
        fmt::format("{}:{}: <{}>: stands outside the file's first element", file.string(), second->GetLineNum(), second->Name()),
        "one a file");
  // <gazebo> was the root until SDF 1.2.
  if (const std::string_view root = document.RootElement()->Name(); root != "sdf" && root != "gazebo")
    throw InputError(Problem{file.string(), "", fmt::format("<{}>", root), "is no SDF, and vsa-doctor reads nothing else",
                             "a file with <sdf>; vsa doctor reads MJCF and URDF, too"});
  if (check_robots(findings, *document.RootElement(), file.string()) == 0)
    findings.note("robot", "no <plugin name=\"vsa::Robot\"> in the file itself", "look at the models that it includes, too");
}

}  // namespace
}  // namespace vsa::app

int main(int argc, char** argv) {
  try {
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (argc > 2 || (!first.empty() && first.front() == '-') || (argc == 2 && first.empty())) {
      std::cerr << "usage: vsa-doctor [WORLD.sdf]\n";
      return first == "--help" && argc == 2 ? vsa::app::kDone : vsa::app::kBadInput;
    }
    vsa::app::tell_old_spellings("vsa-doctor");
    vsa::app::DoctorOptions options;
    options.world = first;
    const int code = vsa::app::run_doctor(options, vsa::app::read_elements);
    vsa::app::see_all_written();
    return code;
  } catch (const vsa::InputError& error) {
    for (const auto& problem : error.problems()) std::cerr << "vsa-doctor: " << problem.text() << '\n';
    return vsa::app::kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "vsa-doctor: " << error.what() << '\n';
    return vsa::app::kFailed;
  }
}
