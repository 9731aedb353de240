// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/run_log.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "record/log_messages.hpp"
#include "record/number_text.hpp"
#include "vsa/errors.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/page/json.hpp"
#include "vsa/record/mcap.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::record {
namespace {

enum Schema : std::size_t { kActuators, kEnergy, kTransforms, kScene };

std::string number(double value) {
  std::string text;
  put(text, value);
  return text;
}

McapMetadata metadata(const RunInfo& info, double rate_Hz) {
  return {"vsasim.run",
          {{"version", VSA_VERSION},
           {"world", info.world},
           {"step_s", number(info.step_s)},
           {"rate_Hz", number(rate_Hz)},
           {"faults", info.faults.empty() ? "none" : info.faults}}};
}

}  // namespace

struct RunLog::Impl {
  RunInfo info;
  std::vector<LogLink> moving, still;
  McapWriter file;
  bool first = true;  // the message under way is the first of the file
  std::string text;   // reused

  Impl(const RunInfo& i, const std::filesystem::path& path, double rate_Hz) : info(i), file(path, contents(i, rate_Hz)) {
    for (std::size_t n = 0; n < info.links.size(); ++n) {
      (info.links[n].is_static ? still : moving).push_back({n, page::json_string(info.links[n].name)});
    }
  }

  // Channels: one per robot, then these.
  [[nodiscard]] std::size_t energy() const { return info.robots.size(); }
  [[nodiscard]] std::size_t links() const { return energy() + 1; }
  [[nodiscard]] std::size_t static_links() const { return energy() + 2; }
  [[nodiscard]] std::size_t shapes() const { return energy() + 3; }

  static McapContents contents(const RunInfo& info, double rate_Hz) {
    McapContents c{"vsasim " VSA_VERSION,
                   {{"vsasim.ActuatorStates", actuators_schema()},
                    {"vsasim.Energy", energy_schema()},
                    {"foxglove.FrameTransforms", transforms_schema()},
                    {"foxglove.SceneUpdate", scene_schema()}},
                   {}};
    for (const RobotInfo& robot : info.robots) {
      McapMap types;
      for (const ActuatorInfo& a : robot.actuators) types.emplace_back(a.name, a.type);
      c.channels.push_back({kActuators, unused(c, "/model/" + joined_by(robot.model, "/"), "/actuators"), types});
    }
    const std::string world = "/world/" + joined_by(info.world, "/");
    c.channels.push_back({kEnergy, world + "/energy"});
    c.channels.push_back({kTransforms, world + "/links"});
    c.channels.push_back({kTransforms, world + "/static_links"});
    c.channels.push_back({kScene, world + "/shapes"});
    c.metadata.push_back(metadata(info, rate_Hz));
    return c;
  }

  /// A model with two robots gets "/actuators" and "/actuators_2".
  static std::string unused(const McapContents& c, const std::string& model, const std::string& what) {
    std::string topic = model + what;
    const auto taken = [&](const McapChannel& other) { return other.topic == topic; };
    for (int n = 2; std::any_of(c.channels.begin(), c.channels.end(), taken); ++n) topic = model + what + "_" + std::to_string(n);
    return topic;
  }

  void write_once(const Sample& sample) {
    transforms_message(text, sample.time_ns, still, sample.poses);
    file.write(static_links(), sample.time_ns, text);
    file.write(shapes(), sample.time_ns, scene_message(sample.time_ns, info.links));
  }
};

RunLog::RunLog(const RunInfo& info, const std::filesystem::path& directory, double rate_Hz) {
  try {
    impl_ = std::make_unique<Impl>(info, directory / kFile, rate_Hz);
  } catch (const RecordError& e) {
    throw InputError(Problem{"", "", "", e.what(), ""});
  }
}

RunLog::~RunLog() = default;

void RunLog::write(const Sample& sample) {
  Impl& log = *impl_;
  if (std::exchange(log.first, false)) log.write_once(sample);
  std::span<const host::ActuatorReading> readings = sample.actuators;
  for (std::size_t i = 0; i < log.info.robots.size(); ++i) {
    const RobotInfo& robot = log.info.robots[i];
    actuators_message(log.text, sample.time_ns, robot, readings.first(robot.actuators.size()));
    readings = readings.subspan(robot.actuators.size());
    log.file.write(i, sample.time_ns, log.text);
  }
  energy_message(log.text, sample);
  log.file.write(log.energy(), sample.time_ns, log.text);
  transforms_message(log.text, sample.time_ns, log.moving, sample.poses);
  log.file.write(log.links(), sample.time_ns, log.text);
}

void RunLog::restart() {
  impl_->file.restart();
  impl_->first = true;
}

void RunLog::close() { impl_->file.close(); }

const std::filesystem::path& RunLog::file() const noexcept { return impl_->file.path(); }

}  // namespace vsa::record
