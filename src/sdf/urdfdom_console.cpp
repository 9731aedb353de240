// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// urdfdom 3 … 4, alone with what only it needs: version 3 brings TinyXML's first version along. It tells by console_bridge, whose
// handler and level belong to the whole process.
#include "sdf/urdfdom_console.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>

namespace vsa::reader {
namespace {

class Listener final : public console_bridge::OutputHandler {
 public:
  explicit Listener(std::vector<UrdfMessage>& said) : said_(said), before_(console_bridge::getLogLevel()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_WARN);
    console_bridge::useOutputHandler(this);
  }
  ~Listener() override {
    console_bridge::restorePreviousOutputHandler();
    console_bridge::setLogLevel(before_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    said_.push_back({level == console_bridge::CONSOLE_BRIDGE_LOG_ERROR, text});
  }

 private:
  std::vector<UrdfMessage>& said_;
  console_bridge::LogLevel before_;
};

}  // namespace

std::shared_ptr<urdf::ModelInterface> parse_urdf(const std::string& xml, std::vector<UrdfMessage>& said) {
  const Listener listener(said);
  try {
    return urdf::parseURDF(xml);
  } catch (const std::exception& error) {
    said.push_back({true, std::string("can't be read: ") + error.what()});
    return nullptr;
  }
}

}  // namespace vsa::reader
