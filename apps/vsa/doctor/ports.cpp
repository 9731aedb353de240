// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Serial ports: devices and whether this user may use them, virtual ports that are served or left behind.
#include "vsa/serial/ports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "doctor/checks.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProcessors = "cpu_dma_latency";

std::vector<fs::path> terminals(const fs::path& devices) {
  std::vector<fs::path> found;
  std::error_code none;
  for (fs::directory_iterator at(devices, none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    if (name.rfind("ttyUSB", 0) == 0 || name.rfind("ttyACM", 0) == 0) found.push_back(at->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void check_devices(Findings& findings, const fs::path& devices) {
  const auto found = terminals(devices);
  for (const fs::path& device : found) {
    if (access(device.c_str(), R_OK | W_OK) == 0) {
      findings.ok("serial port", device.string());
    } else if (errno == EACCES) {
      findings.problem("serial port", device.string() + " isn't this user's to open",
                       "sudo usermod -aG dialout $USER, then log in again");
    } else {
      findings.problem("serial port", device.string() + ": " + std::strerror(errno), "plug it in again");
    }
  }
  if (found.empty()) findings.ok("serial port", "no ttyUSB or ttyACM device: no hardware is plugged in");
}

}  // namespace

void check_ports(Findings& findings, const fs::path& devices) {
  check_devices(findings, devices);
  const serial::PortList ports = serial::find_ports();
  if (!ports.virtual_ports.empty()) findings.ok("virtual ports", fmt::format("{}", fmt::join(ports.virtual_ports, ", ")));
  for (const std::string& port : ports.left_behind)
    findings.note("virtual port", port + " was left behind by a program that was killed", "the next one of that name replaces it");
  const fs::path processors = devices / kProcessors;
  if (access(processors.c_str(), W_OK) == 0) {
    findings.ok("--low-latency", processors.string() + " can be opened");
  } else {
    findings.note("--low-latency", fmt::format("{}: {}", processors.string(), std::strerror(errno)),
                  "only --low-latency needs it; the file is root's as a rule");
  }
}

}  // namespace vsa::app
