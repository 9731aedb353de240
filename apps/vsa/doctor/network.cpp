// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Who hears whom: partition and address of the transports. Debian's and Fortress's read IGN_…, later ones GZ_….
#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <cctype>

#include "doctor/checks.hpp"

namespace vsa::app {
namespace {

/// As the transport asks of a partition (TopicUtils::IsValidPartition).
bool can_be_partition(const std::string& text) {
  const auto bad = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == '@' || c == '~'; };
  return std::none_of(text.begin(), text.end(), bad) && text.find("//") == std::string::npos &&
         text.find(":=") == std::string::npos && text != "/";
}

/// Of interfaces that are up: of another nobody is heard.
std::vector<std::string> addresses() {
  std::vector<std::string> out;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return out;
  for (const ifaddrs* at = list; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET || (at->ifa_flags & IFF_UP) == 0) continue;
    char text[INET_ADDRSTRLEN] = "";
    const auto* in = reinterpret_cast<const sockaddr_in*>(at->ifa_addr);
    if (inet_ntop(AF_INET, &in->sin_addr, text, sizeof text) != nullptr) out.emplace_back(text);
  }
  freeifaddrs(list);
  return out;
}

void check_address(Findings& findings, const char* variable, const std::string& text) {
  in_addr parsed{};
  if (inet_pton(AF_INET, text.c_str(), &parsed) != 1) {
    findings.problem(variable, fmt::format("'{}' is no IPv4 address", text), "127.0.0.1 for this machine alone");
    return;
  }
  const auto mine = addresses();
  const bool loopback = (ntohl(parsed.s_addr) >> 24) == 127;
  if (loopback) {
    findings.ok(variable, text + ": this machine alone");
  } else if (std::find(mine.begin(), mine.end(), text) == mine.end()) {
    findings.problem(variable, text + " is no address of this machine, so nobody is heard",
                     fmt::format("one of {}", fmt::join(mine, ", ")));
  } else {
    findings.note(variable, text + ": who is on that network can command the robots", "127.0.0.1 keeps to this machine");
  }
}

void check_pair(Findings& findings, const char* what, const char* ign, const char* gz) {
  const std::string a = value_of(ign), b = value_of(gz);
  if (!a.empty() && !b.empty() && a != b)
    findings.note(what, fmt::format("{} = {}, but {} = {}", ign, a, gz, b),
                  "vsa and Fortress read the first, later gz-sims the second: give both the same");
}

}  // namespace

void check_network(Findings& findings) {
  if (addresses().empty())
    findings.problem("network", "no network interface is up, so there are no topics", "ip link set lo up, or vsa run --no-topics");
  bool any = false;
  for (const char* variable : {"IGN_PARTITION", "GZ_PARTITION"}) {
    const std::string text = value_of(variable);
    if (text.empty()) continue;
    any = true;
    if (can_be_partition(text)) {
      findings.ok(variable, text + ": only programs with the same are heard");
    } else {
      findings.problem(variable, fmt::format("'{}' can't be a partition", text), "a word without white space, @, ~, // and :=");
    }
  }
  if (!any) findings.ok("partition", "the default: programs of this user on this machine");
  check_pair(findings, "partition", "IGN_PARTITION", "GZ_PARTITION");

  any = false;
  for (const char* variable : {"IGN_IP", "GZ_IP"}) {
    const std::string text = value_of(variable);
    if (text.empty()) continue;
    any = true;
    check_address(findings, variable, text);
  }
  if (!any) findings.ok("address", "IGN_IP and GZ_IP unset: vsa keeps to this machine; a Gazebo listens on the network, too");
  check_pair(findings, "address", "IGN_IP", "GZ_IP");
}

}  // namespace vsa::app
