// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/csv.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "record/energy_columns.hpp"
#include "record/number_text.hpp"
#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;

void cell(std::string& line, double value) {
  line += ',';
  put(line, value);
}

std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// The one preset unit of a robot's actuators; none if they differ.
const std::string* common_unit(const RobotInfo& robot) {
  if (robot.actuators.empty()) return nullptr;
  const std::string& first = robot.actuators.front().preset_unit;
  const bool same =
      std::all_of(robot.actuators.begin(), robot.actuators.end(), [&](const auto& a) { return a.preset_unit == first; });
  return same ? &first : nullptr;
}

std::size_t slides(const RobotInfo& robot) {
  return static_cast<std::size_t>(
      std::count_if(robot.actuators.begin(), robot.actuators.end(), [](const auto& a) { return a.linear; }));
}
/// Linear actuators beside others: a column tells which.
bool mixed(const RobotInfo& robot) { return slides(robot) > 0 && slides(robot) < robot.actuators.size(); }

/// All but the preset's and the motors' are the shaft's.
std::string sliding_columns(const std::string& header) {
  const std::size_t preset = header.find("preset_command"), shaft = header.find(",deflection"),
                    motors = header.find(",motor_1_rad");
  const std::string_view all = header;
  return sliding(all.substr(0, preset)) + header.substr(preset, shaft - preset) + sliding(all.substr(shaft, motors - shaft)) +
         header.substr(motors);
}

std::string actuators_header(const RobotInfo& robot) {
  const std::string* unit = common_unit(robot);
  const std::string suffix = unit != nullptr && !unit->empty() ? "_" + std::string(unit_word(*unit)) : "";
  std::string h = "time_s,actuator,shaft_rad,shaft_speed_rad_per_s,equilibrium_command_rad,equilibrium_rad,";
  h += csv_text("preset_command" + suffix) + ',' + csv_text("preset" + suffix);
  h += ",deflection_rad,stiffness_Nm_per_rad,torque_Nm,motor_1_rad,motor_2_rad,current_1_A,current_2_A";
  if (slides(robot) == robot.actuators.size() && !robot.actuators.empty()) h = sliding_columns(h);
  if (mixed(robot)) h += ",shaft_unit";
  if (unit == nullptr && !robot.actuators.empty()) h += ",preset_unit";
  return h + '\n';
}

void actuator_line(std::string& line, const host::ActuatorReading& r, int motors) {
  for (const double value : {r.shaft_rad, r.shaft_speed_rad_per_s, r.equilibrium_command_rad, r.equilibrium_rad, r.preset_command,
                             r.preset, r.deflection_rad, r.stiffness_Nm_per_rad, r.torque_Nm}) {
    cell(line, value);
  }
  for (const auto& pair : {r.motor_rad, r.current_A}) {
    cell(line, pair[0]);
    if (motors > 1) {
      cell(line, pair[1]);
    } else {
      line += ',';
    }
  }
}

std::string energy_header() {
  std::string h = "time_s";
  for (const EnergyColumn& c : kEnergyColumns) h += ',' + std::string(c.name) + "_J";
  return h + '\n';
}

constexpr std::string_view kLinksHeader = "time_s,link,x_m,y_m,z_m,qw,qx,qy,qz\n";

}  // namespace

std::string file_stem(std::string_view model) {
  std::string out;
  for (std::size_t i = 0; i < model.size(); ++i) {
    const char c = model[i];
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || (c == '.' && i > 0);
    if (c == ':' && i > 0 && model[i - 1] == ':') continue;  // one '_' for "::"
    out += plain ? c : '_';
  }
  return out.empty() ? "robot" : out;
}

struct CsvFiles::Impl {
  DirectoryLock lock;
  struct Robot {
    std::vector<std::string> names;  // quoted
    std::vector<int> motors;
    std::vector<std::string> units;  // filled where the robot mixes laws
  };
  std::vector<Robot> robots;
  std::vector<std::pair<std::size_t, std::string>> links;  // index, quoted name
  std::vector<OutputFile> files;                           // one per robot, then links, energy
  std::vector<std::string> headers;
  std::string text, time;  // reused

  void add_robot(const RobotInfo& info) {
    Robot r;
    for (const ActuatorInfo& a : info.actuators) {
      r.names.push_back(csv_text(a.name));
      r.motors.push_back(a.motors);
      std::string units = mixed(info) ? (a.linear ? ",m" : ",rad") : "";
      if (common_unit(info) == nullptr) units += ',' + csv_text(a.preset_unit);
      r.units.push_back(std::move(units));
    }
    robots.push_back(std::move(r));
    headers.push_back(actuators_header(info));
  }

