// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "vsa/errors.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::host {
namespace {

bool bad_character(char c) { return std::isspace(static_cast<unsigned char>(c)) || c == '@' || c == '~'; }

}  // namespace

std::string topic_scope(std::string_view scoped_name, std::string_view what) {
  std::string out = joined_by(scoped_name, "/");
  const bool empty_part = out.empty() || out.front() == '/' || out.back() == '/' || out.find("//") != std::string::npos;
  const bool forbidden = std::any_of(out.begin(), out.end(), bad_character) || out.find(":=") != std::string::npos;
  if (empty_part || forbidden) {
    throw InputError({"", std::string(what), "'" + std::string(scoped_name) + "'", "can't be a part of a topic's name",
                      "parts joined by ::, none empty, without white space, @, ~ and :="});
  }
  return out;
}

std::string model_topic(std::string_view model, std::string_view leaf) {
  return "/model/" + topic_scope(model, "model") + "/" + std::string(leaf);
}

std::string joint_topic(std::string_view model, std::string_view actuator, std::string_view leaf) {
  return "/model/" + topic_scope(model, "model") + "/joint/" + topic_scope(actuator, "actuator") + "/" + std::string(leaf);
}

}  // namespace vsa::host
