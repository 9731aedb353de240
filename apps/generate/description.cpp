// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"

namespace vsa::generate {
namespace {

/// One table, in which everything that is asked for must be there, and nothing else.
class Section : public config::TomlSection {
 public:
  Section(const std::string& file, const std::string& name, const toml::table* table, Problems& problems)
      : TomlSection(table, file, name + ".", problems), given_(table != nullptr) {
    if (!given_) problems.add({file, name, "", "the table is missing", ""});
  }
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  ~Section() { refuse_others(); }

  double number(const char* key, double min, double max) {
    return asked(key, min, max).TomlSection::number(key, min, max).value_or(min);
  }
  int integer(const char* key, int min, int max) {
    return static_cast<int>(asked(key, min, max).whole(key, min, max).value_or(min));
  }
  /// It goes into XML, which has no control characters.
  std::string text(const char* key) {
    std::string out = (given_ ? need(key, "a name") : *this).TomlSection::text(key).value_or("");
    const bool control = std::any_of(out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    if (control) add(key, "", "has a control character", "a name");
    return control ? "" : out;
  }
  std::uint32_t seed(const char* key) {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(asked(key, 0, kMost).whole(key, 0, kMost).value_or(0));
  }
  std::vector<double> numbers(const char* key, double min, double max) {
    return asked(key, min, max).TomlSection::numbers(key, min, max);
  }
  std::array<double, 2> pair(const char* key, double min, double max) {
    const auto values = numbers(key, min, max);
    if (values.size() == 2) return {values[0], values[1]};
    add(key, "", "not two numbers", config::range_text(min, max));
    return {min, max};
  }
  Range range(const char* key, double min, double max) {
    const Range out = pair(key, min, max);
    if (out[0] > out[1]) add(key, pair_text(out), "the first is above the second", "from … to");
    return out;
  }
  Size size(const char* key, double min, double max) {
    const auto values = numbers(key, min, max);
    if (values.size() == 3) return {values[0], values[1], values[2]};
    add(key, "", "not three numbers", config::range_text(min, max));
    return {min, min, min};
  }
  /// A range in which something changes from one end to the other.
  Range span(const char* key, double min, double max) {
    const Range out = range(key, min, max);
    if (out[0] == out[1]) add(key, pair_text(out), "nothing is between the two", "from … to");
    return out;
  }

 private:
  static std::string pair_text(const std::array<double, 2>& p) {
    return '[' + config::number_text(p[0]) + ", " + config::number_text(p[1]) + ']';
  }
  TomlSection& asked(const char* key, double min, double max) { return given_ ? need(key, config::range_text(min, max)) : *this; }

  bool given_;
};

BenchSpec read_bench(Section& s) {
  return {s.number("height_m", 0.05, 10), s.number("load_mass_kg", 1e-3, 100), s.number("load_lever_m", 1e-3, 10),
          s.number("load_radius_m", 1e-3, 1), s.number("load_length_m", 1e-3, 1)};
}

void read_frank(const std::string& file, const toml::table* table, Problems& problems, FrankSpec& f) {
  Section s(file, "frank", table, problems);
  f.toe_in_deg = s.number("toe_in_deg", 0, 60);
  f.shoulder_height_m = s.number("shoulder_height_m", 0.1, 3);
  f.shoulder_half_width_m = s.number("shoulder_half_width_m", 0.05, 1);
  f.upper_arm_m = s.number("upper_arm_m", 0.05, 1);
  f.forearm_m = s.number("forearm_m", 0.05, 1);
  f.torso_mass_kg = s.number("torso_mass_kg", 0.01, 100);
  f.torso_size_m = s.size("torso_size_m", 0.01, 1);
  f.head_pan_height_m = s.number("head_pan_height_m", 0.1, 3);
  f.head_tilt_m = s.number("head_tilt_m", 0.01, 1);
  f.head_mass_kg = s.number("head_mass_kg", 0.01, 10);
  f.head_size_m = s.size("head_size_m", 0.01, 1);
  f.stand_mass_kg = s.number("stand_mass_kg", 0.1, 100);
  f.stand_size_m = s.size("stand_size_m", 0.005, 2);
  f.foot_radius_m = s.number("foot_radius_m", 1e-3, 0.1);
  f.initial_preset_rad = s.number("initial_preset_rad", 0, 0.785);
  f.bus = s.text("bus");
}

void read_grasping(const std::string& file, const toml::table& root, Problems& problems, Description& d) {
  {
    Section s(file, "gripper", root["gripper"].as_table(), problems);
    d.gripper = {s.number("opening_m", 0.005, 0.1), s.number("approach_m", 0, 0.01),     s.number("pad_at_m", 0.05, 0.3),
                 s.size("pad_size_m", 1e-3, 0.2),   s.number("finger_mass_kg", 1e-3, 1), s.number("friction", 0, 10)};
  }
  {
    Section s(file, "table", root["table"].as_table(), problems);
    d.table = {s.number("reach_m", 0.05, 1),        s.number("top_height_m", 0.02, 2),     s.number("size_m", 0.02, 1),
               s.number("baton_mass_kg", 0.01, 10), s.number("baton_across_m", 0.01, 0.1), s.number("baton_height_m", 0.02, 1)};
  }
  {
    Section s(file, "pendulum", root["pendulum"].as_table(), problems);
    d.pendulum = {s.number("ball_mass_kg", 0.01, 100), s.number("ball_radius_m", 0.005, 0.5), s.number("cord_m", 0.05, 5),
                  s.number("raised_deg", 0, 90), s.number("gap_m", 0, 0.1)};
  }
  {
    Section s(file, "bench_object", root["bench_object"].as_table(), problems);
    d.bench_object = {s.number("stiffness_N_per_m", 1, 1e6), s.number("damping_Ns_per_m", 0, 1e4),
                      s.number("face_mass_kg", 1e-3, 1), s.number("travel_m", 1e-3, 0.1)};
  }
  {
    Section s(file, "manipulator", root["manipulator"].as_table(), problems);
    d.manipulator = {s.number("base_height_m", 0.05, 1),
                     s.number("shoulder_m", 0.07, 1),
                     s.number("upper_arm_m", 0.05, 1),
                     s.number("forearm_m", 0.05, 1),
                     s.number("tip_mass_kg", 1e-3, 10),
                     s.number("initial_preset_rad", 0, 0.785),
                     s.text("bus")};
  }
}

void read_robots(const std::string& file, const toml::table& root, Problems& problems, Description& d) {
  const auto table = [&](const char* name) { return root[name].as_table(); };
  {
    Section s(file, "module", table("module"), problems);
    d.module = {s.number("edge_m", 0.01, 1),
                s.number("mass_kg", 0.01, 100),
                s.number("flange_mass_kg", 1e-3, 10),
                s.number("flange_radius_m", 1e-3, 1),
                s.number("flange_thickness_m", 1e-3, 1),
                s.number("chamfer_m", 1e-4, 0.1),
                s.number("contact_radius_m", 1e-3, 1),
                s.number("friction", 0, 10),
                s.number("bracket_mass_kg", 1e-3, 1)};
    if (d.module.flange_mass_kg >= d.module.mass_kg) s.add("flange_mass_kg", "", "not less than mass_kg, which includes it", "");
  }
  {
    Section s(file, "actuator", table("actuator"), problems);
    d.actuator = {s.text("type"), s.text("plugin_file"), s.number("initial_preset_rad", 0, 0.785),
                  static_cast<double>(s.integer("baud_Hz", 1200, 100'000'000)), s.number("state_rate_Hz", 1, 1000)};
    const auto types = config::TypeLibrary().names();
    if (!d.actuator.type.empty() && std::find(types.begin(), types.end(), d.actuator.type) == types.end())
      s.add("type", d.actuator.type, "no such actuator type", fmt::format("{}", fmt::join(types, ", ")));
  }
  for (const auto& [name, bench] : {std::pair{"bench", &d.bench}, std::pair{"throw", &d.throwing}}) {
    Section s(file, name, table(name), problems);
    *bench = read_bench(s);
  }
  {
    Section s(file, "pole", table("pole"), problems);
    d.pole = {read_bench(s), s.number("mass_kg", 1e-3, 10), s.number("radius_m", 1e-3, 0.1), s.number("length_m", 0.05, 10)};
  }
  {
    Section s(file, "snake", table("snake"), problems);
    d.snake.modules = s.integer("modules", 2, 100);
    d.snake.pitch_m = s.number("pitch_m", 0.01, 1);
    d.snake.tail_mass_kg = s.number("tail_mass_kg", 0.01, 100);
    d.snake.initial_preset_rad = s.number("initial_preset_rad", 0, 0.785);
    d.snake.clearance_m = s.number("clearance_m", 0, 0.1);
    d.snake.bus = s.text("bus");
  }
}

void read_hills(const std::string& file, const toml::table& root, Problems& problems, HillsSpec& hills) {
  Section s(file, "hills", root["hills"].as_table(), problems);
  hills.samples = s.integer("samples", 3, 4097);
  if (const int cells = hills.samples - 1; (cells & (cells - 1)) != 0)
    s.add("samples", "", "not a power of two plus one", "129, 257, 513 …");
  hills.size_m = s.number("size_m", 1, 1000);
  hills.flat_radius_m = s.span("flat_radius_m", 0, 100);
  const auto waves = s.tables("waves");
  if (waves.empty()) s.add("waves", "", "missing or empty", "a list of waves");
  for (std::size_t i = 0; i < waves.size(); ++i) {
    Section w(file, "hills.waves[" + std::to_string(i) + "]", waves[i], problems);
    hills.waves.push_back({w.number("height_m", 0, 10), w.number("wavelength_m", 0.1, 1000), w.number("direction_deg", -360, 360),
                           w.number("phase_deg", -360, 360)});
  }
}

void read_world(const std::string& file, const toml::table& root, Problems& problems, Description& d) {
  {
    Section s(file, "world", root["world"].as_table(), problems);
    d.world = {s.number("step_s", 1e-5, 4e-3), s.number("gravity_m_per_s2", 0, 100)};
  }
  {
    Section s(file, "rubble", root["rubble"].as_table(), problems);
    d.rubble.seed = s.seed("seed");
    d.rubble.boxes = s.integer("boxes", 0, 1000);
    d.rubble.height_m = s.range("height_m", 1e-3, 1);
    d.rubble.side_m = s.range("side_m", 1e-3, 10);
    d.rubble.steps_m = s.numbers("steps_m", 1e-3, 1);
    d.rubble.step_size_m = s.pair("step_size_m", 1e-2, 100);
    d.rubble.step_gap_m = s.number("step_gap_m", 0, 100);
    d.rubble.travel_deg = s.number("travel_deg", -360, 360);
    d.rubble.patch_from_m = s.number("patch_from_m", 0, 100);
    d.rubble.patch_size_m = s.pair("patch_size_m", 0.1, 100);
  }
  read_hills(file, root, problems, d.hills);
}

}  // namespace

Description read_description(const std::filesystem::path& file) {
  const std::string name = file.string();
  Problems problems;
  Description description{};
  const toml::table root = config::parse_toml(file);
  read_robots(name, root, problems, description);
  read_frank(name, root["frank"].as_table(), problems, description.frank);
  read_grasping(name, root, problems, description);
  read_world(name, root, problems, description);
  config::TomlSection top(&root, name, "", problems);
  for (const char* known : {"module", "actuator", "bench", "snake", "frank", "gripper", "table", "pendulum", "bench_object",
                            "throw", "pole", "manipulator", "world", "rubble", "hills"})
    (void)top.find(known);
  top.refuse_others();
  problems.throw_if_any();
  check_shapes(name, description, problems);
  problems.throw_if_any();
  return description;
}

}  // namespace vsa::generate