  void write_robot(std::size_t index, const Sample& sample, std::size_t first) {
    text.clear();
    const Robot& robot = robots[index];
    for (std::size_t i = 0; i < robot.names.size(); ++i) {
      text += time + ',' + robot.names[i];
      actuator_line(text, sample.actuators[first + i], robot.motors[i]);
      text += robot.units[i];
      text += '\n';
    }
    files[index].append(text);
  }

  void write_links(const Sample& sample) {
    text.clear();
    for (const auto& [index, name] : links) {
      text += time + ',' + name;
      for (const double v : sample.poses[index].position) cell(text, v);
      for (const double v : sample.poses[index].quaternion) cell(text, v);
      text += '\n';
    }
    files[robots.size()].append(text);
  }

  void write_energy(const Sample& sample) {
    text = time;
    for (const EnergyColumn& c : kEnergyColumns) {
      const double value = c.value(sample);
      std::isnan(value) ? void(text += ',') : cell(text, value);
    }
    text += '\n';
    files[robots.size() + 1].append(text);
  }
};

CsvFiles::CsvFiles(const RunInfo& info, const fs::path& directory, const std::vector<std::string>& others)
    : impl_(std::make_unique<Impl>()) {
  std::error_code error;
  fs::create_directories(directory, error);
  // "File exists" and friends differ between systems; say what matters.
  std::error_code ignored;
  if (fs::exists(directory, ignored) && !fs::is_directory(directory, ignored)) {
    throw InputError(Problem{directory.string(), "", "", "can't record there: it is a file, not a directory", ""});
  }
  if (error) throw InputError(Problem{directory.string(), "", "", "can't make the directory: " + error.message(), ""});

  impl_->lock = DirectoryLock(directory, "another run is recording there");

  std::vector<std::string> names;
  for (const RobotInfo& robot : info.robots) {
    std::string stem = file_stem(robot.model) + "_actuators";
    for (int n = 2; std::find(names.begin(), names.end(), stem + ".csv") != names.end(); ++n) {
      stem = file_stem(robot.model) + "_" + std::to_string(n) + "_actuators";
    }
    names.push_back(stem + ".csv");
    impl_->add_robot(robot);
  }
  names.insert(names.end(), {"links.csv", "energy.csv"});
  impl_->headers.insert(impl_->headers.end(), {std::string(kLinksHeader), energy_header()});
  for (std::size_t i = 0; i < info.links.size(); ++i) {
    if (!info.links[i].is_static) impl_->links.emplace_back(i, csv_text(info.links[i].name));
  }

  Problems problems;
  const auto can_be_opened = [&](const std::string& name) {
    try {
      static_cast<void>(OutputFile(directory / name, OutputFile::Begin::as_it_is));
    } catch (const RecordError& e) {
      problems.add({"", "", "", e.what(), ""});
    }
  };
  for (const std::string& name : names) can_be_opened(name);
  for (const std::string& name : others) can_be_opened(name);
  problems.throw_if_any();
  for (std::size_t i = 0; i < names.size(); ++i) {
    impl_->files.emplace_back(directory / names[i]);
    impl_->files.back().append(impl_->headers[i]);
  }
}

CsvFiles::~CsvFiles() = default;

void CsvFiles::write(const Sample& sample) {
  impl_->time.clear();
  put(impl_->time, seconds_of(sample.time_ns));
  std::size_t first = 0;
  for (std::size_t i = 0; i < impl_->robots.size(); ++i) {
    impl_->write_robot(i, sample, first);
    first += impl_->robots[i].names.size();
  }
  impl_->write_links(sample);
  impl_->write_energy(sample);
}

void CsvFiles::restart() {
  for (std::size_t i = 0; i < impl_->files.size(); ++i) {
    impl_->files[i].restart();
    impl_->files[i].append(impl_->headers[i]);
  }
}

void CsvFiles::close() {
  for (OutputFile& f : impl_->files) f.close();
}

void CsvFiles::release() noexcept { impl_->lock = {}; }

std::vector<fs::path> CsvFiles::files() const {
  std::vector<fs::path> out;
  for (const OutputFile& f : impl_->files) out.push_back(f.path());
  return out;
}

}  // namespace vsa::record
